//! Rays, triangles and the hierarchy over them.

mod build;
mod order;
mod overlap;
mod ray;
mod traverse;
mod triangle;

pub use build::{Bvh, LEAF, build};
pub use overlap::overlap;
pub use ray::Ray;
pub use traverse::{
    BvhNode, Covers, Hit, LANES, Opaque, SLAB_EXIT, STACK, any_hit, any_hit_block, closest_hit,
};
pub use triangle::{Crossing, cross};
