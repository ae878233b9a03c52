//! What a rendering did, for people and for machines.

use super::command;
use crate::args::{OutputArgs, PartArgs};
use crate::choose::Choice;
use crate::commands::sheet::Written;
use crate::commands::{SCHEMA_VERSION, facts};
use crate::job::Job;
use crate::part::Ranges;
use serde_json::{Value, json};

/// Where the time went, in seconds.
pub(super) struct Seconds {
    /// Each phase, and what is before and after them.
    pub(super) list: Vec<(String, f64)>,
    /// From the first phase until the picture was here, by the host's clock.
    pub(super) wall: f64,
    /// Whose clock the phases were measured by.
    pub(super) clock: &'static str,
}

/// What was done.
pub(super) struct Report<'a> {
    pub(super) job: &'a Job,
    pub(super) out: &'a OutputArgs,
    pub(super) part: &'a PartArgs,
    /// Samples of paths that the picture holds, if it is one of paths.
    pub(super) samples: Option<Ranges>,
    pub(super) backend: &'static str,
    pub(super) device: String,
    pub(super) adapter: Option<Value>,
    /// Why the CPU was taken, if it was not asked for.
    pub(super) why: Option<String>,
    pub(super) clusters: Option<u32>,
    /// How settings were chosen, if they were.
    pub(super) choice: Option<Choice>,
    pub(super) seconds: Seconds,
    pub(super) written: Vec<Written>,
    pub(super) notes: Vec<String>,
}

impl Report<'_> {
    /// The command that does the same again, outputs and all.
    fn command(&self) -> String {
        let mut words = self.job.words();
        words.extend(self.out.display.words());
        if let Some(name) = self.out.backend.chosen() {
            words.extend(["--backend".into(), name.into()]);
        }
        if let Some(range) = &self.part.samples {
            words.extend(["--samples".into(), format!("{}:{}", range.start, range.end)]);
        }
        if self.part.resume {
            words.push("--resume".into());
        }
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
        if let Some(choice) = &self.choice {
            out += &choice.text(&self.job.settings);
        }
        out += &facts::plan_text(self.job);
        out += &format!("phases    on {}, {}", self.backend, self.device);
        if let Some(clusters) = self.clusters {
            let clusters = facts::count(clusters as usize, "virtual light");
            out += &format!(", {clusters}");
        }
        out += "\n";
        let total: f64 = self.seconds.list.iter().map(|(_, s)| s).sum();
        let line = |what: &str, seconds: f64| format!("  {what:<8} {seconds:>9.3} s");
        for (phase, seconds) in &self.seconds.list {
            out += &format!("{}\n", line(phase, *seconds));
        }
        if self.seconds.clock == "host" {
            out += &format!("{}\n", line("all", total));
        } else {
            // Phases overlap with the host's work: their sum says little.
            let note =
                "from the first phase to the picture by the host's clock; phases by the adapter's";
            out += &format!("{}  {note}\n", line("picture", self.seconds.wall));
        }
        let (width, height) = self.job.view.pixels();
        out += &format!("written   {width}x{height}");
        if let Some(samples) = &self.samples {
            let of = self.job.settings.spp;
            out += &format!(", samples {samples} of {of}");
        }
        out += "\n";
        out += &self.written.iter().map(Written::text).collect::<String>();
        out
    }

    /// For machines.
    pub(super) fn json(&self) -> Value {
        let mut document = facts::json(self.job);
        let (width, height) = self.job.view.pixels();
        let phase = |(phase, seconds): &(String, f64)| json!({"phase": phase, "seconds": seconds});
        let warnings = [&self.job.warnings[..], &self.notes].concat();
        document["warnings"] = warnings.into();
        document["schema_version"] = SCHEMA_VERSION.into();
        document["command"] = self.command().into();
        document["backend"] = self.backend.into();
        document["device"] = self.device.as_str().into();
        document["adapter"] = self.adapter.clone().into();
        document["backend_reason"] = self.why.as_deref().into();
        document["virtual_lights"] = self.clusters.into();
        document["width"] = width.into();
        document["height"] = height.into();
        document["choice"] = self.choice.as_ref().map(Choice::json).into();
        document["seed"] = self.job.seed.into();
        document["samples"] = self.samples.as_ref().map(Ranges::json).into();
        document["phases"] = self.seconds.list.iter().map(phase).collect();
        document["phase_clock"] = self.seconds.clock.into();
        document["picture_seconds"] = self.seconds.wall.into();
        document["outputs"] = self.written.iter().map(Written::json).collect();
        document
    }
}
