//! Reflected lobes as Gaussians: warps of normal distributions, and glossy lighting as of 2013 to 2016.
//!
//! Superseded by [`crate::sg::glossy`], which is never far off; these are at their best for smooth surfaces seen from
//! above and off by up to 4.4 times (anisotropic) or 336 times (isotropic) at grazing angles.

use std::f32::consts::PI;

use glam::Vec3;

use super::asg::{self, AsgLobe};
use super::lobe::{self, SHARPNESS_MAX, SgLobe};
use crate::brdf::ggx;
use crate::math::vec::{normalize, reflect};

/// Sharpness `2/α²` of the lobe that stands for an isotropic distribution of normals.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::{glossy, warp};
/// let view = Vec3::new(0.6, 0.0, 0.8);
/// let light = Vec3::new(-0.6, 0.0, 0.8);
/// assert!((warp::normal_sharpness(0.1) - 200.0).abs() < 0.01);
/// ```
#[inline(always)]
#[must_use]
pub fn normal_sharpness(alpha: f32) -> f32 {
    (2.0 / (alpha * alpha).max(1e-12)).min(SHARPNESS_MAX)
}

/// The isotropic lobe of reflected directions: axis the mirrored view, sharpness that of the normals over
/// `4 |view·normal|` (floored at 1e-4 of a right angle's cosine).
///
/// Source: Wang et al. 2009, "All-Frequency Rendering of Dynamic, Spatially-Varying Reflectance".
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::{glossy, warp};
/// let view = Vec3::new(0.6, 0.0, 0.8);
/// let light = Vec3::new(-0.6, 0.0, 0.8);
/// assert!(warp::reflection_sg(view, Vec3::Z, 0.2).axis.dot(light) > 0.999);
/// ```
#[inline(always)]
#[must_use]
pub fn reflection_sg(view: Vec3, normal: Vec3, alpha: f32) -> SgLobe {
    let cosine = view.dot(normal).abs().max(1e-4);
    SgLobe::new(
        reflect(view, normal),
        normal_sharpness(alpha) / (4.0 * cosine),
    )
}

/// The anisotropic lobe of reflected directions for roughnesses along the tangents of a frame with the normal at `+z`.
///
/// The precision `diag(1/α_x², 1/α_y²)` of half vectors, carried to reflected directions by the Jacobian at the normal,
/// diagonalised. `view` is a unit vector in that frame; its cosine is floored at 1e-4.
///
/// Source: Xu et al. 2013, "Anisotropic Spherical Gaussians", section 5; the 2×2 eigenproblem without trigonometry is ours.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::{glossy, warp};
/// let view = Vec3::new(0.6, 0.0, 0.8);
/// let light = Vec3::new(-0.6, 0.0, 0.8);
/// assert!(warp::reflection_asg_local(view, 0.1, 0.3).z.dot(light) > 0.999);
/// ```
#[inline(always)]
#[must_use]
pub fn reflection_asg_local(view: Vec3, alpha_x: f32, alpha_y: f32) -> AsgLobe {
    let cosine = view.z.abs().max(1e-4);
    let axis = normalize(Vec3::new(-view.x, -view.y, cosine));
    let flat2 = view.x * view.x + view.y * view.y;
    let flat = flat2.sqrt();
    let upright = flat2 < 1e-12;
    let (vx, vy) = (view.x / flat.max(1e-6), view.y / flat.max(1e-6));
    let (vx, vy) = (
        if upright { 1.0 } else { vx },
        if upright { 0.0 } else { vy },
    );
    // Tangents of the outgoing axis: in the plane of incidence and across it. Half vectors move by ½ of a step in the plane
    // and by 1/(2 cos) of a step across.
    let plane = Vec3::new(
        vx * axis.z,
        vy * axis.z,
        (1.0 - axis.z * axis.z).max(0.0).sqrt(),
    );
    let across = axis.cross(plane);
    let (px, py) = (
        1.0 / (alpha_x * alpha_x).max(1e-12),
        1.0 / (alpha_y * alpha_y).max(1e-12),
    );
    let step = 0.5 / cosine;
    let m11 = 0.25 * (px * (vx * vx) + py * (vy * vy));
    let m22 = step * step * (px * (vy * vy) + py * (vx * vx));
    let m12 = 0.5 * step * ((py - px) * (vx * vy));
    // Relative to their mean: the squares below would leave the range of f32.
    let middle = 0.5 * (m11 + m22);
    let unit = 1.0 / middle;
    let apart = 0.5 * (m11 - m22) * unit;
    let m12 = m12 * unit;
    let radius = (apart * apart + m12 * m12).sqrt();
    // Eigenvector of the larger eigenvalue, from the better conditioned of its two rows.
    let first = apart >= 0.0;
    let (ex, ey) = if first {
        (apart + radius, m12)
    } else {
        (m12, radius - apart)
    };
    let length = (ex * ex + ey * ey).sqrt();
    let round = length < 1e-12;
    let inverse = 1.0 / (if round { 1.0 } else { length });
    let (ex, ey) = (
        if round { 1.0 } else { ex * inverse },
        if round { 0.0 } else { ey * inverse },
    );
    let larger = middle + middle * radius;
    // Product of the eigenvalues is the determinant, which does not cancel.
    let determinant = 0.25 * step * step * (px * py);
    AsgLobe {
        x: plane * ex + across * ey,
        y: across * ex - plane * ey,
        z: axis,
        sharpness_x: larger.min(SHARPNESS_MAX),
        sharpness_y: (determinant / larger).min(SHARPNESS_MAX),
    }
}

