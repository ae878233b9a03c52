//! `vsgl render`: from a scene to pictures.

mod paths;
mod report;

use super::dump;
use super::sheet::{Sheet, Written};
use crate::args::{OutputArgs, RenderArgs, When};
use crate::choose::{self, Choice, Goal, Open};
use crate::device::{self, Chosen, Host};
use crate::exit::{Failure, Result};
use crate::job::Job;
use crate::output::{self, Format, Metadata, Pending};
use crate::progress::Progress;
use crate::{interrupt, text};
use report::{Report, Seconds};
use serde_json::Value;
use std::time::{Duration, Instant};
use vsgl_core::data::{Image, SceneData};
use vsgl_core::render::{Frame, Phase, render};

/// Renders and writes.
///
/// # Errors
/// What reading, rendering and writing return.
pub(super) fn run(args: &RenderArgs) -> Result<()> {
    let out = &args.output;
    for path in &out.files {
        Format::of(path)?;
    }
    let mut job = Job::new(&args.scene, &args.view, &args.settings)?;
    job.check_drawable()?;
    paths::check(&job, args)?;
    if Goal::of(&args.goal).is_some() {
        choose::check(&job)?;
    }
    warn(out, &job.warnings);
    // Before there are temporary files to remove.
    interrupt::listen()?;
    let files = output::open_all(&out.files)?;
    let dump = out.dump.as_deref().map(dump::prepare).transpose()?;
    match device::choose(out.backend, out.threads)? {
        Chosen::Cpu(backend, why) => {
            if let Some(why) = why.as_ref().filter(|_| !out.quiet && !out.json) {
                text::warn(&format!("note: computing on the CPU: {why}"));
            }
            work(&backend, why, &mut job, args, files, dump)
        }
        Chosen::Wgpu(backend) => work(&*backend, None, &mut job, args, files, dump),
    }
}

fn work<B: Host>(
    backend: &B,
    why: Option<String>,
    job: &mut Job,
    args: &RenderArgs,
    files: Vec<(Format, Pending)>,
    dump: Option<dump::Dump>,
) -> Result<()> {
    let out = &args.output;
    let drawn = match job.plan.path {
        Some(_) => paths::draw(backend, job, args, &files)?,
        None => draw(backend, job, args)?,
    };
    let Drawn {
        image,
        senders,
        mut seconds,
        paths,
        choice,
    } = drawn;
    let notes = notes(&image, dump.is_some() && senders.rsm.is_none());
    warn(out, &notes);

    let start = Instant::now();
    let mut written = Vec::new();
    let sheet = Sheet {
        metadata: metadata(job, backend.name()),
        display: &out.display,
        paths: paths.as_ref().map(|p| (&p.about, p.sums.as_ref())),
    };
    for (format, file) in files {
        // Of paths, what is there is written.
        if paths.is_none() {
            interrupt::check()?;
        }
        written.push(sheet.write(&image, format, file)?);
    }
    if let Some(dump) = dump {
        for (path, format) in dump.write(backend, &senders, &sheet.metadata)? {
            written.push(Written::new(path.to_string_lossy().into_owned(), format));
        }
    }
    seconds
        .list
        .push(("write".into(), start.elapsed().as_secs_f64()));
    if let Some(stopped) = paths.as_ref().and_then(|p| p.stopped(out)) {
        return Err(Failure::Interrupted(stopped));
    }
    let clusters = match &senders.vsgls {
        Some(vsgls) => Some(backend.download(vsgls)?.count),
        None => None,
    };
    let report = Report {
        job,
        out,
        part: &args.part,
        samples: paths.map(|p| p.about.samples),
        backend: backend.name(),
        device: backend.device(),
        adapter: backend.adapter(),
        why,
        clusters,
        choice,
        seconds,
        written,
        notes,
    };
    if out.json {
        return text::print_json(&report.json());
    }
    if out.quiet {
        return Ok(());
    }
    text::print(&report.text())
}

