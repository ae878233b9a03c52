//! What was typed: the command line as clap reads it. What it means is not decided here.

mod compare;
mod lobe;
mod merge;
mod parity;
mod render;
mod scene;
mod settings;
mod sweep;
mod words;

pub use compare::{CompareArgs, Limit};
pub use lobe::LobeArgs;
pub use merge::MergeArgs;
pub use parity::ParityArgs;
pub use render::{
    BackendName, DisplayArgs, GoalArgs, InfoArgs, OutputArgs, PartArgs, RenderArgs, When,
};
pub use scene::{SceneArgs, ViewArgs};
pub use settings::SettingsArgs;
pub use sweep::{SweepArgs, SweepOutputArgs};
pub use words::{LookAt, Point, Size, Spot, Sun};

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;

/// The command line.
#[derive(Debug, Parser)]
#[command(
    name = "vsgl",
    bin_name = "vsgl",
    version,
    about = "Glossy one-bounce indirect light by virtual spherical Gaussian lights",
    after_long_help = crate::exit::EXIT_CODES,
    subcommand_required = true,
    arg_required_else_help = true,
    // The last of a flag wins, so that scripts can add to a command.
    args_override_self = true,
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
    /// Render a scene to pictures
    Render(Box<RenderArgs>),
    /// Put parts of a picture of paths together
    Merge(MergeArgs),
    /// Show what a scene holds and what would run, and why; without a scene, what this program offers
    Info(Box<InfoArgs>),
    /// Compare a picture with a reference: error metrics, limits, a false-colour map
    Compare(CompareArgs),
    /// Compare the CPU with an adapter, phase by phase and number by number
    Parity(Box<ParityArgs>),
    /// Measure error against time over a grid of settings, and report which are worth it
    Sweep(Box<SweepArgs>),
    /// Judge the mathematics against exact values, and draw it
    Lobe(LobeArgs),
    /// Print a completion script for a shell
    Completions(CompletionsArgs),
    /// Print the manual page of the program or of a command
    Man(ManArgs),
}

/// Arguments of `vsgl completions`.
#[derive(Args, Debug)]
#[command(
    after_help = "Example:\n  vsgl completions bash > ~/.local/share/bash-completion/completions/vsgl"
)]
pub struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    pub shell: Shell,
}

/// Arguments of `vsgl man`.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  vsgl man render | man -l -")]
pub struct ManArgs {
    /// The command; without it the program
    #[arg(value_name = "COMMAND")]
    pub page: Option<String>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn negative_numbers_need_no_equals_sign() {
        let typed =
            "vsgl render -o a.png --look-at -1,-2,-3:0,0,0 --spot -1,0,0:0,0,0:1:30 --exposure -2";
        let cli = Cli::try_parse_from(typed.split(' ')).map_err(|e| e.to_string());
        assert!(cli.is_ok(), "{cli:?}");
    }
}
