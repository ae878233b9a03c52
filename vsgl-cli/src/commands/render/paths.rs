//! Rendering paths: some of the samples or all, from the beginning or from where it was left.

use super::{Drawn, dump, metadata, seconds};
use crate::args::{OutputArgs, RenderArgs, When};
use crate::commands::sheet::Sheet;
use crate::device::Host;
use crate::exit::{Failure, Result};
use crate::job::Job;
use crate::output::{Format, Pending};
use crate::part::{self, About};
use crate::paths::Course;
use crate::progress::Progress;
use crate::{fingerprint, interrupt};
use std::ops::Range;
use std::path::Path;
use std::time::{Duration, Instant};
use vsgl_core::trace::{Paths, Sums, pieces};

/// How often an output that may be gone on from is saved.
const SAVED: Duration = Duration::from_secs(300);

/// Samples that were traced.
pub(super) struct Traced {
    pub(super) about: About,
    pub(super) sums: Option<Sums>,
    /// Number of samples that were wanted and are not there: somebody asked to stop.
    left: u32,
}

impl Traced {
    /// What to tell if the picture is not what was wanted.
    pub(super) fn stopped(&self, out: &OutputArgs) -> Option<String> {
        if self.left == 0 {
            return None;
        }
        let go_on = match state(out) {
            Some(_) => "the same command with --resume goes on",
            None => "give an .exr output to be able to go on",
        };
        Some(format!(
            "samples {} of {} are written; {go_on}",
            self.about.samples, self.about.of
        ))
    }
}

/// The output that can be gone on from.
fn state(out: &OutputArgs) -> Option<&Path> {
    let exr = |path: &&std::path::PathBuf| Format::of(path).ok() == Some(Format::Exr);
    out.files.iter().find(exr).map(|path| path.as_path())
}

/// The samples that are wanted.
fn wanted(job: &Job, args: &RenderArgs) -> Range<u32> {
    args.part.samples.clone().unwrap_or(0..job.settings.spp)
}

/// Refuses what cannot be done before anything is.
///
/// # Errors
/// [`Failure::Usage`] for flags that do not go together.
pub(super) fn check(job: &Job, args: &RenderArgs) -> Result<()> {
    let flag = match &args.part {
        part if part.samples.is_some() => "--samples",
        part if part.resume => "--resume",
        _ => return Ok(()),
    };
    let fail = |problem: &str| Err(Failure::Usage(format!("{flag}: {problem}")));
    if job.plan.path.is_none() {
        return fail("samples are those of paths; add --method path");
    }
    drop(pieces(wanted(job, args), job.settings.spp)?);
    if state(&args.output).is_none() {
        return fail("samples are kept in EXR files; give an output that ends in .exr");
    }
    Ok(())
}

/// Traces, and saves on the way.
pub(super) fn draw<B: Host>(
    backend: &B,
    job: &mut Job,
    args: &RenderArgs,
    files: &[(Format, Pending)],
) -> Result<Drawn<B>> {
    let out = &args.output;
    let start = Instant::now();
    let data = job.prepare()?;
    let print = fingerprint::of_scene(&data);
    let scene = backend.upload(data)?;
    let job = &*job;
    let list = vec![("scene".to_owned(), start.elapsed().as_secs_f64())];
    let start = Instant::now();
    let metadata = metadata(job, backend.name());
    let progress = Progress::new(if out.quiet { When::Never } else { out.progress });
    let paths = Paths {
        backend,
        scene: &scene,
        lights: &job.lights,
        view: &job.view,
        plan: &job.plan,
    };
    let mut course = Course::new(
        paths,
        wanted(job, args),
        &print,
        metadata.command.clone(),
        &progress,
    )?;
    let state = state(out).filter(|path| args.part.resume && path.exists());
    if let Some(path) = state {
        course.take(part::read(path)?)?;
    }
    let exr = files.iter().find(|(format, _)| *format == Format::Exr);
    let mut saved = Instant::now();
    let ran = course.run(&progress, interrupt::asked, |course| {
        if !args.part.resume || saved.elapsed() < SAVED || course.left().is_empty() {
            return Ok(());
        }
        saved = Instant::now();
        let Some((_, file)) = exr else {
            return Ok(());
        };
        let sheet = Sheet {
            metadata: metadata.clone(),
            display: &out.display,
            paths: Some((course.about(), course.sums())),
        };
        sheet.save(&course.image(), file)
    });
    let called = progress.finish();
    ran?;
    let wall = start.elapsed().as_secs_f64();
    Ok(Drawn {
        image: course.image(),
        senders: dump::Senders {
            rsm: None,
            pdf: None,
            vsgls: None,
            occlusion: None,
        },
        seconds: seconds(backend, list, called, wall)?,
        paths: Some(Traced {
            left: course.left().count(),
            about: course.about().clone(),
            sums: course.sums().cloned(),
        }),
        choice: None,
    })
}
