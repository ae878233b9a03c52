//! Arguments of `vsgl sweep`.

use super::{BackendName, SceneArgs, SettingsArgs, ViewArgs, When};
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  vsgl sweep sample:cornell -o cornell --quick
  vsgl sweep room.glb -o room --size 1280x720 --backend cpu,wgpu
  vsgl sweep room.glb -o room --occlusion rays --grid lights=64,256,1024 --grid rsm=128,256,512
  vsgl sweep room.glb -o room --explain --occlusion sampled --interleave 4

Every combination of settings is rendered and timed, and compared with the method `path` at the same size. DIR gets
  report.html    curves, pictures, advice: one file that needs no others
  sweep.jsonl    a line for what was swept, then one for each combination
  sweep.csv      the same as a table
  reference.exr  the truth that the errors are against
  pictures/      a PNG of each combination
The reference has 512 paths through each pixel, 256 with --quick, or as many as --spp says; with --explain 8192 and 2048.
Run the same command again after an interruption: what is there is not done again.";

/// Arguments of `vsgl sweep`.
#[derive(Args, Debug)]
#[command(after_long_help = format!("{EXAMPLES}\n\n{}", crate::exit::EXIT_CODES), after_help = "--help has examples, and says what is written.")]
pub struct SweepArgs {
    /// Scene, lights and camera.
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Size and samples; 320x180 unless given with --quick.
    #[command(flatten)]
    pub view: ViewArgs,
    /// What all combinations share: a setting that is given here is not swept. `--spp` is that of the reference.
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// What is swept, where it goes, and what is shown meanwhile.
    #[command(flatten)]
    pub sweep: SweepOutputArgs,
}

/// What is swept, and where it goes.
#[derive(Args, Debug)]
#[command(next_help_heading = "Sweep")]
pub struct SweepOutputArgs {
    /// Folder for the report and what it was made from; made if need be
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// About a minute's worth: 320x180, fewer combinations, fewer runs, a noisier reference
    #[arg(long)]
    pub quick: bool,
    /// Instead of a sweep: split the error of one picture by its causes, in one to four minutes (on the CPU)
    ///
    /// Writes explain.json, explain.csv and explain/*.png to DIR: a map for each cause of where it makes indirect light too bright
    /// or too dark. See docs/explain.md.
    #[arg(long, conflicts_with_all = ["grid", "runs", "longest"])]
    pub explain: bool,
    /// Values of a setting to go through (repeatable)
    ///
    /// Without it: lights=64,256,1024,4096, interleave=1,2,4,8 and occlusion=rays,sampled,none, less those that are set by
    /// a flag.
    #[arg(long, value_name = "KEY=VALUE,VALUE...", value_parser = super::settings::key_value)]
    pub grid: Vec<(String, String)>,
    /// What computes: one or several of auto, cpu, wgpu [default: cpu, and a real GPU if there is one]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "NAME,NAME...")]
    pub backend: Vec<BackendName>,
    /// Runs of each combination after one to warm up; frames of more than two seconds are not warmed up, and slow ones run
    /// less often [default: 5, or 2 with --quick]
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub runs: Option<u32>,
    /// Leave combinations out whose frame would take longer [default: 30, or 3 with --quick]
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true, value_parser = super::words::duration)]
    pub longest: Option<f64>,
    /// Threads of the CPU, 0 for one a core
    #[arg(
        long,
        value_name = "N",
        allow_hyphen_values = true,
        default_value_t = 0
    )]
    pub threads: usize,
    /// Print one JSON document on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
    /// Progress on standard error
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    pub progress: When,
}
