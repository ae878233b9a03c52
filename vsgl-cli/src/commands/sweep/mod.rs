//! `vsgl sweep`: error against time over a grid of settings, and which of them are worth it.

mod advice;
mod explain;
mod grid;
mod page;
mod record;
mod report;

use crate::args::{BackendName, Size, SweepArgs};
use crate::device::{self, Chosen, Host};
use crate::exit::{Failure, Result};
use crate::job::{Defaults, Job};
use crate::measure::{Effort, Layers, Measured, Reference, Shot, Wanted, measure};
use crate::output::exposure::automatic;
use crate::output::tonemap::Tonemap;
use crate::output::{self, Metadata, Pending};
use crate::picture::Picture;
use crate::progress::{Progress, Steps};
use crate::{fingerprint, interrupt, text};
use grid::{Combination, Grid};
use record::Records;
use serde_json::{Value, json};
use std::path::Path;
use std::time::Duration;
use vsgl_core::data::SceneData;
use vsgl_core::settings::Settings;

/// Size of the picture with `--quick`.
const QUICK: Size = Size {
    width: 320,
    height: 180,
};
/// Sides of the blocks that are compared.
const SIDES: [u32; 2] = [1, 8];
/// Frames that take longer need no warming up.
const WARM_UP: Duration = Duration::from_secs(2);
/// Folder of the pictures in the folder of the sweep.
const PICTURES: &str = "pictures";

/// How thorough a sweep is.
#[derive(Clone, Copy, Debug)]
struct Depth {
    /// Paths through each pixel of the reference.
    spp: u32,
    runs: u32,
    /// No further run of a combination begins after so many seconds.
    patience: u64,
    /// Longest frame in seconds.
    longest: f64,
}

const THOROUGH: Depth = Depth {
    spp: 512,
    runs: 5,
    patience: 20,
    longest: 30.0,
};
const HASTY: Depth = Depth {
    spp: 256,
    runs: 2,
    patience: 1,
    longest: 3.0,
};

/// Sweeps and reports.
///
/// # Errors
/// What reading, rendering and writing return; [`Failure::Output`] if the folder holds another sweep.
pub(super) fn run(args: &SweepArgs) -> Result<()> {
    if args.sweep.explain {
        return explain::run(args);
    }
    let (mut sweep, data) = Sweep::new(args)?;
    let swept = sweep.on_all(data);
    match &swept {
        // What there is can be looked at; the same command goes on.
        Err(Failure::Interrupted(_)) if !sweep.records.points.is_empty() => {
            sweep.write(false)?;
            swept
        }
        Err(_) => swept,
        Ok(()) => {
            let document = sweep.write(true)?;
            match args.sweep.json {
                true => text::print_json(&document),
                false => text::print(&report::text(&document)),
            }
        }
    }
}

/// The backends of these names; without any, the processor and a real GPU if there is one.
fn backends(names: &[BackendName], threads: usize) -> Result<Vec<Chosen>> {
    if !names.is_empty() {
        let open = |&name: &BackendName| device::choose(name, threads);
        return names.iter().map(open).collect();
    }
    let cpu = device::choose(BackendName::Cpu, threads)?;
    Ok(match device::choose(BackendName::Auto, threads)? {
        gpu @ Chosen::Wgpu(_) => vec![gpu, cpu],
        Chosen::Cpu(..) => vec![cpu],
    })
}

/// What is swept or explained; the user is told its warnings.
fn job(args: &SweepArgs) -> Result<Job> {
    let mut defaults = Defaults::default();
    if args.sweep.quick {
        defaults.size = QUICK;
    }
    let job = Job::with(&args.scene, &args.view, &args.settings, &defaults)?;
    job.check_drawable()?;
    for warning in &job.warnings {
        text::warn(&format!("warning: {warning}"));
    }
    Ok(job)
}

/// What became of a combination.
enum Found {
    /// It was recorded before; seconds of a frame.
    There(f64),
    /// It was measured.
    New(Box<Value>),
    /// It was not measured, for this reason.
    LeftOut(String),
}

/// A sweep on its way.
struct Sweep<'a> {
    args: &'a SweepArgs,
    job: Job,
    grid: Grid,
    depth: Depth,
    records: Records,
    reference: Option<Reference>,
    /// Points that there will be at most.
    planned: usize,
    /// Devices that computed.
    devices: Vec<String>,
    /// Name and reason of what was not measured.
    left_out: Vec<(String, String)>,
}

