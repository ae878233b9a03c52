//! Pictures that are drawn at random: means with their errors.

use crate::render::Shot;
use vsgl_core::data::Image;
use vsgl_core::plan::Plan;

/// A mean over independent pictures, and the standard error of it.
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    /// The mean.
    pub mean: f64,
    /// Its standard error, from how far the pictures are apart.
    pub error: f64,
}

impl Estimate {
    /// From one value a picture.
    ///
    /// # Panics
    /// For fewer than two.
    pub fn of(values: &[f64]) -> Self {
        let n = values.len() as f64;
        assert!(n >= 2.0, "one picture says nothing of its error");
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
        Self {
            mean,
            error: (variance / n).sqrt(),
        }
    }
}

/// Independent pictures of paths by one plan: each with a seed of its own, the same ones at every run.
///
/// # Panics
/// If the plan has no paths, or a picture fails.
pub fn pictures(shot: &Shot, plan: &Plan, count: u32) -> Vec<Image> {
    let picture = |seed: u32| {
        let mut plan = plan.clone();
        plan.path.as_mut().expect("a plan of paths").seed = seed;
        Image::clone(&shot.frame_by(&plan).image)
    };
    (0..count).map(picture).collect()
}
