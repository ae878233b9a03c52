//! Times of a GPU phase by phase, at the setting of Tokuyoshi 2016 and at every variant of it, as a page of Markdown. Run by
//! `scripts/gpu-report`.

mod operations;
mod page;
mod variants;

use page::{Page, Row};
use std::process::ExitCode;
use std::time::{Duration, Instant};
use variants::Variant;
use vsgl_core::backend::Backend;
use vsgl_core::data::SceneData;
use vsgl_core::plan::Plan;
use vsgl_core::render::{Phase, View, render};
use vsgl_core::scene::{Scene, SceneFacts, samples};
use vsgl_core::{Error, Result};
use vsgl_wgpu::{Clock, Timings, WgpuBackend, WgpuOptions, WgpuRes, is_software};

const USAGE: &str = "gpu-report [--adapter NAME] [--size WxH] [--quick]
  NAME is a part of the adapter's name; without, the best one is taken. WxH is 1920x1088 unless given. --quick takes 64x36
  pixels, 64 lights and small maps, as is done on a software driver.";

/// How much is measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    pub(crate) size: (u32, u32),
    /// Smaller maps and fewer lights.
    pub(crate) quick: bool,
    /// Runs whose median is taken, after one that is not counted.
    pub(crate) runs: usize,
}

fn main() -> ExitCode {
    match arguments().and_then(run) {
        Ok(page) => {
            println!("{page}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("gpu-report: {error}");
            ExitCode::from(match error {
                Error::NoAdapter { .. } => 4,
                Error::Setting { .. } => 2,
                _ => 70,
            })
        }
    }
}

#[derive(Debug, Default)]
struct Arguments {
    adapter: Option<String>,
    size: Option<(u32, u32)>,
    quick: bool,
}

fn arguments() -> Result<Arguments> {
    let mut found = Arguments::default();
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        match &*word {
            "--adapter" => found.adapter = words.next(),
            "--quick" => found.quick = true,
            "--size" => {
                let value = words.next().unwrap_or_default();
                let parsed = value
                    .split_once('x')
                    .and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
                found.size =
                    Some(parsed.ok_or_else(|| Error::setting("size", value, "give WIDTHxHEIGHT"))?);
            }
            _ => return Err(Error::setting("arguments", word, USAGE)),
        }
    }
    Ok(found)
}

fn run(arguments: Arguments) -> Result<Page> {
    let options = WgpuOptions {
        timing: true,
        adapter: arguments.adapter,
        ..WgpuOptions::default()
    };
    let gpu = WgpuBackend::headless(&options)?;
    let quick = arguments.quick || is_software(gpu.context().info());
    let size = if quick { (64, 36) } else { (1920, 1088) };
    let scale = Scale {
        size: arguments.size.unwrap_or(size),
        quick,
        runs: if quick { 1 } else { 9 },
    };
    let mut page = Page::new(gpu.context().info().clone(), scale);
    for sample in ["cornell", "columns"] {
        let scene = samples::by_name(sample)?;
        let subject = Subject {
            gpu: &gpu,
            data: gpu.upload(SceneData::new(&scene))?,
            view: View::new(scene.cameras[0].1, scale.size.0, scale.size.1)?,
            scene,
            runs: scale.runs,
        };
        for variant in variants::all(scale.quick) {
            page.add(subject.row(sample, &variant)?);
        }
    }
    Ok(page)
}

struct Subject<'a> {
    gpu: &'a WgpuBackend,
    data: WgpuRes<SceneData>,
    view: View,
    scene: Scene,
    runs: usize,
}

impl Subject<'_> {
    fn row(&self, sample: &'static str, variant: &Variant) -> Result<Row> {
        let facts = SceneFacts::new(&self.scene, &self.scene.lights, &self.view.camera);
        let mut row = Row {
            scene: sample,
            what: variant.what.clone(),
            phases: Vec::new(),
            clock: Clock::Wall,
            note: String::new(),
        };
        // Not everything goes together, and the words say what does not.
        let plan = match Plan::new(&facts, &variant.settings) {
            Ok(plan) => plan,
            Err(error) => {
                row.note = error.to_string();
                return Ok(row);
            }
        };
        (row.phases, row.clock) = self.median(&plan)?;
        let time = |wanted: Phase| row.phases.iter().find(|(p, _)| *p == wanted).map(|p| p.1);
        if let (Some(time), true) = (time(Phase::Shade), variant.every_pair) {
            let (width, height) = self.view.samples();
            let lights = f64::from(variant.settings.lights);
            let pairs = f64::from(width) * f64::from(height) * lights;
            let rate = pairs / time.as_secs_f64();
            let each = operations::per_light(&plan)?;
            row.note = format!(
                "{:.3} G pairs/s, {each} float operations a pair: {:.3} TFLOP/s",
                rate * 1e-9,
                rate * each as f64 * 1e-12
            );
        }
        Ok(row)
    }

    /// Median times of the phases of a frame over several runs, and the clock that they were taken by.
    fn median(&self, plan: &Plan) -> Result<(Vec<(Phase, Duration)>, Clock)> {
        let start = Instant::now();
        self.frame(plan)?;
        // What takes long varies little.
        let runs = if start.elapsed() > Duration::from_secs(2) {
            self.runs.min(3)
        } else {
            self.runs
        };
        let mut all: Vec<(Phase, Vec<Duration>)> = Vec::new();
        let mut clock = Clock::Wall;
        for _ in 0..runs {
            let timings = self.frame(plan)?;
            clock = timings.clock;
            for (phase, time) in timings.phases {
                match all.iter_mut().find(|(p, _)| *p == phase) {
                    Some((_, times)) => times.push(time),
                    None => all.push((phase, vec![time])),
                }
            }
        }
        let median = |(phase, mut times): (Phase, Vec<Duration>)| {
            times.sort_unstable();
            (phase, times[times.len() / 2])
        };
        Ok((all.into_iter().map(median).collect(), clock))
    }

    fn frame(&self, plan: &Plan) -> Result<Timings> {
        let lights = &self.scene.lights;
        render(self.gpu, &self.data, lights, &self.view, plan, &())?;
        self.gpu
            .timings()?
            .ok_or_else(|| Error::setting("timing", "none", "ask for it when the device is opened"))
    }
}
