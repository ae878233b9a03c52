//! What no renderer may break: energy is kept, and the limit of many lights is the exact sum.

mod coherence;
mod convergence;
mod density;
mod emission;
mod emitters;
mod energy;
mod explain;
mod furnace;
mod invariance;
mod lights;
mod maps;
mod paths;
mod shares;
