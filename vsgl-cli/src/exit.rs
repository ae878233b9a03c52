//! How the program ends: one kind of failure for each exit code.

use std::path::Path;

/// A reason to stop, with the message for the user. Each kind has its exit code.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Failure {
    /// A comparison is over its limit.
    #[error("{0}")]
    OverLimit(String),
    /// An argument that makes no sense.
    #[error("{0}")]
    Usage(String),
    /// Input that cannot be read or used.
    #[error("{0}")]
    Input(String),
    /// No device to compute on, or one that failed.
    #[error("{0}")]
    Device(String),
    /// Output that cannot be written.
    #[error("{0}")]
    Output(String),
    /// Parts of a picture that do not fit together.
    #[error("{0}")]
    Parts(String),
    /// A fault of this program.
    #[error("internal error: {0}; please report it with the command")]
    Internal(String),
    /// Ctrl-C, or a request to terminate.
    #[error("interrupted: {0}")]
    Interrupted(String),
}

/// Result of everything that a command does.
pub type Result<T> = std::result::Result<T, Failure>;

/// The exit codes as the help shows them.
pub const EXIT_CODES: &str = "\
Exit codes:
  0    done
  1    compare: a metric is over the limit of --fail-above; lobe: an error is over what is stated;
       parity: the backends differ by more than is tolerated
  2    wrong arguments
  3    input that cannot be read or used
  4    no device to compute on, or one that failed
  5    output that cannot be written
  6    parts of a picture that do not fit together
  70   internal error
  130  interrupted";

impl Failure {
    /// The exit code.
    pub fn code(&self) -> u8 {
        match self {
            Self::OverLimit(_) => 1,
            Self::Usage(_) => 2,
            Self::Input(_) => 3,
            Self::Device(_) => 4,
            Self::Output(_) => 5,
            Self::Parts(_) => 6,
            Self::Internal(_) => 70,
            Self::Interrupted(_) => 130,
        }
    }

    /// Input `file` cannot be used; `remedy` says what could be.
    pub fn input(file: &Path, problem: impl std::fmt::Display, remedy: &str) -> Self {
        Self::Input(format!("{}: {problem}; {remedy}", file.display()))
    }

    /// Output `file` cannot be written; `remedy` says what to do.
    pub fn output(file: &Path, problem: impl std::fmt::Display, remedy: &str) -> Self {
        Self::Output(format!("{}: {problem}; {remedy}", file.display()))
    }
}

impl From<vsgl_core::Error> for Failure {
    fn from(error: vsgl_core::Error) -> Self {
        use vsgl_core::Error;
        let message = error.to_string();
        match error {
            Error::Scene { .. } => Self::Input(message),
            Error::Setting { .. } => Self::Usage(message),
            Error::NoAdapter { .. } | Error::Device { .. } => Self::Device(message),
            Error::Cancelled(_) => Self::Interrupted(message),
            _ => Self::Internal(message),
        }
    }
}
