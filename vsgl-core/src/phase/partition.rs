//! Exact partition of the texels into clusters: greedy, best first, two by two.
//!
//! Start with the lit texels of each map as one set. Again and again, split the set of greatest
//! [`Statistics::priority`] at the weighted mean of its widest feature. Every texel with weight ends in exactly one set,
//! so that energy is kept exactly.
//!
//! Best-first splitting takes the sets of greatest priority, where a set counts at most as much as those that it came
//! from: its *rank*. So the same sets can be found in rounds. A round looks for the sets that would be split first, by
//! descending rank and then by ascending index, as many as there are clusters wanted beyond the lit maps; it splits all of
//! them that are not split yet. It is over when a round has none left to split.
//!
//! What every backend keeps, since each rounding and each place counts:
//! - *Texels* lie in one list, the sets are ranges of it. At first the list holds the lit texels of all maps in ascending
//!   order. A split is stable: texels up to the threshold come to the front of the range, the others to its end, each in
//!   their order before. Clusters are numbered by the start of their range.
//! - *Features* of a range are folded over blocks of [`BLOCK`] texels of the list by halving, those of the blocks over
//!   [`LANES`] lanes: see [`crate::math::fold`].
//! - *Nodes* of the tree: at first one a map, in order, empty ones included. The sets that a round tries to split take two
//!   further indices each, in ascending order of theirs; the two stay empty if all texels fall on one side, and the rank
//!   of the set becomes zero, so that it is never tried again. A round tries no more sets than there is room for in [`nodes`].
//! - There are at most [`rounds`] rounds, so that a GPU can be told all of them beforehand.

/// Texels of a block.
pub const BLOCK: usize = 256;
/// Lanes that blocks are folded on.
pub const LANES: usize = 64;
/// Numbers of a texel's features: position, none, normal, none.
pub const FEATURES: usize = 8;
/// How much a unit normal counts beside a position in units of the map's spread, squared.
pub const NORMAL_SCALE: f32 = 0.35 * 0.35;

/// Most rounds for this many clusters: `4 + 2 ⌈log₂ count⌉`.
///
/// A balanced tree takes `⌈log₂ count⌉`. Eleven scenes with 64² to 1024² texels took no more than 1 (2 clusters), 5 (16),
/// 11 (256), 13 (1024), 20 (4096) and 21 (65,536); allowed are 6, 12, 20, 24, 28 and 36. Where these do not suffice there
/// are fewer clusters than asked for.
pub fn rounds(count: u32) -> u32 {
    4 + 2 * count.next_power_of_two().ilog2()
}

/// Most nodes of the tree for this many clusters and maps: one a map, and four a cluster.
///
/// Each cluster beyond those of the maps takes two; the rest are sets that a round split and that better ones displaced
/// later. The scenes above took up to 2.7.
pub fn nodes(count: u32, maps: u32) -> u32 {
    maps + 4 * count
}

/// Weight, mean and sum of weighted squared deviations of the features of a set: three numbers for the position \[m\], a
/// zero, three for the unit normal, a zero.
///
/// Source: Chan, Golub and LeVeque 1979, "Updating Formulae and a Pairwise Algorithm for Computing Sample Variances",
/// equation 2.1; as [`crate::math::moments`], with the axes apart.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Features {
    /// Sum of weights \[W\].
    pub weight: f32,
    /// Weighted mean.
    pub mean: [f32; FEATURES],
    /// Sum of `weight · (feature − mean)²`.
    pub deviation: [f32; FEATURES],
}

impl Features {
    /// One texel: xyz position \[m\]; weight \[W\]; xyz unit normal; zero.
    #[inline(always)]
    pub fn texel(texel: &[f32; FEATURES]) -> Self {
        let [x, y, z, weight, nx, ny, nz, _] = *texel;
        Self {
            weight,
            mean: [x, y, z, 0.0, nx, ny, nz, 0.0],
            deviation: [0.0; FEATURES],
        }
    }

    /// Two sets together.
    #[inline(always)]
    pub fn merge(self, other: Self) -> Self {
        let total = self.weight + other.weight;
        let share = other.weight / total.max(f32::MIN_POSITIVE);
        let factor = self.weight * share;
        let mut merged = Self {
            weight: total,
            ..self
        };
        for i in 0..FEATURES {
            let apart = other.mean[i] - self.mean[i];
            merged.mean[i] = self.mean[i] + apart * share;
            merged.deviation[i] =
                (self.deviation[i] + other.deviation[i]) + (apart * apart) * factor;
        }
        merged
    }

    /// What squared deviations of positions are multiplied by: one over the variance of positions \[1/m²\]. Taken from the
    /// whole map.
    #[inline(always)]
    pub fn scale(&self) -> f32 {
        let spread = (self.deviation[0] + self.deviation[1]) + self.deviation[2];
        1.0 / (spread / self.weight.max(f32::MIN_POSITIVE)).max(f32::MIN_POSITIVE)
    }
}

/// What decides whether and where a set is split.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Weighted sum of squared deviations, all features: what a split may lessen.
    pub priority: f32,
    /// The widest feature.
    pub axis: usize,
    /// Its weighted mean: texels at most this go to the first half.
    pub threshold: f32,
}

impl Statistics {
    /// From the features of a set and [`Features::scale`] of its map.
    #[inline(always)]
    pub fn new(set: &Features, scale: f32) -> Self {
        let mut statistics = Self::default();
        let mut widest = 0.0;
        for i in 0..FEATURES {
            let unit = if i < 4 { scale } else { NORMAL_SCALE };
            let width = set.deviation[i] * unit;
            statistics.priority += width;
            if width > widest {
                widest = width;
                statistics.axis = i;
                statistics.threshold = set.mean[i];
            }
        }
        statistics
    }
}
