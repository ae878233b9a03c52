//! Points of surfaces that shine.

use super::columns::{Element, Scalar};

/// A point of a surface that shines, standing for a piece around it. All pieces of a scene have the same luminance of flux.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EmitterRecord {
    /// Position \[m\].
    pub position: [f32; 3],
    /// Area of the piece \[m²\].
    pub area: f32,
    /// Unit geometric normal on the side that shines.
    pub normal: [f32; 3],
    /// Id of the triangle.
    pub triangle: u32,
    /// Flux of the piece to this side \[W\].
    pub flux: [f32; 3],
    /// Zero.
    pub padding: u32,
}

impl Element for EmitterRecord {
    const SCALAR: Scalar = Scalar::U32;
}
