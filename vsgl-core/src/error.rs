//! What can go wrong, in words that name the place and the remedy.

use crate::render::Phase;

/// Result of a fallible operation of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// An error that a user can cause. Broken promises inside the program are assertions instead.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A scene file that cannot be read, is broken, or requires something unknown.
    #[error("{file}: {place}: {problem}; {remedy}")]
    Scene {
        /// The file as the user named it, or the file it refers to.
        file: String,
        /// Where in the file: a JSON path such as `meshes[3].primitives[0].indices`, or `file`.
        place: String,
        /// What is wrong there.
        problem: String,
        /// What would be accepted, or what to do.
        remedy: String,
    },
    /// A setting or an argument outside its range.
    #[error("setting `{name}`: {problem}; {remedy}")]
    Setting {
        /// Key of the setting, spelled as on the command line.
        name: String,
        /// What is wrong with the value, the value included.
        problem: String,
        /// What would be accepted.
        remedy: String,
    },
    /// A resource put together from columns that do not fit.
    #[error("resource `{resource}`: {problem}")]
    Columns {
        /// Name of the resource type.
        resource: &'static str,
        /// Which column, and what does not fit.
        problem: String,
    },
    /// A comparison that would prove nothing.
    #[error("comparing `{resource}`: {problem}")]
    Comparison {
        /// Name of the resource type.
        resource: &'static str,
        /// Why.
        problem: String,
    },
    /// No device to compute on was found.
    #[error("no adapter: {problem}; {remedy}")]
    NoAdapter {
        /// What was looked for.
        problem: String,
        /// What to install or to choose instead.
        remedy: String,
    },
    /// A device that cannot do what is asked, or failed at it: too small, out of memory, lost.
    #[error("{device}: {problem}; {remedy}")]
    Device {
        /// Name of the device.
        device: String,
        /// What it cannot do, or what happened.
        problem: String,
        /// What to do instead.
        remedy: String,
    },
    /// The observer asked to stop.
    #[error("cancelled during {0}")]
    Cancelled(Phase),
}

impl Error {
    /// A [`Error::Setting`] from anything that prints.
    pub fn setting(
        name: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self::Setting {
            name: name.into(),
            problem: problem.into(),
            remedy: remedy.into(),
        }
    }
}
