//! Settings for a time or an error: a cost model, made from small pictures in a few seconds on the machine at hand, chooses, and
//! frames at the full size correct it.

mod model;
mod pilot;

use crate::args::GoalArgs;
use crate::device::Host;
use crate::exit::{Failure, Result};
use crate::job::Job;
use crate::measure::{Effort, Shot, measure};
use model::{Model, Outcome};
use pilot::{Choices, SIDES, Truth, calibrate};
use serde_json::{Value, json};
use std::time::{Duration, Instant};
use vsgl_core::data::SceneData;
use vsgl_core::render::Observer;
use vsgl_core::settings::{Method, OcclusionMethod, Settings};

/// What a user wants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Goal {
    /// The least error for a frame of at most so many seconds.
    Budget(f64),
    /// The fastest frame with an error of at most so many percent.
    TargetError(f64),
}

impl Goal {
    /// What was asked for, if anything.
    pub(crate) fn of(args: &GoalArgs) -> Option<Self> {
        match (args.budget, args.target_error) {
            (Some(seconds), _) => Some(Self::Budget(seconds)),
            (None, Some(percent)) => Some(Self::TargetError(percent)),
            (None, None) => None,
        }
    }
}

/// What may be chosen: the settings that the user has left open.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Open {
    /// Whether the number of virtual lights is.
    pub lights: bool,
    /// Whether sharing them out is.
    pub interleave: bool,
    /// Whether how light is blocked is.
    pub occlusion: bool,
}

/// Numbers of lights to choose from.
const LIGHTS: [u32; 10] = [16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192];
/// Ways to find occlusion to choose from.
const KINDS: [OcclusionMethod; 2] = [OcclusionMethod::Rays, OcclusionMethod::Sampled];
/// Frames at the full size that correct the model.
const ROUNDS: usize = 4;
/// Seconds of a frame beyond which nothing is tried for a small error.
const SLOWEST: f64 = 60.0;
/// Frames that are expected to take longer than the budget by more than this are not tried.
const NEAR: f64 = 1.05;

/// What was chosen, and why.
#[derive(Clone, Debug)]
pub(crate) struct Choice {
    goal: Goal,
    predicted: Outcome,
    measured: Outcome,
    noise: f64,
    /// Frames at the full size that were tried, the chosen one included.
    frames: usize,
    /// Seconds that the choice took.
    seconds: f64,
}

/// Chooses settings, and makes them those of the job.
///
/// # Errors
/// [`Failure::Usage`] for a picture that is too small, or one without indirect light; what rendering returns.
pub(crate) fn choose<B: Host>(
    backend: &B,
    scene: &B::Res<SceneData>,
    job: &mut Job,
    goal: Goal,
    open: &Open,
    observer: &dyn Observer,
) -> Result<Choice> {
    let start = Instant::now();
    let truth = Truth::trace(backend, scene, job, observer)?;
    let usual = &job.settings;
    let choices = Choices {
        kinds: if open.occlusion {
            &KINDS
        } else {
            &[usual.occlusion]
        },
        sides: if open.interleave {
            &SIDES
        } else {
            &[usual.interleave]
        },
        lights: (!open.lights).then_some(usual.lights),
    };
    let mut model = calibrate(backend, scene, job, &truth, &choices)?;
    let candidates = candidates(usual, &choices);

    let mut tried: Vec<(Settings, Outcome, Outcome)> = Vec::new();
    while tried.len() < ROUNDS {
        let (settings, predicted) = best(&candidates, &model, &tried, goal)?;
        if tried.iter().any(|(other, ..)| *other == settings) {
            break;
        }
        let plan = job.plan_for(&settings, job.seed)?;
        let shot = Shot {
            lights: &job.lights,
            view: &job.view,
            plan: &plan,
        };
        let effort = Effort {
            warm_up: Duration::from_millis(500),
            runs: 3,
            patience: Duration::from_secs(2),
        };
        let frames = measure(backend, scene, shot, effort)?;
        let measured = Outcome {
            seconds: frames.seconds(),
            error: truth.error_of(&frames)?,
        };
        tried.push((settings, predicted, measured));
        model.correct(
            tried
                .iter()
                .map(|(settings, _, measured)| (settings, measured)),
        );
    }
    let frames = tried.len();
    let rank = |outcome: &Outcome| rank(goal, outcome);
    let chosen = tried
        .into_iter()
        .min_by(|a, b| rank(&a.2).total_cmp(&rank(&b.2)));
    let (settings, predicted, measured) =
        chosen.ok_or_else(|| Failure::Internal("no settings tried".into()))?;
    job.plan = job.plan_for(&settings, job.seed)?;
    job.settings = settings;
    Ok(Choice {
        goal,
        predicted,
        measured,
        noise: truth.noise,
        frames,
        seconds: start.elapsed().as_secs_f64(),
    })
}

/// Refuses what no settings can be chosen for.
///
/// # Errors
/// [`Failure::Usage`] for a method other than `vsgl`, or a stride.
pub(crate) fn check(job: &Job) -> Result<()> {
    if job.settings.method != Method::Vsgl {
        return Err(Failure::Usage(format!(
            "--budget and --target-error choose settings of the method vsgl, not of {}; leave --method out",
            job.settings.method
        )));
    }
    if job.view.stride != 1 {
        return Err(Failure::Usage(
            "--budget and --target-error compare blocks of pixels, and --stride leaves pixels out; give a smaller --size instead"
                .into(),
        ));
    }
    Ok(())
}

