//! What was left out.

use std::collections::HashSet;

/// Lines for the user, each once.
#[derive(Debug, Default)]
pub(super) struct Warnings {
    lines: Vec<String>,
    seen: HashSet<String>,
}

impl Warnings {
    /// More than this many different lines help nobody.
    const MOST: usize = 32;

    /// Adds a line, unless it is there.
    pub(super) fn add(&mut self, line: impl Into<String>) {
        let line = line.into();
        if self.seen.len() <= Self::MOST && self.seen.insert(line.clone()) {
            self.lines.push(line);
        }
    }

    pub(super) fn into_lines(mut self) -> Vec<String> {
        if self.lines.len() > Self::MOST {
            self.lines.truncate(Self::MOST);
            self.lines.push("and more".into());
        }
        self.lines
    }
}
