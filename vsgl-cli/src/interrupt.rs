//! Ctrl-C and requests to terminate.

use crate::exit::{Failure, Result};
use crate::output;
use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// From here on a first request is noted for [`asked`]; a second one ends the program at once, without partial files.
///
/// # Errors
/// [`Failure::Internal`] if the system refuses.
pub(crate) fn listen() -> Result<()> {
    let note = || {
        if ASKED.swap(true, Ordering::Relaxed) {
            output::remove_all();
            std::process::exit(i32::from(Failure::Interrupted(String::new()).code()));
        }
    };
    ctrlc::set_handler(note).map_err(|e| Failure::Internal(e.to_string()))
}

/// Whether the program was asked to stop.
pub(crate) fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// Stops here if the program was asked to.
///
/// # Errors
/// [`Failure::Interrupted`] if so.
pub(crate) fn check() -> Result<()> {
    if asked() {
        return Err(Failure::Interrupted(
            "files that were not complete are not there".into(),
        ));
    }
    Ok(())
}
