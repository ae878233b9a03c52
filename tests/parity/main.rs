//! Whether the backends agree, and whether a disagreement would be found.

mod chain;
mod devices;
mod embed;
mod faults;
mod phases;
mod raster;
mod shaders;