impl<'a> Sweep<'a> {
    fn new(args: &'a SweepArgs) -> Result<(Self, SceneData)> {
        let out = &args.sweep;
        let mut job = job(args)?;
        let mut depth = if out.quick { HASTY } else { THOROUGH };
        let usual = Settings::default().spp;
        // Paths are those of the reference.
        if job.settings.spp != usual {
            depth.spp = std::mem::replace(&mut job.settings.spp, usual);
        }
        depth.runs = out.runs.unwrap_or(depth.runs);
        depth.longest = out.longest.unwrap_or(depth.longest);
        let grid = Grid::new(&job, &args.settings, &out.grid, out.quick)?;
        interrupt::listen()?;
        let data = job.prepare()?;
        let header = header(args, &job, depth, &fingerprint::of_scene(&data));
        let records = Records::open(&out.output, header)?;
        let sweep = Self {
            args,
            left_out: grid.left_out.clone(),
            job,
            grid,
            depth,
            records,
            reference: None,
            planned: 0,
            devices: Vec::new(),
        };
        Ok((sweep, data))
    }

    /// All combinations on all backends.
    fn on_all(&mut self, data: SceneData) -> Result<()> {
        let args = &self.args.sweep;
        let backends = backends(&args.backend, args.threads)?;
        self.planned = backends.len() * self.grid.combinations.len();
        let last = backends.len() - 1;
        let mut data = Some(data);
        for (index, backend) in backends.iter().enumerate() {
            let data = if index == last {
                data.take()
            } else {
                data.clone()
            };
            let Some(data) = data else { continue };
            match backend {
                Chosen::Cpu(backend, _) => self.on(backend, data)?,
                Chosen::Wgpu(backend) => self.on(&**backend, data)?,
            }
        }
        Ok(())
    }

    /// All combinations on one backend; the first renders the reference too.
    fn on<B: Host>(&mut self, backend: &B, data: SceneData) -> Result<()> {
        let scene = backend.upload(data)?;
        let reference = match self.reference.take() {
            Some(reference) => reference,
            None => self.reference_by(backend, &scene)?,
        };
        self.devices.push(device_of(backend));
        let swept = self.combinations(backend, &scene, &reference);
        self.reference = Some(reference);
        swept
    }

    fn combinations<B: Host>(
        &mut self,
        backend: &B,
        scene: &B::Res<SceneData>,
        reference: &Reference,
    ) -> Result<()> {
        let steps = Steps::new(self.args.sweep.progress, self.grid.combinations.len());
        let mut done: Vec<(usize, f64)> = Vec::new();
        for index in 0..self.grid.combinations.len() {
            let label = format!(
                "{}: {}",
                backend.name(),
                self.grid.combinations[index].name()
            );
            interrupt::check()?;
            steps.begun(&label);
            let told = match self.one(backend, scene, index, reference, &done)? {
                Found::There(seconds) => {
                    done.push((index, seconds));
                    "there already".to_owned()
                }
                Found::New(point) => {
                    done.push((index, seconds(&point)));
                    let told = report::brief(&point);
                    self.records.push(*point)?;
                    told
                }
                Found::LeftOut(why) => {
                    let told = format!("left out, {why}");
                    self.left_out.push((label.clone(), why));
                    told
                }
            };
            steps.passed(&format!("{label}: {told}"));
        }
        steps.finish();
        Ok(())
    }

    /// One combination, if it is not there yet and does not take for ever. `done` has the seconds of others.
    fn one<B: Host>(
        &self,
        backend: &B,
        scene: &B::Res<SceneData>,
        index: usize,
        reference: &Reference,
        done: &[(usize, f64)],
    ) -> Result<Found> {
        let combination = &self.grid.combinations[index];
        let id = format!("{}_{}", backend.name(), combination.id());
        if let Some(point) = self.records.find(&id) {
            return Ok(Found::There(seconds(point)));
        }
        let longest = self.depth.longest;
        if let Some(expected) = self.expected(index, done).filter(|s| *s > longest) {
            let why = format!("a frame would take about {expected:.0} s; see --longest");
            return Ok(Found::LeftOut(why));
        }
        let effort = Effort {
            warm_up: WARM_UP,
            runs: self.depth.runs,
            patience: Duration::from_secs(self.depth.patience),
        };
        let shot = Shot {
            lights: &self.job.lights,
            view: &self.job.view,
            plan: &combination.plan,
        };
        match measure(backend, scene, shot, effort) {
            Ok(measured) => {
                let on = [backend.name(), &device_of(backend)];
                let point = self.point(&id, on, combination, &measured, reference)?;
                Ok(Found::New(Box::new(point)))
            }
            // What a device cannot hold, for one.
            Err(Failure::Usage(why)) => Ok(Found::LeftOut(why)),
            Err(failure) => Err(failure),
        }
    }

