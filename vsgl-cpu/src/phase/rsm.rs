//! What the lights see, all texels of all maps.

use rayon::prelude::*;
use vsgl_core::data::{Rsm, SceneData};
use vsgl_core::phase::rsm::{Texel, planned, texel};
use vsgl_core::plan::RsmPlan;
use vsgl_core::scene::Light;

pub(crate) fn run(scene: &SceneData, lights: &[Light], plan: &RsmPlan) -> Rsm {
    let size = plan.size;
    let maps = planned(lights, plan, scene.bounds());
    let rows = maps.len() * size as usize;
    let row = |row: usize| {
        let (map, y) = (&maps[row / size as usize], (row % size as usize) as u32);
        (0..size).map(move |x| texel(scene, map, size, x, y, plan))
    };
    let texels: Vec<Texel> = (0..rows).into_par_iter().flat_map_iter(row).collect();
    Rsm::from_texels(size, maps, &texels, plan)
}
