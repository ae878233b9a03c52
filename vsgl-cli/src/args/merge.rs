//! Arguments of `vsgl merge`.

use super::DisplayArgs;
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  vsgl merge part-0.exr part-1.exr -o whole.exr
  vsgl merge part-*.exr -o whole.exr -o whole.png
  vsgl merge part-0.exr part-3.exr -o some.exr --allow-missing

Parts are pictures by `vsgl render --method path` with --samples, or interrupted ones. In whichever ranges the samples were rendered
and in whichever order parts are given, the result has the bits of one run. Refused are parts that hold samples twice, that were made
by other settings or versions, and missing samples.";

/// Arguments of `vsgl merge`.
#[derive(Args, Debug)]
#[command(after_long_help = format!("{EXAMPLES}\n\n{}", crate::exit::EXIT_CODES), after_help = "--help has examples.")]
pub struct MergeArgs {
    /// Parts of one picture, in any order
    #[arg(value_name = "PART", required = true)]
    pub parts: Vec<PathBuf>,
    /// Merge also if samples are missing; the result is a part itself
    #[arg(long)]
    pub allow_missing: bool,
    /// File to write: .png (8 bit, tone-mapped) or .exr (linear f32, all layers) (repeatable)
    #[arg(short = 'o', long = "output", value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// How a PNG looks.
    #[command(flatten)]
    pub display: DisplayArgs,
    /// Print one JSON document on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
    /// No report
    #[arg(short, long)]
    pub quiet: bool,
}
