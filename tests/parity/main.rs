//! Whether the backends agree, and whether a disagreement would be found.

mod chain;
mod devices;
mod edges;
mod embed;
mod faults;
mod frames;
mod functions;
mod phases;
mod raster;
mod shaders;
