//! GGX reflectance in world space, isotropic.
//!
//! Every term is a dot or cross product, so no tangent frame is needed. Half vectors enter unnormalised, and their
//! distance from the normal as a cross product: `1 − (h·n)²` would lose the peak of smooth surfaces.
//!
//! Source: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"; Heitz 2014, "Understanding the
//! Masking-Shadowing Function in Microfacet-Based BRDFs" (height correlation).

use std::f32::consts::PI;

use glam::Vec3;

/// Density of microfacet normals `D` \[1/sr\] at the direction of `half`, which need not be unit; 0 below the surface.
///
/// `D = α²/(π (sin² + α² cos²)²)` with the angle to the unit `normal`; `alpha` above 0.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::brdf::ggx;
/// let peak = 1.0 / (std::f32::consts::PI * 0.04);
/// assert!((ggx::distribution(Vec3::Z, Vec3::Z, 0.2) / peak - 1.0).abs() < 1e-5);
/// ```
#[inline(always)]
#[must_use]
pub fn distribution(half: Vec3, normal: Vec3, alpha: f32) -> f32 {
    let alpha2 = alpha * alpha;
    let upright = half.dot(normal);
    let tangent = normal.cross(half);
    let form = (tangent.dot(tangent) + alpha2 * (upright * upright)).max(f32::MIN_POSITIVE);
    let ratio = half.dot(half) / form;
    let value = alpha2 * ratio * ratio * (1.0 / PI);
    if upright > 0.0 { value } else { 0.0 }
}

/// `√(α² + (1 − α²) cos²)`: the projected area of the microsurface's symmetric counterpart; `alpha2` is `α²`.
///
/// `cos (1 + 2Λ)` with Smith's `Λ`; finite and positive at grazing angles where `Λ` is not.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::brdf::ggx;
/// assert_eq!(ggx::reach(1.0, 0.04), 1.0);
/// ```
#[inline(always)]
#[must_use]
pub fn reach(cosine: f32, alpha2: f32) -> f32 {
    (alpha2 + (1.0 - alpha2).max(0.0) * (cosine * cosine)).sqrt()
}

/// Smith's `Λ` at a direction of `cosine` to the normal: `(√(1 + α² tan²) − 1)/2`, written without cancellation.
///
/// Infinite in the limit of grazing directions; the cosine is floored at 1e-9.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::brdf::ggx;
/// assert!(ggx::lambda(1.0, 0.5) < 1e-6 && ggx::lambda(0.1, 0.5) > 1.0);
/// ```
#[inline(always)]
#[must_use]
pub fn lambda(cosine: f32, alpha: f32) -> f32 {
    let c = cosine.abs().clamp(1e-9, 1.0);
    let slope = alpha / c;
    let k2 = slope * slope * ((1.0 - c) * (1.0 + c));
    0.5 * k2 / ((k2 + 1.0).sqrt() + 1.0)
}

/// `G₂/(4 v o)`: masking and shadowing, height-correlated, over the denominator of the reflectance \[1\].
///
/// `1/(2 (s_v o + s_o v))` with the cosines of view and light and their [`reach`]; finite unless both are grazing, where
/// it is capped at 1e9.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::brdf::ggx;
/// assert!((ggx::visibility(1.0, 1.0, 0.5) - 0.25).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn visibility(view_cosine: f32, light_cosine: f32, alpha: f32) -> f32 {
    let alpha2 = alpha * alpha;
    let sum = reach(view_cosine, alpha2) * light_cosine + reach(light_cosine, alpha2) * view_cosine;
    0.5 / sum.max(5e-10)
}

/// Reflectance with Fresnel factor 1 \[1/sr\]: `D · visibility`; 0 when either direction is below the surface.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::brdf::ggx;
/// // At the peak and normal incidence: 1/(4 π α²).
/// let f = ggx::reflectance(Vec3::Z, Vec3::Z, Vec3::Z, 0.1);
/// assert!((f * 4.0 * std::f32::consts::PI * 0.01 - 1.0).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn reflectance(view: Vec3, light: Vec3, normal: Vec3, alpha: f32) -> f32 {
    let (v, o) = (view.dot(normal), light.dot(normal));
    let value =
        distribution(view + light, normal, alpha) * visibility(v.max(0.0), o.max(0.0), alpha);
    let above = v.min(o);
    if above > 0.0 { value } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec::tilted;

    #[test]
    fn projected_normals_integrate_to_one() {
        for alpha in [0.2f32, 0.5, 1.0] {
            let n = 4000;
            let sum: f64 = (0..n)
                .map(|i| (i as f32 + 0.5) / n as f32)
                .map(|z| f64::from(2.0 * PI * z * distribution(tilted(z, 0.3), Vec3::Z, alpha)))
                .sum();
            assert!((sum / f64::from(n) - 1.0).abs() < 1e-3, "{alpha}");
        }
    }

    #[test]
    fn reciprocal_and_masked() {
        let (view, light) = (tilted(0.3, 0.0), tilted(0.8, 2.0));
        let forward = reflectance(view, light, Vec3::Z, 0.4);
        assert!((forward / reflectance(light, view, Vec3::Z, 0.4) - 1.0).abs() < 1e-6);
        assert_eq!(reflectance(view, -light, Vec3::Z, 0.4), 0.0);
        let smith = 1.0 / (1.0 + lambda(0.3, 0.4) + lambda(0.8, 0.4));
        assert!((visibility(0.3, 0.8, 0.4) * 4.0 * 0.3 * 0.8 / smith - 1.0).abs() < 1e-5);
    }

    #[test]
    fn smooth_peak_is_resolved() {
        // Half vector at tan θ = α: D is a quarter of its peak 1/(π α²).
        let alpha = 1e-4f32;
        let half = Vec3::new(alpha, 0.0, 1.0);
        let value = distribution(half, Vec3::Z, alpha);
        assert!((value * 4.0 * PI * alpha * alpha - 1.0).abs() < 1e-5);
    }
}
