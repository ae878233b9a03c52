//! Arguments of `vsgl render` and `vsgl info`.

use super::{SceneArgs, SettingsArgs, ViewArgs};
use crate::output::exposure::Exposure;
use crate::output::tonemap::Tonemap;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

const RENDER_EXAMPLES: &str = "\
Examples:
  vsgl render -o cornell.png
  vsgl render room.glb -o room.png -o room.exr --size 1280x720 --aa 2 --lights 4096
  vsgl render room.glb -o room.png --look-at 0,1.6,4:0,1,0 --fov 50 --spot 0,2.4,0:1,0,1:90:40:30
  vsgl render room.glb -o reference.exr --method vpl --stride 3 --occlusion none";

const INFO_EXAMPLES: &str = "\
Examples:
  vsgl info
  vsgl info sample:columns
  vsgl info room.glb --preset paper-2016 --spot 0,2.4,0:1,0,1:90:40 --json";

/// Arguments of `vsgl render`.
#[derive(Args, Debug)]
#[command(after_long_help = format!("{RENDER_EXAMPLES}\n\n{}", crate::exit::EXIT_CODES), after_help = "--help has examples.")]
pub struct RenderArgs {
    /// Scene, lights and camera.
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Size and samples.
    #[command(flatten)]
    pub view: ViewArgs,
    /// How light is computed.
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// What is written, and what is shown meanwhile.
    #[command(flatten)]
    pub output: OutputArgs,
}

/// Outputs and reports of `vsgl render`.
#[derive(Args, Debug)]
#[command(next_help_heading = "Output")]
pub struct OutputArgs {
    /// File to write: .png (8 bit, tone-mapped) or .exr (linear f32, all layers) (repeatable)
    #[arg(
        short = 'o',
        long = "output",
        value_name = "FILE",
        required_unless_present = "dump"
    )]
    pub files: Vec<PathBuf>,
    /// Exposure of a PNG in stops
    ///
    /// auto: the geometric mean of the lit pixels' luminance goes to 0.25, or lower where that would put more than one
    /// lit pixel in twenty above 1.5.
    #[arg(long, value_name = "auto|EV", default_value = "auto", value_parser = Exposure::parse, allow_hyphen_values = true)]
    pub exposure: Exposure,
    /// Tone curve of a PNG: Khronos PBR Neutral, or none
    #[arg(long, value_enum, default_value = "neutral")]
    pub tonemap: Tonemap,
    /// Write pictures of the reflective shadow maps, the density and the clusters to DIR
    #[arg(long, value_name = "DIR")]
    pub dump: Option<PathBuf>,
    /// What computes; the variable VSGL_ADAPTER names an adapter by a part of its name, `vsgl info` lists them
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: BackendName,
    /// Threads of the CPU, 0 for one a core; the picture is the same for any number
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
    /// No report, no warnings, no progress
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Report all settings
    #[arg(short, long)]
    pub verbose: bool,
}

/// Arguments of `vsgl info`.
#[derive(Args, Debug)]
#[command(after_long_help = format!("{INFO_EXAMPLES}\n\n{}", crate::exit::EXIT_CODES), after_help = "--help has examples.")]
pub struct InfoArgs {
    /// Scene, lights and camera.
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Size and samples.
    #[command(flatten)]
    pub view: ViewArgs,
    /// How light is computed.
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// Print one JSON document on standard output, and nothing else
    #[arg(long)]
    pub json: bool,
}

/// What computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BackendName {
    /// A real GPU if there is one, else the CPU.
    Auto,
    /// The processor's cores.
    Cpu,
    /// Any adapter that wgpu finds: a GPU, or a software driver, which is slower than the CPU backend.
    Wgpu,
}

impl BackendName {
    /// Its name, if one was chosen.
    pub fn chosen(self) -> Option<&'static str> {
        match self {
            Self::Auto => None,
            Self::Cpu => Some("cpu"),
            Self::Wgpu => Some("wgpu"),
        }
    }
}

/// Whether something is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum When {
    /// If standard error is a terminal.
    Auto,
    /// Also elsewhere, as lines.
    Always,
    /// Not at all.
    Never,
}