/// All that may be chosen.
fn candidates(usual: &Settings, choices: &Choices<'_>) -> Vec<Settings> {
    let numbers = choices.lights.map_or(LIGHTS.to_vec(), |n| vec![n]);
    let mut all = Vec::new();
    for &lights in &numbers {
        for &interleave in choices.sides {
            for &occlusion in choices.kinds {
                // A pixel without a light of its own has nothing to shade.
                if lights >= interleave * interleave || interleave == 1 {
                    all.push(Settings {
                        lights,
                        interleave,
                        occlusion,
                        ..usual.clone()
                    });
                }
            }
        }
    }
    all
}

/// The candidate that fits the goal best by what is known: by measurement where it was tried, else by the model.
fn best(
    candidates: &[Settings],
    model: &Model,
    tried: &[(Settings, Outcome, Outcome)],
    goal: Goal,
) -> Result<(Settings, Outcome)> {
    let known = |settings: &Settings| {
        let measured = tried.iter().find(|(other, ..)| other == settings);
        let outcome = match measured {
            Some((_, _, measured)) => *measured,
            None => model.predict(settings)?,
        };
        Some((settings.clone(), outcome))
    };
    let all = candidates.iter().filter_map(known);
    let best = all.min_by(|a, b| rank(goal, &a.1).total_cmp(&rank(goal, &b.1)));
    best.ok_or_else(|| Failure::Internal("nothing to choose from".into()))
}

/// How far an outcome is from what is wanted: among those that keep to the limit by the other quantity, and behind them by how
/// far they are over it.
fn rank(goal: Goal, outcome: &Outcome) -> f64 {
    const OVER: f64 = 1e9;
    let (limited, limit, other) = match goal {
        Goal::Budget(seconds) => (outcome.seconds, seconds, outcome.error),
        // What takes for ever is as bad as what is wrong.
        Goal::TargetError(_) if outcome.seconds > SLOWEST => {
            return OVER * OVER * outcome.seconds;
        }
        Goal::TargetError(error) => (outcome.error, error, outcome.seconds),
    };
    if limited <= limit * NEAR {
        other
    } else {
        OVER * limited / limit
    }
}

impl Choice {
    /// For people; `settings` are the chosen ones.
    pub(crate) fn text(&self, settings: &Settings) -> String {
        let Self {
            predicted,
            measured,
            ..
        } = self;
        let mut out = format!(
            "chosen    lights = {}, interleave = {}, occlusion = {}\n",
            settings.lights, settings.interleave, settings.occlusion
        );
        out += &format!(
            "  a frame in {:.3} s, predicted {:.3} s\n  error {:.2} %, predicted {:.2} %: mape of the indirect light in blocks of 8x8 pixels\n",
            measured.seconds, predicted.seconds, measured.error, predicted.error
        );
        out += &format!(
            "  chosen in {:.1} s, after {} at the full size; the truth it was held against has {:.2} % of noise, which is taken out\n",
            self.seconds,
            crate::commands::count(self.frames, "try"),
            self.noise
        );
        if let Some(missed) = self.missed() {
            out += &format!("  {missed}\n");
        }
        out
    }

    /// What to say if the goal is out of reach.
    pub(crate) fn missed(&self) -> Option<String> {
        let Outcome { seconds, error } = self.measured;
        match self.goal {
            Goal::Budget(limit) if seconds > limit * NEAR => Some(format!(
                "{limit} s are not enough for this scene at this size: the fastest settings take {seconds:.3} s"
            )),
            Goal::TargetError(limit) if error > limit * NEAR => Some(format!(
                "an error of {limit} % is out of reach of what was chosen from, frames of up to {SLOWEST} s: the best has {error:.2} %"
            )),
            _ => None,
        }
    }

    /// For machines.
    pub(crate) fn json(&self) -> Value {
        let outcome = |o: &Outcome| json!({"seconds": o.seconds, "error_percent": o.error});
        let (key, limit) = match self.goal {
            Goal::Budget(seconds) => ("budget_seconds", seconds),
            Goal::TargetError(error) => ("target_error_percent", error),
        };
        json!({
            key: limit,
            "predicted": outcome(&self.predicted),
            "measured": outcome(&self.measured),
            "reference_noise_percent": self.noise,
            "frames_tried": self.frames,
            "seconds": self.seconds,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_keeps_to_the_limit_comes_first_then_what_is_near_it() {
        let outcome = |seconds, error| Outcome { seconds, error };
        let order = |goal, list: [Outcome; 4]| {
            let mut order: Vec<usize> = (0..4).collect();
            order.sort_by(|&a, &b| rank(goal, &list[a]).total_cmp(&rank(goal, &list[b])));
            order
        };
        let list = [
            outcome(0.1, 12.0),
            outcome(0.19, 6.0),
            outcome(0.3, 4.0),
            outcome(2.0, 1.0),
        ];
        assert_eq!(order(Goal::Budget(0.2), list), [1, 0, 2, 3]);
        assert_eq!(order(Goal::TargetError(5.0), list), [2, 3, 1, 0]);
    }

    #[test]
    fn settings_that_are_given_are_not_chosen() {
        let usual = Settings {
            lights: 77,
            ..Settings::default()
        };
        let choices = Choices {
            kinds: &[OcclusionMethod::None],
            sides: &[1, 2],
            lights: Some(77),
        };
        let all = candidates(&usual, &choices);
        assert_eq!(all.len(), 2);
        assert!(
            all.iter()
                .all(|s| s.lights == 77 && s.occlusion == OcclusionMethod::None)
        );
        let choices = Choices {
            kinds: &KINDS,
            sides: &SIDES,
            lights: None,
        };
        let all = candidates(&usual, &choices);
        assert!(
            all.iter()
                .all(|s| s.interleave == 1 || s.lights >= s.interleave * s.interleave)
        );
        assert!(all.len() > 60);
    }
}
