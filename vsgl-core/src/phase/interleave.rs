//! Interleaved shading: which samples take which share of the virtual lights.
//!
//! Of each square of `side` by `side` samples every one takes another share of the lights: every `side²`-th of the list,
//! which neighbours in space follow each other in. Samples of one share are shaded together, so that they read the same lights.
//!
//! Source of the idea: Keller and Heidrich 2001, "Interleaved Sampling".

/// Samples of one share are shaded in tiles of so many samples along a side, which is sixteen lanes: rays from a tile to one
/// light stay closer to each other than those of a row.
pub const TILE: u32 = 4;

/// The samples of a picture in the order in which they are shaded.
///
/// With a `side` of 1 that is row by row, and every sample takes all lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shares {
    /// Shares along a side: 1, 2, 4 or 8.
    pub side: u32,
    /// Samples in a row of the picture.
    pub width: u32,
    /// Its rows.
    pub height: u32,
}

impl Shares {
    /// Number of shares, which is also how far apart the lights of a share are in the list of lights.
    pub fn count(&self) -> u32 {
        self.side * self.side
    }

    /// The share of the sample in column `x` and row `y`: the number of its first light.
    pub fn share(&self, x: u32, y: u32) -> u32 {
        x % self.side + self.side * (y % self.side)
    }

    /// Tiles in a row, and rows of tiles, of the samples of one share.
    fn tiles(&self) -> (u32, u32) {
        let tile = self.side * TILE;
        (self.width.div_ceil(tile), self.height.div_ceil(tile))
    }

    /// Number of indices of [`Shares::sample`]; those of one share follow each other.
    pub fn indices(&self) -> u32 {
        if self.side == 1 {
            return self.width * self.height;
        }
        let (columns, rows) = self.tiles();
        self.count() * (columns * rows * (TILE * TILE))
    }

    /// Column and row of the sample with an index; outside the picture where its tile is not full.
    pub fn sample(&self, index: u32) -> (u32, u32) {
        if self.side == 1 {
            return (index % self.width, index / self.width);
        }
        let (columns, rows) = self.tiles();
        let each = columns * rows * (TILE * TILE);
        let share = index / each;
        let within = index % each;
        let tile = within / (TILE * TILE);
        let place = within % (TILE * TILE);
        let x = tile % columns * TILE + place % TILE;
        let y = tile / columns * TILE + place / TILE;
        (
            x * self.side + share % self.side,
            y * self.side + share / self.side,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sample_has_one_index_and_tiles_one_share() {
        for side in [1, 2, 4, 8] {
            for (width, height) in [(1, 1), (48, 27), (64, 36), (17, 1), (3, 65), (16, 16)] {
                let shares = Shares {
                    side,
                    width,
                    height,
                };
                let mut seen = vec![0; (width * height) as usize];
                let mut first = 0;
                for index in 0..shares.indices() {
                    let (x, y) = shares.sample(index);
                    if index % (TILE * TILE) == 0 {
                        first = shares.share(x, y);
                    }
                    assert_eq!(shares.share(x, y), first, "side {side}, {width}x{height}");
                    if x < width && y < height {
                        seen[(y * width + x) as usize] += 1;
                    }
                }
                assert!(
                    seen.iter().all(|&n| n == 1),
                    "side {side}, {width}x{height}"
                );
            }
        }
        let rows = Shares {
            side: 1,
            width: 7,
            height: 3,
        };
        assert!((0..rows.indices()).all(|i| rows.sample(i) == (i % 7, i / 7)));
    }
}
