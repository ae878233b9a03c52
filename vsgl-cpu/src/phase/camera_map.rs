//! What the camera sees as a reflective shadow map of its own.

use rayon::prelude::*;
use vsgl_core::data::{GBuffer, Rsm};
use vsgl_core::phase::camera_map::{map, sample, side, texel};
use vsgl_core::phase::rsm::Texel;
use vsgl_core::plan::{ClusterPlan, RsmPlan, SurfacePlan};
use vsgl_core::render::View;

pub(crate) fn run(gbuffer: &GBuffer, view: &View, plan: &ClusterPlan) -> Rsm {
    let side = side(gbuffer.width, gbuffer.height);
    let map = map(view, side);
    let texel = |i: u32| {
        let x = sample(i % side, side, gbuffer.width);
        let y = sample(i / side, side, gbuffer.height);
        let at = y as usize * gbuffer.width as usize + x as usize;
        texel(gbuffer, at, &map)
    };
    let texels: Vec<Texel> = (0..side * side).into_par_iter().map(texel).collect();
    let columns = RsmPlan {
        lights: true,
        emitters: false,
        size: side,
        glossy: plan.glossy,
        surface: SurfacePlan {
            anisotropy: plan.anisotropic,
            ..SurfacePlan::default()
        },
    };
    Rsm::from_texels(side, vec![map], &texels, &columns)
}