/// `∫ f (ω·n) G dω` with the reflection lobe of [`asg::reflection_lobe`] (half sharpness `1/α²`) and the rest of the
/// reflectance taken at the axis of the integrand. Fresnel factor 1.
///
/// Source: Xu et al. 2013, "Anisotropic Spherical Gaussians"; Tokuyoshi 2015, "Fast Indirect Illumination Using Two Virtual
/// Spherical Gaussian Lights", supplement, section 3.2 (the axis; the paper of 2016 takes the light's own).
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::{glossy, warp};
/// let view = Vec3::new(0.6, 0.0, 0.8);
/// let light = Vec3::new(-0.6, 0.0, 0.8);
/// let ours = glossy::masked(view, Vec3::Z, 0.2, light, 200.0);
/// assert!((warp::glossy_asg_2015(view, Vec3::Z, 0.2, light, 200.0) / ours - 1.0).abs() < 0.3);
/// ```
#[inline(always)]
#[must_use]
pub fn glossy_asg_2015(view: Vec3, normal: Vec3, alpha: f32, axis: Vec3, sharpness: f32) -> f32 {
    let lobe = asg::reflection_lobe(view, normal, 0.5 * normal_sharpness(alpha));
    let surface = reflection_sg(view, normal, alpha);
    let middle = normalize(axis * sharpness.min(SHARPNESS_MAX) + lobe.z * surface.sharpness);
    lobe.product_integral(axis, sharpness) * rest(view, normal, alpha, middle)
}

/// As [`glossy_asg_2015`] with the rest of the reflectance taken at the light's axis.
///
/// Source: Tokuyoshi 2016, "Modified Filtered Importance Sampling for Virtual Spherical Gaussian Lights", supplement,
/// section C.2.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::{glossy, warp};
/// let view = Vec3::new(0.6, 0.0, 0.8);
/// let light = Vec3::new(-0.6, 0.0, 0.8);
/// let ours = glossy::masked(view, Vec3::Z, 0.2, light, 200.0);
/// assert!((warp::glossy_asg_2016(view, Vec3::Z, 0.2, light, 200.0) / ours - 1.0).abs() < 0.3);
/// ```
#[inline(always)]
#[must_use]
pub fn glossy_asg_2016(view: Vec3, normal: Vec3, alpha: f32, axis: Vec3, sharpness: f32) -> f32 {
    let lobe = asg::reflection_lobe(view, normal, 0.5 * normal_sharpness(alpha));
    lobe.product_integral(axis, sharpness) * rest(view, normal, alpha, axis)
}

