//! What the lights see: reflective shadow maps.

use super::columns::{Element, Scalar, columns};

columns! {
    /// Virtual point lights, `maps` square maps of `size²` texels one after the other, row-major.
    ///
    /// Where nothing was hit, or no flux arrives, all fluxes are zero.
    ///
    /// Source: Dachsbacher and Stamminger 2005, "Reflective Shadow Maps".
    pub struct Rsm = "rsm" {
        head {
            /// Texels along a side of a map.
            size,
            /// Number of maps: one a spot light.
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
    /// Position of the light \[m\].
    pub position: [f32; 3],
    /// Tangent of half the map's field of view.
    pub tan_half_fov: f32,
    /// Unit direction of the map's axis, away from the light.
    pub axis: [f32; 3],
    /// Cosine of the half angle of full intensity.
    pub cos_inner: f32,
    /// Unit direction of increasing column.
    pub right: [f32; 3],
    /// Cosine of the half angle of no intensity.
    pub cos_outer: f32,
    /// Unit direction of decreasing row.
    pub up: [f32; 3],
    /// Solid angle of a texel on the axis \[sr\].
    pub solid_angle: f32,
    /// Radiant intensity on the axis \[W/sr\].
    pub intensity: [f32; 3],
    /// Zero; it keeps the record a multiple of 16 bytes.
    pub padding: f32,
}

impl Element for MapRecord {
    const SCALAR: Scalar = Scalar::F32;
}
