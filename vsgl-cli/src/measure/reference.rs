//! The truth that errors are against: paths of light, in two halves that tell how noisy it is.

use super::Layers;
use crate::device::Host;
use crate::exit::{Failure, Result};
use crate::job::{Job, settings_json};
use crate::output::{self, Metadata, Pending};
use crate::picture::{Channel, Picture};
use crate::progress::Progress;
use crate::{input, text};
use serde_json::{Value, json};
use std::path::Path;
use vsgl_core::data::SceneData;
use vsgl_core::render::{Observer, View, render};
use vsgl_core::settings::{Method, Settings};

/// Names of the halves in a sweep's folder.
const HALVES: [&str; 2] = ["reference-a.exr", "reference-b.exr"];
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
    /// Renders what the folder does not hold yet.
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
            if !path.exists() {
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
        let picture = half(backend, scene, job, &job.view, (spp, seed), progress)?;
        let settings = paths(job, spp);
        let mut words = job.words_for(&settings);
        words.extend(["--seed".into(), seed.to_string()]);
        let start = ["vsgl", "render"].map(String::from);
        let command = text::shell(&[&start[..], &words].concat());
        self.write(path, picture, command, settings_json(&settings))
    }

    fn write(&self, path: &Path, picture: Picture, command: String, settings: Value) -> Result<()> {
        let metadata = Metadata {
            software: output::software(),
            command,
            world_to_camera: Some(self.job.world_to_camera()),
            settings,
            paths: None,
        };
        Pending::create(path)?.write(|file| output::exr::write(file, picture, &metadata))
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
