//! Render, compare and measure with virtual spherical Gaussian lights: all of the program `vsgl` but its entry.
//!
//! | module | holds |
//! | --- | --- |
//! | [`args`] | what was typed |
//! | [`job`] | what it means |
//! | `choose` | settings for a time or an error |
//! | [`commands`] | one file a command |
//! | [`device`] | which backend computes, and on what |
//! | `measure` | what a picture costs, and how far it is from the truth |
//! | [`input`], [`output`], [`picture`] | files |
//! | [`part`] | some samples of a picture of paths, to be merged or gone on from |
//! | [`paths`], [`fingerprint`] | a picture of paths on its way |
//! | [`progress`] | what is shown meanwhile |
//! | [`exit`] | failures and their exit codes |

pub mod args;
mod choose;
mod clock;
pub mod commands;
pub mod device;
pub mod exit;
pub mod fingerprint;
pub mod input;
mod interrupt;
pub mod job;
mod measure;
pub mod output;
pub mod part;
pub mod paths;
pub mod picture;
pub mod progress;
mod text;

use clap::Parser;
use exit::Failure;
use std::process::ExitCode;
use vsgl_core::scene::gltf;

/// Reads the command line, does what it says, and reports a failure on standard error.
pub fn main() -> ExitCode {
    // Wrong arguments, `--help` and `--version` end here, with the codes of `exit`.
    let cli = args::Cli::parse();
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        // What makes a decoder panic is told as an error of its file.
        if std::thread::current().name() != Some(gltf::IMAGE_THREAD) {
            usual(info);
        }
    }));
    // A panic is a fault of this program. Unwinding has removed partial files and printed the place by now.
    let ran = std::panic::catch_unwind(|| commands::run(cli));
    let ran = ran.unwrap_or_else(|_| Err(Failure::Internal("it panicked, see above".into())));
    match ran {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            text::warn(&format!("error: {failure}"));
            ExitCode::from(failure.code())
        }
    }
}
