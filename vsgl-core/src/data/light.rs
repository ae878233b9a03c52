//! Lights as shading reads them.

use crate::scene::Light;
use crate::scene::light::inverse_range2;

/// A light that shines on receivers directly, ready to be evaluated.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct LightRecord {
    /// Position \[m\]; zero where `parallel`.
    pub position: [f32; 3],
    /// Cosine of the half angle of full intensity; -2 for all directions.
    pub cos_inner: f32,
    /// Unit direction of the cone's axis, or that the light travels in.
    pub axis: [f32; 3],
    /// Cosine of the half angle of no intensity; -3 for all directions.
    pub cos_outer: f32,
    /// Radiant intensity on the axis \[W/sr\]; irradiance across the light where `parallel` \[W/m²\].
    pub intensity: [f32; 3],
    /// One over the square of the range \[1/m²\]; 0: the light reaches everywhere.
    pub inverse_range2: f32,
    /// 1: the light is parallel and comes from outside the scene. 0: it comes from `position`.
    pub parallel: u32,
    /// For lights that are drawn at random: share of this one and of all before it, in 2⁻²⁴; see `phase/draw.rs`. Else zero.
    pub passed: u32,
    /// Zero.
    pub padding: [u32; 2],
}

/// The cosines of [`LightRecord`] and [`super::MapRecord`] that let the falloff be 1 in all directions.
pub(crate) const ALL_AROUND: [f32; 2] = [-2.0, -3.0];

impl From<&Light> for LightRecord {
    fn from(light: &Light) -> Self {
        let [cos_inner, cos_outer] = ALL_AROUND;
        let around = Self {
            axis: [0.0, 0.0, -1.0],
            cos_inner,
            cos_outer,
            ..Self::default()
        };
        match *light {
            Light::Spot(spot) => Self {
                position: spot.position.to_array(),
                cos_inner: spot.inner.cos(),
                axis: spot.axis.to_array(),
                cos_outer: spot.outer.cos(),
                intensity: spot.intensity,
                inverse_range2: inverse_range2(spot.range),
                ..Self::default()
            },
            Light::Point(point) => Self {
                position: point.position.to_array(),
                intensity: point.intensity,
                inverse_range2: inverse_range2(point.range),
                ..around
            },
            Light::Directional(sun) => Self {
                axis: sun.axis.to_array(),
                intensity: sun.irradiance,
                parallel: 1,
                ..around
            },
        }
    }
}
