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
        self.0.file = Some(shortened(&file.display().to_string(), 400));
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
    shortened(text, 120)
}

fn shortened(text: &str, longest: usize) -> String {
    let mut short: String = text
        .chars()
        .take(longest)
        .map(|c| if obeyed(c) { '\u{fffd}' } else { c })
        .collect();
    if text.chars().nth(longest).is_some() {
        short.push('…');
    }
    short
}

/// Whether a terminal does something other than show the character: control characters, and those that turn the
/// direction of text.
fn obeyed(c: char) -> bool {
    c.is_control() || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// The same between quotation marks.
pub(super) fn quoted(text: &str) -> String {
    format!("`{}`", printable(text))
}
