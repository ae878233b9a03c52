//! Parts of a picture of paths: some of its samples, with sums that can be added to those of others.
//!
//! A part is an EXR file that shows the mean over its samples in the usual layers and holds the sums in whole numbers
//! ([`vsgl_core::trace::Sum`]) besides. Which samples, of how many, and a fingerprint of what they belong to are under `paths` in its
//! settings. A picture of all samples says so too, and has no sums.

mod file;
mod ranges;

pub use file::{read, write};
pub use ranges::Ranges;

use crate::exit::{Failure, Result};
use crate::output::{Metadata, software};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use vsgl_core::data::Image;
use vsgl_core::trace::Sums;

/// What a file says about its paths.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct About {
    /// Samples that it holds.
    pub samples: Ranges,
    /// Samples of the whole picture.
    pub of: u32,
    /// See [`crate::fingerprint::of_paths`].
    pub fingerprint: String,
    /// The command that makes the whole picture.
    pub command: String,
}

impl About {
    /// Whether it is the whole picture.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.samples.missing(self.of).is_empty()
    }

    /// As it is written into files.
    #[must_use]
    pub fn json(&self) -> Value {
        json!({
            "samples": self.samples.json(),
            "of": self.of,
            "fingerprint": self.fingerprint,
            "command": self.command,
        })
    }

    /// From what was written into a file.
    #[must_use]
    pub fn from_json(json: &Value) -> Option<Self> {
        Some(Self {
            samples: Ranges::from_json(&json["samples"])?,
            of: u32::try_from(json["of"].as_u64()?).ok()?,
            fingerprint: json["fingerprint"].as_str()?.to_owned(),
            command: json["command"].as_str()?.to_owned(),
        })
    }
}

/// A file with paths.
#[derive(Clone, Debug)]
pub struct Part {
    /// Where it came from.
    pub path: PathBuf,
    /// What it holds.
    pub about: About,
    /// The means over its samples, and the layers that are not light.
    pub image: Image,
    /// Their sums; none in a whole picture.
    pub sums: Option<Sums>,
    /// What else the file says.
    pub metadata: Metadata,
}

/// Parts do not fit together.
pub(crate) fn misfit(path: &Path, problem: impl std::fmt::Display, remedy: &str) -> Failure {
    Failure::Parts(format!("{}: {problem}; {remedy}", path.display()))
}

impl Part {
    /// The sums.
    ///
    /// # Errors
    /// [`Failure::Parts`] for a whole picture, which has none.
    pub fn sums(&self) -> Result<&Sums> {
        self.sums.as_ref().ok_or_else(|| {
            misfit(
                &self.path,
                format!(
                    "holds all of its {} samples, and no sums to add to",
                    self.about.of
                ),
                "give parts: pictures by --samples, or interrupted ones",
            )
        })
    }

    /// Whether it was made by this version of the program.
    ///
    /// # Errors
    /// [`Failure::Parts`] if not.
    pub fn check_version(&self) -> Result<()> {
        let (theirs, ours) = (&self.metadata.software, software());
        if *theirs == ours {
            return Ok(());
        }
        Err(misfit(
            &self.path,
            format!("made by {theirs}, and this is {ours}"),
            "make all parts with one version",
        ))
    }

    /// Adds another part: samples that this one has not.
    ///
    /// # Errors
    /// [`Failure::Parts`] if it does not fit.
    pub fn merge(&mut self, other: &Self) -> Result<()> {
        let fail = |problem: String, remedy: &str| {
            let both = format!("{} and {}", self.path.display(), other.path.display());
            Failure::Parts(format!("{both}: {problem}; {remedy}"))
        };
        if self.about.fingerprint != other.about.fingerprint {
            return Err(fail(
                "parts of different pictures: scene, light, camera, size, settings, seed or backend differ".into(),
                "make all parts by one command but for --samples",
            ));
        }
        if self.about.of != other.about.of {
            return Err(fail(
                format!("of {} and of {} samples", self.about.of, other.about.of),
                "make all parts with the same --spp",
            ));
        }
        let Some(joined) = self.about.samples.joined(&other.about.samples) else {
            let twice = self.about.samples.common(&other.about.samples);
            return Err(fail(
                format!("both hold samples {twice}"),
                "give each sample once",
            ));
        };
        let mut sums = self.sums()?.clone();
        sums.merge(other.sums()?)?;
        // What is not light is that of the first samples; it is the same in all.
        if other.about.samples.first() < self.about.samples.first() {
            self.image = other.image.clone();
            self.metadata = other.metadata.clone();
            self.about.command.clone_from(&other.about.command);
        }
        self.about.samples = joined;
        self.sums = Some(sums);
        Ok(())
    }
}
