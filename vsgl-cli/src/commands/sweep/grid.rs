//! The combinations of settings that a sweep goes through.

use crate::args::SettingsArgs;
use crate::exit::{Failure, Result};
use crate::job::Job;
use vsgl_core::plan::Plan;
use vsgl_core::settings::{OcclusionMethod, Settings};

/// What is swept unless told otherwise, and with `--quick`.
const USUAL: &[(&str, [&str; 2])] = &[
    ("lights", ["64,256,1024,4096", "64,256,1024"]),
    ("interleave", ["1,2,4,8", "1,2,4"]),
    ("occlusion", ["rays,sampled,none", "rays,sampled,none"]),
];
/// Most combinations.
const COMBINATIONS_MAX: usize = 10_000;

/// One combination.
#[derive(Clone, Debug)]
pub(super) struct Combination {
    /// All settings.
    pub(super) settings: Settings,
    /// What will run.
    pub(super) plan: Plan,
    /// The settings that differ from the usual ones, with their values.
    pub(super) differing: Vec<(&'static str, String)>,
}

/// The combinations, cheap ones first, and those left out with the reason.
#[derive(Debug, Default)]
pub(super) struct Grid {
    /// Each runs something else.
    pub(super) combinations: Vec<Combination>,
    /// Name and reason.
    pub(super) left_out: Vec<(String, String)>,
}

impl Grid {
    /// All combinations of what `typed` asks for by `--grid`, or of the usual values of what is not set.
    ///
    /// # Errors
    /// [`Failure::Usage`] for an unknown setting or value, for one that is given twice, or for too many combinations.
    pub(super) fn new(
        job: &Job,
        typed: &SettingsArgs,
        wanted: &[(String, String)],
        quick: bool,
    ) -> Result<Self> {
        let axes = match wanted.is_empty() {
            true => usual(&job.settings, typed, quick),
            false => wanted.to_vec(),
        };
        let mut all = vec![job.settings.clone()];
        for (index, (key, values)) in axes.iter().enumerate() {
            if axes[..index].iter().any(|(other, _)| other == key) {
                let problem = format!("--grid: `{key}` is given twice; give each setting once");
                return Err(Failure::Usage(problem));
            }
            all = product(&all, key, values)?;
        }
        let mut grid = Self::default();
        all.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
        for settings in all {
            grid.add(job, settings);
        }
        if grid.combinations.is_empty() {
            let first = grid.left_out.first();
            let why = first.map_or("there are none", |(_, why)| why);
            return Err(Failure::Usage(format!(
                "--grid: no combination can run: {why}"
            )));
        }
        Ok(grid)
    }

    fn add(&mut self, job: &Job, settings: Settings) {
        let differing = differing(&settings);
        let plan = match job.plan_for(&settings, job.seed) {
            Ok(plan) => plan,
            Err(refused) => {
                self.left_out.push((name(&differing), refused.to_string()));
                return;
            }
        };
        if let Some(same) = self.combinations.iter().find(|c| c.plan == plan) {
            let why = format!("this scene is drawn just as with {}", same.name());
            self.left_out.push((name(&differing), why));
            return;
        }
        self.combinations.push(Combination {
            settings,
            plan,
            differing,
        });
    }
}

impl Combination {
    /// What differs from the usual settings, for people.
    pub(super) fn name(&self) -> String {
        name(&self.differing)
    }

    /// The same as a part of a file's name.
    pub(super) fn id(&self) -> String {
        let parts = self.differing.iter();
        let parts: Vec<_> = parts.map(|(key, value)| format!("{key}-{value}")).collect();
        match parts.is_empty() {
            true => "usual".into(),
            false => parts.join("_"),
        }
    }

    /// Whether the two differ in the number of lights alone.
    pub(super) fn differs_in_lights_alone(&self, other: &Self) -> bool {
        let with = Settings {
            lights: other.settings.lights,
            ..self.settings.clone()
        };
        with == other.settings
    }
}

/// The usual axes, less the settings that somebody chose.
fn usual(base: &Settings, typed: &SettingsArgs, quick: bool) -> Vec<(String, String)> {
    let axes = USUAL.iter().filter(|(key, _)| !typed.chooses(base, key));
    axes.map(|(key, values)| ((*key).to_owned(), values[usize::from(quick)].to_owned()))
        .collect()
}

/// All settings with each of these values.
fn product(all: &[Settings], key: &str, values: &str) -> Result<Vec<Settings>> {
    let mut more = Vec::new();
    for settings in all {
        for value in values.split(',') {
            let mut settings = settings.clone();
            settings.set(key, value.trim())?;
            more.push(settings);
        }
    }
    if more.len() > COMBINATIONS_MAX {
        return Err(Failure::Usage(format!(
            "--grid: {} combinations; at most {COMBINATIONS_MAX} can be swept, give fewer values",
            more.len()
        )));
    }
    Ok(more)
}

fn differing(settings: &Settings) -> Vec<(&'static str, String)> {
    let usual = Settings::default().entries();
    let pairs = settings.entries().into_iter().zip(usual);
    pairs
        .filter(|(entry, usual)| entry != usual)
        .map(|(entry, _)| entry)
        .collect()
}

fn name(differing: &[(&'static str, String)]) -> String {
    let flag = |(key, value): &(&str, String)| format!("{key} {value}");
    let parts: Vec<_> = differing.iter().map(flag).collect();
    match parts.is_empty() {
        true => "usual settings".into(),
        false => parts.join(", "),
    }
}

/// What a frame costs, roughly: enough to begin with the cheap ones.
fn cost(settings: &Settings) -> f64 {
    let shares = f64::from(settings.interleave * settings.interleave);
    let rays = match settings.occlusion {
        OcclusionMethod::Rays => 10.0,
        OcclusionMethod::None => 1.0,
        _ => 2.0,
    };
    f64::from(settings.lights) / shares * rays
}
