//! Glossy reflection of a spherical Gaussian light by a surface with two roughnesses, in world space.
//!
//! [`FilteredView`] and the anisotropic Gaussians of [`crate::sg::warp`] work in a tangent frame; here are the frame and the
//! way into it. Isotropic surfaces need no frame: see [`crate::sg::glossy`].

use glam::Vec3;

use super::filtering::FilteredView;
use super::lobe::SHARPNESS_MAX;
use super::warp;
use crate::brdf::ggx_local;
use crate::brdf::roughness::Roughness;
use crate::math::vec::{normalize, orthonormal_basis};

/// A right-handed frame of unit vectors.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// The direction in the surface that the first roughness belongs to.
    pub tangent: Vec3,
    /// The direction in the surface across it.
    pub bitangent: Vec3,
    /// The normal.
    pub normal: Vec3,
}

impl Frame {
    /// About a unit `normal`, with the part of `tangent` that lies in the surface: not parallel to the normal.
    #[inline(always)]
    #[must_use]
    pub fn new(normal: Vec3, tangent: Vec3) -> Self {
        let bitangent = normalize(normal.cross(tangent));
        Self {
            tangent: bitangent.cross(normal),
            bitangent,
            normal,
        }
    }

    /// A world-space vector in this frame, the normal along `+z`.
    #[inline(always)]
    #[must_use]
    pub fn local(&self, v: Vec3) -> Vec3 {
        Vec3::new(
            v.dot(self.tangent),
            v.dot(self.bitangent),
            v.dot(self.normal),
        )
    }
}

/// A glossy surface with two roughnesses seen from one direction: what the evaluations for many lights share.
///
/// ```
/// use vsgl_core::glam::Vec3;
/// use vsgl_core::sg::anisotropic::AnisotropicView;
/// // Brushed along x: highlights are long across the brush.
/// let view = AnisotropicView::new(Vec3::Z, Vec3::Z, Vec3::X, 0.05, 0.4);
/// let (along, across) = (Vec3::new(0.3, 0.0, 0.954), Vec3::new(0.0, 0.3, 0.954));
/// assert!(view.masked(across, 1e4, 1e4) > 10.0 * view.masked(along, 1e4, 1e4));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct AnisotropicView {
    frame: Frame,
    local: FilteredView,
}

impl AnisotropicView {
    /// For a surface with unit `normal`, GGX roughness `along` its `tangent` and `across` it, seen from `view`.
    #[inline(always)]
    #[must_use]
    pub fn new(view: Vec3, normal: Vec3, tangent: Vec3, along: f32, across: f32) -> Self {
        let frame = Frame::new(normal, tangent);
        Self {
            frame,
            local: FilteredView::reflection(frame.local(view), along, across),
        }
    }

    /// Reflected radiance of a light of strength 1 and Fresnel factor 1 \[1/sr\]: [`FilteredView::masked`].
    #[inline(always)]
    #[must_use]
    pub fn masked(&self, axis: Vec3, sharpness: f32, horizon_sharpness: f32) -> f32 {
        self.local
            .masked(self.frame.local(axis), sharpness, horizon_sharpness)
    }

    /// The same as published in 2024: [`FilteredView::filtered_2024`].
    #[inline(always)]
    #[must_use]
    pub fn filtered_2024(&self, axis: Vec3, sharpness: f32) -> f32 {
        self.local.filtered_2024(self.frame.local(axis), sharpness)
    }
}

/// GGX reflectance with Fresnel factor 1 \[1/sr\], see [`ggx_local::reflectance`].
#[inline(always)]
#[must_use]
pub fn reflectance(view: Vec3, light: Vec3, frame: &Frame, along: f32, across: f32) -> f32 {
    let roughness = Roughness::aligned(along, across);
    ggx_local::reflectance(frame.local(view), frame.local(light), roughness)
}

