//! Arguments of `vsgl parity`.

use super::{SceneArgs, SettingsArgs, ViewArgs, When};
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  vsgl parity
  vsgl parity room.glb --lights 1024 --clustering filtered -o differences
  vsgl parity sample:columns --method vpl --rsm 32 -o difference.png
  VSGL_ADAPTER=llvmpipe vsgl parity sample:columns --size 160x90 --json

Every phase runs on the CPU and on the adapter, from the same input, and the results are compared number by number; then
the whole picture. Ids, labels and levels (decisions) must be equal; values are judged where the decisions that govern
them are. How far values may be apart depends on the adapter:
  strict    software adapters whose drivers may not rearrange arithmetic: every bit must agree
  ordinary  software adapters as they come
  hardware  real GPUs
The report begins with what each tier tolerates.";

/// Arguments of `vsgl parity`.
#[derive(Args, Debug)]
#[command(after_long_help = format!("{EXAMPLES}\n\n{}", crate::exit::EXIT_CODES), after_help = "--help has examples, and says what is compared.")]
pub struct ParityArgs {
    /// Scene, lights and camera.
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Size and samples; 320x180 unless given.
    #[command(flatten)]
    pub view: ViewArgs,
    /// How light is computed; 256 virtual lights unless given.
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// Write false-colour pictures of the differences: to FILE.png that of the whole picture, to DIR those of all phases
    #[arg(short, long, value_name = "DIR|FILE.png", help_heading = "Output")]
    pub output: Option<PathBuf>,
    /// Threads of the CPU, 0 for one a core
    #[arg(
        long,
        value_name = "N",
        allow_hyphen_values = true,
        default_value_t = 0,
        help_heading = "Output"
    )]
    pub threads: usize,
    /// Print one JSON document on standard output, and nothing else there
    #[arg(long, help_heading = "Output")]
    pub json: bool,
    /// Progress on standard error
    #[arg(
        long,
        value_enum,
        default_value = "auto",
        value_name = "WHEN",
        help_heading = "Output"
    )]
    pub progress: When,
}
