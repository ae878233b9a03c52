//! Beckmann's distribution of normals with any roughness matrix, in a tangent frame (normal at `+z`), and sampling of
//! visible normals.
//!
//! Source: Beckmann and Spizzichino 1963, "The Scattering of Electromagnetic Waves from Rough Surfaces"; Walter et al.
//! 2007, "Microfacet Models for Refraction through Rough Surfaces"; Heitz 2014, "Understanding the Masking-Shadowing
//! Function in Microfacet-Based BRDFs"; Heitz and d'Eon 2014, "Importance Sampling Microfacet-Based BSDFs using the
//! Distribution of Visible Normals", and Jakob 2014, "An Improved Visible Normal Sampling Routine for the Beckmann
//! Distribution" (sampling).

use std::f32::consts::PI;

use glam::Vec3;

use super::roughness::Roughness;
use super::visible;
use crate::math::elementary::{INV_SQRT_PI, erf, erfc, erfc_integral, erfc_inverse, exp, log};
use crate::math::vec::normalize;

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

/// Slope of a visible microfacet towards the view at roughness 1, drawn by inversion from the density
/// `∝ max(cosine + sine·m, 0) e^{−m²}`; `u` is the probability of a larger slope.
///
/// In the variable `β = erfc(m)` the probability to invert is `G(β) = cosine·β + sine·e^{−m²}/√π`, with the derivative
/// `cosine + sine·m`: concave, so that Newton's steps approach from below, and a straight line at normal incidence.
#[inline(always)]
fn visible_slope(cosine: f32, sine: f32, u: f32) -> f32 {
    let cot = cosine / sine.max(1e-9);
    let end = erfc(-cot);
    let all = cosine * end + sine * INV_SQRT_PI * exp(-(cot * cot).min(1e4));
    let goal = u * all;
    // A start: straight for a view along the normal, a parabola beyond about 40 degrees.
    let rest = (1.0 - u).max(0.0);
    let bend = (1.65 * sine).min(1.0);
    let mut beta = end * (1.0 - (rest + bend * (rest.sqrt() - rest)));
    // Written out: a loop in here would keep one over lanes from becoming vectors.
    beta = towards(beta, goal, cosine, sine, end);
    beta = towards(beta, goal, cosine, sine, end);
    beta = towards(beta, goal, cosine, sine, end);
    beta = towards(beta, goal, cosine, sine, end);
    erfc_inverse(beta)
}

/// One step of Newton's for [`visible_slope`].
#[inline(always)]
fn towards(beta: f32, goal: f32, cosine: f32, sine: f32, end: f32) -> f32 {
    let slope = erfc_inverse(beta);
    let value = cosine * beta + sine * INV_SQRT_PI * exp(-slope * slope);
    let derivative = (cosine + sine * slope).max(1e-6);
    (beta + (goal - value) / derivative).min(end).max(1e-7)
}

/// A microfacet normal drawn from those visible along the unit vector `view`, for uniform `u` and `v` in \[0, 1).
///
/// Unit, above the surface. Any roughness matrix is brought to unit roughness by one of its factors; there the slope across
/// the view is normally distributed and the slope towards it is found by four of Newton's steps. The probability that a drawn
/// slope is exceeded differs from `u` by at most 1e-6 (2e-7 measured); slopes at unit roughness end at ±3.77, beyond
/// which there would be one in a million. A view below the horizon is raised to it.
///
/// ```
/// use vsgl_core::glam::Vec3;
/// use vsgl_core::brdf::{beckmann, roughness::Roughness};
/// let roughness = Roughness::rotated(0.4, 0.1, 0.6, 0.8);
/// let view = Vec3::new(0.6, 0.0, 0.8);
/// let half = beckmann::sample_visible_normal(view, roughness, 0.3, 0.7);
/// assert!(view.dot(half) > 0.0 && beckmann::visible_normal_density(view, half, roughness) > 0.0);
/// ```
#[inline(always)]
#[must_use]
pub fn sample_visible_normal(view: Vec3, roughness: Roughness, u: f32, v: f32) -> Vec3 {
    let (xx, yx, yy) = roughness.factor();
    // Stretch the view by the transposed factor, draw slopes there, and stretch these by the factor.
    let seen = normalize(Vec3::new(
        xx * view.x + yx * view.y,
        yy * view.y,
        view.z.max(0.0),
    ));
    let sine = (seen.x * seen.x + seen.y * seen.y).sqrt();
    let tilted = sine > 1e-12;
    let cos = if tilted {
        seen.x / sine.max(1e-12)
    } else {
        1.0
    };
    let sin = if tilted {
        seen.y / sine.max(1e-12)
    } else {
        0.0
    };
    let along = visible_slope(seen.z, sine, u);
    let across = erfc_inverse(2.0 * v);
    let (x, y) = (cos * along - sin * across, sin * along + cos * across);
    normalize(Vec3::new(xx * x, yx * x + yy * y, 1.0))
}

