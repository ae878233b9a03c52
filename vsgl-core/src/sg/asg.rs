//! Anisotropic spherical Gaussians: glossy lobes of the papers of 2013 to 2016.

use std::f32::consts::PI;

use glam::Vec3;

use super::lobe::SHARPNESS_MAX;
use crate::math::elementary::exp;
use crate::math::vec::{normalize, orthonormal_basis, reflect};

/// An anisotropic spherical Gaussian of peak 1: `max(ω·z, 0) exp(−η_x (ω·x)² − η_y (ω·y)²)`.
///
/// Note the convention: with equal sharpnesses η it is about as wide as a spherical Gaussian of sharpness `2η`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AsgLobe {
    /// First tangent, unit.
    pub x: Vec3,
    /// Second tangent, unit, perpendicular to the first.
    pub y: Vec3,
    /// Axis, unit, perpendicular to both.
    pub z: Vec3,
    /// Sharpness along `x`, 0 or more.
    pub sharpness_x: f32,
    /// Sharpness along `y`, 0 or more.
    pub sharpness_y: f32,
}

impl AsgLobe {
    /// Value towards the unit vector `direction`, within 0 … 1.
    ///
    /// ```
    /// use glam::Vec3;
    /// use vsgl_core::sg::asg;
    /// let lobe = asg::reflection_lobe(Vec3::Z, Vec3::Z, 100.0);
    /// assert_eq!(lobe.evaluate(Vec3::Z), 1.0);
    /// assert_eq!(lobe.evaluate(-Vec3::Z), 0.0);
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn evaluate(self, direction: Vec3) -> f32 {
        let (x, y) = (direction.dot(self.x), direction.dot(self.y));
        let exponent = (self.sharpness_x * x) * x + (self.sharpness_y * y) * y;
        direction.dot(self.z).max(0.0) * exp(-exponent)
    }

    /// Integral of the product with a spherical Gaussian of peak 1 about `axis` \[sr\], approximately.
    ///
    /// `π ASG(axis; η_x ν/(η_x + ν), η_y ν/(η_y + ν)) / √((η_x + ν)(η_y + ν))` with `ν = sharpness/2`. Good for lobes that are
    /// sharp or near each other; for a light at or below the horizon of the lobe it is 0. The sum `η + ν` is floored
    /// at 1e-6, which keeps two constants finite.
    ///
    /// Source: Xu et al. 2013, "Anisotropic Spherical Gaussians", Eq. 14 and supplement.
    ///
    /// ```
    /// use glam::Vec3;
    /// use vsgl_core::sg::asg;
    /// let lobe = asg::reflection_lobe(Vec3::Z, Vec3::Z, 100.0);
    /// assert!(lobe.product_integral(Vec3::Z, 50.0) > lobe.product_integral(Vec3::new(0.6, 0.0, 0.8), 50.0));
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn product_integral(self, axis: Vec3, sharpness: f32) -> f32 {
        let half = 0.5 * sharpness.min(SHARPNESS_MAX);
        let eta_x = self.sharpness_x.min(SHARPNESS_MAX);
        let eta_y = self.sharpness_y.min(SHARPNESS_MAX);
        let sum_x = (eta_x + half).max(1e-6);
        let sum_y = (eta_y + half).max(1e-6);
        let wide = Self {
            sharpness_x: eta_x * (half / sum_x),
            sharpness_y: eta_y * (half / sum_y),
            ..self
        };
        PI * wide.evaluate(axis) / (sum_x.sqrt() * sum_y.sqrt())
    }
}

/// The lobe of reflected directions for an isotropic normal distribution of sharpness `2 half_sharpness` about `normal`,
/// seen from `view`.
///
/// The half vector turns half as fast as the reflected direction in the plane of incidence, and `2 view·normal` times
/// slower across it: `η_x = η/(4 (view·normal)²)` across, `η_y = η/4` along. `view·normal` is floored at 1e-6.
/// For GGX and Beckmann the papers take `half_sharpness = 1/α²`; the author's later code `1/α² − 1`.
///
/// Source: Xu et al. 2013, "Anisotropic Spherical Gaussians", section 5; Wang et al. 2009 for the isotropic warp.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::asg;
/// let lobe = asg::reflection_lobe(Vec3::Z, Vec3::Z, 100.0);
/// // At normal incidence the lobe is round, a quarter as sharp as the normals.
/// assert!((lobe.sharpness_x - 25.0).abs() < 1e-4 && (lobe.sharpness_y - 25.0).abs() < 1e-4);
/// ```
#[inline(always)]
#[must_use]
pub fn reflection_lobe(view: Vec3, normal: Vec3, half_sharpness: f32) -> AsgLobe {
    let cosine = view.dot(normal).abs().max(1e-6);
    let z = normalize(reflect(view, normal));
    let across = view.cross(normal);
    let squared = across.dot(across);
    let (any, _) = orthonormal_basis(z);
    // At normal incidence every tangent serves.
    let raw = if squared < 1e-12 { any } else { across };
    let x = normalize(raw - z * z.dot(raw));
    let y = z.cross(x);
    let quarter = 0.25 * half_sharpness;
    AsgLobe {
        x,
        y,
        z,
        sharpness_x: (quarter / (cosine * cosine)).min(SHARPNESS_MAX),
        sharpness_y: quarter,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frame_is_orthonormal() {
        for cosine in [1.0f32, 0.9999, 0.5, 1e-3, 1e-7] {
            let view = Vec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
            let lobe = reflection_lobe(view, Vec3::Z, 50.0);
            assert!((lobe.x.cross(lobe.y) - lobe.z).length() < 1e-6, "{cosine}");
            assert!((lobe.evaluate(reflect(view, Vec3::Z)) - 1.0).abs() < 1e-5);
        }
    }

    #[test]
    fn product_integral_limits() {
        let lobe = reflection_lobe(Vec3::Z, Vec3::Z, 400.0);
        // A light much sharper than the lobe: its integral times the lobe's value.
        let axis = normalize(Vec3::new(0.03, 0.02, 1.0));
        let sharp = lobe.product_integral(axis, 1e7);
        assert!((sharp / (2.0 * PI / 1e7 * lobe.evaluate(axis)) - 1.0).abs() < 1e-3);
        let none = AsgLobe {
            sharpness_x: 0.0,
            sharpness_y: 0.0,
            ..lobe
        };
        assert!(none.product_integral(axis, 0.0).is_finite());
    }
}
