//! What the camera sees through one sample.

use super::footprint::Place;
use super::mask::closest_hit;
use super::surface::{self, Surface};
use crate::data::{GBuffer, NO_TRIANGLE, SceneData};
use crate::geom::Ray;
use crate::plan::GBufferPlan;
use crate::render::View;
use glam::Vec3;

/// Ray through the sample in column `x` and row `y` of the sample grid; its direction has length 1 along the view
/// axis, so that its parameter is the depth.
///
/// Samples lie on a regular grid of `aa × aa` in each rendered pixel.
pub fn ray(view: &View, x: u32, y: u32) -> Ray {
    let camera = &view.camera;
    let place = |sample: u32| {
        let pixel = (sample / view.aa) * view.stride;
        pixel as f32 + ((sample % view.aa) as f32 + 0.5) / view.aa as f32
    };
    let scale = 2.0 * camera.tan_half_fov / view.height as f32;
    let across = (place(x) - 0.5 * view.width as f32) * scale;
    let upwards = (0.5 * view.height as f32 - place(y)) * scale;
    Ray::new(
        camera.eye,
        (camera.forward + camera.right * across) + camera.up * upwards,
    )
}

/// By how much directions of rays differ from one sample of a pixel to the next, along columns and rows.
pub fn steps(view: &View) -> [Vec3; 2] {
    let camera = &view.camera;
    let scale = 2.0 * camera.tan_half_fov / view.height as f32 / view.aa as f32;
    [camera.right * scale, camera.up * -scale]
}

/// One sample of the G-buffer.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Id of the triangle, or [`NO_TRIANGLE`].
    pub triangle: u32,
    /// Depth along the view axis \[m\].
    pub depth: f32,
    /// The surface; meaningless where nothing was hit.
    pub surface: Surface,
}

/// What the ray through one sample meets.
pub fn sample(scene: &SceneData, view: &View, x: u32, y: u32, plan: &GBufferPlan) -> Sample {
    let ray = ray(view, x, y);
    let hit = closest_hit(scene, &ray, f32::MAX, plan.surface.masks);
    if hit.triangle == NO_TRIANGLE {
        return Sample {
            triangle: NO_TRIANGLE,
            depth: 0.0,
            surface: Surface::default(),
        };
    }
    let steps = steps(view).map(|step| step * hit.t);
    let place = Place::at_hit(scene, &hit, ray.direction, steps, &plan.surface);
    let surface = surface::at_hit(scene, &place, ray.direction, &plan.surface);
    Sample {
        triangle: hit.triangle,
        depth: hit.t,
        surface,
    }
}

impl GBuffer {
    /// Columns from samples, row-major; those of gloss and emission only where the plan has them.
    pub fn from_samples(width: u32, height: u32, samples: &[Sample], plan: &GBufferPlan) -> Self {
        let (glossy, emission) = (plan.glossy, plan.surface.emission);
        let column = |f: fn(&Sample) -> [f32; 4]| samples.iter().map(f).collect::<Vec<_>>();
        let specular = |f: fn(&Sample) -> [f32; 4]| if glossy { column(f) } else { Vec::new() };
        Self {
            width,
            height,
            triangle: samples.iter().map(|s| s.triangle).collect(),
            position: column(|s| s.surface.position.extend(s.depth).to_array()),
            normal: column(|s| s.surface.normal.extend(s.surface.dielectric_f90).to_array()),
            diffuse: column(|s| with(s.surface.diffuse, s.surface.dielectric_f0)),
            specular: specular(|s| with(s.surface.f0, s.surface.alpha)),
            grazing: if glossy {
                samples.iter().map(|s| s.surface.f90).collect()
            } else {
                Vec::new()
            },
            tangent: if plan.surface.anisotropy {
                column(|s| s.surface.tangent.extend(s.surface.across).to_array())
            } else {
                Vec::new()
            },
            emission: if emission {
                samples.iter().map(|s| s.surface.emission).collect()
            } else {
                Vec::new()
            },
        }
    }
}

fn with(rgb: [f32; 3], w: f32) -> [f32; 4] {
    [rgb[0], rgb[1], rgb[2], w]
}
