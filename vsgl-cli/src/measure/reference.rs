//! The truth that errors are against: paths of light, in two halves that tell how noisy it is.

use super::Layers;
use crate::device::Host;
use crate::exit::{Failure, Result};
use crate::job::{Job, settings_json};
use crate::output::{self, Metadata, Pending};
use crate::paths::Course;
use crate::picture::{Channel, Picture};
use crate::progress::Progress;
use crate::{fingerprint, input, interrupt, part, text};
use serde_json::{Value, json};
use std::path::Path;
use std::time::{Duration, Instant};
use vsgl_core::data::SceneData;
use vsgl_core::render::{Observer, View, render};
use vsgl_core::settings::{Method, Settings};
use vsgl_core::trace::Paths;

/// Names of the halves in a sweep's folder.
const HALVES: [&str; 2] = ["reference-a.exr", "reference-b.exr"];
/// How often a half is saved.
const SAVED: Duration = Duration::from_secs(60);
/// Name of their mean.
const WHOLE: &str = "reference.exr";

/// A reference picture.
pub(crate) struct Reference {
    /// What is compared.
    pub(crate) layers: Layers,
    /// Colours of all light, for pictures of it.
    pub(crate) pixels: Vec<[f32; 3]>,
    /// Its own errors, as far as noise makes them.
    pub(crate) noise: Value,
}

impl Reference {
    /// The mean of two independent halves, compared in blocks of these sides.
    ///
    /// Its error is distributed as half their difference, which is what separates a half from the mean: the errors of a half
    /// against the mean are those of the mean against the truth.
    ///
    /// # Errors
    /// None for halves of one size.
    pub(crate) fn of_halves(halves: &[Picture; 2], sides: &[u32]) -> Result<Self> {
        let whole = mean(&halves[0], &halves[1]);
        let layers = Layers::of(&whole)?;
        Ok(Self {
            noise: Layers::of(&halves[0])?.errors(&layers, sides)?,
            pixels: whole.rgb("").unwrap_or_default(),
            layers,
        })
    }
}

/// What is rendered for the reference of a sweep.
pub(crate) struct Wanted<'a> {
    /// Scene, lights and view.
    pub(crate) job: &'a Job,
    /// Paths through each pixel, both halves together.
    pub(crate) spp: u32,
    /// Folder that keeps them.
    pub(crate) folder: &'a Path,
    /// Sides of the blocks that are compared.
    pub(crate) sides: &'a [u32],
}

