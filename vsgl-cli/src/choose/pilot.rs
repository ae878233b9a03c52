//! Small pictures that tell what larger ones will cost and err.

use super::model::{Kind, Model, Share, Told};
use crate::device::Host;
use crate::exit::{Failure, Result};
use crate::job::Job;
use crate::measure::{Effort, Layers, Measured, Reference, Shot, half, measure};
use crate::picture::Picture;
use std::time::{Duration, Instant};
use vsgl_core::data::SceneData;
use vsgl_core::metrics::{Metric, Plane, compare};
use vsgl_core::render::{Observer, Phase, View};
use vsgl_core::settings::{OcclusionMethod, Settings};

/// Side of the blocks whose means are compared, in pixels of the full picture.
const BLOCK: u32 = 8;
/// A small picture's pixel in pixels of the full one, along one side: of many pictures, and of a few that tell what that changes.
const SHRINK: [u32; 2] = [4, 2];
/// Numbers of lights that are tried.
const LIGHTS: [u32; 5] = [16, 64, 256, 1024, 4096];
/// Lights of the pictures that tell what sharing them out adds, and what a small picture does.
const SHARED: u32 = 256;
/// Sides of squares that share lights.
pub(super) const SIDES: [u32; 4] = [1, 2, 4, 8];
/// Further pictures are not tried after so long.
const PATIENCE: Duration = Duration::from_secs(12);
/// Paths of light in all: in the scenes that were measured they leave 3 to 5 % of noise.
const PATHS: u32 = 1 << 23;
/// Most paths in each block, for each half of the truth.
const SPP_MAX: u32 = 1 << 12;
/// Blocks that paths are traced for, or somewhat more: every which along both sides.
const BLOCKS: u32 = 800;

/// Means over blocks of the picture as paths of light have them.
pub(super) struct Truth {
    reference: Reference,
    /// Which blocks: every `stride`th of every such row, from the first in the middle of the picture.
    view: View,
    /// The error that noise alone makes, in percent.
    pub(super) noise: f64,
}

impl Truth {
    /// Traces paths, which takes a few seconds. A pixel of this picture is a block of the full one: paths are spread over it.
    ///
    /// # Errors
    /// [`Failure::Usage`] for a picture without a whole block, and what rendering returns.
    pub(super) fn trace<B: Host>(
        backend: &B,
        scene: &B::Res<SceneData>,
        job: &Job,
        observer: &dyn Observer,
    ) -> Result<Self> {
        let blocks = (job.view.width / BLOCK, job.view.height / BLOCK);
        if blocks.0 == 0 || blocks.1 == 0 {
            return Err(Failure::Usage(format!(
                "--size: settings are chosen by the means over blocks of {BLOCK} by {BLOCK} pixels, and {}x{} has none; \
                 make the picture larger",
                job.view.width, job.view.height
            )));
        }
        let stride = (blocks.0 * blocks.1 / BLOCKS).isqrt().max(1);
        let view = View {
            stride,
            ..small(&job.view, BLOCK)
        };
        let seeds = [1, 2].map(|i| job.seed.wrapping_add(i));
        let (columns, rows) = view.pixels();
        let spp = (PATHS / 2 / (columns * rows)).clamp(1, SPP_MAX);
        let first = half(backend, scene, job, &view, (spp, seeds[0]), observer)?;
        let second = half(backend, scene, job, &view, (spp, seeds[1]), observer)?;
        let reference = Reference::of_halves(&[first, second], &[1])?;
        let noise = reference.noise["indirect"]["1"]["mape"].as_f64();
        let noise = noise.ok_or_else(|| {
            Failure::Usage("no indirect light is seen, so that no setting changes the picture; leave --budget and --target-error out".into())
        })?;
        Ok(Self {
            reference,
            view,
            noise,
        })
    }

    /// The error of a picture of `side` by `side` pixels a block, in percent: the mean absolute percentage error of the indirect
    /// light in blocks, less what noise alone makes.
    ///
    /// # Errors
    /// None for a picture of the right size.
    pub(super) fn error(&self, picture: &Picture, side: u32) -> Result<f64> {
        let plane = blocks(&Layers::of(picture)?.indirect, &self.view, side)?;
        let found = compare(&plane, &self.reference.layers.indirect, 1)?;
        let found = found.map_or(0.0, |errors| errors.get(Metric::Mape));
        // Errors that are independent of each other add up like this. What is below the noise cannot be told.
        let square = found * found - self.noise * self.noise;
        Ok(square.max(0.25 * self.noise * self.noise).sqrt())
    }

