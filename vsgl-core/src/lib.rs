//! Spherical-Gaussian lighting: mathematics, scene, settings and the order of the pipeline, free of any backend.

pub mod brdf;
pub mod math;
pub mod sg;

#[cfg(feature = "render")]
pub mod backend;
#[cfg(feature = "render")]
pub mod data;
#[cfg(feature = "render")]
mod error;
#[cfg(feature = "render")]
pub mod geom;
#[cfg(feature = "render")]
pub mod metrics;
#[cfg(feature = "render")]
pub mod phase;
#[cfg(feature = "render")]
pub mod plan;
#[cfg(feature = "render")]
pub mod render;
#[cfg(feature = "render")]
pub mod scene;
#[cfg(feature = "render")]
pub mod settings;

pub use glam;

#[cfg(feature = "render")]
pub use error::{Error, Result};