impl Wanted<'_> {
    /// Renders what the folder does not hold yet. A half is saved every minute, and when somebody asks to stop; it goes on from there,
    /// and ends with the bits of one that was never interrupted.
    ///
    /// # Errors
    /// What rendering, reading and writing return.
    pub(crate) fn get<B: Host>(
        &self,
        backend: &B,
        scene: &B::Res<SceneData>,
        progress: &Progress,
    ) -> Result<Reference> {
        let half = |index: usize| {
            let path = self.folder.join(HALVES[index]);
            if !is_whole(&path) {
                let seed = self.job.seed.wrapping_add(1 + index as u64);
                self.render(backend, scene, &path, seed, progress)?;
            }
            self.read(&path)
        };
        let halves = [half(0)?, half(1)?];
        let path = self.folder.join(WHOLE);
        if !path.exists() {
            let command = format!("the mean of {} and {}", HALVES[0], HALVES[1]);
            let settings = json!({"halves": HALVES});
            self.write(&path, mean(&halves[0], &halves[1]), command, settings)?;
        }
        Reference::of_halves(&halves, self.sides)
    }

    fn render<B: Host>(
        &self,
        backend: &B,
        scene: &B::Res<SceneData>,
        path: &Path,
        seed: u64,
        progress: &Progress,
    ) -> Result<()> {
        let job = self.job;
        let spp = self.spp.div_ceil(2);
        let settings = paths(job, spp);
        let plan = job.plan_for(&settings, seed)?;
        let view = View { aa: 1, ..job.view };
        let mut words = job.words_for(&settings);
        words.extend(["--seed".into(), seed.to_string()]);
        let start = ["vsgl", "render"].map(String::from);
        let command = text::shell(&[&start[..], &words].concat());
        let print = fingerprint::of_scene(&backend.download(scene)?);
        let paths = Paths {
            backend,
            scene,
            lights: &job.lights,
            view: &view,
            plan: &plan,
        };
        let mut course = Course::new(paths, 0..spp, &print, command.clone(), progress)?;
        if path.exists() {
            course.take(part::read(path)?)?;
        }
        let metadata = self.metadata(command, settings_json(&settings));
        let save = |course: &Course<'_, B>| match course.sums() {
            Some(sums) => Pending::create(path)?
                .write(|file| part::write(file, &course.image(), sums, course.about(), &metadata)),
            None => Ok(()),
        };
        let mut saved = Instant::now();
        course.run(progress, interrupt::asked, |course| {
            if saved.elapsed() < SAVED {
                return Ok(());
            }
            saved = Instant::now();
            save(course)
        })?;
        save(&course)?;
        if course.left().is_empty() {
            return Ok(());
        }
        Err(Failure::Interrupted(format!(
            "{} holds samples {} of {spp}; the same command goes on",
            path.display(),
            course.about().samples
        )))
    }

    fn write(&self, path: &Path, picture: Picture, command: String, settings: Value) -> Result<()> {
        let metadata = self.metadata(command, settings);
        Pending::create(path)?.write(|file| output::exr::write(file, picture, &metadata))
    }

    fn metadata(&self, command: String, settings: Value) -> Metadata {
        Metadata {
            software: output::software(),
            command,
            world_to_camera: Some(self.job.world_to_camera()),
            settings,
            paths: None,
        }
    }

    fn read(&self, path: &Path) -> Result<Picture> {
        let picture = input::read(path)?.picture;
        let same = (picture.width, picture.height) == self.job.view.pixels();
        if same
            && ["", "indirect"]
                .iter()
                .all(|layer| picture.rgb(layer).is_some())
        {
            return Ok(picture);
        }
        let problem = "is not the reference of this sweep";
        let remedy = "remove it, and it is made anew";
        Err(Failure::input(path, problem, remedy))
    }
}

/// Whether there is a half with all of its samples.
fn is_whole(path: &Path) -> bool {
    // What is no picture of paths is judged when it is read.
    path.exists() && part::read(path).map_or(true, |part| part.sums.is_none())
}

/// Renders one half of a reference: so many paths through each pixel, with this seed.
///
/// # Errors
/// What rendering returns.
pub(crate) fn half<B: Host>(
    backend: &B,
    scene: &B::Res<SceneData>,
    job: &Job,
    view: &View,
    (spp, seed): (u32, u64),
    observer: &dyn Observer,
) -> Result<Picture> {
    let plan = job.plan_for(&paths(job, spp), seed)?;
    // Paths are spread over the pixel anyway.
    let view = View { aa: 1, ..*view };
    let frame = render(backend, scene, &job.lights, &view, &plan, observer)?;
    Ok(Picture::from_image(&backend.download(&frame.image)?))
}

fn paths(job: &Job, spp: u32) -> Settings {
    Settings {
        method: Method::Path,
        spp,
        max_depth: job.settings.max_depth,
        ..Settings::default()
    }
}

/// The mean of two pictures with the same channels.
fn mean(a: &Picture, b: &Picture) -> Picture {
    let channel = |a: &Channel| {
        let other = b.channel(&a.name).unwrap_or(&a.values);
        let values = a.values.iter().zip(other);
        Channel {
            name: a.name.clone(),
            values: values.map(|(a, b)| 0.5 * (a + b)).collect(),
        }
    };
    Picture {
        width: a.width,
        height: a.height,
        channels: a.channels.iter().map(channel).collect(),
    }
}
