//! What was typed, turned into what is to be done: a scene with its lights, a view, settings and their plan.

mod choose;
mod repeat;

pub use choose::settings;
pub use repeat::settings_json;

use crate::args::{SceneArgs, SettingsArgs, Size, ViewArgs};
use crate::exit::{Failure, Result};
use std::path::Path;
use vsgl_core::data::SceneData;
use vsgl_core::math::sobol;
use vsgl_core::plan::Plan;
use vsgl_core::render::View;
use vsgl_core::scene::{Light, Scene, SceneFacts, gltf, samples};
use vsgl_core::settings::Settings;

/// Scene that is rendered when none is named.
pub const DEFAULT_SCENE: &str = "sample:cornell";

/// Everything that decides the pixels of a picture.
#[derive(Clone, Debug)]
pub struct Job {
    /// The scene as it was named.
    pub name: String,
    /// The scene.
    pub scene: Scene,
    /// The lights that shine: the scene's own, unless switched off, and the added ones.
    pub lights: Vec<Light>,
    /// Name of the camera for reports.
    pub camera: String,
    /// Camera, size and samples.
    pub view: View,
    /// How light is computed.
    pub settings: Settings,
    /// What the scene contains, under these lights and seen by this camera.
    pub facts: SceneFacts,
    /// What will run, and why.
    pub plan: Plan,
    /// Seed of random numbers.
    pub seed: u64,
    /// What the user should know, a line each.
    pub warnings: Vec<String>,
    /// Most triangles in one place.
    overlap: u64,
    /// Whether the scene's own lights shine; they are the first.
    own_lights: bool,
    /// Arguments that choose the same scene, lights and camera again.
    scene_words: Vec<String>,
}

impl Job {
    /// Reads the scene and decides everything.
    ///
    /// # Errors
    /// [`Failure::Usage`] for arguments that do not fit the scene or each other,
    /// [`Failure::Input`] for files that cannot be read.
    pub fn new(scene: &SceneArgs, view: &ViewArgs, settings: &SettingsArgs) -> Result<Self> {
        Self::with(scene, view, settings, &Defaults::default())
    }

    /// As [`Job::new`], with other values where none are given.
    ///
    /// # Errors
    /// As [`Job::new`].
    pub fn with(
        scene: &SceneArgs,
        view: &ViewArgs,
        settings: &SettingsArgs,
        defaults: &Defaults,
    ) -> Result<Self> {
        let settings = choose::settings(settings, defaults.lights)?;
        let size = view.size.unwrap_or(defaults.size);
        let name = scene.scene.clone().unwrap_or_else(|| DEFAULT_SCENE.into());
        let (mut read, overlap) = read_scene(&name, scene)?;
        if scene.only_added_lights {
            // What shines is a light of the file too.
            read.materials
                .iter_mut()
                .for_each(|m| m.emission = [0.0; 3]);
        }
        let mut warnings = read.warnings.clone();
        let lights = choose::lights(&read, scene)?;
        let (camera_name, camera) = choose::camera(&read, scene, size, &mut warnings)?;
        let view_checked = View {
            camera,
            width: size.width,
            height: size.height,
            aa: view.aa.unwrap_or(1),
            stride: view.stride.unwrap_or(1),
        }
        .checked()?;
        let facts = SceneFacts::new(&read, &lights, &camera);
        let seed = view.seed.unwrap_or(0);
        let plan = plan(&facts, &settings, seed)?;
        if facts.triangles > 0 && lights.is_empty() && facts.emitters == 0 {
            let shown = if facts.seen.unlit {
                "nothing but what shines by itself will be seen"
            } else {
                "the picture will be black"
            };
            warnings.push(format!(
                "no light: {shown}; add one with --spot, --point or --sun"
            ));
        }
        Ok(Self {
            overlap,
            own_lights: !scene.only_added_lights,
            scene_words: repeat::scene_words(&name, scene),
            name,
            scene: read,
            lights,
            camera: camera_name,
            view: view_checked,
            settings,
            facts,
            plan,
            seed,
            warnings,
        })
    }
}

impl Job {
    /// What would run with other settings.
    ///
    /// # Errors
    /// As [`Plan::new`].
    pub fn plan_for(&self, settings: &Settings, seed: u64) -> Result<Plan> {
        plan(&self.facts, settings, seed)
    }

    /// That there is something to draw.
    ///
    /// # Errors
    /// [`Failure::Input`] for a scene without triangles.
    pub fn check_drawable(&self) -> Result<()> {
        if self.facts.triangles > 0 {
            return Ok(());
        }
        Err(Failure::Input(format!(
            "{}: nothing to draw: the scene has no triangles; give one that has",
            self.name
        )))
    }

    /// Name of a light in the scene's file; empty for those without, and for added ones.
    pub fn light_name(&self, index: usize) -> &str {
        let names = match self.own_lights {
            true => &self.scene.source.lights[..],
            false => &[],
        };
        names.get(index).map_or("", String::as_str)
    }

    /// The scene as the phases read it.
    ///
    /// # Errors
    /// [`Failure::Input`] for a scene that would take for ever to draw.
    pub fn prepared(&self) -> Result<SceneData> {
        self.checked(SceneData::new(&self.scene))
    }

    /// As [`Job::prepared`], and lets go of what the scene need not hold any more; see [`SceneData::take`].
    ///
    /// # Errors
    /// As [`Job::prepared`].
    pub fn prepare(&mut self) -> Result<SceneData> {
        let data = SceneData::take(&mut self.scene);
        self.checked(data)
    }

    fn checked(&self, data: SceneData) -> Result<SceneData> {
        data.check_overlap(&self.name, self.overlap)?;
        Ok(data)
    }
}

fn plan(facts: &SceneFacts, settings: &Settings, seed: u64) -> Result<Plan> {
    let mut plan = Plan::new(facts, settings)?;
    if let Some(path) = &mut plan.path {
        path.seed = sobol::combine(seed as u32, (seed >> 32) as u32);
    }
    Ok(plan)
}

/// What is taken where nothing is given.
#[derive(Clone, Copy, Debug)]
pub struct Defaults {
    /// Size of the picture.
    pub size: Size,
    /// Number of virtual lights; none: as the preset has it.
    pub lights: Option<u32>,
}

impl Default for Defaults {
    fn default() -> Self {
        let (width, height) = (640, 360);
        Self {
            size: Size { width, height },
            lights: None,
        }
    }
}

/// The scene, and how many triangles may lie in one place.
fn read_scene(name: &str, args: &SceneArgs) -> Result<(Scene, u64)> {
    let mut options = gltf::Options::default();
    for (limit, value) in &args.limit {
        options.limits.set(limit, value)?;
    }
    options.scene.clone_from(&args.part);
    options.time = args.time;
    let Some(sample) = name.strip_prefix("sample:") else {
        let scene = gltf::load_with(Path::new(name), &options)?;
        return Ok((scene, options.limits.overlap));
    };
    if args.part.is_some() || args.time.is_some() || !args.limit.is_empty() {
        return Err(Failure::Usage(
            "--scene, --time and --limit are about files; leave them out with a sample".into(),
        ));
    }
    Ok((samples::by_name(sample)?, options.limits.overlap))
}
