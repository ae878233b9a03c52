//! Occlusion by a few rays from each sample, to lights chosen by what they would bring to the eye.
//!
//! With contributions `c_j` in the order of the lights and `C` their sum, the rays of a sample go to the lights at which the
//! running sum passes `(k + ξ)/K · C`, `k` = 0 … K − 1. So light `j` is asked `K c_j/C` times in the mean over `ξ`, and the
//! share of open ones is, in that mean, the share of the light that arrives. Neighbours in the list are neighbours in space,
//! so the choice is spread over space too.
//!
//! Source: systematic sampling, Madow 1949, "On the Theory of Systematic Sampling, II".

use super::interleave::Shares;
use super::pdf::{GOLDEN_TURN, unit};
use super::shade::Colors;
use crate::math::vec::luminance;
use glam::Vec3;

/// Steps of a lattice in the plane whose points are far apart in every neighbourhood, as fractions of 2³²: one over the
/// number whose cube is itself and one, and the square of that. Source: Roberts 2018, "The Unreasonable Effectiveness of
/// Quasirandom Sequences".
pub const STEP_X: u32 = 0xC13F_A9A9;
/// As [`STEP_X`], along the other side.
pub const STEP_Y: u32 = 0x91E1_0DA5;

/// Luminance of what a light brings to the eye if nothing is in its way, from its sums at the receiver \[W/(m² sr)\].
#[inline(always)]
pub fn contribution(colors: &Colors, diffuse: Vec3, near: Vec3, grazing: Vec3) -> f32 {
    luminance(colors.diffuse(diffuse)) + luminance(colors.glossy(near, grazing))
}

/// `ξ` of the sample in column `x` and row `y`, 0 ≤ ξ < 1. Samples of one share that are near each other get numbers far
/// apart, and so do the shares of one square.
pub fn offset(shares: &Shares, x: u32, y: u32) -> f32 {
    let across = (x / shares.side).wrapping_mul(STEP_X);
    let down = (y / shares.side).wrapping_mul(STEP_Y);
    let share = shares.share(x, y).wrapping_mul(GOLDEN_TURN);
    let bits = across.wrapping_add(down).wrapping_add(share);
    unit(bits)
}

/// The running sum at which ray `k` finds its light; `step` is [`step`].
#[inline(always)]
pub fn threshold(k: u32, offset: f32, step: f32) -> f32 {
    (k as f32 + offset) * step
}

/// The sum of contributions that a ray stands for.
#[inline(always)]
pub fn step(total: f32, rays: u32) -> f32 {
    total / rays as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_of_neighbours_are_far_apart() {
        for side in [1, 2, 4, 8] {
            let shares = Shares {
                side,
                width: 64,
                height: 64,
            };
            for (x0, y0) in [(0, 0), (5, 9), (20, 3)] {
                // Four by four neighbours of one share.
                let mut all: Vec<f32> = (0..16)
                    .map(|i| offset(&shares, x0 + side * (i % 4), y0 + side * (i / 4)))
                    .collect();
                all.sort_by(f32::total_cmp);
                assert!(all[0] >= 0.0 && all[15] < 1.0);
                let gap = all.windows(2).map(|w| w[1] - w[0]).fold(0.0, f32::max);
                assert!(gap < 3.0 / 16.0, "side {side}: a gap of {gap}");
            }
        }
    }
}
