//! Where a picture is looked at: every texel against every pixel would take hours.

use vsgl_core::math::sobol;

/// Side of the blocks that are compared.
pub(super) const BLOCK: u32 = 8;
/// Of 16 pixels so many are in blocks, the others by themselves all over the picture.
const IN_BLOCKS: usize = 7;

/// The pixels that are looked at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Points {
    /// Columns and rows of pixels that stand for the whole picture; the first in [`Points::pixels`], row by row.
    pub(super) grid: (u32, u32),
    /// How many blocks of 8 by 8 pixels there are beside them, after them in [`Points::pixels`]: row by row of all blocks, which lie
    /// side by side. Zero if the grid is the whole picture.
    pub(super) blocks: u32,
    /// Column and row of each pixel.
    pub(super) pixels: Vec<(u32, u32)>,
}

impl Points {
    /// At most about `most` pixels of a picture: all, or one drawn from each cell of a grid, and whole blocks drawn likewise.
    ///
    /// Drawn, since every so-manieth pixel would have the same share of the virtual lights. More than `most` where the least
    /// number of blocks asks for it.
    pub(super) fn of(width: u32, height: u32, most: usize, seed: u32) -> Self {
        if u64::from(width) * u64::from(height) <= most as u64 {
            let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
            return Self {
                grid: (width, height),
                blocks: 0,
                pixels: pixels.collect(),
            };
        }
        let lattice = (width / BLOCK, height / BLOCK);
        let many = most * IN_BLOCKS / 16 / (BLOCK * BLOCK) as usize;
        let blocks = cells(lattice, many.max(4), sobol::combine(seed, 1)).1;
        let single = most.saturating_sub(blocks.len() * (BLOCK * BLOCK) as usize);
        let (grid, mut pixels) = cells((width, height), single.max(64), sobol::combine(seed, 2));
        for row in 0..BLOCK {
            for &(x, y) in &blocks {
                let start = x * BLOCK;
                pixels.extend((start..start + BLOCK).map(|x| (x, y * BLOCK + row)));
            }
        }
        Self {
            grid,
            blocks: blocks.len() as u32,
            pixels,
        }
    }

    /// Number of pixels of the grid.
    pub(super) fn singles(&self) -> usize {
        self.grid.0 as usize * self.grid.1 as usize
    }
}

/// About `wanted` cells of a lattice, each of about its shape, and one place drawn from each.
fn cells((width, height): (u32, u32), wanted: usize, seed: u32) -> ((u32, u32), Vec<(u32, u32)>) {
    if width == 0 || height == 0 {
        return ((0, 0), Vec::new());
    }
    let shape = f64::from(width) / f64::from(height);
    let columns = ((wanted as f64 * shape).sqrt().round() as u32).clamp(1, width);
    let rows = ((wanted as f64 / f64::from(columns)).round() as u32).clamp(1, height);
    let place = |cell: u32, cells: u32, size: u32, bits: u32| {
        let bound = |c: u32| (u64::from(c) * u64::from(size) / u64::from(cells)) as u32;
        bound(cell) + bits % (bound(cell + 1) - bound(cell))
    };
    let one = |row: u32, column: u32| {
        let bits = sobol::combine(sobol::combine(seed, row), column);
        let x = place(column, columns, width, bits >> 16);
        (x, place(row, rows, height, bits & 0xffff))
    };
    let all = (0..rows).flat_map(|row| (0..columns).map(move |column| one(row, column)));
    ((columns, rows), all.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn small_pictures_are_looked_at_in_full() {
        let points = Points::of(16, 9, 144, 0);
        assert_eq!((points.grid, points.blocks), ((16, 9), 0));
        assert_eq!(points.pixels[17], (1, 1));
        assert_eq!(points.pixels.len(), points.singles());
    }

    #[test]
    fn large_ones_in_a_grid_and_in_whole_blocks() {
        for (width, height) in [(640, 360), (1921, 1), (7, 3000), (100, 100)] {
            let points = Points::of(width, height, 2000, 3);
            let inside = |&(x, y): &(u32, u32)| x < width && y < height;
            assert!(points.pixels.iter().all(inside));
            assert!(points.pixels.len() < 2400, "{}", points.pixels.len());
            let singles: BTreeSet<_> = points.pixels[..points.singles()].iter().collect();
            assert_eq!(singles.len(), points.singles());
            let side = (points.blocks * BLOCK) as usize;
            let rest = &points.pixels[points.singles()..];
            assert_eq!(rest.len(), side * BLOCK as usize);
            for block in 0..points.blocks as usize {
                let (x, y) = rest[block * 8];
                assert_eq!((x % 8, y % 8), (0, 0));
                assert_eq!(rest[7 * side + block * 8 + 7], (x + 7, y + 7));
            }
        }
        let shares: BTreeSet<_> = Points::of(640, 360, 2000, 0)
            .pixels
            .iter()
            .map(|(x, y)| (x % 8, y % 8))
            .collect();
        assert_eq!(shares.len(), 64);
    }
}
