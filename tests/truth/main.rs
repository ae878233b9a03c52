//! Pictures against references of an independent renderer.
//!
//! The references are not part of the repository; see [`vsgl_tests::assets`]. They were made by a path tracer, and, for
//! light without indirect shadows, by the sum over very many points. Scenes, cameras and lights are in `views.json`.

mod paths;
mod scenes;
