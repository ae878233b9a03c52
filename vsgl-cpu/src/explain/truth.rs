//! Light along paths, at some places of a picture.

use crate::CpuBackend;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use vsgl_core::data::SceneData;
use vsgl_core::metrics::luminance;
use vsgl_core::phase::draw;
use vsgl_core::phase::path::{World, sample};
use vsgl_core::plan::PathPlan;
use vsgl_core::render::{Observer, Phase, View};
use vsgl_core::scene::Light;
use vsgl_core::{Error, Result};

/// Squares of a picture that paths go through.
#[derive(Clone, Debug)]
pub struct Places {
    /// The view whose pixels are the squares.
    view: View,
    /// Column and row of each.
    squares: Vec<(u32, u32)>,
}

impl Places {
    /// Parts of a pixel that [`Places::at_samples`] looks through, along a side.
    const PARTS: u32 = 63;

    /// Whole pixels.
    pub fn pixels(view: &View, pixels: &[(u32, u32)]) -> Self {
        Self {
            view: View { aa: 1, ..*view },
            squares: pixels.to_vec(),
        }
    }

    /// The middles of samples: a sixty-third of the way from one to the next, which is a pixel of a picture so much larger.
    pub fn at_samples(view: &View, samples: &[(u32, u32)]) -> Self {
        let times = view.aa * Self::PARTS;
        let middle = |place: u32| place * Self::PARTS + Self::PARTS / 2;
        Self {
            view: View {
                width: view.width * times,
                height: view.height * times,
                aa: 1,
                ..*view
            },
            squares: samples
                .iter()
                .map(|&(x, y)| (middle(x), middle(y)))
                .collect(),
        }
    }
}

/// Luminance of indirect light through some squares, the mean over all paths of the plan \[W/(m² sr)\].
///
/// # Errors
/// [`Error::Cancelled`] if the observer says so.
pub fn truth(
    backend: &CpuBackend,
    scene: &SceneData,
    lights: &[Light],
    places: &Places,
    plan: &PathPlan,
    observer: &dyn Observer,
) -> Result<Vec<f64>> {
    let lights = draw::lights(lights, scene.bounds(), plan.light_sampling);
    let world = World {
        scene,
        lights: &lights,
        plan,
    };
    let done = AtomicUsize::new(0);
    let one = |&(x, y): &(u32, u32)| {
        if observer.cancelled() {
            return Err(Error::Cancelled(Phase::Trace));
        }
        let mut sum = 0.0;
        for index in 0..plan.samples {
            let light = sample(&world, &places.view, x, y, index);
            sum += luminance((light.indirect_diffuse + light.indirect_glossy).to_array());
        }
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        observer.advanced(Phase::Trace, done as f32 / places.squares.len() as f32);
        Ok(sum / f64::from(plan.samples))
    };
    backend
        .pool
        .install(|| places.squares.par_iter().map(one).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use vsgl_core::glam::Vec3;
    use vsgl_core::phase::gbuffer::ray;
    use vsgl_core::phase::path::camera_ray;
    use vsgl_core::scene::Camera;

    #[test]
    fn paths_go_through_the_samples() {
        let camera = Camera::look_at(Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO, 0.8);
        for (width, height, aa) in [(16, 9, 1), (640, 360, 2), (1920, 1080, 3), (7, 4096, 1)] {
            let view = View {
                camera,
                width,
                height,
                aa,
                stride: 1,
            };
            let samples = [(0, 0), (3 * aa, 2), (width * aa - 1, height * aa - 1)];
            let places = Places::at_samples(&view, &samples);
            for (sample, square) in samples.iter().zip(&places.squares) {
                let wanted = ray(&view, sample.0, sample.1).direction.normalize();
                for corner in [[0.0, 0.0], [0.5, 0.5], [0.99, 0.99]] {
                    let found = camera_ray(&places.view, square.0, square.1, corner).direction;
                    let step = 2.0 * camera.tan_half_fov / (height * aa) as f32;
                    let apart = (found - wanted).length();
                    assert!(
                        apart < 0.02 * step + 1e-6,
                        "{width}x{height}: {apart} of {step}"
                    );
                }
            }
        }
    }
}