/// `∫ f (ω·n) G dω` with an anisotropic spherical Gaussian for the reflectance: [`warp::reflection_asg_local`] with the rest
/// of the reflectance taken at the light's axis, as [`warp::glossy_asg_2016`] does for one roughness. Fresnel factor 1.
///
/// Source: Xu et al. 2013, "Anisotropic Spherical Gaussians", section 5.
#[inline(always)]
#[must_use]
pub fn glossy_asg(
    view: Vec3,
    frame: &Frame,
    along: f32,
    across: f32,
    axis: Vec3,
    sharpness: f32,
) -> f32 {
    let (view, light) = (frame.local(view), frame.local(axis));
    let lobe = warp::reflection_asg_local(view, along, across);
    lobe.product_integral(light, sharpness) * rest(view, light, along, across)
}

/// As [`glossy_asg`] with the rest of the reflectance taken at the axis of the integrand, as [`warp::glossy_asg_2015`] does
/// for one roughness. Of the surface's two sharpnesses the geometric mean stands against the light's.
///
/// Source: Xu et al. 2013, "Anisotropic Spherical Gaussians", section 5; Tokuyoshi 2015, "Fast Indirect Illumination Using
/// Two Virtual Spherical Gaussian Lights", supplement, section 3.2 (the axis).
#[inline(always)]
#[must_use]
pub fn glossy_asg_2015(
    view: Vec3,
    frame: &Frame,
    along: f32,
    across: f32,
    axis: Vec3,
    sharpness: f32,
) -> f32 {
    let (view, light) = (frame.local(view), frame.local(axis));
    let lobe = warp::reflection_asg_local(view, along, across);
    let own = 2.0 * (lobe.sharpness_x.sqrt() * lobe.sharpness_y.sqrt());
    let middle = normalize(light * sharpness.min(SHARPNESS_MAX) + lobe.z * own);
    lobe.product_integral(light, sharpness) * rest(view, middle, along, across)
}

/// Reflectance times cosine over the distribution of normals scaled to peak 1, in the frame of the surface.
#[inline(always)]
fn rest(view: Vec3, light: Vec3, along: f32, across: f32) -> f32 {
    let roughness = Roughness::aligned(along, across);
    let (v, o) = (view.z.max(1e-6), light.z.max(0.0));
    let masked = ggx_local::projected_area(view, roughness) * o
        + ggx_local::projected_area(light, roughness) * v;
    let peak = (along * across).max(1e-12);
    o / (2.0 * std::f32::consts::PI * peak * masked.max(1e-18))
}

/// One number for the direction of a `tangent` in the surface of unit `normal`, whichever of its two ends is meant:
/// −1 … 1. [`tangent_of`] gives it back.
#[inline(always)]
#[must_use]
pub fn turn_of(normal: Vec3, tangent: Vec3) -> f32 {
    let (x, y) = orthonormal_basis(normal);
    let (along, across) = (tangent.dot(x), tangent.dot(y));
    let length = (along * along + across * across).sqrt();
    let turn = across / length.max(1e-18);
    if along < 0.0 { -turn } else { turn }
}

