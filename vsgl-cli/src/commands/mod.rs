//! One file a command.

mod compare;
mod contents;
mod dump;
mod facts;
mod info;
pub mod lobe;
mod merge;
mod pages;
mod parity;
mod render;
mod sheet;
mod sweep;

pub(crate) use facts::count;

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
        Command::Render(args) => render::run(&args),
        Command::Merge(args) => merge::run(&args),
        Command::Info(args) => info::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Parity(args) => parity::run(&args),
        Command::Sweep(args) => sweep::run(&args),
        Command::Lobe(args) => lobe::run(&args),
        Command::Completions(args) => pages::completions(&args),
        Command::Man(args) => pages::man(&args),
    }
}
