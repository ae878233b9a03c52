//! Arguments of `vsgl render` and `vsgl info`.

use super::words::samples;
use super::{SceneArgs, SettingsArgs, ViewArgs};
use crate::output::exposure::Exposure;
use crate::output::tonemap::Tonemap;
use clap::{Args, ValueEnum};
use std::ops::Range;
use std::path::PathBuf;

const RENDER_EXAMPLES: &str = "\
Examples:
  vsgl render -o cornell.png
  vsgl render room.glb -o room.png -o room.exr --size 1280x720 --aa 2 --lights 4096
  vsgl render room.glb -o room.png --look-at 0,1.6,4:0,1,0 --fov 50 --spot 0,2.4,0:1,0,1:90:40:30
  vsgl render room.glb -o room.png --budget 200ms
  vsgl render room.glb -o reference.exr --method vpl --stride 3 --occlusion none
  vsgl render room.glb -o truth.exr --method path --spp 4096 --resume
  vsgl render room.glb -o part.exr --method path --spp 4096 --samples 1024:2048";

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
    /// Which samples of paths.
    #[command(flatten)]
    pub part: PartArgs,
    /// Settings that are chosen by measurement.
    #[command(flatten)]
    pub goal: GoalArgs,
    /// What is written, and what is shown meanwhile.
    #[command(flatten)]
    pub output: OutputArgs,
}

/// Parts of a picture of paths, and going on with one.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Parts (with --method path, into .exr)")]
pub struct PartArgs {
    /// Render these of the --spp samples alone, from A up to B: a part, which `vsgl merge` adds to others
    ///
    /// A and B are multiples of 8, or B is all. Parts of any ranges are merged to the bits of the whole picture.
    #[arg(long, value_name = "A:B", value_parser = samples)]
    pub samples: Option<Range<u32>>,
    /// Go on from the samples that the output holds, if it is there, and save them every five minutes
    ///
    /// After Ctrl-C, or whatever else ended the program, the same command with this goes on. The picture has the bits of one that was
    /// never interrupted. Done is done: a whole picture is not rendered again.
    #[arg(long)]
    pub resume: bool,
}

/// How a PNG looks.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Output")]
pub struct DisplayArgs {
    /// Exposure of a PNG in stops
    ///
    /// auto: the geometric mean of the lit pixels' luminance goes to 0.25, or lower where that would put more than one
    /// lit pixel in twenty above 1.5.
    #[arg(long, value_name = "auto|EV", default_value = "auto", value_parser = Exposure::parse, allow_hyphen_values = true)]
    pub exposure: Exposure,
    /// Tone curve of a PNG: Khronos PBR Neutral, or none
    #[arg(long, value_enum, default_value = "neutral")]
    pub tonemap: Tonemap,
}

impl DisplayArgs {
    /// Flags that decide how a PNG looks, where they differ from the usual.
    pub fn words(&self) -> Vec<String> {
        let mut words = Vec::new();
        if let Exposure::Stops(stops) = self.exposure {
            words.push(format!("--exposure={stops}"));
        }
        if self.tonemap != Tonemap::Neutral {
            words.extend(["--tonemap".into(), self.tonemap.word().into()]);
        }
        words
    }
}

/// What settings are chosen for.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq)]
#[command(next_help_heading = "Settings chosen by measurement (those that are not given)")]
pub struct GoalArgs {
    /// Choose --lights, --interleave and --occlusion for the least error that a frame of this time has, such as 200ms
    ///
    /// Small pictures and paths of light tell in some seconds what settings cost and err in this scene on this machine; a few
    /// frames at the full size correct that. The report says what was predicted and what was measured. The time is that of the
    /// phases, without reading the scene and writing files.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = super::words::budget, conflicts_with = "target_error")]
    pub budget: Option<f64>,
    /// Choose them for the fastest frame that has this error, such as 5%
    ///
    /// The error is the mean absolute percentage error of the indirect light in blocks of 8 by 8 pixels against paths of light.
    #[arg(long, value_name = "PERCENT", allow_hyphen_values = true, value_parser = super::words::percent)]
    pub target_error: Option<f64>,
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
    /// How a PNG looks.
    #[command(flatten)]
    pub display: DisplayArgs,
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
