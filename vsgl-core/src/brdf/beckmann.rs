//! Beckmann's distribution of normals with any roughness matrix, in a tangent frame (normal at `+z`).
//!
//! Source: Beckmann and Spizzichino 1963, "The Scattering of Electromagnetic Waves from Rough Surfaces"; Walter et al.
//! 2007, "Microfacet Models for Refraction through Rough Surfaces"; Heitz 2014, "Understanding the Masking-Shadowing
//! Function in Microfacet-Based BRDFs".

use std::f32::consts::PI;

use glam::Vec3;

use super::roughness::Roughness;
use crate::math::elementary::{INV_SQRT_PI, erf, erfc_integral, exp, log};

/// Density of microfacet normals \[1/sr\] at `half`, which need not be unit: `e^{−q}/(π √det A cos⁴)` with
/// `q = h_xyᵀ A⁻¹ h_xy / h_z²`. Zero for `half.z ≤ 0`.
///
/// The relative error grows with the exponent, about `q · 1e-7`.
#[inline(always)]
#[must_use]
pub fn distribution(half: Vec3, roughness: Roughness) -> f32 {
    let z = half.z.max(1e-18);
    let ratio = half.dot(half) / (z * z);
    let exponent = roughness.inverse_form(half.x / z, half.y / z).min(1e38);
    // Where the exponential is zero the other factor may be anything up to 1e37.
    let peak = (ratio.min(1e18) * ratio.min(1e18)) / (PI * roughness.determinant.sqrt());
    let value = exp(-exponent) * peak.min(1e37);
    if half.z > 0.0 { value } else { 0.0 }
}

/// Logarithm of [`distribution`], finite (at least −3.4e38) also below the surface.
#[inline(always)]
#[must_use]
pub fn log_distribution(half: Vec3, roughness: Roughness) -> f32 {
    let z = half.z.max(1e-18);
    let length2 = half.dot(half).max(f32::MIN_POSITIVE);
    let (x, y) = (half.x / z, half.y / z);
    let exponent = roughness.inverse_form(x, y).min(1e38);
    let cos2 = (z * z / length2).max(f32::MIN_POSITIVE);
    let value = -exponent - log(PI * roughness.determinant.sqrt()) - 2.0 * log(cos2);
    if half.z > 0.0 { value } else { f32::MIN }
}

/// Projected area of the symmetric microsurface along the unit vector `direction`:
/// `|z| erf(|z|/√q) + √(q/π) e^{−z²/q}` with `q = ωᵀ A ω`; `|z|` for a smooth surface.
///
/// Equals `|z| (1 + 2Λ)` with Smith's `Λ`, and is finite at grazing directions.
/// Source: Tokuyoshi et al. 2024, "Hierarchical Light Sampling with Accurate Spherical Gaussian Lighting", section 2.2.
#[inline(always)]
#[must_use]
pub fn projected_area(direction: Vec3, roughness: Roughness) -> f32 {
    let root = roughness.form(direction.x, direction.y).sqrt().max(1e-18);
    let z = direction.z.abs();
    let a = z / root;
    z * erf(a) + root * INV_SQRT_PI * exp(-(a * a).min(1e4))
}

/// Smith's `Λ` towards the unit vector `direction`: `∫ₐ^∞ erfc / (2a)` with `a = |z|/√(ωᵀ A ω)`.
///
/// The textbook difference of error functions cancels for smooth surfaces; this is the same without. At most about 1e8,
/// reached at grazing directions.
#[inline(always)]
#[must_use]
pub fn lambda(direction: Vec3, roughness: Roughness) -> f32 {
    let root = roughness.form(direction.x, direction.y).sqrt().max(1e-18);
    let a = (direction.z.abs() / root).max(1e-9);
    0.5 * erfc_integral(a) / a
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec::normalize;

    #[test]
    fn projected_normals_integrate_to_one() {
        let roughness = Roughness::rotated(0.5, 0.2, 0.8, 0.6);
        let (rows, columns) = (800, 400);
        let mut sum = 0.0f64;
        for i in 0..rows {
            let z = (i as f32 + 0.5) / rows as f32;
            let ring = (1.0 - z * z).sqrt();
            for j in 0..columns {
                let turn = (j as f32 + 0.5) / columns as f32 * 2.0 * PI;
                let h = Vec3::new(ring * turn.cos(), ring * turn.sin(), z);
                sum += f64::from(z * distribution(h, roughness));
            }
        }
        let integral = sum * f64::from(2.0 * PI) / f64::from(rows * columns);
        assert!((integral - 1.0).abs() < 1e-3, "{integral}");
    }

    #[test]
    fn area_and_lambda_agree() {
        for z in [0.01f32, 0.1, 0.5, 0.9] {
            for alpha in [0.1, 0.4, 1.0] {
                let direction = Vec3::new((1.0 - z * z).sqrt(), 0.0, z);
                let roughness = Roughness::isotropic(alpha);
                let area = z * (1.0 + 2.0 * lambda(direction, roughness));
                assert!((projected_area(direction, roughness) / area - 1.0).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn edges() {
        for alpha in [1e-4, 0.5, 1.0] {
            let roughness = Roughness::isotropic(alpha);
            for direction in [
                Vec3::Z,
                Vec3::X,
                normalize(Vec3::new(1.0, 0.0, 1e-6)),
                -Vec3::Z,
            ] {
                for f in [distribution, projected_area, lambda] {
                    let value = f(direction, roughness);
                    assert!(
                        value.is_finite() && value >= 0.0,
                        "{alpha} {direction} {value}"
                    );
                }
                assert!(reflectance(direction, direction, roughness).is_finite());
            }
        }
    }
}
