//! What the lights see: reflective shadow maps.

use super::columns::{Element, Scalar, columns};
use crate::math::vec::normalize;
use glam::Vec3;

columns! {
    /// Virtual point lights, `maps` square maps of `size²` texels one after the other, row-major.
    ///
    /// Where nothing was hit, or no flux arrives, all fluxes are zero.
    ///
    /// Source: Dachsbacher and Stamminger 2005, "Reflective Shadow Maps".
    ///
    /// The map of emitters, if there is one, is the last: the flux that leaves its texels stands where the others have the flux
    /// that they reflect.
    pub struct Rsm = "rsm" {
        head {
            /// Texels along a side of a map.
            size,
            /// Number of maps: see [`Light::maps`](crate::scene::Light::maps).
            maps,
        }
        /// Frame of each map.
        map: MapRecord,
        /// Id of the triangle hit.
        triangle: u32,
        /// xyz: position \[m\]; w: area of the surface that the texel covers \[m²\].
        position: [f32; 4],
        /// xyz: unit shading normal, turned to the light; w: dielectric reflectance at grazing incidence.
        normal: [f32; 4],
        /// rgb: arriving flux times albedo of the Lambert part \[W\]; w: dielectric reflectance at normal incidence.
        diffuse: [f32; 4],
        /// rgb: arriving flux times `F0` \[W\]; w: GGX `alpha`. Empty without glossy senders.
        specular: [f32; 4],
        /// rgb: arriving flux times `F90` \[W\]; w: luminance of the flux that the specular part reflects \[W\].
        /// Empty without glossy senders.
        grazing: [f32; 4],
        /// xyz: unit tangent that `alpha` belongs to; w: `alpha` across it. Empty where no surface that light reaches has two
        /// roughnesses.
        tangent: [f32; 4],
    }
}

/// Frame of one map: from a texel's place to a direction of light and back.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct MapRecord {
    /// Position of the light \[m\]; [`map_kind::PARALLEL`]: the middle of the rectangle that rays start from.
    pub position: [f32; 3],
    /// Tangent of half the map's field of view; [`map_kind::PARALLEL`]: 1.
    pub tan_half_fov: f32,
    /// Unit direction of the map's axis, away from the light.
    pub axis: [f32; 3],
    /// Cosine of the half angle of full intensity; -2 for all directions.
    pub cos_inner: f32,
    /// Unit direction of increasing column; [`map_kind::PARALLEL`]: from the middle of the rectangle to its side \[m\].
    pub right: [f32; 3],
    /// Cosine of the half angle of no intensity; -3 for all directions.
    pub cos_outer: f32,
    /// Unit direction of decreasing row; [`map_kind::PARALLEL`]: from the middle of the rectangle to its side \[m\].
    pub up: [f32; 3],
    /// Solid angle of a texel on the axis \[sr\]; [`map_kind::PARALLEL`]: area of a texel \[m²\].
    pub solid_angle: f32,
    /// Radiant intensity on the axis of the cone \[W/sr\]; [`map_kind::PARALLEL`]: irradiance across the light \[W/m²\].
    pub intensity: [f32; 3],
    /// One of [`map_kind`].
    pub kind: f32,
    /// Unit direction of the axis of the light's cone.
    pub cone: [f32; 3],
    /// One over the square of the light's range \[1/m²\]; 0: it reaches everywhere.
    pub inverse_range2: f32,
}

/// What [`MapRecord::kind`] may be.
pub mod map_kind {
    /// Rays from the light's position around the axis of its cone.
    pub const CONE: f32 = 0.0;
    /// Rays from the light's position through the face of a cube; its cone has another axis than the map, or is no cone.
    pub const FACE: f32 = 1.0;
    /// Parallel rays from a rectangle outside the scene.
    pub const PARALLEL: f32 = 2.0;
    /// No rays: the texels are points of surfaces that shine.
    pub const EMITTERS: f32 = 3.0;
}

impl MapRecord {
    /// Unit direction from a position to the light; zero for emitters, whose light comes from nowhere else.
    pub fn light(&self, position: Vec3) -> Vec3 {
        if self.kind == map_kind::EMITTERS {
            Vec3::ZERO
        } else {
            normalize(self.to_light(position))
        }
    }

    /// Direction from a position to the light, of any length. Of emitters it has no meaning.
    pub fn to_light(&self, position: Vec3) -> Vec3 {
        if self.kind >= map_kind::PARALLEL {
            -Vec3::from_array(self.axis)
        } else {
            Vec3::from_array(self.position) - position
        }
    }
}

impl Element for MapRecord {
    const SCALAR: Scalar = Scalar::F32;
}