    /// The error of a picture at the full size.
    ///
    /// # Errors
    /// As [`Truth::error`].
    pub(super) fn error_of(&self, measured: &Measured) -> Result<f64> {
        self.error(&Picture::from_image(&measured.image), BLOCK)
    }
}

/// The middle of the picture in whole blocks, each of `shrink` times fewer pixels along both sides.
fn small(view: &View, shrink: u32) -> View {
    let (columns, rows) = (view.width / BLOCK, view.height / BLOCK);
    let mut camera = view.camera;
    camera.tan_half_fov *= (rows * BLOCK) as f32 / view.height as f32;
    View {
        camera,
        width: columns * (BLOCK / shrink),
        height: rows * (BLOCK / shrink),
        aa: 1,
        stride: 1,
    }
}

/// Means over the blocks of `side` by `side` pixels in the middle of a picture that `view` has pixels of.
fn blocks(plane: &Plane, view: &View, side: u32) -> Result<Plane> {
    let left = (plane.width() - view.width * side) / 2;
    let top = (plane.height() - view.height * side) / 2;
    let mean = |column: u32, row: u32| {
        let line = |y: u32| {
            let first = ((top + row * side + y) * plane.width() + left + column * side) as usize;
            let pixels = &plane.values()[first..first + side as usize];
            pixels.iter().sum::<f64>()
        };
        (0..side).map(line).sum::<f64>() / f64::from(side * side)
    };
    let (columns, rows) = view.pixels();
    let row =
        |row: u32| (0..columns).map(move |column| mean(column * view.stride, row * view.stride));
    Ok(Plane::new(
        columns,
        rows,
        (0..rows).flat_map(row).collect(),
    )?)
}

/// What may be chosen from.
pub(super) struct Choices<'a> {
    pub(super) kinds: &'a [OcclusionMethod],
    /// Of squares that share lights.
    pub(super) sides: &'a [u32],
    /// A number of lights that must not be changed.
    pub(super) lights: Option<u32>,
}

/// Renders small pictures and puts together what they told.
///
/// # Errors
/// What rendering returns.
pub(super) fn calibrate<B: Host>(
    backend: &B,
    scene: &B::Res<SceneData>,
    job: &Job,
    truth: &Truth,
    choices: &Choices<'_>,
) -> Result<Model> {
    let pilot = Pilot {
        backend,
        scene,
        job,
        truth,
    };
    let kinds = choices.kinds.iter().map(|&kind| pilot.kind(kind, choices));
    let mut kinds = kinds.collect::<Result<Vec<Kind>>>()?;
    let (shares, alone) = pilot.shares(choices)?;
    // Errors of blocks of few pixels are larger by an amount that hardly depends on the number of lights, and falls to a quarter
    // with half the pixel: measured in three scenes, what is left is within a tenth.
    let small = kinds[0].error(pilot.shared(choices));
    let excess = (small - alone).max(0.0) * 4.0 / 3.0;
    for told in kinds.iter_mut().flat_map(|kind| &mut kind.told) {
        told.error = (told.error - excess).max(0.2 * told.error);
    }
    Ok(Model {
        kinds,
        shares,
        samples: samples(&job.view),
        time_scale: 1.0,
        error_scale: 1.0,
    })
}

/// Renders small pictures.
struct Pilot<'a, B: Host> {
    backend: &'a B,
    scene: &'a B::Res<SceneData>,
    job: &'a Job,
    truth: &'a Truth,
}

/// What a small picture cost, a sample where it is shading, and erred.
struct Shown {
    measured: Measured,
    error: f64,
    samples: f64,
}

