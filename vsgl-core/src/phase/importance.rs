//! How much each texel matters to what the camera sees: the density `brsm`.
//!
//! The camera shines ([`super::camera_map`]), and what it sees becomes virtual lights by the same texts as what lights
//! see. A texel matters as much as what it reflects of those towards its own light, since surfaces reflect alike both
//! ways. Nothing blocks that light.
//!
//! Sources: Ritschel, Eisemann, Ha, Kim and Seidel 2011, "Making Imperfect Shadow Maps View-Adaptive"; Tokuyoshi 2016,
//! "Modified Filtered Importance Sampling for Virtual Spherical Gaussian Lights", section 4.1. The share of the lights
//! that each texel takes, the box over texels and the floor are ours.

use super::shade::Receiver;
use crate::data::{Rsm, map_kind};
use crate::math::vec::{luminance, normalize};
use glam::Vec3;

/// Side of a block of texels that share all lights: each takes one of so many squared.
pub const INTERLEAVE: u32 = 4;
/// Share of the density that is the same on all texels with light: without it, what the camera sees little of would fall
/// into a few huge kernels.
pub const FLOOR: f32 = 0.1;
/// The rest.
pub const KEPT: f32 = 1.0 - FLOOR;
/// Most that a texel may matter: sums stay finite.
pub const IMPORTANCE_MAX: f32 = 1e28;

/// The first light of those that a texel takes; the others follow it `INTERLEAVE²` apart.
///
/// Lights come in the order of the partition's tree, so that each share is spread over all that is seen.
pub fn first_light(x: u32, y: u32) -> u32 {
    x % INTERLEAVE + INTERLEAVE * (y % INTERLEAVE)
}

/// A texel as a receiver whose eye is its light. What shines by itself, without a direction of light, has its eye above.
pub fn receiver(rsm: &Rsm, texel: usize) -> Receiver {
    let [x, y, z, _] = rsm.position[texel];
    let [nx, ny, nz, f90] = rsm.normal[texel];
    let (position, normal) = (Vec3::new(x, y, z), Vec3::new(nx, ny, nz));
    let map = rsm.map_of(texel);
    let view = if map.kind == map_kind::EMITTERS {
        normal
    } else {
        normalize(map.to_light(position))
    };
    let [tx, ty, tz, across] = rsm.tangent.get(texel).copied().unwrap_or_default();
    Receiver {
        position,
        normal,
        view,
        f0: rsm.diffuse[texel][3],
        f90,
        alpha: rsm.specular.get(texel).map_or(1.0, |s| s[3]),
        tangent: Vec3::new(tx, ty, tz),
        across,
    }
}

/// What a texel's flux brings to what is seen, in units of their own, from the sums over its lights: luminance of what it
/// reflects.
pub fn reflected(rsm: &Rsm, texel: usize, diffuse: Vec3, near: Vec3, grazing: Vec3) -> f32 {
    let xyz = |v: [f32; 4]| Vec3::new(v[0], v[1], v[2]);
    let column = |c: &[[f32; 4]]| c.get(texel).map_or(Vec3::ZERO, |&v| xyz(v));
    let lambert = diffuse * (xyz(rsm.diffuse[texel]) * std::f32::consts::FRAC_1_PI);
    let specular = near * column(&rsm.specular) + grazing * column(&rsm.grazing);
    luminance(lambert + specular).clamp(0.0, IMPORTANCE_MAX)
}

/// What a texel matters, from what all of them reflect: its flux, times what the flux of the texels around it matters.
///
/// The box is as wide as a block, two of it before a texel and none of another map: it holds each share of the lights
/// once, except at the sides of a map.
pub fn smoothed(rsm: &Rsm, reflected: &[f32], texel: usize) -> f32 {
    let size = rsm.size as usize;
    let (x, y) = (texel % size, texel / size % size);
    let first = texel - (y * size + x);
    let (mut sum, mut flux) = (0.0, 0.0);
    for row in (y + 2).saturating_sub(INTERLEAVE as usize)..(y + 2).min(size) {
        for column in (x + 2).saturating_sub(INTERLEAVE as usize)..(x + 2).min(size) {
            let at = first + row * size + column;
            sum += reflected[at];
            flux += rsm.weight(at);
        }
    }
    if flux > 0.0 {
        sum * (rsm.weight(texel) / flux)
    } else {
        0.0
    }
}

/// The density of a texel with light, 1 in the mean: what it matters, of a map's `total` over `lit` texels, and the
/// floor.
pub fn density(matters: f32, total: f32, lit: f32) -> f32 {
    let share = if total >= f32::MIN_POSITIVE {
        matters / total
    } else {
        0.0
    };
    (share * lit) * KEPT + FLOOR
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_of_texels_takes_each_light_once() {
        for (x0, y0) in [(0, 0), (1, 2), (7, 5)] {
            let mut firsts: Vec<u32> = (0..16)
                .map(|i| first_light(x0 + i % 4, y0 + i / 4))
                .collect();
            firsts.sort_unstable();
            assert_eq!(firsts, (0..16).collect::<Vec<_>>());
        }
    }

    #[test]
    fn densities_have_mean_one_and_keep_the_floor() {
        let matters = [0.0, 1e-20, 3.0, 5.0, 0.25];
        let total: f32 = matters.iter().sum();
        let made = matters.map(|m| density(m, total, 5.0));
        assert!((made.iter().sum::<f32>() - 5.0).abs() < 1e-5);
        assert!(made.iter().all(|&d| d >= FLOOR));
        assert_eq!(density(0.0, 0.0, 5.0), FLOOR);
    }
}
