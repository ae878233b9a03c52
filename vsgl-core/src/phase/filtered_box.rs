//! Clusters by filtered importance sampling with square kernels: a square of texels around each centre, as large as it must
//! be to hold the kernel's share of the density.
//!
//! A square has sharp edges, where a trilinear kernel of the same mass is two to three times as wide. Its texels are the
//! *cells* that it touches, each with the share of it that is covered. Squares of more than [`CELLS`] texels along a side
//! take cells of a coarser level of the pyramid, so that a kernel never has more than `(CELLS + 2)²` of them.
//!
//! How many texels all squares cover together: a point of the map lies in about four of them at most. Of the squares around
//! centres in one quadrant as seen from the point, the one whose centre is farthest covers all the other centres, and holds
//! no more than `overlap / count` of the density, in which about `overlap` centres are drawn. So the sum is about
//! `4 overlap` maps at most however uneven the density is, and a few texels a kernel beside it; built-in scenes have less
//! than one.

use super::cluster::Sum;
use super::pdf::top_level;
use crate::data::Pdf;
use crate::math::elementary::exp;
use crate::math::fold;

/// Most cells along the side of a square, two that are touched only apart.
pub const CELLS: f32 = 32.0;
/// Lanes that the cells of a square are folded on.
pub const LANES: usize = 32;
/// Binary logarithm of the least side, in texels.
pub const LEAST: f32 = -4.0;

/// A cluster drawn from the density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Square {
    /// The map that it lies in.
    pub map: u32,
    /// Column of the centre in texels of level 0.
    pub x: f32,
    /// Row of the centre in texels of level 0.
    pub y: f32,
    /// Texels of level 0 along a side. What lies outside the map is cut off.
    pub side: f32,
    /// What the fluxes of the texels in it are multiplied by.
    pub scale: f32,
}

/// The cells that a square touches, row by row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cells {
    /// Level of the pyramid.
    pub level: u32,
    /// First column.
    pub column: u32,
    /// First row.
    pub row: u32,
    /// Cells in a row.
    pub columns: u32,
    /// All of them.
    pub count: u32,
    left: f32,
    right: f32,
    top: f32,
    bottom: f32,
}

impl Cells {
    /// Those of a square of `side` texels around a point of a map of `size` texels along a side.
    pub fn new(size: u32, x: f32, y: f32, side: f32) -> Self {
        let mut level = 0;
        for l in 0..top_level(size) {
            if side > CELLS * (1u32 << l) as f32 {
                level = l + 1;
            }
        }
        let scale = 1.0 / (1u32 << level) as f32;
        let end = (size >> level) as f32;
        let half = 0.5 * side;
        let left = ((x - half) * scale).max(0.0);
        let right = ((x + half) * scale).min(end);
        let top = ((y - half) * scale).max(0.0);
        let bottom = ((y + half) * scale).min(end);
        let (column, columns) = touched(left, right, end);
        let (row, rows) = touched(top, bottom, end);
        Self {
            level,
            column,
            row,
            columns,
            count: columns * rows,
            left,
            right,
            top,
            bottom,
        }
    }

    /// Column and row of a cell, and how much of it is covered.
    pub fn at(&self, index: u32) -> (u32, u32, f32) {
        let column = self.column + index % self.columns;
        let row = self.row + index / self.columns;
        let along = covered(self.left, self.right, column as f32);
        let down = covered(self.top, self.bottom, row as f32);
        (column, row, along * down)
    }
}

/// The first cell that an interval touches, and how many it does.
fn touched(low: f32, high: f32, end: f32) -> (u32, u32) {
    let first = low.floor().min(end - 1.0);
    let past = high.ceil().min(end);
    (first as u32, (past - first).max(1.0) as u32)
}

/// How much of a cell an interval covers.
fn covered(low: f32, high: f32, cell: f32) -> f32 {
    (high.min(cell + 1.0) - low.max(cell)).max(0.0)
}

/// Weight of the texels in a square \[W\].
fn mass(pdf: &Pdf, map: u32, cells: &Cells) -> f32 {
    let mut lanes = [0.0; LANES];
    for index in 0..cells.count {
        let (column, row, share) = cells.at(index);
        let lane = &mut lanes[index as usize % LANES];
        *lane += share * pdf.at(map, cells.level, column, row);
    }
    fold::halve(&mut lanes, |a, b| a + b).unwrap_or_default()
}

/// The square around a point that holds `overlap / count` of the map's weight: the logarithm of its side is bisected.
///
/// Its scale gives it `1 / count` of the map's weight, so the sum of all has all of it: equation 5 of Tokuyoshi 2016 for
/// another shape of kernel.
pub fn square(
    pdf: &Pdf,
    map: u32,
    x: f32,
    y: f32,
    count: u32,
    overlap: f32,
    bisections: u32,
) -> Square {
    let total = pdf.total(map);
    let wanted = (overlap / count as f32).min(1.0) * total;
    // Around any point a square of twice the map's side covers all.
    let all = top_level(pdf.size) as f32 + 1.0;
    let (mut low, mut high) = (LEAST, all);
    for _ in 0..bisections {
        let middle = 0.5 * (low + high);
        let held = mass(pdf, map, &Cells::new(pdf.size, x, y, side_of(middle)));
        if held < wanted {
            low = middle
        } else {
            high = middle
        }
    }
    let level = if wanted >= total {
        all
    } else {
        0.5 * (low + high)
    };
    let side = side_of(level);
    let held = mass(pdf, map, &Cells::new(pdf.size, x, y, side));
    let scale = if held > 0.0 {
        total / (count as f32 * held)
    } else {
        0.0
    };
    Square {
        map,
        x,
        y,
        side,
        scale,
    }
}

