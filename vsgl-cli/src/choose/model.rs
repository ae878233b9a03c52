//! What settings will cost and how far they will be from the truth, from what a small picture told.

use vsgl_core::settings::{OcclusionMethod, Settings};

/// What a small picture with some settings told, `interleave` being 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Told {
    /// Number of virtual lights.
    pub(super) lights: u32,
    /// Seconds that the size of the picture does not change.
    pub(super) fixed: f64,
    /// Seconds of shading a sample.
    pub(super) shade: f64,
    /// Seconds of everything else a sample.
    pub(super) rest: f64,
    /// The error in percent.
    pub(super) error: f64,
}

/// What is known of one way to find occlusion.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Kind {
    pub(super) occlusion: OcclusionMethod,
    /// At least one, by ascending number of lights.
    pub(super) told: Vec<Told>,
}

/// What sharing out the lights costs and adds at the size of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Share {
    /// Side of the square of pixels that share.
    pub(super) side: u32,
    /// Error that is added, in percent.
    pub(super) error: f64,
    /// Seconds a sample for putting the shares together.
    pub(super) seconds: f64,
}

/// Predicts.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Model {
    pub(super) kinds: Vec<Kind>,
    /// One for each side, beginning with 1.
    pub(super) shares: Vec<Share>,
    /// Samples of the picture.
    pub(super) samples: f64,
    /// Measured over predicted time, from frames at the full size.
    pub(super) time_scale: f64,
    /// The same for errors.
    pub(super) error_scale: f64,
}

/// Time and error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Outcome {
    /// Of a frame, in seconds.
    pub(super) seconds: f64,
    /// In percent.
    pub(super) error: f64,
}

impl Model {
    /// What these settings lead to. None if nothing is known of their occlusion or interleaving.
    pub(super) fn predict(&self, settings: &Settings) -> Option<Outcome> {
        let kind = self
            .kinds
            .iter()
            .find(|k| k.occlusion == settings.occlusion)?;
        let share = self.shares.iter().find(|s| s.side == settings.interleave)?;
        let lights = f64::from(settings.lights);
        let each = lights / f64::from(share.side * share.side);
        let fixed = kind.at(lights.ln(), |t| f64::from(t.lights).ln(), |t| t.fixed);
        let shade = kind.at(each, |t| f64::from(t.lights), |t| t.shade);
        let rest = kind.at(lights.ln(), |t| f64::from(t.lights).ln(), |t| t.rest);
        let seconds =
            fixed.max(0.0) + self.samples * (shade.max(0.0) + rest.max(0.0) + share.seconds);
        Some(Outcome {
            seconds: self.time_scale * seconds,
            error: self.error_scale * (kind.error(settings.lights) + share.error),
        })
    }
}

impl Model {
    /// Learns from frames at the full size: all predictions are scaled by the geometric mean of measured over predicted, so that
    /// one odd number of lights does not spoil the others.
    pub(super) fn correct<'a>(
        &mut self,
        measured: impl Iterator<Item = (&'a Settings, &'a Outcome)>,
    ) {
        (self.time_scale, self.error_scale) = (1.0, 1.0);
        let ratio = |(settings, measured): (&Settings, &Outcome)| {
            let predicted = self.predict(settings)?;
            let ratio = |measured: f64, predicted: f64| (measured / predicted).ln();
            Some((
                ratio(measured.seconds, predicted.seconds),
                ratio(measured.error, predicted.error),
            ))
        };
        let ratios: Vec<(f64, f64)> = measured.filter_map(ratio).collect();
        if ratios.is_empty() {
            return;
        }
        let count = ratios.len() as f64;
        self.time_scale = (ratios.iter().map(|r| r.0).sum::<f64>() / count).exp();
        self.error_scale = (ratios.iter().map(|r| r.1).sum::<f64>() / count).exp();
    }
}

