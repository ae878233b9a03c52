//! How far a picture is: on a terminal as a bar, elsewhere not at all or as lines.

use crate::args::When;
use crate::interrupt;
use crate::text;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};
use vsgl_core::render::{Observer, Phase};

/// Shows the phases, notes their times, and passes on the wish to stop.
#[derive(Debug)]
pub struct Progress {
    show: Show,
    /// When the current phase began.
    began: Mutex<Instant>,
    times: Mutex<Vec<(Phase, Duration)>>,
}

#[derive(Debug)]
enum Show {
    Nothing,
    Bar(ProgressBar),
    /// A line for each phase and each tenth of it; the last tenth shown.
    Lines(Mutex<u32>),
}

impl Progress {
    /// Shows progress on standard error, as asked.
    pub fn new(when: When) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let show = match (when, terminal) {
            (When::Never, _) | (When::Auto, false) => Show::Nothing,
            (_, true) => Show::Bar(bar()),
            (When::Always, false) => Show::Lines(Mutex::new(0)),
        };
        Self {
            show,
            began: Mutex::new(Instant::now()),
            times: Mutex::new(Vec::new()),
        }
    }

    /// How long the current phase still takes, of which a share is done; nothing before a hundredth of it, or of less than a
    /// second.
    fn left(&self, share: f32) -> Option<String> {
        let began = *self.began.lock().unwrap_or_else(PoisonError::into_inner);
        let share = f64::from(share);
        let seconds = began.elapsed().as_secs_f64() * (1.0 - share) / share;
        (share >= 0.01 && seconds >= 1.0).then(|| time(seconds as u64))
    }

    /// The phases that ran with their wall times, and an end to all that is shown.
    pub fn finish(self) -> Vec<(Phase, Duration)> {
        if let Show::Bar(bar) = &self.show {
            bar.finish_and_clear();
        }
        self.times
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner)
    }
}

/// A time in words of two units at most.
fn time(seconds: u64) -> String {
    let (minutes, hours) = (seconds / 60, seconds / 3600);
    match (hours, minutes) {
        (0, 0) => format!("{seconds} s"),
        (0, _) => format!("{minutes} min {} s", seconds % 60),
        _ => format!("{hours} h {} min", minutes % 60),
    }
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(1000), ProgressDrawTarget::stderr());
    if let Ok(style) =
        ProgressStyle::with_template("{msg:9} {wide_bar} {percent:>3} %  {elapsed}{prefix}")
    {
        bar.set_style(style);
    }
    bar
}

impl Observer for Progress {
    fn started(&self, phase: Phase) {
        *self.began.lock().unwrap_or_else(PoisonError::into_inner) = Instant::now();
        match &self.show {
            Show::Nothing => {}
            Show::Bar(bar) => {
                bar.set_message(phase.to_string());
                bar.set_prefix("");
                bar.set_position(0);
                bar.tick();
            }
            Show::Lines(tenth) => {
                *tenth.lock().unwrap_or_else(PoisonError::into_inner) = 0;
                text::warn(&format!("{phase} ..."));
            }
        }
    }

    fn advanced(&self, phase: Phase, share: f32) {
        match &self.show {
            Show::Nothing => {}
            Show::Bar(bar) => {
                bar.set_position((share * 1000.0) as u64);
                if let Some(left) = self.left(share) {
                    bar.set_prefix(format!(", {left} left"));
                }
            }
            Show::Lines(shown) => {
                let tenth = (share * 10.0) as u32;
                let mut shown = shown.lock().unwrap_or_else(PoisonError::into_inner);
                if tenth > *shown && tenth < 10 {
                    *shown = tenth;
                    let left = self.left(share).map(|left| format!(", {left} left"));
                    text::warn(&format!("{phase} {tenth}0 %{}", left.unwrap_or_default()));
                }
            }
        }
    }

    fn finished(&self, phase: Phase, wall: Duration) {
        if let Show::Lines(_) = &self.show {
            text::warn(&format!("{phase} {:.2} s", wall.as_secs_f64()));
        }
        let mut times = self.times.lock().unwrap_or_else(PoisonError::into_inner);
        times.push((phase, wall));
    }

    fn cancelled(&self) -> bool {
        interrupt::asked()
    }
}

/// Shows how many of several steps are done.
#[derive(Debug)]
pub struct Steps {
    bar: Option<ProgressBar>,
    lines: bool,
}

impl Steps {
    /// Shows progress on standard error, as asked.
    pub fn new(when: When, steps: usize) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let bar = (when != When::Never && terminal).then(|| {
            let bar =
                ProgressBar::with_draw_target(Some(steps as u64), ProgressDrawTarget::stderr());
            let style = "{wide_msg}  {pos} of {len}, {eta} left";
            if let Ok(style) = ProgressStyle::with_template(style) {
                bar.set_style(style);
            }
            bar
        });
        Self {
            bar,
            lines: when == When::Always && !terminal,
        }
    }

    /// A step begins.
    pub fn begun(&self, what: &str) {
        if let Some(bar) = &self.bar {
            bar.set_message(what.to_owned());
        }
    }

    /// A step is done, or need not be.
    pub fn passed(&self, what: &str) {
        if let Some(bar) = &self.bar {
            bar.println(what);
            bar.inc(1);
        }
        if self.lines {
            text::warn(what);
        }
    }

    /// An end to all that is shown.
    pub fn finish(self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_two_units() {
        for (seconds, words) in [
            (0, "0 s"),
            (59, "59 s"),
            (61, "1 min 1 s"),
            (3599, "59 min 59 s"),
            (90_000, "25 h 0 min"),
        ] {
            assert_eq!(time(seconds), words);
        }
    }

    #[test]
    fn time_left_follows_from_the_share() {
        let progress = Progress::new(When::Never);
        progress.started(Phase::Trace);
        let Some(earlier) = Instant::now().checked_sub(Duration::from_secs(100)) else {
            return;
        };
        *progress.began.lock().expect("nobody else") = earlier;
        assert_eq!(progress.left(0.5).as_deref(), Some("1 min 40 s"));
        assert_eq!(progress.left(0.0), None);
        assert_eq!(progress.left(1.0), None);
    }
}
