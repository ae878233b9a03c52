//! Tests that need more than one crate, and what they share.

pub mod assets;
pub mod chance;
pub mod coherence;
pub mod gltf;
pub mod gpu;
pub mod measure;
pub mod random;
pub mod render;
pub mod surfaces;
pub mod usage;
pub mod view;