impl Kind {
    /// The error with so many lights that no pixels share, in percent.
    pub(super) fn error(&self, lights: u32) -> f64 {
        let coordinate = |t: &Told| f64::from(t.lights).ln();
        self.at(f64::from(lights).ln(), coordinate, |t| t.error.ln())
            .exp()
    }

    /// A quantity between what was told, along a coordinate; on the line through the last two outside.
    fn at(&self, x: f64, coordinate: impl Fn(&Told) -> f64, value: impl Fn(&Told) -> f64) -> f64 {
        let told = &self.told;
        let upper = told.partition_point(|t| coordinate(t) < x);
        let upper = upper.clamp(1.min(told.len() - 1), told.len() - 1);
        let (a, b) = (&told[upper.saturating_sub(1)], &told[upper]);
        let width = coordinate(b) - coordinate(a);
        if width <= 0.0 {
            return value(b);
        }
        value(a) + (x - coordinate(a)) / width * (value(b) - value(a))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(lights: u32, error: f64) -> Told {
        Told {
            lights,
            fixed: 0.01 * f64::from(lights).ln(),
            shade: 1e-6 + 1e-8 * f64::from(lights),
            rest: 1e-7,
            error,
        }
    }

    fn model() -> Model {
        let share = |side, error, seconds| Share {
            side,
            error,
            seconds,
        };
        Model {
            kinds: vec![Kind {
                occlusion: OcclusionMethod::Rays,
                told: vec![told(64, 16.0), told(256, 8.0), told(1024, 4.0)],
            }],
            shares: vec![share(1, 0.0, 0.0), share(4, 0.5, 1e-7)],
            samples: 1e6,
            time_scale: 1.0,
            error_scale: 1.0,
        }
    }

    fn settings(lights: u32, interleave: u32) -> Settings {
        Settings {
            lights,
            interleave,
            ..Settings::default()
        }
    }

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-9 * b.abs(), "{a} is not {b}");
    }

    #[test]
    fn laws_that_hold_between_pilots_are_found_and_go_on_beyond() {
        let model = model();
        for lights in [16, 64, 128, 1024, 8192] {
            let found = model.predict(&settings(lights, 1)).expect("known");
            let n = f64::from(lights);
            close(
                found.seconds,
                0.01 * n.ln() + 1e6 * (1e-6 + 1e-8 * n + 1e-7),
            );
            close(found.error, 16.0 * (64.0 / n).sqrt());
        }
    }

    #[test]
    fn shares_of_lights_cost_less_and_err_more() {
        let model = model();
        let found = model.predict(&settings(1024, 4)).expect("known");
        close(
            found.seconds,
            0.01 * 1024f64.ln() + 1e6 * (1e-6 + 1e-8 * 64.0 + 2e-7),
        );
        close(found.error, 4.5);
        assert_eq!(model.predict(&settings(64, 2)), None);
    }

    #[test]
    fn frames_at_the_full_size_correct_all_predictions() {
        let mut model = model();
        let (a, b) = (settings(64, 1), settings(256, 1));
        let raw = |s| model.predict(s).expect("known");
        let times = |o: Outcome, time, error| Outcome {
            seconds: time * o.seconds,
            error: error * o.error,
        };
        let found = [times(raw(&a), 2.0, 9.0), times(raw(&b), 2.0, 1.0)];
        let other = settings(1024, 4);
        let expected = times(raw(&other), 2.0, 3.0);
        for _ in 0..2 {
            model.correct([(&a, &found[0]), (&b, &found[1])].into_iter());
            let corrected = model.predict(&other).expect("known");
            close(corrected.seconds, expected.seconds);
            close(corrected.error, expected.error);
        }
    }

    #[test]
    fn one_pilot_is_enough_to_say_something() {
        let mut model = model();
        model.kinds[0].told.truncate(1);
        let found = model.predict(&settings(1024, 1)).expect("known");
        close(found.error, 16.0);
    }
}
