//! Rays, triangles and the hierarchy over them.

mod bvh;
pub use bvh::BvhNode;