    fn reference_by<B: Host>(&self, backend: &B, scene: &B::Res<SceneData>) -> Result<Reference> {
        let wanted = Wanted {
            job: &self.job,
            spp: self.depth.spp,
            folder: &self.args.sweep.output,
            sides: &SIDES,
        };
        let progress = Progress::new(self.args.sweep.progress);
        let reference = wanted.get(backend, scene, &progress);
        progress.finish();
        let reference = reference?;
        let path = self.args.sweep.output.join("reference.png");
        self.picture(&path, &reference.pixels, &reference, "")?;
        Ok(reference)
    }

    /// Seconds of a frame that a combination is expected to take at most, if one with fewer lights was measured.
    fn expected(&self, index: usize, done: &[(usize, f64)]) -> Option<f64> {
        let all = &self.grid.combinations;
        let combination = &all[index];
        let lights = |c: &Combination| f64::from(c.settings.lights);
        let like = done.iter().filter(|(other, _)| {
            combination.differs_in_lights_alone(&all[*other])
                && lights(&all[*other]) < lights(combination)
        });
        let scaled = like.map(|(other, s)| s * lights(combination) / lights(&all[*other]));
        scaled.min_by(f64::total_cmp)
    }

    /// What is recorded of a combination. Its picture is written.
    fn point(
        &self,
        id: &str,
        [backend, device]: [&str; 2],
        combination: &Combination,
        measured: &Measured,
        reference: &Reference,
    ) -> Result<Value> {
        let picture = Picture::from_image(&measured.image);
        let errors = Layers::of(&picture)?.errors(&reference.layers, &SIDES)?;
        let mut words = ["vsgl", "render"].map(String::from).to_vec();
        words.extend(self.job.words_for(&combination.settings));
        words.extend(["--backend", backend, "-o", "picture.png"].map(String::from));
        let command = text::shell(&words);
        let file = format!("{PICTURES}/{id}.png");
        let pixels = picture.rgb("").unwrap_or_default();
        let path = self.args.sweep.output.join(&file);
        self.picture(&path, &pixels, reference, &command)?;
        let settings = combination.differing.iter();
        Ok(json!({
            "id": id,
            "backend": backend,
            "device": device,
            "name": combination.name(),
            "settings": settings.map(|(key, value)| ((*key).to_owned(), value.as_str().into())).collect::<serde_json::Map<_, Value>>(),
            "command": command,
            "virtual_lights": measured.lights,
            "runs": measured.runs(),
            "wall": measured.wall(),
            "cpu": measured.cpu(),
            "phases": measured.phases(),
            "errors": errors,
            "picture": file,
        }))
    }

    /// Writes a PNG, exposed like the reference.
    fn picture(
        &self,
        path: &Path,
        pixels: &[[f32; 3]],
        reference: &Reference,
        command: &str,
    ) -> Result<()> {
        let scale = automatic(&reference.pixels).exp2();
        let code = |p: &[f32; 3]| {
            Tonemap::Neutral
                .apply(p.map(|c| c * scale))
                .map(output::srgb::code)
        };
        let codes: Vec<[u8; 3]> = pixels.iter().map(code).collect();
        let metadata = Metadata {
            software: output::software(),
            command: command.into(),
            ..Metadata::default()
        };
        let (width, height) = self.job.view.pixels();
        let file = Pending::create(path)?;
        file.write(|file| output::png::write(file, width, height, &codes, &metadata))
    }

    /// Marks the front, advises, and writes what people read.
    fn write(&mut self, finished: bool) -> Result<Value> {
        let advice = advice::give(&mut self.records.points);
        self.records.write()?;
        self.records.write_table()?;
        let mut document = self.document(&advice);
        document["finished"] = finished.into();
        if !finished {
            document["planned"] = self.planned.into();
        }
        self.write_page(&document)?;
        Ok(document)
    }
}

/// A backend and what it runs on, in words.
fn device_of<B: Host>(backend: &B) -> String {
    format!("{}, {}", backend.name(), backend.device())
}

/// Seconds of a recorded frame.
fn seconds(point: &Value) -> f64 {
    point["wall"]["median"].as_f64().unwrap_or(f64::INFINITY)
}

/// What begins the records of a sweep. `sweep` holds what its points have in common.
fn header(args: &SweepArgs, job: &Job, depth: Depth, scene: &str) -> Value {
    json!({
        "kind": "sweep",
        "schema_version": crate::commands::SCHEMA_VERSION,
        "sweep": {
            "software": output::software(),
            "job": job.words(),
            "scene": scene,
            "reference_spp": depth.spp,
            "threads": args.sweep.threads,
        },
    })
}
