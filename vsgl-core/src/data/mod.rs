//! Resources: what the phases read and write, as flat arrays of 32-bit numbers.
//!
//! Every resource is a [`Columns`]: a small head and a few named arrays. A backend can bring any of them to the host
//! and take any of them from it, so that tests, dumps and comparisons need no code of their own for each type.

pub(crate) mod columns;
mod emitter;
mod gbuffer;
mod image;
mod light;
mod occlusion;
mod pdf;
mod radiance;
mod rsm;
mod scene_data;
mod vsgls;

pub use columns::{Column, Columns, Element, Scalar};
pub use emitter::{EmitterRecord, LampRecord};
pub use gbuffer::GBuffer;
pub use image::Image;
pub(crate) use light::ALL_AROUND;
pub use light::LightRecord;
pub use occlusion::Occlusion;
pub use pdf::Pdf;
pub use radiance::{Radiance, SampleSums};
pub use rsm::{MapRecord, Rsm, map_kind};
pub use scene_data::{
    DOUBLE_SIDED, MIPS, MaterialRecord, NEAREST, NO_TEXTURE, SECOND_SET, SceneData, TextureRecord,
    UNLIT,
};
pub use vsgls::{DiffuseVsgl, SpecularVsgl, Target, Vsgls};

/// Id of no triangle: a ray that left the scene.
pub const NO_TRIANGLE: u32 = u32::MAX;
