//! Whether the backends agree, and whether a disagreement would be found.

mod chain;
mod faults;
mod functions;
mod phases;
mod raster;
mod shaders;
