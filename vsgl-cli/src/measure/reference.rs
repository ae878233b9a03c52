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
use vsgl_core::render::{View, render};
use vsgl_core::settings::{Method, Settings};

/// Names of the halves in a sweep's folder.
const HALVES: [&str; 2] = ["reference-a.exr", "reference-b.exr"];
/// Name of their mean.
const WHOLE: &str = "reference.exr";

/// The reference of a sweep.
pub(crate) struct Reference {
    /// What is compared.
    pub(crate) layers: Layers,
    /// Colours of all light, for pictures of it.
    pub(crate) pixels: Vec<[f32; 3]>,
    /// Its own errors, as far as noise makes them.
    pub(crate) noise: Value,
}

/// What is rendered for a reference.
pub(crate) struct Wanted<'a> {
    /// Scene, lights and view.
    pub(crate) job: &'a Job,
    /// Paths through each pixel, both halves together.
    pub(crate) spp: u32,
    /// Folder that keeps them.
    pub(crate) folder: &'a Path,
}

impl Wanted<'_> {
    /// Renders what the folder does not hold yet.
    ///
    /// The error of the mean of two independent halves is distributed as half their difference, which is what separates a
    /// half from the mean: the errors of a half against the mean are those of the mean against the truth.
    ///
    /// # Errors
    /// What rendering, reading and writing return.
    pub(crate) fn get<B: Host>(
        &self,
        backend: &B,
        scene: &B::Res<SceneData>,
        progress: &Progress,
    ) -> Result<Reference> {
        let mut halves = Vec::new();
        for (index, name) in HALVES.iter().enumerate() {
            let path = self.folder.join(name);
            let seed = self.job.seed.wrapping_add(1 + index as u64);
            if !path.exists() {
                self.render(backend, scene, &path, seed, progress)?;
            }
            halves.push(self.read(&path)?);
        }
        let whole = mean(&halves[0], &halves[1]);
        let path = self.folder.join(WHOLE);
        if !path.exists() {
            let command = format!("the mean of {} and {}", HALVES[0], HALVES[1]);
            let settings = json!({"halves": HALVES});
            self.write(Pending::create(&path)?, whole.clone(), command, settings)?;
        }
        let layers = Layers::of(&whole)?;
        Ok(Reference {
            noise: Layers::of(&halves[0])?.errors(&layers)?,
            pixels: whole.rgb("").unwrap_or_default(),
            layers,
        })
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
        let file = Pending::create(path)?;
        let settings = Settings {
            method: Method::Path,
            spp: self.spp.div_ceil(2),
            max_depth: job.settings.max_depth,
            ..Settings::default()
        };
        let plan = job.plan_for(&settings, seed)?;
        // Paths are spread over the pixel anyway.
        let view = View { aa: 1, ..job.view };
        let frame = render(backend, scene, &job.lights, &view, &plan, progress)?;
        let picture = Picture::from_image(&backend.download(&frame.image)?);
        let mut words = job.words_for(&settings);
        words.extend(["--seed".into(), seed.to_string()]);
        let start = ["vsgl", "render"].map(String::from);
        let command = text::shell(&[&start[..], &words].concat());
        self.write(file, picture, command, settings_json(&settings))
    }

    fn write(
        &self,
        file: Pending,
        picture: Picture,
        command: String,
        settings: Value,
    ) -> Result<()> {
        let metadata = Metadata {
            software: output::software(),
            command,
            world_to_camera: Some(self.job.world_to_camera()),
            settings,
            paths: None,
        };
        file.write(|file| output::exr::write(file, picture, &metadata))
    }

    fn read(&self, path: &Path) -> Result<Picture> {
        let picture = input::read(path)?.picture;
        let (width, height) = self.job.view.pixels();
        let layers = ["", "direct", "indirect"].map(|layer| picture.rgb(layer));
        if (picture.width, picture.height) == (width, height) && layers.iter().all(Option::is_some)
        {
            return Ok(picture);
        }
        let problem = format!("is not a reference of {width}x{height} pixels");
        Err(Failure::input(
            path,
            problem,
            "remove it, and it is made anew",
        ))
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
