//! Schlick's approximation of Fresnel reflectance.

use glam::Vec3;

/// `(1 − c)⁵`, the weight of the reflectance at grazing incidence; `cosine` is that between direction and half vector.
///
/// Source: Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering".
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::brdf::fresnel;
/// assert_eq!((fresnel::schlick_weight(1.0), fresnel::schlick_weight(0.0)), (0.0, 1.0));
/// ```
#[inline(always)]
#[must_use]
pub fn schlick_weight(cosine: f32) -> f32 {
    let c = 1.0 - cosine.clamp(0.0, 1.0);
    let square = c * c;
    square * square * c
}

/// `f0 + (f90 − f0) (1 − c)⁵` for each colour.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::brdf::fresnel;
/// let f = fresnel::schlick(Vec3::splat(0.04), Vec3::ONE, 1.0);
/// assert_eq!(f, Vec3::splat(0.04));
/// ```
#[inline(always)]
#[must_use]
pub fn schlick(f0: Vec3, f90: Vec3, cosine: f32) -> Vec3 {
    f0 + (f90 - f0) * schlick_weight(cosine)
}

/// Cosine between `view` and the half vector of `view` and `light`, 0 … 1: `|view + light|/2`.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::brdf::fresnel;
/// assert!((fresnel::half_cosine(Vec3::X, Vec3::Y) - 0.5f32.sqrt()).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn half_cosine(view: Vec3, light: Vec3) -> f32 {
    let sum = view + light;
    (0.5 * sum.dot(sum).sqrt()).min(1.0)
}

/// Reflectance at normal incidence of a dielectric with relative index `index`: `((η − 1)/(η + 1))²`.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::brdf::fresnel;
/// assert!((fresnel::f0_of_index(1.5) - 0.04).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn f0_of_index(index: f32) -> f32 {
    let root = (index - 1.0) / (index + 1.0);
    root * root
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends() {
        let (f0, f90) = (Vec3::splat(0.04), Vec3::ONE);
        assert_eq!(schlick(f0, f90, 1.0), f0);
        assert_eq!(schlick(f0, f90, 0.0), f90);
        assert!((f0_of_index(1.5) - 0.04).abs() < 1e-7);
        assert_eq!(half_cosine(Vec3::Z, Vec3::Z), 1.0);
        assert_eq!(half_cosine(Vec3::Z, -Vec3::Z), 0.0);
        assert!((half_cosine(Vec3::Z, Vec3::X) - 0.5f32.sqrt()).abs() < 1e-7);
    }
}
