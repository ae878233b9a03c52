//! Reflected radiance a sample.

use super::columns::columns;

columns! {
    /// Radiance to the eye from each sample of a [`super::GBuffer`] \[W/(m² sr)\], kept apart by path.
    pub struct Radiance = "radiance" {
        head {
            /// Samples in a row.
            width,
            /// Rows.
            height,
        }
        /// Reflected light of the lights themselves, and of surfaces that shine.
        direct: [f32; 3],
        /// One bounce, reflected by the receiver's Lambert part. Empty without a bounce.
        indirect_diffuse: [f32; 3],
        /// One bounce, reflected by the receiver's specular part. Empty without a bounce or glossy receivers.
        indirect_glossy: [f32; 3],
    }
}
