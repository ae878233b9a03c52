//! Bounding volume hierarchy.

use crate::data::{Element, Scalar};

/// Node of the binary hierarchy, 32 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct BvhNode {
    /// Least corner of the box \[m\].
    pub min: [f32; 3],
    /// Leaf: first triangle. Inner node: index of the left child; the right one follows it.
    pub first: u32,
    /// Greatest corner of the box \[m\].
    pub max: [f32; 3],
    /// Leaf: number of triangles. Inner node: 0.
    pub count: u32,
}

impl Element for BvhNode {
    const SCALAR: Scalar = Scalar::U32;
}
