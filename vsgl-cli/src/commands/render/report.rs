//! What a rendering did, for people and for machines.

use super::{command, display_words};
use crate::args::OutputArgs;
use crate::commands::{SCHEMA_VERSION, facts};
use crate::job::Job;
use serde_json::{Value, json};

/// A file that was written.
pub(super) struct Written {
    pub(super) path: String,
    pub(super) format: &'static str,
    /// Stops of a PNG.
    pub(super) exposure: Option<f32>,
}

impl Written {
    pub(super) fn new(path: String, format: &'static str) -> Self {
        Self {
            path,
            format,
            exposure: None,
        }
    }
}

/// Wall time of each phase.
pub(super) type Seconds = Vec<(String, f64)>;

/// What was done.
pub(super) struct Report<'a> {
    pub(super) job: &'a Job,
    pub(super) out: &'a OutputArgs,
    pub(super) backend: &'static str,
    pub(super) device: &'a str,
    pub(super) clusters: Option<u32>,
    pub(super) seconds: Seconds,
    pub(super) written: Vec<Written>,
    pub(super) notes: Vec<String>,
}

impl Report<'_> {
    /// The command that does the same again, outputs and all.
    fn command(&self) -> String {
        let mut words = self.job.words();
        words.extend(display_words(self.out));
        for file in &self.out.files {
            words.extend(["-o".into(), file.to_string_lossy().into_owned()]);
        }
        if let Some(dump) = &self.out.dump {
            words.extend(["--dump".into(), dump.to_string_lossy().into_owned()]);
        }
        command(&words)
    }

    /// For people.
    pub(super) fn text(&self) -> String {
        let mut out = format!("{}\n\n", self.command());
        out += &facts::scene_text(self.job);
        if self.out.verbose {
            out += &facts::settings_text(self.job);
        }
        out += &facts::plan_text(self.job);
        out += &format!("phases    on {}, {}", self.backend, self.device);
        if let Some(clusters) = self.clusters {
            let clusters = facts::count(clusters as usize, "virtual light");
            out += &format!(", {clusters}");
        }
        out += "\n";
        let total: f64 = self.seconds.iter().map(|(_, s)| s).sum();
        for (phase, seconds) in &self.seconds {
            out += &format!("  {phase:<8} {seconds:>9.3} s\n");
        }
        out += &format!("  {:<8} {total:>9.3} s\n", "all");
        let (width, height) = self.job.view.pixels();
        out += &format!("written   {width}x{height}\n");
        for file in &self.written {
            out += &format!("  {}  {}", file.path, file.format);
            if let Some(stops) = file.exposure {
                out += &format!(", exposure {stops:+.2} stops");
            }
            out += "\n";
        }
        out
    }

    /// For machines.
    pub(super) fn json(&self) -> Value {
        let mut document = facts::json(self.job);
        let (width, height) = self.job.view.pixels();
        let phase = |(phase, seconds): &(String, f64)| json!({"phase": phase, "seconds": seconds});
        let file =
            |w: &Written| json!({"file": w.path, "format": w.format, "exposure": w.exposure});
        let warnings = [&self.job.warnings[..], &self.notes].concat();
        document["warnings"] = warnings.into();
        document["schema_version"] = SCHEMA_VERSION.into();
        document["command"] = self.command().into();
        document["backend"] = self.backend.into();
        document["device"] = self.device.into();
        document["virtual_lights"] = self.clusters.into();
        document["width"] = width.into();
        document["height"] = height.into();
        document["seed"] = self.job.seed.into();
        document["phases"] = self.seconds.iter().map(phase).collect();
        document["outputs"] = self.written.iter().map(file).collect();
        document
    }
}
