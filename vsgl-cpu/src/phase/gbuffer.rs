//! What the camera sees, all samples.

use super::band;
use rayon::prelude::*;
use vsgl_core::data::{GBuffer, SceneData};
use vsgl_core::phase::gbuffer::{Sample, sample};
use vsgl_core::plan::GBufferPlan;
use vsgl_core::render::View;

pub(crate) fn run(scene: &SceneData, view: &View, plan: &GBufferPlan) -> GBuffer {
    let (width, height) = view.samples();
    let row = |y: u32| (0..width).map(move |x| sample(scene, view, x, y, plan));
    let mut gbuffer = GBuffer {
        width,
        height,
        ..GBuffer::default()
    };
    let count = width as usize * height as usize;
    for rows in band::rows(width, height) {
        let height = rows.len() as u32;
        let samples: Vec<Sample> = rows.into_par_iter().flat_map_iter(row).collect();
        gbuffer.append(&GBuffer::from_samples(width, height, &samples, plan), count);
    }
    gbuffer
}
