//! `vsgl sweep --explain`: where the error of a picture comes from.

mod chain;
mod map;
mod points;
mod report;

use crate::args::{BackendName, SweepArgs};
use crate::commands::{SCHEMA_VERSION, facts};
use crate::exit::{Failure, Result};
use crate::job::Job;
use crate::output::exposure::automatic;
use crate::output::font::Canvas;
use crate::output::tonemap::Tonemap;
use crate::output::{self, Metadata, Pending};
use crate::progress::Progress;
use crate::{interrupt, text};
use chain::chain;
use report::Measured;
use serde_json::Value;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;
use vsgl_cpu::CpuBackend;

/// Splits the error of one picture, writes and reports.
///
/// # Errors
/// [`Failure::Usage`] for settings whose error cannot be split, and what reading, rendering and writing return.
pub(super) fn run(args: &SweepArgs) -> Result<()> {
    let out = &args.sweep;
    let other = |name: &BackendName| *name == BackendName::Wgpu;
    if out.backend.iter().any(other) {
        return Err(Failure::Usage(
            "--explain sums up texels on the CPU alone; leave `--backend wgpu` away".into(),
        ));
    }
    let mut job = super::job(args)?;
    interrupt::listen()?;
    let files = Files::open(&out.output)?;
    let backend = CpuBackend::new(out.threads)?;
    let scene = Arc::new(job.prepare()?);
    let start = Instant::now();
    let progress = Progress::new(out.progress);
    let chain = chain(&backend, &scene, &job, out.quick, &progress);
    progress.finish();
    let chain = chain?;
    let measured = Measured::new(&chain)?;
    let mut document = report::document(&measured);
    document["seconds"] = text::json_number(start.elapsed().as_secs_f64());
    let command = command(args, &job);
    head(&mut document, &job, &command);
    files.write(&measured, &document, &command)?;
    if out.json {
        return text::print_json(&document);
    }
    text::print(&format!("{command}\n{}", report::text(&document)))
}

/// What was explained.
fn head(document: &mut Value, job: &Job, command: &str) {
    let facts = facts::json(job);
    document["schema_version"] = SCHEMA_VERSION.into();
    document["software"] = output::software().into();
    document["command"] = command.into();
    document["backend"] = "cpu".into();
    document["facts"] = facts;
    document["width"] = job.view.width.into();
    document["height"] = job.view.height.into();
    document["aa"] = job.view.aa.into();
    document["settings"] = crate::job::settings_json(&job.settings);
}

fn command(args: &SweepArgs, job: &Job) -> String {
    let mut words = ["vsgl", "sweep"].map(String::from).to_vec();
    words.extend(job.words());
    words.push("--explain".into());
    if args.sweep.quick {
        words.push("--quick".into());
    }
    words.extend([
        "-o".into(),
        args.sweep.output.to_string_lossy().into_owned(),
    ]);
    text::shell(&words)
}

/// The files that are not pictures: made before the work, so that a bad folder is found then.
struct Files<'a> {
    folder: &'a Path,
    json: Pending,
    csv: Pending,
}

impl<'a> Files<'a> {
    fn open(folder: &'a Path) -> Result<Self> {
        Ok(Self {
            folder,
            json: Pending::create(&folder.join("explain.json"))?,
            csv: Pending::create(&folder.join("explain.csv"))?,
        })
    }

    /// Writes all; the document last, since what it names is there then.
    fn write(self, measured: &Measured<'_>, document: &Value, command: &str) -> Result<()> {
        use std::io::Write;
        for (name, canvas) in pictures(measured) {
            interrupt::check()?;
            let metadata = Metadata {
                software: output::software(),
                command: command.into(),
                ..Metadata::default()
            };
            let (width, height) = (canvas.width as u32, canvas.height as u32);
            let file = Pending::create(&self.folder.join(name))?;
            file.write(|file| output::png::write(file, width, height, &canvas.pixels, &metadata))?;
        }
        self.csv
            .write(|file| file.write_all(report::table(document).as_bytes()))?;
        self.json
            .write(|file| file.write_all(format!("{document:#}\n").as_bytes()))
    }
}

/// A map for each cause and for the whole error, and the two pictures that it is between.
fn pictures(measured: &Measured<'_>) -> Vec<(String, Canvas)> {
    let chain = measured.chain;
    let (grid, truth) = (chain.points.grid, measured.grid.truth());
    let map = |step: &[f64]| map::draw(step, truth, grid);
    let mut all: Vec<_> = chain
        .links
        .iter()
        .filter(|link| link.none.is_none())
        .map(|link| (report::picture_name(link), map(&link.step.mean())))
        .collect();
    all.push((
        "explain/whole.png".into(),
        map(&measured.grid.whole().mean()),
    ));
    let grey = |values: &[f64]| -> Vec<[f32; 3]> {
        let single = values[..chain.points.singles()].iter();
        single.map(|&v| [v as f32; 3]).collect()
    };
    let scale = automatic(&grey(&chain.truth.mean())).exp2();
    for (name, picture) in [("tested", &chain.tested), ("truth", &chain.truth)] {
        let pixels = grey(&picture.mean());
        let code = |at: usize| {
            let shown = pixels[at].map(|c| c * scale);
            Tonemap::Neutral.apply(shown).map(output::srgb::code)
        };
        let canvas = map::squares(grid.0, grid.1, code);
        all.push((format!("explain/{name}.png"), canvas));
    }
    all
}
