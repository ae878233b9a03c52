//! The GPU backend of vsgl: the texts of `vsgl-core` again, in WGSL.

pub use wgpu;
