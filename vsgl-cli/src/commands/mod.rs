//! One file a command.

mod compare;

use crate::args::{Cli, Command};
use crate::exit::Result;

/// Number of the shape of all JSON documents; it grows when a field changes its meaning or goes.
pub const SCHEMA_VERSION: u32 = 1;

/// Runs the command.
///
/// # Errors
/// What the command returns.
pub fn run(cli: Cli) -> Result<()> {
    match cli.command {
        Command::Compare(args) => compare::run(&args),
    }
}
