//! Spherical-Gaussian lighting: mathematics, scene, settings and the order of the pipeline, free of any backend.

pub mod brdf;
pub mod math;
pub mod sg;
