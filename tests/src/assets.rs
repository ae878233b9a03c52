//! Files by others, which are not part of the repository.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The folder of this name among the assets, or none, with a word about the tests that are skipped without it.
///
/// The variable `VSGL_ASSETS` names the folder that holds `scenes`, `scenes-conformance`, `ground-truth` and
/// `reference`.
///
/// # Panics
/// If the variable is set and the folder is not there.
pub fn assets(folder: &str, tests: &str) -> Option<PathBuf> {
    let Some(root) = std::env::var_os("VSGL_ASSETS") else {
        skipped(tests, "VSGL_ASSETS is not set");
        return None;
    };
    let path = Path::new(&root).join(folder);
    assert!(path.is_dir(), "VSGL_ASSETS: no folder {}", path.display());
    Some(path)
}

/// Counts and names what is skipped, on the standard error stream itself: what a passing test prints is not shown.
pub(crate) fn skipped(tests: &str, why: &str) {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let count = COUNT.fetch_add(1, Ordering::Relaxed) + 1;
    let line = format!("skipped {count}: {tests} ({why})\n");
    // A closed stream is no reason to fail.
    let _ = std::io::stderr().write_all(line.as_bytes());
}
