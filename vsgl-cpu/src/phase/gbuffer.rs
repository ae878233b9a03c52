//! What the camera sees, all samples.

use rayon::prelude::*;
use vsgl_core::data::{GBuffer, SceneData};
use vsgl_core::phase::gbuffer::{Sample, sample};
use vsgl_core::plan::GBufferPlan;
use vsgl_core::render::View;

pub(crate) fn run(scene: &SceneData, view: &View, plan: &GBufferPlan) -> GBuffer {
    let (width, height) = view.samples();
    let row = |y: u32| (0..width).map(move |x| sample(scene, view, x, y, plan));
    let samples: Vec<Sample> = (0..height).into_par_iter().flat_map_iter(row).collect();
    GBuffer::from_samples(width, height, &samples, plan)
}
