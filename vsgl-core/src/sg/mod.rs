//! Spherical Gaussians: lobes, their integrals over sphere and hemisphere, and lighting of diffuse and glossy surfaces.
//!
//! A lobe is `G(ω; axis, sharpness) = exp(sharpness (ω·axis − 1))`, with peak 1. Every function takes a sharpness from
//! 0 to `f32::MAX`; above [`SHARPNESS_MAX`] it counts as [`SHARPNESS_MAX`]. Directions are unit vectors, and cosines
//! lie in [-1, 1]. Results are finite and not negative (logarithms aside).

pub mod anisotropic;
pub mod asg;
pub mod cosine;
pub mod extent;
pub mod filtering;
pub mod glossy;
pub mod glossy_blend;
pub mod hemisphere;
pub mod lobe;
pub mod polar;
pub mod vmf;
pub mod warp;

pub use lobe::{SHARPNESS_MAX, SgLobe};
