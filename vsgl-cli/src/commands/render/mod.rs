//! `vsgl render`: from a scene to pictures.

mod report;

use super::dump;
use crate::args::{OutputArgs, RenderArgs, When};
use crate::device::{self, Chosen, Host};
use crate::exit::Result;
use crate::job::Job;
use crate::output::{self, Format, Metadata, Pending};
use crate::picture::Picture;
use crate::progress::Progress;
use crate::{interrupt, text};
use report::{Report, Seconds, Written};
use serde_json::Value;
use std::time::Instant;
use vsgl_core::data::Image;
use vsgl_core::render::{Frame, render};

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
            work(&backend, why, &mut job, out, files, dump)
        }
        Chosen::Wgpu(backend) => work(&*backend, None, &mut job, out, files, dump),
    }
}

fn work<B: Host>(
    backend: &B,
    why: Option<String>,
    job: &mut Job,
    out: &OutputArgs,
    files: Vec<(Format, Pending)>,
    dump: Option<dump::Dump>,
) -> Result<()> {
    let (image, senders, mut seconds) = draw(backend, job, out)?;
    let notes = notes(&image, dump.is_some() && senders.rsm.is_none());
    warn(out, &notes);

    let start = Instant::now();
    let mut written = Vec::new();
    for (format, file) in files {
        interrupt::check()?;
        written.push(write(job, backend.name(), out, &image, format, file)?);
    }
    if let Some(dump) = dump {
        let metadata = metadata(job, job.metadata(backend.name()), &job.words());
        for (path, format) in dump.write(backend, &senders, &metadata)? {
            written.push(Written::new(path.to_string_lossy().into_owned(), format));
        }
    }
    seconds
        .list
        .push(("write".into(), start.elapsed().as_secs_f64()));
    let clusters = match &senders.vsgls {
        Some(vsgls) => Some(backend.download(vsgls)?.count),
        None => None,
    };
    let report = Report {
        job,
        out,
        backend: backend.name(),
        device: backend.device(),
        adapter: backend.adapter(),
        why,
        clusters,
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

/// Renders. The scene and what the camera sees are let go as soon as they are not needed any more: a large picture
/// needs the room.
fn draw<B: Host>(
    backend: &B,
    job: &mut Job,
    out: &OutputArgs,
) -> Result<(Image, dump::Senders<B>, Seconds)> {
    let start = Instant::now();
    let scene = backend.upload(job.prepare()?)?;
    let mut list = vec![("scene".to_owned(), start.elapsed().as_secs_f64())];
    let start = Instant::now();
    let progress = Progress::new(if out.quiet { When::Never } else { out.progress });
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
    let device = backend.times()?;
    let clock = if device.is_some() { "device" } else { "host" };
    for (phase, time) in device.unwrap_or(called) {
        list.push((phase.to_string(), time.as_secs_f64()));
    }
    let seconds = Seconds { list, wall, clock };
    let senders = dump::Senders {
        rsm,
        pdf,
        vsgls,
        occlusion,
    };
    Ok((image, senders, seconds))
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

fn write(
    job: &Job,
    backend: &str,
    out: &OutputArgs,
    image: &Image,
    format: Format,
    file: Pending,
) -> Result<Written> {
    let path = file.path().to_string_lossy().into_owned();
    let mut written = Written::new(path, format.name());
    let mut settings = job.metadata(backend);
    let mut words = job.words();
    match format {
        Format::Exr => {
            let metadata = metadata(job, settings, &words);
            let picture = Picture::from_image(image);
            file.write(|file| output::exr::write(file, picture, &metadata))?;
        }
        Format::Png => {
            let pixels = image.beauty();
            let stops = out.exposure.stops(&pixels);
            written.exposure = Some(stops);
            settings.insert("exposure".into(), text::json_number(f64::from(stops)));
            settings.insert("tonemap".into(), out.tonemap.word().into());
            words.extend(display_words(out));
            let metadata = metadata(job, settings, &words);
            let scale = stops.exp2();
            let code = |p: &[f32; 3]| {
                out.tonemap
                    .apply(p.map(|c| c * scale))
                    .map(output::srgb::code)
            };
            let codes: Vec<[u8; 3]> = pixels.iter().map(code).collect();
            let (width, height) = (image.width, image.height);
            file.write(|file| output::png::write(file, width, height, &codes, &metadata))?;
        }
    }
    Ok(written)
}

fn metadata(job: &Job, settings: serde_json::Map<String, Value>, words: &[String]) -> Metadata {
    Metadata {
        software: output::software(),
        command: command(words),
        world_to_camera: Some(job.world_to_camera()),
        settings: Value::Object(settings),
    }
}

/// Flags that decide how a PNG looks, where they differ from the usual.
fn display_words(out: &OutputArgs) -> Vec<String> {
    let mut words = Vec::new();
    if let output::exposure::Exposure::Stops(stops) = out.exposure {
        words.push(format!("--exposure={stops}"));
    }
    if out.tonemap != output::tonemap::Tonemap::Neutral {
        words.extend(["--tonemap".into(), out.tonemap.word().into()]);
    }
    words
}

fn command(words: &[String]) -> String {
    let start = ["vsgl", "render"].map(String::from);
    text::shell(&[&start[..], words].concat())
}
