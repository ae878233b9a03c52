//! The CPU backend of vsgl: loops over the texts of vsgl-core, on all cores.
