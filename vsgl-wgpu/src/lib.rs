//! The GPU backend of vsgl: the texts of `vsgl-core` again, in WGSL.
//!
//! Runs on what [`wgpu`] finds, within the least limits of WebGPU and without any of its optional features. Phases are
//! recorded and submitted; nothing is read back between them, and only downloads wait. How it is kept equal to the CPU
//! backend: `docs/parity.md`.
//!
//! ```no_run
//! use vsgl_core::backend::Backend;
//! use vsgl_core::data::SceneData;
//! use vsgl_core::plan::Plan;
//! use vsgl_core::render::{View, render};
//! use vsgl_core::scene::{SceneFacts, samples};
//! use vsgl_core::settings::Settings;
//! use vsgl_wgpu::{WgpuBackend, WgpuOptions};
//!
//! # fn main() -> vsgl_core::Result<()> {
//! let scene = samples::by_name("cornell")?;
//! let view = View::new(scene.cameras[0].1, 1280, 720)?;
//! let facts = SceneFacts::new(&scene, &scene.lights, &view.camera);
//! let plan = Plan::new(&facts, &Settings::default())?;
//!
//! let backend = WgpuBackend::headless(&WgpuOptions::default())?;
//! println!("on {}", backend.context().info().name);
//! let data = backend.upload(SceneData::new(&scene))?;
//! let frame = render(&backend, &data, &scene.lights, &view, &plan, &())?;
//! let image = backend.download(&frame.image)?;
//! assert_eq!(image.beauty().len(), 1280 * 720);
//! # Ok(())
//! # }
//! ```

mod backend;
mod constants;
mod context;
mod drawing;
pub mod interop;
mod kernel;
#[cfg(test)]
mod layout;
mod linked;
mod params;
mod passes;
mod pool;
mod probe;
mod raster;
mod recorder;
mod res;
mod shaders;
mod strict;
mod texels;
mod timing;

pub use backend::WgpuBackend;
pub use context::{Context, Survey, WgpuOptions, adapters, is_software, survey};
pub use kernel::{Constant, KernelId};
pub use passes::kernels;
#[doc(hidden)]
pub use probe::Probe;
pub use res::WgpuRes;
pub use shaders::{MODULES, link};
pub use timing::{Clock, Timings};
pub use wgpu;
