//! Render, compare and measure with virtual spherical Gaussian lights: all of the program `vsgl` but its entry.
//!
//! | module | holds |
//! | --- | --- |
//! | [`args`] | what was typed |
//! | [`commands`] | one file a command |
//! | [`input`], [`output`], [`picture`] | files |
//! | [`exit`] | failures and their exit codes |

pub mod args;
pub mod commands;
pub mod exit;
pub mod input;
pub mod output;
pub mod picture;
mod text;

use clap::Parser;
use std::process::ExitCode;

/// Reads the command line, does what it says, and reports a failure on standard error.
pub fn main() -> ExitCode {
    // Wrong arguments, `--help` and `--version` end here, with the codes of `exit`.
    let cli = args::Cli::parse();
    match commands::run(cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            text::warn(&format!("error: {failure}"));
            ExitCode::from(failure.code())
        }
    }
}
