//! Arguments of `vsgl lobe`.

use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  vsgl lobe --check tests/reference
  vsgl lobe --check tests/reference --markdown
  vsgl lobe -o plots";

/// Arguments of `vsgl lobe`.
#[derive(Args, Debug)]
#[command(arg_required_else_help = true, after_long_help = format!("{EXAMPLES}\n\n{}", crate::exit::EXIT_CODES))]
pub struct LobeArgs {
    /// Judge every function against the tables of exact values in DIR
    #[arg(long, value_name = "DIR")]
    pub check: Option<PathBuf>,
    /// Print the judgement as the tables of docs/accuracy.md
    #[arg(long, requires = "check", conflicts_with = "json")]
    pub markdown: bool,
    /// Draw errors and values of all forms beside the exact ones into DIR, as SVG and CSV
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Print the judgement as JSON
    #[arg(long, requires = "check")]
    pub json: bool,
}
