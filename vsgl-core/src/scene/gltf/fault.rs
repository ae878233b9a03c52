//! Why a file is refused.

use crate::error::Error;
use std::path::Path;

/// Result of reading a part of a file.
pub(super) type Result<T> = std::result::Result<T, Fault>;

/// What is wrong where, and what would be right. Boxed: results stay small.
#[derive(Debug)]
pub(super) struct Fault(Box<Parts>);

#[derive(Debug)]
struct Parts {
    /// What was asked of the file is wrong, not the file.
    asked: bool,
    /// The file, where it is not the scene's own.
    file: Option<String>,
    place: String,
    problem: String,
    remedy: String,
}

impl Fault {
    pub(super) fn new(
        place: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self(Box::new(Parts {
            asked: false,
            file: None,
            place: place.into(),
            problem: problem.into(),
            remedy: remedy.into(),
        }))
    }

    /// What was asked of a file that it does not have; `name` is the option's.
    pub(super) fn setting(name: &str, problem: String, remedy: String) -> Self {
        let mut fault = Self::new(name, problem, remedy);
        fault.0.asked = true;
        fault
    }

    /// The same about another file than the scene's own.
    pub(super) fn in_file(mut self, file: &Path) -> Self {
        self.0.file = Some(file.display().to_string());
        self
    }

    /// For the user, who named the scene's file `path`.
    pub(super) fn into_error(self, path: &Path) -> Error {
        let Parts {
            asked,
            file,
            place,
            problem,
            remedy,
        } = *self.0;
        if asked {
            return Error::setting(place, problem, remedy);
        }
        Error::Scene {
            file: file.unwrap_or_else(|| path.display().to_string()),
            place,
            problem,
            remedy,
        }
    }
}

/// A string of the file, fit for a message: short, and without characters that a terminal obeys.
pub(super) fn printable(text: &str) -> String {
    const LONGEST: usize = 120;
    let mut short: String = text
        .chars()
        .take(LONGEST)
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect();
    if text.chars().nth(LONGEST).is_some() {
        short.push('…');
    }
    short
}

/// The same between quotation marks.
pub(super) fn quoted(text: &str) -> String {
    format!("`{}`", printable(text))
}
