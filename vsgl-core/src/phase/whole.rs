//! One cluster for each map: all of its texels.
//!
//! No density, no samples, no partition: texels are summed up chunk by chunk, chunks map by map. Both steps fold on lanes
//! ([`crate::math::fold::lanes`]), and what has no weight is left out, wherever it lies.
//!
//! Source: Tokuyoshi 2015, "Fast Indirect Illumination Using Two Virtual Spherical Gaussian Lights", section 2.

use super::cluster::{Sum, pick};
use super::pdf::{GOLDEN_TURN, unit};
use crate::data::Rsm;
use crate::math::fold::lanes;
use crate::plan::ClusterPlan;
use std::ops::Range;

/// Texels of a chunk: so many of a map at a time, row by row.
pub const CHUNK: usize = 256;
/// Lanes that texels and chunks are folded on.
pub const LANES: usize = 32;

impl Sum {
    /// As [`Sum::merge`], but what has no weight is left out: a texel without light may lie anywhere.
    pub fn join(self, other: Self) -> Self {
        if other.weight() <= 0.0 {
            self
        } else if self.weight() <= 0.0 {
            other
        } else {
            self.merge(other)
        }
    }

    /// The sum of a chunk of texels.
    pub fn of_chunk(rsm: &Rsm, texels: Range<usize>, plan: &ClusterPlan) -> Self {
        let texel = |i: usize| {
            if rsm.weight(i) > 0.0 {
                Self::texel(rsm, i, plan)
            } else {
                Self::default()
            }
        };
        lanes::<LANES, _>(texels.map(texel), Self::join).unwrap_or_default()
    }

    /// The sum of a map from those of its chunks.
    pub fn of_chunks(chunks: &[Self]) -> Self {
        lanes::<LANES, _>(chunks.iter().copied(), Self::join).unwrap_or_default()
    }
}

/// The texel that a map's shadow ray ends at, drawn by weight: of the first map the one in the middle of the weights, row by
/// row; of the others by a golden-ratio sequence from there. `first` is the first texel of the map, `texels` their number.
pub fn draw(rsm: &Rsm, map: u32, first: usize, texels: usize, chunks: &[Sum]) -> u32 {
    let u = unit(map.wrapping_mul(GOLDEN_TURN).wrapping_add(1 << 31));
    let total = chunks.iter().fold(0.0, |total, c| total + c.weight());
    let (chunk, rest) = pick(chunks.iter().map(Sum::weight), u * total);
    let start = first + chunk * CHUNK;
    let end = (start + CHUNK).min(first + texels);
    let (texel, _) = pick((start..end).map(|t| rsm.weight(t)), rest);
    (start + texel) as u32
}
