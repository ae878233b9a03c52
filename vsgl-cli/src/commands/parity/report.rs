//! What the comparisons found, for people and for machines.

use super::Tier;
use crate::args::ParityArgs;
use crate::commands::SCHEMA_VERSION;
use crate::device::{adapter_json, adapter_text};
use crate::job::Job;
use crate::text::{self, json_number};
use serde_json::{Value, json};
use vsgl_core::parity::{ColumnVerdict, Comparison, Origin, Step, Worst};
use vsgl_wgpu::wgpu::AdapterInfo;

/// What was compared, and how it came out.
pub(super) struct Report<'a> {
    pub(super) job: &'a Job,
    pub(super) args: &'a ParityArgs,
    pub(super) reference: Origin,
    pub(super) adapter: &'a AdapterInfo,
    pub(super) tiers: &'a [Tier],
    pub(super) written: Vec<String>,
}

impl Report<'_> {
    /// The command that compares the same again.
    fn command(&self) -> String {
        let mut words = command_words(self.job);
        if let Some(path) = &self.args.output {
            words.extend(["-o".into(), path.to_string_lossy().into_owned()]);
        }
        text::shell(&words)
    }

    /// For people: a line for each column.
    pub(super) fn text(&self) -> String {
        let mut out = format!("{}\n\n", self.command());
        out += &format!("reference  {}\n", self.reference);
        out += &format!("tested     wgpu, {}\n", adapter_text(self.adapter));
        for tier in self.tiers {
            out += &format!("\n{}: {}\n", tier.tolerance.name, tier.tolerance.describe());
            match &tier.steps {
                Ok(steps) => steps.iter().for_each(|step| out += &step_text(step)),
                Err(why) => out += &format!("  not tested: {why}\n"),
            }
        }
        if !self.written.is_empty() {
            out += "\nwritten\n";
        }
        for path in &self.written {
            out += &format!("  {path}\n");
        }
        out += "\n";
        for tier in self.tiers {
            let verdict = match (&tier.steps, tier.passed()) {
                (Err(_), _) => "not tested",
                (Ok(_), true) => "passed",
                (Ok(_), false) => "over the tolerance",
            };
            out += &format!("{:<10} {verdict}\n", tier.tolerance.name);
        }
        out
    }

    /// For machines.
    pub(super) fn json(&self) -> Value {
        let (width, height) = self.job.view.pixels();
        json!({
            "schema_version": SCHEMA_VERSION,
            "command": self.command(),
            "scene": self.job.name,
            "width": width,
            "height": height,
            "settings": crate::job::settings_json(&self.job.settings),
            "reference": {"backend": self.reference.backend, "device": self.reference.device},
            "adapter": adapter_json(self.adapter),
            "tiers": self.tiers.iter().map(tier_json).collect::<Vec<_>>(),
            "passed": self.tiers.iter().all(Tier::passed),
            "warnings": self.job.warnings,
            "outputs": self.written,
        })
    }
}

/// The words of the command, without outputs.
pub(super) fn command_words(job: &Job) -> Vec<String> {
    let start = ["vsgl", "parity"].map(String::from);
    let mut words = [&start[..], &job.words()].concat();
    // Unless given, this command takes another number than `words` leaves out.
    if !words.iter().any(|word| word == "--lights") {
        words.extend(["--lights".into(), job.settings.lights.to_string()]);
    }
    words
}

fn step_text(step: &Step) -> String {
    let Comparison {
        resource,
        misfits,
        columns,
        ..
    } = &step.comparison;
    let line = |name: &str, passed: bool, what: &str| {
        let verdict = if passed { "ok" } else { "OVER" };
        format!("  {:<8} {name:<25} {verdict:<5} {what}\n", step.stage)
    };
    let mut out = String::new();
    for misfit in misfits {
        out += &line(resource, false, misfit);
    }
    for column in columns.iter().filter(|c| c.entries > 0) {
        let name = format!("{resource}.{}", column.name);
        out += &line(&name, column.passed, &column.describe());
    }
    out
}

fn tier_json(tier: &Tier) -> Value {
    let steps = tier.steps.iter().flatten();
    json!({
        "tier": tier.tolerance.name,
        "tolerance": tier.tolerance.describe(),
        "device": tier.tested.device,
        "tested": tier.steps.is_ok(),
        "reason": tier.steps.as_ref().err(),
        "passed": tier.steps.is_ok() && tier.passed(),
        "steps": steps.map(step_json).collect::<Vec<_>>(),
    })
}

fn step_json(step: &Step) -> Value {
    let comparison = &step.comparison;
    json!({
        "stage": step.stage.to_string(),
        "resource": comparison.resource,
        "passed": comparison.passed(),
        "misfits": comparison.misfits,
        "columns": comparison.columns.iter().map(column_json).collect::<Vec<_>>(),
    })
}

fn column_json(column: &ColumnVerdict) -> Value {
    let worst = |worst: &Worst| {
        json!({
            "entry": worst.entry,
            "place": worst.place.to_string(),
            "number": worst.name,
            "tested": json_number(worst.tested),
            "reference": json_number(worst.reference),
        })
    };
    json!({
        "column": column.name,
        "entries": column.entries,
        "numbers": column.entries * column.lanes,
        "differing": column.differing,
        "differing_numbers": column.differing_components,
        "decisions": column.decisions,
        "unjudged": column.unjudged,
        "not_finite": column.broken,
        "over": column.over,
        "ulps": column.ulps,
        "relative": json_number(column.relative),
        "mean_relative": json_number(column.mean_relative),
        "worst": column.worst.as_ref().map(worst),
        "passed": column.passed,
    })
}
