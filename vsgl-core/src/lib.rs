//! Spherical-Gaussian lighting: mathematics, scene, settings and the order of the pipeline, free of any backend.
//!
//! [`math`], [`sg`] and [`brdf`] need nothing but `glam`; with `default-features = false` they are all there is:
//!
//! ```
//! use vsgl_core::glam::Vec3;
//! use vsgl_core::sg::{cosine, glossy, lobe};
//!
//! // A light of radiance 10 at its peak, 60° off the normal, as sharp as a small window.
//! let (axis, sharpness) = (Vec3::new(0.866, 0.0, 0.5), 40.0);
//! // What a white Lambert surface reflects of it, and what a metal of roughness alpha 0.2 sends back to the mirror side.
//! let lambert = 10.0 * cosine::interpolated_v13(sharpness, axis.dot(Vec3::Z)) / std::f32::consts::PI;
//! let metal = 10.0 * glossy::masked(Vec3::new(-0.866, 0.0, 0.5), Vec3::Z, 0.2, axis, sharpness);
//! assert!(metal > 10.0 * lambert && lambert < 10.0 * lobe::integral(sharpness));
//! ```
//!
//! The feature `render` adds the pipeline **RSM → PDF → cluster → shade** of virtual spherical Gaussian lights: a
//! [`scene`], [`settings`], the [`plan`] that decides what runs, [`data`] that the phases pass on, and [`render::render`],
//! which runs them on a [`backend`]. The feature `gltf`, on by default, adds the loader.
//!
//! Units are SI; directions are unit vectors away from the surface, `view` to the eye and `light` to the light.

pub mod brdf;
#[doc(hidden)]
pub mod constants;
pub mod math;
pub mod sg;

#[cfg(feature = "render")]
pub mod backend;
#[cfg(feature = "render")]
pub mod data;
#[cfg(feature = "render")]
mod error;
#[cfg(feature = "render")]
pub mod explain;
#[cfg(feature = "render")]
pub mod geom;
#[cfg(feature = "render")]
pub mod metrics;
#[cfg(feature = "render")]
pub mod parity;
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
#[cfg(feature = "render")]
pub mod trace;

pub use glam;

#[cfg(feature = "render")]
pub use error::{Error, Result};
