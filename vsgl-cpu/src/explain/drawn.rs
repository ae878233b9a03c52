//! Reflective shadow maps finer than what is kept of them.

use crate::CpuBackend;
use rayon::prelude::*;
use vsgl_core::data::{Rsm, SceneData};
use vsgl_core::math::sobol;
use vsgl_core::phase::rsm::{Texel, planned, texel};
use vsgl_core::plan::RsmPlan;
use vsgl_core::scene::Light;

/// Of maps with `finer` times as many texels along a side, one texel in each square of `finer` by `finer`, drawn evenly, with the
/// flux of all of them in the mean: a sum over these is right in the mean for the finer maps, and takes no longer than one over the
/// coarse. Maps of the lights alone.
pub fn drawn_texels(
    backend: &CpuBackend,
    scene: &SceneData,
    lights: &[Light],
    plan: &RsmPlan,
    finer: u32,
    seed: u32,
) -> Rsm {
    let coarse = plan.size;
    let plan = RsmPlan {
        size: coarse * finer,
        emitters: false,
        ..plan.clone()
    };
    let maps = planned(lights, &plan, scene.bounds());
    let times = (finer * finer) as f32;
    let row = |row: u32| {
        let (map, y) = (&maps[(row / coarse) as usize], row % coarse);
        let (plan, scene) = (&plan, scene);
        (0..coarse).map(move |x| {
            let bits = sobol::combine(sobol::combine(seed, row), x);
            let (across, down) = (bits % finer, bits / finer % finer);
            let (x, y) = (x * finer + across, y * finer + down);
            let found = texel(scene, map, plan.size, x, y, plan);
            let light = |[r, g, b, rest]: [f32; 4]| [r * times, g * times, b * times, rest];
            Texel {
                diffuse: light(found.diffuse),
                specular: light(found.specular),
                grazing: found.grazing.map(|c| c * times),
                ..found
            }
        })
    };
    let rows = 0..maps.len() as u32 * coarse;
    let texels: Vec<Texel> = backend
        .pool
        .install(|| rows.into_par_iter().flat_map_iter(row).collect());
    Rsm::from_texels(coarse, maps, &texels, &plan)
}
