//! The text of each phase for one element: one texel, one cluster, one pixel against one light.
//!
//! Backends loop over these functions, or repeat them word for word in their own language.

pub mod anisotropy;
pub mod bsdf;
pub mod camera_map;
pub mod cluster;
pub mod color;
pub mod direct;
pub mod draw;
pub mod emit;
pub mod facet;
pub mod facing;
pub mod fill;
pub mod filtered;
pub mod filtered_box;
pub mod footprint;
pub mod gbuffer;
pub mod importance;
pub mod interleave;
pub mod mask;
pub mod nearest;
pub mod normal_map;
pub mod occlusion;
pub mod partition;
pub mod path;
pub mod pdf;
pub mod reconstruct;
pub mod resolve;
pub mod rsm;
pub mod run;
pub mod sampled;
pub mod shade;
pub mod splat;
pub mod surface;
pub mod texture;
pub mod whole;
