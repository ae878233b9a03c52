//! Scenes from files by others.
//!
//! The files are not part of the repository. The variable `VSGL_ASSETS` names the folder that holds `scenes`,
//! `scenes-conformance` and `ground-truth`; without it these tests only say that they were skipped.

mod conformance;
mod corner;
mod development;

use std::path::{Path, PathBuf};

/// The folder of this name among the assets, or none, with a word about it.
fn assets(folder: &str, tests: &str) -> Option<PathBuf> {
    let Some(root) = std::env::var_os("VSGL_ASSETS") else {
        println!("skipped: {tests} (VSGL_ASSETS is not set)");
        return None;
    };
    let path = Path::new(&root).join(folder);
    assert!(path.is_dir(), "VSGL_ASSETS: no folder {}", path.display());
    Some(path)
}