/// The unit tangent of a surface that [`turn_of`] gave this number for.
#[inline(always)]
#[must_use]
pub fn tangent_of(normal: Vec3, turn: f32) -> Vec3 {
    let (x, y) = orthonormal_basis(normal);
    x * ((1.0 - turn) * (1.0 + turn)).max(0.0).sqrt() + y * turn
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::ggx;
    use crate::math::vec::tilted;
    use crate::sg::glossy::GlossyView;

    #[test]
    fn equal_roughnesses_need_no_frame() {
        let (view, normal) = (tilted(0.7, 0.2), tilted(0.9, 4.0));
        let tangent = tilted(0.1, 1.0);
        for (alpha, k) in [(0.05, 2000.0), (0.3, 30.0), (0.9, 0.5)] {
            let (one, two) = (
                GlossyView::new(view, normal, alpha),
                AnisotropicView::new(view, normal, tangent, alpha, alpha),
            );
            for light in [tilted(0.8, 3.0), tilted(0.99, 0.0), tilted(0.3, 2.0)] {
                let (a, b) = (one.masked(light, k, k), two.masked(light, k, k));
                assert!((a - b).abs() <= 2e-4 * a, "{alpha} {k}: {a} {b}");
                let (a, b) = (one.filtered_2024(light, k), two.filtered_2024(light, k));
                assert!((a - b).abs() <= 2e-4 * a, "{alpha} {k}: {a} {b}");
                let frame = Frame::new(normal, tangent);
                let (a, b) = (
                    ggx::reflectance(view, light, normal, alpha),
                    reflectance(view, light, &frame, alpha, alpha),
                );
                assert!((a - b).abs() <= 1e-4 * a, "{alpha}: {a} {b}");
                let (a, b) = (
                    warp::glossy_asg_2016(view, normal, alpha, light, k),
                    glossy_asg(view, &frame, alpha, alpha, light, k),
                );
                assert!((a - b).abs() <= 2e-3 * a + 1e-12, "{alpha} {k}: {a} {b}");
                let (a, b) = (
                    warp::glossy_asg_2015(view, normal, alpha, light, k),
                    glossy_asg_2015(view, &frame, alpha, alpha, light, k),
                );
                assert!((a - b).abs() <= 2e-3 * a + 1e-12, "{alpha} {k}: {a} {b}");
            }
        }
    }

    #[test]
    fn a_sharp_light_gives_the_reflectance() {
        let (view, normal, tangent) = (tilted(0.7, 0.2), tilted(0.95, 4.0), tilted(0.1, 1.0));
        let frame = Frame::new(normal, tangent);
        let surface = AnisotropicView::new(view, normal, tangent, 0.1, 0.4);
        for light in [tilted(0.8, 3.0), tilted(0.9, 3.6), tilted(0.5, 2.5)] {
            let exact = reflectance(view, light, &frame, 0.1, 0.4) * light.dot(normal);
            let ours = surface.masked(light, 1e9, 1e9);
            assert!((ours / exact - 1.0).abs() < 1e-3, "{ours} {exact}");
        }
    }

    #[test]
    fn a_frame_is_orthonormal_and_right_handed() {
        let frame = Frame::new(tilted(0.3, 2.0), tilted(0.6, -1.0));
        assert!(frame.tangent.dot(frame.bitangent).abs() < 1e-6);
        assert!(frame.tangent.dot(frame.normal).abs() < 1e-6);
        assert!((frame.tangent.cross(frame.bitangent) - frame.normal).length() < 1e-6);
    }

    #[test]
    fn tangents_return_up_to_their_sign() {
        for normal in [tilted(0.3, 2.0), tilted(-0.7, 0.4), Vec3::Z, Vec3::NEG_Z] {
            for i in 0..24 {
                let frame = Frame::new(normal, tilted(0.0, i as f32 * 0.27));
                let turn = turn_of(normal, frame.tangent);
                assert!((-1.0..=1.0).contains(&turn));
                let back = tangent_of(normal, turn);
                assert!(
                    back.dot(frame.tangent).abs() > 1.0 - 1e-6,
                    "{normal} {i}: {back} {}",
                    frame.tangent
                );
            }
        }
        // Nothing to give back, but a direction all the same.
        assert!(tangent_of(Vec3::Z, turn_of(Vec3::Z, Vec3::Z)).is_normalized());
    }

    #[test]
    fn extremes_are_finite() {
        for normal in [Vec3::Z, tilted(0.0, 1.0)] {
            for (along, across) in [(0.0, 1.0), (1e-4, 1e-4), (1.0, 1e-3), (2.0, 2.0)] {
                for view in [Vec3::Z, tilted(1e-7, 0.3), tilted(-1.0, 0.0)] {
                    let surface = AnisotropicView::new(view, normal, Vec3::X, along, across);
                    for k in [0.0, 1e-10, 1.0, 1e8, f32::MAX] {
                        for light in [Vec3::Z, Vec3::NEG_Z, tilted(0.0, 0.3)] {
                            let value = surface.masked(light, k, k);
                            assert!(value.is_finite() && value >= 0.0, "{along} {across} {k}");
                        }
                    }
                }
            }
        }
    }
}
