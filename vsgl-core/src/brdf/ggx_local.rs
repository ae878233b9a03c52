//! GGX with any roughness matrix, in a tangent frame (normal at `+z`), and sampling of visible normals.
//!
//! Source: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"; Heitz 2014, "Understanding the
//! Masking-Shadowing Function in Microfacet-Based BRDFs"; Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with
//! Spherical Caps" (sampling).

use std::f32::consts::PI;

use glam::Vec3;

use super::roughness::Roughness;
use super::visible;
use crate::math::elementary::sin_cos_turns;
use crate::math::vec::normalize;

/// Density of microfacet normals \[1/sr\] at `half`, which need not be unit:
/// `1/(π √det A (h_xyᵀ A⁻¹ h_xy + h_z²)²)`. Zero for `half.z ≤ 0`.
#[inline(always)]
#[must_use]
pub fn distribution(half: Vec3, roughness: Roughness) -> f32 {
    let length2 = half.dot(half);
    let form = (roughness.inverse_form(half.x, half.y) + half.z * half.z).max(f32::MIN_POSITIVE);
    let ratio = length2 / form;
    let value = ratio * ratio / (PI * roughness.determinant.sqrt());
    if half.z > 0.0 { value } else { 0.0 }
}

/// Projected area of the symmetric microsurface along the unit vector `direction`: `√(ωᵀ A ω + z²)`.
///
/// Equals `|z| (1 + 2Λ)` with Smith's `Λ`, and is finite at grazing directions.
/// Source: Tokuyoshi et al. 2024, "Hierarchical Light Sampling with Accurate Spherical Gaussian Lighting", section 2.2.
#[inline(always)]
#[must_use]
pub fn projected_area(direction: Vec3, roughness: Roughness) -> f32 {
    (roughness.form(direction.x, direction.y) + direction.z * direction.z).sqrt()
}

/// Smith's `Λ` towards the unit vector `direction`: `(√(1 + ωᵀ A ω/z²) − 1)/2` without cancellation.
///
/// The cosine is floored at 1e-9, so at most about 5e8.
#[inline(always)]
#[must_use]
pub fn lambda(direction: Vec3, roughness: Roughness) -> f32 {
    let z = direction.z.abs().max(1e-9);
    let k = roughness.form(direction.x, direction.y).sqrt() / z;
    let k2 = k * k;
    0.5 * k2 / ((k2 + 1.0).sqrt() + 1.0)
}

/// Reflectance with Fresnel factor 1 \[1/sr\], height-correlated; 0 when either direction is below the surface.
#[inline(always)]
#[must_use]
pub fn reflectance(view: Vec3, light: Vec3, roughness: Roughness) -> f32 {
    let area =
        projected_area(view, roughness) * light.z + projected_area(light, roughness) * view.z;
    let value = distribution(view + light, roughness) * (0.5 / area.max(5e-10));
    let above = view.z.min(light.z);
    if above > 0.0 { value } else { 0.0 }
}

/// A microfacet normal drawn from those visible along the unit vector `view` (`view.z > −1`), for uniform `u` and `v` in
/// [0, 1).
///
/// Unit. In the frame where roughness is 1 the reflections off visible normals fill a spherical cap uniformly.
///
/// ```
/// use vsgl_core::glam::Vec3;
/// use vsgl_core::brdf::{ggx_local, roughness::Roughness};
/// let roughness = Roughness::aligned(0.4, 0.1);
/// let view = Vec3::new(0.6, 0.0, 0.8);
/// let half = ggx_local::sample_visible_normal(view, roughness, 0.3, 0.7);
/// assert!(ggx_local::visible_normal_density(view, half, roughness) > 0.0);
/// ```
#[inline(always)]
#[must_use]
pub fn sample_visible_normal(view: Vec3, roughness: Roughness, u: f32, v: f32) -> Vec3 {
    let (xx, yx, yy) = roughness.factor();
    // Stretch the view by the transposed factor, draw on the cap, and stretch the normal by the factor.
    let seen = normalize(Vec3::new(xx * view.x + yx * view.y, yy * view.y, view.z));
    let z = (1.0 - v) * (1.0 + seen.z) - seen.z;
    let ring = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    let (sin, cos) = sin_cos_turns(u);
    let half = Vec3::new(ring * cos + seen.x, ring * sin + seen.y, z + seen.z);
    normalize(Vec3::new(
        xx * half.x,
        yx * half.x + yy * half.y,
        half.z.max(0.0),
    ))
}