/// Density \[1/sr\] of [`sample_visible_normal`] at the unit vector `half`: `G₁ D max(v·h, 0)/v_z = D max(v·h, 0) ·
/// 2/(v_z + s_v)` with the projected area `s_v`, finite at grazing views. Integrates to 1. Relative error as that of
/// [`distribution`].
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
    use crate::math::vec::reflect;
    use crate::math::vec::tilted;

    /// Sum of `f(normal, density)` over a grid of slopes, in units of probability.
    fn over_normals(view: Vec3, roughness: Roughness, mut f: impl FnMut(Vec3, f64)) {
        let n = 600;
        let (xx, yx, yy) = roughness.factor();
        let cell = f64::from(10.0 / n as f32).powi(2) * f64::from(roughness.determinant).sqrt();
        for i in 0..n {
            for j in 0..n {
                let x = ((i as f32 + 0.5) / n as f32 - 0.5) * 10.0;
                let y = ((j as f32 + 0.5) / n as f32 - 0.5) * 10.0;
                let half = normalize(Vec3::new(xx * x, yx * x + yy * y, 1.0));
                let density = visible_normal_density(view, half, roughness);
                f(half, f64::from(density) * cell * f64::from(half.z).powi(3));
            }
        }
    }

    #[test]
    fn slopes_invert_their_distribution() {
        let mut worst = 0.0f64;
        for angle in [
            0.0f32,
            0.01,
            0.1,
            0.2,
            0.4,
            0.7,
            1.0,
            1.3,
            1.5,
            1.57,
            std::f32::consts::FRAC_PI_2,
        ] {
            let (sine, cosine) = angle.sin_cos();
            let (s, c) = (f64::from(sine), f64::from(cosine));
            let beyond =
                |m: f64| c * libm::erfc(m) + s * libm::exp(-m * m) / std::f64::consts::PI.sqrt();
            let all = beyond(-c / s.max(1e-9));
            for i in 0..2000 {
                let u = (i as f32 + 0.5) / 2000.0;
                let m = visible_slope(cosine, sine, u);
                worst = worst.max((beyond(f64::from(m)) / all - f64::from(u)).abs());
            }
        }
        assert!(worst < 1e-6, "{worst}");
    }

    #[test]
    fn visible_normals_integrate_to_one() {
        for roughness in [
            Roughness::isotropic(1.0),
            Roughness::rotated(0.5, 0.02, 0.8, 0.6),
            Roughness::aligned(1e-3, 0.1),
        ] {
            for cosine in [1.0, 0.7, 0.2, 0.01, 1e-6] {
                let mut sum = 0.0;
                over_normals(tilted(cosine, 0.7), roughness, |_, p| sum += p);
                assert!((sum - 1.0).abs() < 1e-3, "{roughness:?} {cosine} {sum}");
            }
        }
    }

    #[test]
    fn samples_follow_the_density() {
        // First and second moments of the drawn normals, in units of the slopes' own scale.
        for roughness in [
            Roughness::isotropic(0.8),
            Roughness::rotated(0.7, 0.1, 0.8, 0.6),
            Roughness::aligned(0.01, 0.3),
        ] {
            let scale = f64::from(roughness.xx.max(roughness.yy)).sqrt();
            let moments = |h: Vec3| {
                let (x, y) = (f64::from(h.x) / scale, f64::from(h.y) / scale);
                [x, y, x * x, x * y, y * y, x * x * y]
            };
            for cosine in [1.0, 0.8, 0.4, 0.1, 1e-3, 1e-6] {
                let view = tilted(cosine, 2.1);
                let mut exact = [0.0f64; 6];
                over_normals(view, roughness, |h, p| {
                    for (e, m) in exact.iter_mut().zip(moments(h)) {
                        *e += p * m;
                    }
                });
                let n = 300;
                let mut drawn = [0.0f64; 6];
                for i in 0..n * n {
                    let u = ((i % n) as f32 + 0.5) / n as f32;
                    let v = ((i / n) as f32 + 0.5) / n as f32;
                    let half = sample_visible_normal(view, roughness, u, v);
                    for (d, m) in drawn.iter_mut().zip(moments(half)) {
                        *d += m / f64::from(n * n);
                    }
                }
                for (d, e) in drawn.iter().zip(exact) {
                    assert!(
                        (d - e).abs() < 2e-3,
                        "{roughness:?} {cosine} {drawn:?} {exact:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn samples_integrate_the_reflectance() {
        let roughness = Roughness::rotated(0.7, 0.25, 0.6, 0.8);
        for cosine in [0.9, 0.5, 0.1] {
            let view = tilted(cosine, 1.0);
            let n = 300;
            let (mut sampled, mut gridded) = (0.0f64, 0.0f64);
            for i in 0..n {
                for j in 0..n {
                    let (u, v) = ((i as f32 + 0.5) / n as f32, (j as f32 + 0.5) / n as f32);
                    let half = sample_visible_normal(view, roughness, u, v);
                    let light = reflect(view, half);
                    let weight = sample_weight(view, light, roughness);
                    assert!((0.0..=1.0).contains(&weight));
                    sampled += f64::from(weight) / f64::from(n * n);
                    let light = tilted(u, v * 2.0 * PI);
                    gridded += f64::from(reflectance(view, light, roughness) * u)
                        * f64::from(2.0 * PI)
                        / f64::from(n * n);
                }
            }
            assert!(
                (sampled / gridded - 1.0).abs() < 2e-3,
                "{sampled} {gridded}"
            );
            assert!(sampled <= 1.0);
        }
    }

    #[test]
    fn weight_is_reflectance_over_density() {
        let roughness = Roughness::aligned(0.5, 0.2);
        let (view, light) = (tilted(0.3, 0.3), tilted(0.6, 3.5));
        let ratio = reflectance(view, light, roughness) * light.z
            / reflected_density(view, light, roughness);
        assert!((ratio / sample_weight(view, light, roughness) - 1.0).abs() < 1e-5);
        let half = normalize(view + light);
        let by_normal = visible_normal_density(view, half, roughness) / (4.0 * view.dot(half));
        assert!((by_normal / reflected_density(view, light, roughness) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn sampling_edges() {
        for alpha in [1e-4, 0.5, 1.0] {
            let roughness = Roughness::isotropic(alpha);
            for z in [-0.5, 0.0, 1e-6, 0.5, 1.0] {
                for u in [0.0, 1e-9, 0.5, 0.999_999_94] {
                    for v in [0.0, 0.5, 0.999_999_94] {
                        let view = tilted(z, 0.0);
                        let half = sample_visible_normal(view, roughness, u, v);
                        assert!(half.is_finite() && half.z >= 0.0, "{alpha} {z} {u} {v}");
                        assert!((half.length() - 1.0).abs() < 1e-5);
                        let light = reflect(view, half);
                        assert!(reflected_density(view, light, roughness).is_finite());
                        assert!(sample_weight(view, light, roughness).is_finite());
                    }
                }
            }
        }
    }

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
