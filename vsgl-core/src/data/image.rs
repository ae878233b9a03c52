//! The finished picture.

use super::columns::columns;

columns! {
    /// Linear picture with its layers, row-major from the top left: the mean over the samples of each pixel.
    ///
    /// All columns have `width * height` entries; layers that were not rendered are zero.
    pub struct Image = "image" {
        head {
            /// Width in pixels.
            width,
            /// Height in pixels.
            height,
        }
        /// Reflected light of the lights themselves, and what surfaces send by themselves \[W/(m² sr)\].
        direct: [f32; 3],
        /// One bounce, by the receiver's Lambert part \[W/(m² sr)\].
        indirect_diffuse: [f32; 3],
        /// One bounce, by the receiver's specular part \[W/(m² sr)\].
        indirect_glossy: [f32; 3],
        /// Albedo of the Lambert part plus specular reflectance at normal incidence.
        albedo: [f32; 3],
        /// Mean of the unit normals, not normalised.
        normal: [f32; 3],
        /// Mean depth along the view axis over the samples that hit something \[m\]; 0 where none did.
        depth: f32,
    }
}

impl Image {
    /// All light: direct and one bounce \[W/(m² sr)\].
    pub fn beauty(&self) -> Vec<[f32; 3]> {
        self.layer_sum(&[&self.direct, &self.indirect_diffuse, &self.indirect_glossy])
    }

    /// One bounce, both parts \[W/(m² sr)\].
    pub fn indirect(&self) -> Vec<[f32; 3]> {
        self.layer_sum(&[&self.indirect_diffuse, &self.indirect_glossy])
    }

    fn layer_sum(&self, layers: &[&Vec<[f32; 3]>]) -> Vec<[f32; 3]> {
        let pixel = |i: usize| {
            layers.iter().fold([0.0; 3], |sum: [f32; 3], layer| {
                [
                    sum[0] + layer[i][0],
                    sum[1] + layer[i][1],
                    sum[2] + layer[i][2],
                ]
            })
        };
        (0..self.direct.len()).map(pixel).collect()
    }
}
