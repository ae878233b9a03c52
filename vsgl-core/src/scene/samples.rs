//! Scenes made in code, with the lights and the camera that they are meant to be seen by.

use super::Scene;
use crate::error::{Error, Result};

/// Names of the scenes, as after `sample:`.
pub const NAMES: &[&str] = &[];

/// The scene of this name.
///
/// # Errors
/// [`Error::Setting`] for an unknown name.
pub fn by_name(name: &str) -> Result<Scene> {
    Err(Error::setting(
        "SCENE",
        format!("no sample `{name}`"),
        format!("samples are {}", NAMES.join(", ")),
    ))
}