/// `2^x` for `x` of at least [`LEAST`]: the side of a square in texels from its logarithm.
pub fn side_of(x: f32) -> f32 {
    let whole = x.floor();
    let power = (1u32 << (whole - LEAST) as u32) as f32 * 0.0625;
    power * exp((x - whole) * std::f32::consts::LN_2)
}

/// The sum over a square: cells of the pyramid `at(level, column, row)`, each by its share, merged on [`LANES`] lanes.
pub fn sum(size: u32, square: &Square, at: impl Fn(u32, u32, u32) -> Sum) -> Sum {
    let cells = Cells::new(size, square.x, square.y, square.side);
    let mut lanes = [Sum::default(); LANES];
    for index in 0..cells.count {
        let (column, row, share) = cells.at(index);
        let cell = at(cells.level, column, row).scaled(share * square.scale);
        let lane = &mut lanes[index as usize % LANES];
        *lane = if (index as usize) < LANES {
            cell
        } else {
            lane.merge(cell)
        };
    }
    let used = LANES.min(cells.count as usize);
    fold::halve(&mut lanes[..used], Sum::merge).unwrap_or_default()
}

impl Square {
    /// The column of the resource: map, centre, side in texels of level 0.
    pub fn record(&self) -> [f32; 4] {
        [self.map as f32, self.x, self.y, self.side]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phase::pdf::pyramid;

    /// Weights of a map that are as uneven as they can be: most are nothing, some a million times others.
    fn uneven(size: u32) -> Pdf {
        let weight = |i: u32| match (i.wrapping_mul(2_654_435_769) >> 20) % 97 {
            0 => 1e6,
            1..=20 => 1.0,
            _ => 0.0,
        };
        pyramid(size, (0..size * size).map(weight).collect())
    }

    fn held(pdf: &Pdf, square: &Square) -> f32 {
        let cells = Cells::new(pdf.size, square.x, square.y, square.side);
        mass(pdf, square.map, &cells)
    }

    #[test]
    fn on_an_even_density_squares_have_equal_area_and_unit_scale() {
        let pdf = pyramid(64, vec![1.0; 64 * 64]);
        for count in [4, 16, 100, 4096] {
            let s = square(&pdf, 0, 20.3, 41.9, count, 1.0, 24);
            let side = (4096.0 / count as f32).sqrt();
            assert!(
                count < 16 || (s.side / side - 1.0).abs() < 1e-4,
                "{count}: {s:?}"
            );
            assert!((s.scale - 1.0).abs() < 1e-4, "{count}: {s:?}");
        }
        let all = square(&pdf, 0, 1.0, 63.0, 3, 4.0, 12);
        assert_eq!((all.side, all.scale), (128.0, 1.0 / 3.0));
    }

    #[test]
    fn squares_hold_their_share_of_an_uneven_density() {
        let pdf = uneven(128);
        for count in [2, 7, 64, 1000] {
            for (x, y) in [(0.2, 0.7), (64.0, 64.0), (127.9, 3.1), (90.4, 127.5)] {
                let s = square(&pdf, 0, x, y, count, 1.0, 30);
                let share = held(&pdf, &s) * count as f32 / pdf.total(0);
                // A square may be smaller than what f32 resolves of its place.
                assert!(
                    (share - 1.0).abs() < 1e-2 || s.side < 0.1,
                    "{count} {x} {y}: {share}"
                );
                assert!((share * s.scale - 1.0).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn cells_stay_inside_and_cover_the_square() {
        for (x, y, side) in [
            (0.0, 0.0, 0.0625),
            (63.999, 0.2, 3.5),
            (64.0, 64.0, 1.0),
            (31.0, 64.0, 31.9),
            (10.0, 10.0, 40.0),
            (10.0, 10.0, 128.0),
        ] {
            let cells = Cells::new(64, x, y, side);
            let within = 64 >> cells.level;
            let mut area = 0.0;
            for index in 0..cells.count {
                let (column, row, share) = cells.at(index);
                assert!(column < within && row < within && (0.0..=1.0).contains(&share));
                area += share;
            }
            assert!(cells.count as f32 <= (CELLS + 2.0) * (CELLS + 2.0));
            let cut = |c: f32| (c + 0.5 * side).min(64.0) - (c - 0.5 * side).max(0.0);
            let texel = (1u32 << (2 * cells.level)) as f32;
            let wanted = cut(x) * cut(y) / texel;
            assert!(
                (area - wanted).abs() < 1e-3 * wanted.max(1.0),
                "{area} {wanted}"
            );
        }
    }
}
