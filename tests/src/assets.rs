//! Files by others, which are not part of the repository.

use std::path::{Path, PathBuf};

/// The folder of this name among the assets, or none, with a word about the tests that are skipped without it.
///
/// The variable `VSGL_ASSETS` names the folder that holds `scenes`, `scenes-conformance` and `ground-truth`.
///
/// # Panics
/// If the variable is set and the folder is not there.
pub fn assets(folder: &str, tests: &str) -> Option<PathBuf> {
    let Some(root) = std::env::var_os("VSGL_ASSETS") else {
        println!("skipped: {tests} (VSGL_ASSETS is not set)");
        return None;
    };
    let path = Path::new(&root).join(folder);
    assert!(path.is_dir(), "VSGL_ASSETS: no folder {}", path.display());
    Some(path)
}
