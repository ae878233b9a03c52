//! Lights.

use glam::Vec3;

/// A light of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Light {
    /// A point that shines into a cone.
    Spot(SpotLight),
}

/// A point light that shines into a cone, with the angular falloff of `KHR_lights_punctual`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpotLight {
    /// Position relative to the scene's origin \[m\].
    pub position: Vec3,
    /// Unit direction of the cone's axis, away from the light.
    pub axis: Vec3,
    /// Radiant intensity on the axis \[W/sr\].
    pub intensity: [f32; 3],
    /// Half angle up to which the intensity is full \[rad\].
    pub inner: f32,
    /// Half angle beyond which it is zero \[rad\], at most [`SpotLight::OUTER_MAX`]. Equal to `inner`: a hard edge.
    pub outer: f32,
}

impl SpotLight {
    /// Largest outer half angle \[rad\]: one perspective map holds the whole cone. 80 degrees.
    pub const OUTER_MAX: f32 = 80.0 * std::f32::consts::PI / 180.0;

    /// Share of the on-axis intensity in a direction at `cosine` to the axis, 0..=1.
    ///
    /// Source: Khronos Group, `KHR_lights_punctual`, "Inner and outer cone angles". The extension's note divides by
    /// at least 0.001, which would soften a hard edge; here an edge is as hard as the file says.
    #[inline(always)]
    pub fn falloff(cosine: f32, cos_inner: f32, cos_outer: f32) -> f32 {
        let width = (cos_inner - cos_outer).max(1e-7);
        let t = ((cosine - cos_outer) / width).clamp(0.0, 1.0);
        t * t
    }
}
