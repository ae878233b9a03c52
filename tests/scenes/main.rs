//! Scenes from files by others.
//!
//! The files are not part of the repository. The variable `VSGL_ASSETS` names the folder that holds `scenes`,
//! `scenes-conformance` and `ground-truth`; without it these tests only say that they were skipped.

mod conformance;
mod corner;
mod development;

use vsgl_tests::assets::assets;