impl<B: Host> Pilot<'_, B> {
    fn shoot(&self, settings: &Settings, shrink: u32) -> Result<Shown> {
        let view = small(&self.job.view, shrink);
        let shot = Shot {
            lights: &self.job.lights,
            view: &view,
            plan: &self.job.plan_for(settings, self.job.seed)?,
        };
        let effort = Effort {
            warm_up: Duration::from_millis(50),
            runs: 2,
            patience: Duration::from_millis(200),
        };
        let measured = measure(self.backend, self.scene, shot, effort)?;
        let picture = Picture::from_image(&measured.image);
        Ok(Shown {
            error: self.truth.error(&picture, BLOCK / shrink)?,
            samples: samples(&view),
            measured,
        })
    }

    /// How one way to find occlusion does with more and more lights.
    fn kind(&self, occlusion: OcclusionMethod, choices: &Choices<'_>) -> Result<Kind> {
        let start = Instant::now();
        let mut told: Vec<Told> = Vec::new();
        for lights in numbers(choices) {
            if told.len() > 2 && start.elapsed() > PATIENCE {
                break;
            }
            let settings = Settings {
                lights,
                occlusion,
                interleave: 1,
                ..self.job.settings.clone()
            };
            let shown = self.shoot(&settings, SHRINK[0])?;
            let seconds = |wanted: fn(Phase) -> bool| shown.measured.seconds_of(wanted);
            let shade = seconds(|p| p == Phase::Shade);
            let rest = seconds(|p| matches!(p, Phase::GBuffer | Phase::Resolve));
            told.push(Told {
                lights,
                fixed: (shown.measured.seconds() - shade - rest).max(0.0),
                shade: shade / shown.samples,
                rest: rest / shown.samples,
                error: shown.error.max(1e-3),
            });
        }
        Ok(Kind { occlusion, told })
    }

    /// What sharing out lights adds, and the error of a picture that does not.
    fn shares(&self, choices: &Choices<'_>) -> Result<(Vec<Share>, f64)> {
        let settings = |interleave| Settings {
            lights: self.shared(choices),
            occlusion: choices.kinds[0],
            interleave,
            ..self.job.settings.clone()
        };
        let alone = self.shoot(&settings(1), SHRINK[1])?.error;
        let mut shares = Vec::new();
        for &side in choices.sides {
            let shown = self.shoot(&settings(side), SHRINK[1])?;
            // In the larger picture a square of pixels covers a quarter of the scene, and adds about that: measured, an eleventh to
            // a half.
            let area = f64::from(SHRINK[1] * SHRINK[1]);
            shares.push(Share {
                side,
                error: (shown.error - alone).max(0.0) / area,
                seconds: shown.measured.seconds_of(|p| p == Phase::Reconstruct) / shown.samples,
            });
        }
        Ok((shares, alone))
    }

    /// Lights of the pictures for [`Pilot::shares`].
    fn shared(&self, choices: &Choices<'_>) -> u32 {
        choices.lights.unwrap_or(SHARED)
    }
}

/// Numbers of lights to try, ascending.
fn numbers(choices: &Choices<'_>) -> Vec<u32> {
    let Some(given) = choices.lights else {
        return LIGHTS.to_vec();
    };
    // Shares of a number that is given are as cheap as fewer lights.
    let shares = choices.sides.iter().map(|s| (given / (s * s)).max(1));
    let mut numbers: Vec<u32> = shares.chain([given]).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// Samples of a picture.
fn samples(view: &View) -> f64 {
    let (width, height) = view.samples();
    f64::from(width) * f64::from(height)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_those_of_every_which_block_in_the_middle() {
        // 5 by 3 pixels: one column is left over on the right, one row below.
        let values = (0..15).map(f64::from).collect();
        let plane = Plane::new(5, 3, values).expect("15 values");
        let camera = vsgl_core::scene::Camera::look_at(Default::default(), Default::default(), 1.0);
        let mut view = View::new(camera, 2, 1).expect("a picture");
        let means = blocks(&plane, &view, 2).expect("two blocks");
        assert_eq!(means.values(), [3.0, 5.0]);
        view.stride = 2;
        assert_eq!(blocks(&plane, &view, 2).expect("one").values(), [3.0]);
    }

    #[test]
    fn numbers_that_are_given_are_tried_with_their_shares() {
        let mut choices = Choices {
            kinds: &[OcclusionMethod::Rays],
            sides: &SIDES,
            lights: Some(1024),
        };
        assert_eq!(numbers(&choices), [16, 64, 256, 1024]);
        choices.lights = Some(1);
        assert_eq!(numbers(&choices), [1]);
        choices.lights = None;
        assert_eq!(numbers(&choices), LIGHTS);
    }
}
