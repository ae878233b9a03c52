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
/// The small picture's pixel in pixels of the full one; a block has 2 by 2 of them.
const SHRINK: u32 = 4;
/// Numbers of lights that are tried.
const LIGHTS: [u32; 5] = [16, 64, 256, 1024, 4096];
/// Lights of the pictures that tell what sharing them out adds.
const SHARED: u32 = 1024;
/// Sides of squares that share lights.
pub(super) const SIDES: [u32; 4] = [1, 2, 4, 8];
/// Further pictures are not tried after so long.
const PATIENCE: Duration = Duration::from_secs(12);
/// Paths of light in all: in the scenes that were measured they leave 3 to 5 % of noise.
const PATHS: u32 = 1 << 23;
/// Most paths in each block, for each half of the truth.
const SPP_MAX: u32 = 1 << 10;

/// The means over the blocks of the picture as paths of light have them.
pub(super) struct Truth {
    reference: Reference,
    blocks: (u32, u32),
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
        let view = small(&job.view, BLOCK);
        let seeds = [1, 2].map(|i| job.seed.wrapping_add(i));
        let spp = (PATHS / 2 / (blocks.0 * blocks.1)).clamp(1, SPP_MAX);
        let first = half(backend, scene, job, &view, (spp, seeds[0]), observer)?;
        let second = half(backend, scene, job, &view, (spp, seeds[1]), observer)?;
        let reference = Reference::of_halves(&[first, second], &[1])?;
        let noise = reference.noise["indirect"]["1"]["mape"].as_f64();
        let noise = noise.ok_or_else(|| {
            Failure::Usage("no indirect light is seen, so that no setting changes the picture; leave --budget and --target-error out".into())
        })?;
        Ok(Self {
            reference,
            blocks,
            noise,
        })
    }

    /// The error of a picture of `side` by `side` pixels a block, in percent: the mean absolute percentage error of the indirect
    /// light in blocks, less what noise alone makes.
    ///
    /// # Errors
    /// None for a picture of the right size.
    pub(super) fn error(&self, picture: &Picture, side: u32) -> Result<f64> {
        let plane = blocks(&Layers::of(picture)?.indirect, self.blocks, side)?;
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

/// Means over blocks in the middle of a picture.
fn blocks(plane: &Plane, (columns, rows): (u32, u32), side: u32) -> Result<Plane> {
    let (left, top) = (
        (plane.width() - columns * side) / 2,
        (plane.height() - rows * side) / 2,
    );
    let mean = |column: u32, row: u32| {
        let line = |y: u32| {
            let first = ((top + row * side + y) * plane.width() + left + column * side) as usize;
            plane.values()[first..first + side as usize]
                .iter()
                .sum::<f64>()
        };
        (0..side).map(line).sum::<f64>() / f64::from(side * side)
    };
    let means = (0..rows).flat_map(|row| (0..columns).map(move |column| mean(column, row)));
    Ok(Plane::new(columns, rows, means.collect())?)
}

/// Renders small pictures and puts together what they told. `kinds` and `sides` are what may be chosen from, `lights` a number
/// that must not be changed.
///
/// # Errors
/// What rendering returns.
pub(super) fn calibrate<B: Host>(
    backend: &B,
    scene: &B::Res<SceneData>,
    job: &Job,
    truth: &Truth,
    kinds: &[OcclusionMethod],
    sides: &[u32],
    lights: Option<u32>,
) -> Result<Model> {
    let start = Instant::now();
    let view = small(&job.view, SHRINK);
    let pixels = f64::from(view.width) * f64::from(view.height);
    let shoot = |settings: &Settings| -> Result<(Measured, f64)> {
        let plan = job.plan_for(settings, job.seed)?;
        let shot = Shot {
            lights: &job.lights,
            view: &view,
            plan: &plan,
        };
        let effort = Effort {
            runs: 2,
            patience: Duration::from_millis(200),
        };
        let measured = measure(backend, scene, shot, effort)?;
        let error = truth.error(&Picture::from_image(&measured.image), BLOCK / SHRINK)?;
        Ok((measured, error))
    };
    let tried: Vec<u32> = lights.map_or(LIGHTS.to_vec(), |n| {
        // Shares of a number that is given are as cheap as fewer lights.
        let shares = sides.iter().map(|s| (n / (s * s)).max(1));
        let mut tried: Vec<u32> = shares.chain([n]).collect();
        tried.sort_unstable();
        tried.dedup();
        tried
    });
    let mut model = Model {
        kinds: Vec::new(),
        shares: Vec::new(),
        samples: samples(&job.view),
        time_scale: 1.0,
        error_scale: 1.0,
    };
    for &occlusion in kinds {
        let mut told = Vec::new();
        for &lights in &tried {
            if !told.is_empty() && start.elapsed() > PATIENCE {
                break;
            }
            let settings = Settings {
                lights,
                occlusion,
                interleave: 1,
                ..job.settings.clone()
            };
            let (measured, error) = shoot(&settings)?;
            let shade = measured.seconds_of(|p| p == Phase::Shade);
            let rest = measured.seconds_of(|p| matches!(p, Phase::GBuffer | Phase::Resolve));
            told.push(Told {
                lights,
                fixed: (measured.seconds() - shade - rest).max(0.0),
                shade: shade / pixels,
                rest: rest / pixels,
                error: error.max(1e-3),
            });
        }
        model.kinds.push(Kind { occlusion, told });
    }
    let lights = lights.unwrap_or(SHARED);
    let shared = |side: u32| {
        shoot(&Settings {
            lights,
            occlusion: kinds[0],
            interleave: side,
            ..job.settings.clone()
        })
    };
    let (_, alone) = shared(1)?;
    for &side in sides {
        let (measured, error) = shared(side)?;
        // Squares of pixels cover less of the scene in the larger picture: measured, what is added falls by more than their area.
        let area = f64::from(SHRINK * SHRINK);
        model.shares.push(Share {
            side,
            error: (error - alone).max(0.0) / area,
            seconds: measured.seconds_of(|p| p == Phase::Reconstruct) / pixels,
        });
    }
    Ok(model)
}

/// Samples of a picture.
fn samples(view: &View) -> f64 {
    let (width, height) = view.samples();
    f64::from(width) * f64::from(height)
}
