//! How much each texel matters to what the camera sees.

use super::block::{self, LANES, Receivers, Sums};
use super::{camera_map, cluster};
use crate::CpuBackend;
use glam::Vec3;
use multiversion::multiversion;
use rayon::prelude::*;
use vsgl_core::backend::PdfInputs;
use vsgl_core::data::{Rsm, Vsgls};
use vsgl_core::phase::importance::{INTERLEAVE, first_light, receiver, reflected, smoothed};
use vsgl_core::plan::{ImportancePlan, ShadePlan};

/// A number a texel of all maps.
pub(crate) fn run(inputs: &PdfInputs<'_, CpuBackend>, plan: &ImportancePlan) -> Vec<f32> {
    let camera = camera_map::run(inputs.gbuffer, inputs.view, &plan.cluster);
    let lights = cluster::run(inputs.scene, &camera, None, &plan.cluster);
    let reflected = reflected_by_all(inputs.rsm, &lights, &plan.shade);
    (0..reflected.len())
        .into_par_iter()
        .map(|texel| smoothed(inputs.rsm, &reflected, texel))
        .collect()
}

/// What each texel reflects of its share of the lights.
fn reflected_by_all(rsm: &Rsm, lights: &Vsgls, plan: &ShadePlan) -> Vec<f32> {
    // Texels that take the same lights fill blocks.
    let mut alike = vec![Vec::new(); (INTERLEAVE * INTERLEAVE) as usize];
    for texel in 0..rsm.position.len() {
        if rsm.weight(texel) > 0.0 {
            let (x, y) = (texel as u32 % rsm.size, texel as u32 / rsm.size % rsm.size);
            alike[first_light(x, y) as usize].push(texel);
        }
    }
    let blocks: Vec<(usize, &[usize])> = alike
        .iter()
        .enumerate()
        .flat_map(|(first, texels)| texels.chunks(LANES).map(move |block| (first, block)))
        .collect();
    let block = |(first, texels): (usize, &[usize])| -> [f32; LANES] {
        // Lanes beyond the last texel repeat the first: the same work, thrown away.
        let texel = |lane: usize| texels.get(lane).copied().unwrap_or(texels[0]);
        let single = std::array::from_fn(|lane| receiver(rsm, texel(lane)));
        let sums = received(lights, first, &Receivers::new(&single), plan);
        std::array::from_fn(|lane| {
            let [diffuse, near, grazing] = [&sums.diffuse, &sums.near, &sums.grazing]
                .map(|sum| Vec3::from_array(sum.map(|c| c[lane])));
            reflected(rsm, texel(lane), diffuse, near, grazing)
        })
    };
    let made: Vec<[f32; LANES]> = blocks.par_iter().map(|&b| block(b)).collect();
    let mut all = vec![0.0; rsm.position.len()];
    for ((_, texels), values) in blocks.iter().zip(&made) {
        for (&texel, &value) in texels.iter().zip(values) {
            all[texel] = value;
        }
    }
    all
}

/// Sums over one share of the lights at sixteen texels.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn received(lights: &Vsgls, first: usize, receivers: &Receivers, plan: &ShadePlan) -> Sums {
    let mut total = Sums::default();
    let receivers = *receivers;
    let all = [1.0; LANES];
    for j in (first..lights.diffuse.len()).step_by((INTERLEAVE * INTERLEAVE) as usize) {
        let specular = if plan.glossy_senders {
            lights.specular.get(j)
        } else {
            None
        };
        let sums = block::vsgl(&lights.diffuse[j], specular, &receivers, plan);
        total.add_open(&sums, &all);
    }
    total
}
