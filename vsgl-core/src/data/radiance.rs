//! Reflected radiance a sample.

use super::columns::{Element, Scalar, columns};

columns! {
    /// Radiance to the eye from each sample of a [`super::GBuffer`] \[W/(m² sr)\], kept apart by path.
    ///
    /// Where the plan has a [`crate::plan::ReconstructPlan`], shading leaves sums over a share of the virtual lights in the last
    /// two columns, and reconstruction makes the others of them.
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
        /// One bounce before reconstruction. Empty otherwise.
        sums: SampleSums,
        /// Light of surfaces that shine before reconstruction. Empty otherwise, and where none shines.
        emitted: SampleSums,
    }
}

/// What some virtual lights bring to a sample, without the sample's colours.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SampleSums {
    /// For the Lambert part: multiply by albedo over π \[W/m²\].
    pub diffuse: [f32; 3],
    /// Luminance of what the lights bring to the eye if nothing is in their way \[W/(m² sr)\]; zero unless rays are drawn.
    pub total: f32,
    /// For the specular part: multiply by `F0` \[W/(m² sr)\].
    pub near: [f32; 3],
    /// Drawn lights that nothing hides, a whole number.
    pub open: f32,
    /// For the specular part: multiply by `F90` \[W/(m² sr)\].
    pub grazing: [f32; 3],
    /// Lights drawn, a whole number.
    pub asked: f32,
}

impl Element for SampleSums {
    const SCALAR: Scalar = Scalar::F32;
}
