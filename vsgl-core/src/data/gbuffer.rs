//! What the camera sees.

use super::columns::columns;

columns! {
    /// Surface points seen through the samples of a picture, row-major from the top left.
    ///
    /// Where nothing was hit, `triangle` is [`super::NO_TRIANGLE`] and all else is zero.
    pub struct GBuffer = "gbuffer" {
        head {
            /// Samples in a row.
            width,
            /// Rows.
            height,
        }
        /// Id of the triangle hit.
        triangle: u32,
        /// xyz: position \[m\]; w: depth along the view axis \[m\].
        position: [f32; 4],
        /// xyz: unit shading normal, turned to the eye; w: dielectric reflectance at grazing incidence.
        normal: [f32; 4],
        /// rgb: albedo of the Lambert part `(1 - metallic) base`; w: largest channel of the dielectric reflectance at
        /// normal incidence.
        diffuse: [f32; 4],
        /// rgb: specular reflectance at normal incidence (`F0`); w: GGX `alpha`. Empty where nothing is glossy.
        specular: [f32; 4],
        /// Specular reflectance at grazing incidence (`F90`). Empty where nothing is glossy.
        grazing: f32,
        /// xyz: unit tangent that `alpha` belongs to; w: `alpha` across it. Empty where no surface has two roughnesses.
        tangent: [f32; 4],
        /// Radiance that surfaces send to the eye by themselves \[W/(m² sr)\]. Empty where none does.
        emission: [f32; 3],
    }
}
