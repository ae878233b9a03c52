//! What was typed: the command line as clap reads it. What it means is not decided here.

mod compare;

pub use compare::{CompareArgs, Limit};

use clap::{Parser, Subcommand};

/// The command line.
#[derive(Debug, Parser)]
#[command(
    name = "vsgl",
    version,
    about = "Glossy one-bounce indirect light by virtual spherical Gaussian lights",
    after_long_help = crate::exit::EXIT_CODES,
    arg_required_else_help = true,
    max_term_width = 110,
)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Compare a picture with a reference: error metrics, limits, a false-colour map
    Compare(CompareArgs),
}
