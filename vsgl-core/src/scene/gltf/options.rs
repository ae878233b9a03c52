//! What is asked of a file.

use super::limits::Limits;

/// What is read of a file, and how much at most.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// How much is accepted.
    pub limits: Limits,
    /// The scene of the file, by its name, or if none has it by its index from 0. None: the default one of the file, else
    /// the first; in a file without scenes all nodes.
    pub scene: Option<String>,
    /// Seconds since the beginning of all animations of the file, each of which stands still before its first key and
    /// after its last; where two move the same, the first has its way. None: as the nodes stand in the file.
    pub time: Option<f64>,
}

impl Options {
    /// The usual scene within other limits.
    pub fn within(limits: &Limits) -> Self {
        Self {
            limits: limits.clone(),
            ..Self::default()
        }
    }
}