/// Reflectance times cosine over the distribution of normals scaled to peak 1: `max(o, 0)/(2π α² (s_v o + s_o v))`.
#[inline(always)]
fn rest(view: Vec3, normal: Vec3, alpha: f32, light: Vec3) -> f32 {
    let alpha2 = (alpha * alpha).max(1e-12);
    let (v, o) = (view.dot(normal).max(1e-6), light.dot(normal).max(0.0));
    let sum = ggx::reach(v, alpha2) * o + ggx::reach(o, alpha2) * v;
    o / (2.0 * PI * alpha2 * sum.max(1e-18))
}

/// `∫ f (ω·n) G dω` with the normalised isotropic lobe of [`reflection_sg`] in place of the reflectance.
///
/// Source: Tokuyoshi 2015, "Fast Indirect Illumination Using Two Virtual Spherical Gaussian Lights", Eq. 2.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::{glossy, warp};
/// let view = Vec3::new(0.6, 0.0, 0.8);
/// let light = Vec3::new(-0.6, 0.0, 0.8);
/// let ours = glossy::masked(view, Vec3::Z, 0.2, light, 200.0);
/// assert!((warp::glossy_sg_2015(view, Vec3::Z, 0.2, light, 200.0) / ours - 1.0).abs() < 0.5);
/// ```
#[inline(always)]
#[must_use]
pub fn glossy_sg_2015(view: Vec3, normal: Vec3, alpha: f32, axis: Vec3, sharpness: f32) -> f32 {
    let surface = reflection_sg(view, normal, alpha);
    let log_norm = lobe::log_integral(surface.sharpness);
    let log_product = lobe::log_inner_product(surface.axis, surface.sharpness, axis, sharpness);
    crate::math::elementary::exp(log_product - log_norm)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn aligned_lobe_agrees_with_the_isotropic_one() {
        let view = Vec3::new(0.48, 0.36, 0.8);
        let a = reflection_asg_local(view, 0.2, 0.2);
        let b = asg::reflection_lobe(view, Vec3::Z, 25.0);
        for direction in [
            Vec3::Z,
            normalize(Vec3::new(-0.5, -0.2, 0.9)),
            normalize(Vec3::new(-0.3, -0.5, 0.6)),
        ] {
            assert!((a.evaluate(direction) - b.evaluate(direction)).abs() < 1e-5);
        }
        assert!((a.x.cross(a.y) - a.z).length() < 1e-5);
    }

    #[test]
    fn anisotropic_lobe_follows_half_vectors() {
        // Close to its axis the lobe is exp(−h_xyᵀ A⁻¹ h_xy) of the half vector.
        let view = Vec3::new(0.48, 0.36, 0.8);
        let (ax, ay) = (0.3, 0.1);
        let lobe = reflection_asg_local(view, ax, ay);
        for (dx, dy) in [(0.01f32, 0.0f32), (0.0, 0.01), (0.007, -0.007)] {
            let direction = normalize(lobe.z + Vec3::new(dx, dy, 0.0));
            let half = normalize(view + direction);
            let exponent = (half.x / ax).powi(2) + (half.y / ay).powi(2);
            let value = -lobe.evaluate(direction).ln();
            assert!(
                (value - exponent).abs() < 0.05 * exponent + 2e-4,
                "{value} {exponent}"
            );
        }
    }

    #[test]
    fn extremes_are_finite() {
        for alpha in [1e-4, 0.1, 1.0] {
            for z in [1e-6f32, 0.3, 1.0] {
                let view = Vec3::new((1.0 - z * z).sqrt(), 0.0, z);
                for k in [0.0, 1.0, 1e6, f32::MAX] {
                    for axis in [Vec3::Z, Vec3::X, -Vec3::Z, -view] {
                        for f in [glossy_asg_2016, glossy_asg_2015, glossy_sg_2015] {
                            let value = f(view, Vec3::Z, alpha, axis, k);
                            assert!(
                                value.is_finite() && value >= 0.0,
                                "{alpha} {z} {k} {axis} {value}"
                            );
                        }
                    }
                }
            }
        }
    }
}
