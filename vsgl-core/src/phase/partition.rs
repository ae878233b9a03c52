//! Exact partition of the texels into clusters: greedy, best first, two by two.
//!
//! Start with the texels of each map as one set. Again and again, split the set of greatest [`Statistics::priority`] at
//! the weighted mean of its widest feature. Every texel with weight ends in exactly one set, so that energy is kept
//! exactly.
//!
//! Order of summation, the same for every backend: texel `i` of a set is added to lane `i % 16`; the lanes are then
//! added pairwise, `i` and `i + 8`, `i` and `i + 4` and so on.

use crate::data::Rsm;

/// Number of features of a texel.
pub const FEATURES: usize = 6;
/// Lanes of the sums over a set.
pub const LANES: usize = 16;
/// How much a unit normal counts beside a position in units of the map's spread.
pub const NORMAL_SCALE: f32 = 0.35;

/// Features of a texel: position relative to `centre` in units of `spread`, and the normal scaled.
pub fn features(rsm: &Rsm, texel: usize, centre: [f32; 3], spread: f32) -> [f32; FEATURES] {
    let [x, y, z, _] = rsm.position[texel];
    let [nx, ny, nz, _] = rsm.normal[texel];
    let scale = 1.0 / spread.max(f32::MIN_POSITIVE);
    [
        (x - centre[0]) * scale,
        (y - centre[1]) * scale,
        (z - centre[2]) * scale,
        nx * NORMAL_SCALE,
        ny * NORMAL_SCALE,
        nz * NORMAL_SCALE,
    ]
}

/// Adds lanes pairwise.
#[inline(always)]
pub fn add_lanes(lanes: &[f32; LANES]) -> f32 {
    let mut sums = *lanes;
    let mut half = LANES / 2;
    while half > 0 {
        for i in 0..half {
            sums[i] += sums[i + half];
        }
        half /= 2;
    }
    sums[0]
}

/// What decides whether and where a set is split.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// Sum of weights.
    pub weight: f32,
    /// Weighted sum of squared deviations, all features: what a split may lessen.
    pub priority: f32,
    /// The widest feature.
    pub axis: usize,
    /// Its weighted mean: texels at most this go to the first half.
    pub threshold: f32,
}

impl Statistics {
    /// From the mean of each feature and the weighted squared deviations from it.
    pub fn new(weight: f32, mean: &[f32; FEATURES], deviation: &[f32; FEATURES]) -> Self {
        let mut axis = 0;
        let mut priority = deviation[0];
        for i in 1..FEATURES {
            axis = if deviation[i] > deviation[axis] {
                i
            } else {
                axis
            };
            priority += deviation[i];
        }
        Self {
            weight,
            priority,
            axis,
            threshold: mean[axis],
        }
    }
}
