//! One combination of settings on one backend: how long its frames take, and what they look like.

use crate::clock;
use crate::device::Host;
use crate::exit::Result;
use crate::interrupt;
use serde_json::{Value, json};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};
use vsgl_core::data::{Image, SceneData};
use vsgl_core::plan::Plan;
use vsgl_core::render::{Observer, Phase, View, render};
use vsgl_core::scene::Light;

/// A frame that is timed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shot<'a> {
    /// The lights that shine.
    pub(crate) lights: &'a [Light],
    /// Camera, size and samples.
    pub(crate) view: &'a View,
    /// What runs.
    pub(crate) plan: &'a Plan,
}

/// How often a combination is run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    /// A first frame that takes longer needs no warming up, and counts.
    pub(crate) warm_up: Duration,
    /// Runs that are timed.
    pub(crate) runs: u32,
    /// No further run begins when so much time was spent on the combination.
    pub(crate) patience: Duration,
}

/// What was found.
pub(crate) struct Measured {
    /// The picture.
    pub(crate) image: Image,
    /// Clusters that there were.
    pub(crate) lights: Option<u32>,
    runs: Vec<Run>,
}

/// Times of one frame.
struct Run {
    wall: Duration,
    /// Of the processor, all threads together; none where the system does not tell.
    cpu: Option<Duration>,
    phases: Vec<Span>,
}

#[derive(Clone, Copy)]
struct Span {
    phase: Phase,
    wall: Duration,
    /// None of a phase that ran elsewhere.
    cpu: Option<Duration>,
}

/// Renders until the times are known.
///
/// # Errors
/// What rendering returns; [`crate::exit::Failure::Interrupted`] if the user wishes.
pub(crate) fn measure<B: Host>(
    backend: &B,
    scene: &B::Res<SceneData>,
    shot: Shot<'_>,
    effort: Effort,
) -> Result<Measured> {
    let start = Instant::now();
    let (mut run, mut image, lights) = once(backend, scene, shot)?;
    if run.wall < effort.warm_up {
        (run, image, _) = once(backend, scene, shot)?;
    }
    let mut runs = vec![run];
    while runs.len() < effort.runs as usize && start.elapsed() < effort.patience {
        interrupt::check()?;
        (run, image, _) = once(backend, scene, shot)?;
        runs.push(run);
    }
    Ok(Measured {
        image,
        lights,
        runs,
    })
}

/// One frame. Its time ends when the picture is complete where the backend keeps it.
fn once<B: Host>(
    backend: &B,
    scene: &B::Res<SceneData>,
    shot: Shot<'_>,
) -> Result<(Run, Image, Option<u32>)> {
    // Forgets the times of what was before.
    backend.times()?;
    let watch = Watch::default();
    let (start, cpu) = (Instant::now(), clock::processor());
    let Shot { lights, view, plan } = shot;
    let frame = render(backend, scene, lights, view, plan, &watch)?;
    backend.finish()?;
    let wall = start.elapsed();
    let cpu = since(cpu);
    let phases = match backend.times()? {
        Some(times) => times
            .into_iter()
            .map(|(phase, wall)| Span {
                phase,
                wall,
                cpu: None,
            })
            .collect(),
        None => watch.spans(),
    };
    let lights = match &frame.vsgls {
        Some(vsgls) => Some(backend.download(vsgls)?.count),
        None => None,
    };
    let image = backend.download(&frame.image)?;
    Ok((Run { wall, cpu, phases }, image, lights))
}

fn since(start: Option<Duration>) -> Option<Duration> {
    Some(clock::processor()?.saturating_sub(start?))
}

/// Notes the times of phases by both clocks.
#[derive(Default)]
struct Watch(Mutex<(Option<Duration>, Vec<Span>)>);

impl Watch {
    fn spans(self) -> Vec<Span> {
        self.0
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner)
            .1
    }
}

impl Observer for Watch {
    fn started(&self, _: Phase) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).0 = clock::processor();
    }

    fn finished(&self, phase: Phase, wall: Duration) {
        let mut noted = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let cpu = since(noted.0);
        noted.1.push(Span { phase, wall, cpu });
    }

    fn cancelled(&self) -> bool {
        interrupt::asked()
    }
}

impl Measured {
    /// Frames that were timed.
    pub(crate) fn runs(&self) -> usize {
        self.runs.len()
    }

    /// Seconds of a frame by the wall clock, the median over the runs.
    pub(crate) fn seconds(&self) -> f64 {
        median(self.runs.iter().map(|r| r.wall))
    }

    /// Seconds of the phases that are asked for by the wall clock, the median over the runs.
    pub(crate) fn seconds_of(&self, wanted: impl Fn(Phase) -> bool) -> f64 {
        let sum = |run: &Run| {
            let spans = run.phases.iter().filter(|s| wanted(s.phase));
            spans.map(|s| s.wall).sum()
        };
        median(self.runs.iter().map(sum))
    }

    /// Seconds of a frame by the wall clock: median, least and most.
    pub(crate) fn wall(&self) -> Value {
        spread(self.runs.iter().map(|r| r.wall))
    }

    /// The same by the processor's clock; null where nobody tells.
    pub(crate) fn cpu(&self) -> Value {
        let times: Option<Vec<_>> = self.runs.iter().map(|r| r.cpu).collect();
        times.map_or(Value::Null, |times| spread(times.into_iter()))
    }

    /// The phases in their order, each with its median over the runs.
    pub(crate) fn phases(&self) -> Value {
        let count = self.runs.iter().map(|r| r.phases.len()).min().unwrap_or(0);
        let phase = |index: usize| {
            let spans = || self.runs.iter().map(move |r| r.phases[index]);
            let cpu: Option<Vec<_>> = spans().map(|s| s.cpu).collect();
            json!({
                "phase": self.runs[0].phases[index].phase.to_string(),
                "wall": median(spans().map(|s| s.wall)),
                "cpu": cpu.map(|times| median(times.into_iter())),
            })
        };
        (0..count).map(phase).collect()
    }
}

/// Median, least and most in seconds.
fn spread(times: impl Iterator<Item = Duration>) -> Value {
    let mut seconds: Vec<f64> = times.map(|t| t.as_secs_f64()).collect();
    seconds.sort_unstable_by(f64::total_cmp);
    json!({
        "median": middle(&seconds),
        "least": seconds.first(),
        "most": seconds.last(),
    })
}

fn median(times: impl Iterator<Item = Duration>) -> f64 {
    let mut seconds: Vec<f64> = times.map(|t| t.as_secs_f64()).collect();
    seconds.sort_unstable_by(f64::total_cmp);
    middle(&seconds)
}

/// The middle of sorted values, or the mean of the two there.
fn middle(sorted: &[f64]) -> f64 {
    let half = sorted.len() / 2;
    match sorted.len() {
        0 => 0.0,
        odd if odd % 2 == 1 => sorted[half],
        _ => 0.5 * (sorted[half - 1] + sorted[half]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_are_in_the_middle() {
        assert_eq!(middle(&[1.0, 2.0, 9.0]), 2.0);
        assert_eq!(middle(&[1.0, 2.0, 4.0, 9.0]), 3.0);
        let times = [3, 1, 2].map(Duration::from_secs);
        let found = spread(times.into_iter());
        assert_eq!(found, json!({"median": 2.0, "least": 1.0, "most": 3.0}));
    }
}
