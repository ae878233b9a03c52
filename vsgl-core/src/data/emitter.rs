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

/// A triangle that shines, ready to be drawn at random; see `phase/draw.rs`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct LampRecord {
    /// Id of the triangle.
    pub triangle: u32,
    /// Share of this one and of all before it by the power that they send, in 2⁻²⁴.
    pub by_power: u32,
    /// The same where all have the same share.
    pub evenly: u32,
    /// Zero.
    pub padding: u32,
}

impl Element for LampRecord {
    const SCALAR: Scalar = Scalar::U32;
}

impl Element for EmitterRecord {
    const SCALAR: Scalar = Scalar::U32;
}