/// Density \[1/sr\] of [`sample_visible_normal`] at the unit vector `half`: `D max(v·h, 0) · 2/(v_z + s_v)`.
#[inline(always)]
#[must_use]
pub fn visible_normal_density(view: Vec3, half: Vec3, roughness: Roughness) -> f32 {
    let d = distribution(half, roughness);
    visible::normal_density(d, view.dot(half), view.z, projected_area(view, roughness))
}

/// Density \[1/sr\] of the reflection of `view` off [`sample_visible_normal`] at the unit vector `light`:
/// `D/(2 (v_z + s_v))`. Directions below the surface have density too; their weight is 0.
#[inline(always)]
#[must_use]
pub fn reflected_density(view: Vec3, light: Vec3, roughness: Roughness) -> f32 {
    let d = distribution(view + light, roughness);
    visible::reflected_density(d, view.z, projected_area(view, roughness))
}

/// `f cos / density` of a reflection drawn by [`sample_visible_normal`], Fresnel factor 1: `G₂/G₁`, within 0 … 1.
#[inline(always)]
#[must_use]
pub fn sample_weight(view: Vec3, light: Vec3, roughness: Roughness) -> f32 {
    let (view_area, light_area) = (
        projected_area(view, roughness),
        projected_area(light, roughness),
    );
    visible::sample_weight(view.z, light.z, view_area, light_area)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::ggx;
    use crate::math::vec::reflect;
    use crate::math::vec::tilted;

    #[test]
    fn isotropic_agrees_with_world_space() {
        let (view, light) = (tilted(0.4, 0.3), tilted(0.7, 2.0));
        let local = reflectance(view, light, Roughness::isotropic(0.3));
        assert!((local / ggx::reflectance(view, light, Vec3::Z, 0.3) - 1.0).abs() < 1e-5);
        assert!(
            (lambda(view, Roughness::isotropic(0.3)) / ggx::lambda(0.4, 0.3) - 1.0).abs() < 1e-5
        );
    }

    #[test]
    fn samples_integrate_the_reflectance() {
        // Albedo by samples against a plain quadrature over the hemisphere of light directions.
        let roughness = Roughness::rotated(0.7, 0.25, 0.6, 0.8);
        let view = tilted(0.5, 1.0);
        let n = 300;
        let (mut sampled, mut gridded) = (0.0f64, 0.0f64);
        for i in 0..n {
            for j in 0..n {
                let (u, v) = ((i as f32 + 0.5) / n as f32, (j as f32 + 0.5) / n as f32);
                let half = sample_visible_normal(view, roughness, u, v);
                let light = reflect(view, half);
                sampled += f64::from(sample_weight(view, light, roughness));
                let light = tilted(u, v * 2.0 * PI);
                gridded += f64::from(reflectance(view, light, roughness) * u) * f64::from(2.0 * PI);
                assert!(half.is_finite() && (half.length() - 1.0).abs() < 1e-5);
            }
        }
        let (sampled, gridded) = (sampled / f64::from(n * n), gridded / f64::from(n * n));
        assert!(
            (sampled / gridded - 1.0).abs() < 2e-3,
            "{sampled} {gridded}"
        );
    }

    #[test]
    fn weight_is_reflectance_over_density() {
        let roughness = Roughness::aligned(0.5, 0.2);
        let (view, light) = (tilted(0.3, 0.3), tilted(0.6, 3.5));
        let ratio = reflectance(view, light, roughness) * light.z
            / reflected_density(view, light, roughness);
        assert!((ratio / sample_weight(view, light, roughness) - 1.0).abs() < 1e-5);
        let half = normalize(view + light);
        let jacobian = 1.0 / (4.0 * view.dot(half));
        let by_normal = visible_normal_density(view, half, roughness) * jacobian;
        assert!((by_normal / reflected_density(view, light, roughness) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn edges() {
        for alpha in [1e-4, 0.5, 1.0] {
            let roughness = Roughness::isotropic(alpha);
            for z in [1e-6, 0.5, 1.0] {
                for u in [0.0, 0.5, 0.999_999_94] {
                    let half = sample_visible_normal(tilted(z, 0.0), roughness, u, u);
                    assert!(half.is_finite() && half.z >= 0.0);
                    assert!(
                        reflected_density(tilted(z, 0.0), reflect(tilted(z, 0.0), half), roughness)
                            .is_finite()
                    );
                }
            }
        }
    }
}
