//! `vsgl info`: what a scene holds and what would run; without a scene, what the program offers.

use super::{SCHEMA_VERSION, contents, facts};
use crate::args::{InfoArgs, SceneArgs, SettingsArgs, ViewArgs};
use crate::device;
use crate::exit::{Failure, Result};
use crate::job::{Job, settings_json};
use crate::text;
use serde_json::{Value, json};
use vsgl_core::scene::samples;
use vsgl_core::settings::{Preset, Settings};

/// Reports.
///
/// # Errors
/// What reading the scene returns.
pub(super) fn run(args: &InfoArgs) -> Result<()> {
    if args.scene.scene.is_some() {
        return scene(args);
    }
    let plain = args.scene == SceneArgs::default()
        && args.view == ViewArgs::default()
        && args.settings == SettingsArgs::default();
    if !plain {
        return Err(Failure::Usage(
            "flags about a scene, but no SCENE; name one, such as sample:cornell".into(),
        ));
    }
    if args.json {
        text::print_json(&program_json())
    } else {
        text::print(&program_text())
    }
}

fn scene(args: &InfoArgs) -> Result<()> {
    let job = Job::new(&args.scene, &args.view, &args.settings)?;
    if args.json {
        let mut document = facts::json(&job);
        contents::add(&mut document, &job);
        document["schema_version"] = SCHEMA_VERSION.into();
        document["command"] = command(&job).into();
        return text::print_json(&document);
    }
    let mut out = format!("{}\n\n", command(&job));
    out += &facts::scene_text(&job);
    out += &contents::text(&job);
    out += &facts::cameras_text(&job);
    out += &facts::settings_text(&job);
    out += &facts::plan_text(&job);
    for warning in &job.warnings {
        out += &format!("warning   {warning}\n");
    }
    text::print(&out)
}

fn command(job: &Job) -> String {
    let start = ["vsgl", "info"].map(String::from);
    text::shell(&[&start[..], &job.words()].concat())
}

/// What computes, with its name on the command line.
const BACKENDS: [(&str, &str); 2] = [
    ("cpu", "all cores of the processor"),
    (
        "wgpu",
        "an adapter, the first unless VSGL_ADAPTER names another",
    ),
];

fn program_text() -> String {
    let mut out = format!("{}\n\nbackends\n", crate::output::software());
    for (name, about) in BACKENDS {
        out += &format!("  {name:<14}  {about}\n");
    }
    out += "\nadapters\n";
    let adapters = vsgl_wgpu::survey();
    for adapter in &adapters {
        out += &format!("  {}\n", device::adapter_text(&adapter.info));
        out += &format!("    {}\n", device::abilities_text(adapter));
    }
    if adapters.is_empty() {
        out += "  none: no graphics driver was found\n";
    }
    out += "\nsamples (write sample:NAME)\n";
    for name in samples::NAMES {
        let about = samples::describe(name).unwrap_or_default();
        out += &format!("  {name:<14}  {about}\n");
    }
    out += "\nsettings and their values in the presets\n";
    out += &format!("  {:<12}", "");
    for preset in Preset::ALL {
        out += &format!("  {:<16}", preset.word());
    }
    out = out.trim_end().to_owned() + "\n";
    let presets: Vec<_> = Preset::ALL.iter().map(|p| p.settings().entries()).collect();
    for (row, key) in Settings::KEYS.iter().enumerate() {
        let cells = presets
            .iter()
            .map(|entries| format!("  {:<16}", entries[row].1));
        let line = format!("  {key:<12}{}", cells.collect::<String>());
        out += &format!("{}\n", line.trim_end());
    }
    out
}

fn program_json() -> Value {
    let samples = samples::NAMES
        .iter()
        .map(|name| json!({"name": name, "about": samples::describe(name)}));
    let presets = Preset::ALL.iter().map(
        |preset| json!({"name": preset.word(), "settings": settings_json(&preset.settings())}),
    );
    json!({
        "schema_version": SCHEMA_VERSION,
        "version": env!("CARGO_PKG_VERSION"),
        "backends": BACKENDS.map(|(name, _)| name),
        "adapters": vsgl_wgpu::survey().iter().map(device::survey_json).collect::<Vec<_>>(),
        "samples": samples.collect::<Vec<_>>(),
        "presets": presets.collect::<Vec<_>>(),
    })
}
