//! One file a phase: only loops. What is computed for one element stands under the same name in `vsgl_core::phase`.

pub(crate) mod band;
pub mod block;
pub(crate) mod camera_map;
pub(crate) mod cluster;
pub(crate) mod filtered;
pub(crate) mod gbuffer;
pub(crate) mod importance;
pub(crate) mod nearest;
pub(crate) mod occlusion;
pub(crate) mod partition;
pub(crate) mod path;
pub(crate) mod pdf;
pub(crate) mod reconstruct;
pub(crate) mod resolve;
pub(crate) mod rsm;
pub(crate) mod sampled;
pub(crate) mod shade;
pub(crate) mod whole;
