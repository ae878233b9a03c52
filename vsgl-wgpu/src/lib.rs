//! The GPU backend of vsgl: the texts of `vsgl-core` again, in WGSL.

mod backend;
mod constants;
mod context;
mod drawing;
mod kernel;
#[cfg(test)]
mod layout;
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
