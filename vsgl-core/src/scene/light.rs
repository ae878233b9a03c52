//! Lights.

use glam::Vec3;

/// A light of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Light {
    /// A point that shines into a cone.
    Spot(SpotLight),
    /// A point that shines alike in all directions.
    Point(PointLight),
    /// A source so far off that its light is parallel, such as the sun.
    Directional(DirectionalLight),
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
    /// As [`PointLight::range`] \[m\].
    pub range: f32,
}

/// A light that shines alike in all directions from a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// Position relative to the scene's origin \[m\].
    pub position: Vec3,
    /// Radiant intensity \[W/sr\].
    pub intensity: [f32; 3],
    /// Distance that the light fades out to \[m\], at least 0: see [`window`]. Infinite: it does not.
    pub range: f32,
}

/// Parallel light from everywhere outside the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLight {
    /// Unit direction that the light travels in.
    pub axis: Vec3,
    /// Irradiance of a surface that faces the light \[W/m²\].
    pub irradiance: [f32; 3],
}

impl Light {
    /// Maps of the light among the reflective shadow maps: faces of a cube for one that shines all around, else one.
    pub fn maps(&self) -> u32 {
        match self {
            Self::Spot(spot) if spot.outer > SpotLight::ONE_MAP_MAX => 5,
            Self::Spot(_) | Self::Directional(_) => 1,
            Self::Point(_) => 6,
        }
    }
}

impl SpotLight {
    /// Largest outer half angle \[rad\]: a right angle.
    pub const OUTER_MAX: f32 = std::f32::consts::FRAC_PI_2;
    /// Largest outer half angle that one perspective map holds \[rad\], 80 degrees. Wider cones take five faces of a cube.
    pub const ONE_MAP_MAX: f32 = 80.0 * std::f32::consts::PI / 180.0;

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

/// Share of a light that is left at a distance, its square given \[m²\]: `1 - (distance/range)⁴`, zero beyond the range.
///
/// Source: Khronos Group, `KHR_lights_punctual`, "Range property". `inverse_range2` is [`inverse_range2`].
#[inline(always)]
pub fn window(distance2: f32, inverse_range2: f32) -> f32 {
    let t = (distance2 * inverse_range2).min(1.0);
    1.0 - t * t
}

/// One over the square of a light's range \[1/m²\], finite; 0 for an infinite range.
pub fn inverse_range2(range: f32) -> f32 {
    let inverse = (1.0 / range.max(1e-18)).min(1e18);
    inverse * inverse
}
