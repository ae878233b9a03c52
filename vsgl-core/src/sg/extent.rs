//! Extent of a cluster of points along a direction.
//!
//! The light of a cluster at distance `d` has sharpness `d²/σ²` with the variance `σ²` across the line of sight. A horizon
//! sees the extent along its own normal instead, which for a flat cluster can be anything from nothing to all of it.

use glam::Vec3;

/// Variance `aᵀ C a` \[m²\] of points along the unit direction `a`, from their covariance xx, yy, zz, xy, xz, yz \[m²\].
///
/// Exact; at least 0, which rounding can miss by some 1e-7 of the trace where the points lie in a plane.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::extent;
/// let disk = [2.0, 2.0, 0.0, 0.0, 0.0, 0.0];
/// assert_eq!(extent::along(&disk, Vec3::X), 2.0);
/// assert_eq!(extent::along(&disk, Vec3::Z), 0.0);
/// ```
#[inline(always)]
#[must_use]
pub fn along(covariance: &[f32; 6], direction: Vec3) -> f32 {
    let [xx, yy, zz, xy, xz, yz] = *covariance;
    let (x, y, z) = (direction.x, direction.y, direction.z);
    let squares = xx * (x * x) + yy * (y * y) + zz * (z * z);
    let crossed = xy * (x * y) + xz * (x * z) + yz * (y * z);
    (squares + 2.0 * crossed).max(0.0)
}

/// The same guessed from less: `σ² (1 − r⁴ (a·ν)²)` \[m²\] for a cluster of variance `σ²` along an axis in its surface, whose
/// normals have the mean direction `ν` and mean length `r`; `cosine` is `a·ν`.
///
/// Exact for a disk with one normal. On caps of a sphere never too small, but too large: up to 1.5 times across the axis,
/// and along it from 1.5 times (the whole sphere) to 11 times (a slight cap). For lights that keep no covariance; the
/// pipeline takes [`along`].
///
/// Ours, superseded by [`along`]: see `docs/vsgl.md`, section 4.
#[inline(always)]
#[must_use]
pub fn along_flat(variance: f32, mean_length: f32, cosine: f32) -> f32 {
    let square = mean_length * mean_length;
    variance * (1.0 - (square * square) * (cosine * cosine)).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tilted_disk_has_no_extent_along_its_normal() {
        // Covariance of a disk: σ² (E − ννᵀ).
        let normal = Vec3::new(2.0, -1.0, 2.0) / 3.0;
        let (n, variance) = (normal.to_array(), 0.3);
        let entry = |i: usize, j: usize| variance * (f32::from(u8::from(i == j)) - n[i] * n[j]);
        let disk = [
            entry(0, 0),
            entry(1, 1),
            entry(2, 2),
            entry(0, 1),
            entry(0, 2),
            entry(1, 2),
        ];
        for direction in [
            normal,
            Vec3::X,
            Vec3::new(0.6, 0.0, 0.8),
            Vec3::new(0.0, -0.6, 0.8),
        ] {
            let expected = along_flat(variance, 1.0, direction.dot(normal));
            assert!((along(&disk, direction) - expected).abs() < 1e-6);
        }
    }

    #[test]
    fn the_guess_on_caps_of_a_sphere_is_never_too_small() {
        // A cap of the unit sphere down to height h about +z: moments by integration over height.
        for h in [0.9f32, 0.5, 0.0, -0.5, -1.0] {
            let mean = 0.5 * (1.0 + h);
            let square = (1.0 + h + h * h) / 3.0;
            let (upright, sideways) = (square - mean * mean, 0.5 * (1.0 - square));
            let variance = 0.5 * (upright + 2.0 * sideways);
            let along_axis = along_flat(variance, mean, 1.0);
            let across = along_flat(variance, mean, 0.0);
            assert!(
                (1.4..11.0).contains(&(along_axis / upright)),
                "{h}: {}",
                along_axis / upright
            );
            assert!(
                (1.0..1.51).contains(&(across / sideways)),
                "{h}: {}",
                across / sideways
            );
        }
    }
}