/// A picture, and what it was made of.
struct Drawn<B: Host> {
    image: Image,
    senders: dump::Senders<B>,
    seconds: Seconds,
    paths: Option<paths::Traced>,
    choice: Option<Choice>,
}

/// Renders. The scene and what the camera sees are let go as soon as they are not needed any more: a large picture
/// needs the room.
fn draw<B: Host>(backend: &B, job: &mut Job, args: &RenderArgs) -> Result<Drawn<B>> {
    let out = &args.output;
    let start = Instant::now();
    let scene = backend.upload(job.prepare()?)?;
    let list = vec![("scene".to_owned(), start.elapsed().as_secs_f64())];
    let choice = chosen(backend, &scene, job, args)?;
    let start = Instant::now();
    let progress = progress(out);
    let frame = render(
        backend,
        &scene,
        &job.lights,
        &job.view,
        &job.plan,
        &progress,
    );
    let called = progress.finish();
    let Frame {
        rsm,
        pdf,
        vsgls,
        occlusion,
        gbuffer,
        radiance,
        image,
    } = frame?;
    drop((scene, gbuffer, radiance));
    let image = backend.download(&image)?;
    let wall = start.elapsed().as_secs_f64();
    Ok(Drawn {
        image,
        senders: dump::Senders {
            rsm,
            pdf,
            vsgls,
            occlusion,
        },
        seconds: seconds(backend, list, called, wall)?,
        paths: None,
        choice,
    })
}

/// The times of the phases, by the device's clock if it has one, else as they were `called`.
fn seconds<B: Host>(
    backend: &B,
    mut list: Vec<(String, f64)>,
    called: Vec<(Phase, Duration)>,
    wall: f64,
) -> Result<Seconds> {
    let device = backend.times()?;
    let clock = if device.is_some() { "device" } else { "host" };
    for (phase, time) in device.unwrap_or(called) {
        list.push((phase.to_string(), time.as_secs_f64()));
    }
    Ok(Seconds { list, wall, clock })
}

fn progress(out: &OutputArgs) -> Progress {
    Progress::new(if out.quiet { When::Never } else { out.progress })
}

/// Settings by measurement, if the user wants that.
fn chosen<B: Host>(
    backend: &B,
    scene: &B::Res<SceneData>,
    job: &mut Job,
    args: &RenderArgs,
) -> Result<Option<Choice>> {
    let Some(goal) = Goal::of(&args.goal) else {
        return Ok(None);
    };
    let open = |key| !args.settings.chooses(&job.settings, key);
    let open = Open {
        lights: open("lights"),
        interleave: open("interleave"),
        occlusion: open("occlusion"),
    };
    let progress = progress(&args.output);
    let choice = choose::choose(backend, scene, job, goal, &open, &progress);
    progress.finish();
    let choice = choice?;
    warn(&args.output, choice.missed().as_slice());
    // The times of what was tried are not those of the picture.
    backend.times()?;
    Ok(Some(choice))
}

fn warn(out: &OutputArgs, warnings: &[String]) {
    if !out.quiet {
        warnings
            .iter()
            .for_each(|w| text::warn(&format!("warning: {w}")));
    }
}

/// What the user should know about the result.
fn notes(image: &Image, nothing_to_dump: bool) -> Vec<String> {
    let mut notes = Vec::new();
    let broken = |p: &&[f32; 3]| !p.iter().all(|c| c.is_finite());
    let count = image.beauty().iter().filter(broken).count();
    if count > 0 {
        notes.push(format!(
            "{count} pixels are not finite: a fault of this program, please report it"
        ));
    }
    if nothing_to_dump {
        notes.push("nothing to dump: no light bounces".into());
    }
    notes
}

/// What files say about the picture.
fn metadata(job: &Job, backend: &str) -> Metadata {
    Metadata {
        software: output::software(),
        command: command(&job.words()),
        world_to_camera: Some(job.world_to_camera()),
        settings: Value::Object(job.metadata(backend)),
        paths: None,
    }
}

fn command(words: &[String]) -> String {
    let start = ["vsgl", "render"].map(String::from);
    text::shell(&[&start[..], words].concat())
}
