//! From shares of the virtual lights to all of them, all samples.

use super::band;
use rayon::prelude::*;
use vsgl_core::data::{GBuffer, Radiance};
use vsgl_core::phase::reconstruct::{Layers, sample};
use vsgl_core::plan::ReconstructPlan;

pub(crate) fn run(gbuffer: &GBuffer, radiance: &Radiance, plan: &ReconstructPlan) -> Radiance {
    let (width, height) = (gbuffer.width, gbuffer.height);
    let row = |y: u32| (0..width).map(move |x| sample(gbuffer, radiance, plan, x, y));
    let mut made = Radiance {
        width,
        height,
        ..Radiance::default()
    };
    let count = width as usize * height as usize;
    for rows in band::rows(width, height) {
        let samples: Vec<Layers> = rows.into_par_iter().flat_map_iter(row).collect();
        let glossy = if plan.glossy { &samples[..] } else { &[] };
        let part = Radiance {
            direct: samples.iter().map(|s| s.direct).collect(),
            indirect_diffuse: samples.iter().map(|s| s.indirect_diffuse).collect(),
            indirect_glossy: glossy.iter().map(|s| s.indirect_glossy).collect(),
            ..Radiance::default()
        };
        made.append(&part, count);
    }
    made
}
