//! One cluster for each map: the loops of `vsgl_core::phase::whole`.

use super::cluster::Cluster;
use multiversion::multiversion;
use rayon::prelude::*;
use std::ops::Range;
use vsgl_core::data::Rsm;
use vsgl_core::phase::cluster::Sum;
use vsgl_core::phase::whole::{CHUNK, draw};
use vsgl_core::plan::ClusterPlan;

/// A cluster for each map with light, in their order.
pub(crate) fn run(rsm: &Rsm, plan: &ClusterPlan) -> Vec<Cluster> {
    let texels = (rsm.size * rsm.size) as usize;
    let chunks = texels.div_ceil(CHUNK).max(1);
    let sums: Vec<Sum> = (0..rsm.maps as usize * chunks)
        .into_par_iter()
        .map(|i| {
            let first = i / chunks * texels;
            let start = i % chunks * CHUNK;
            let end = (start + CHUNK).min(texels);
            chunk(rsm, first + start..first + end, plan)
        })
        .collect();
    let maps = sums.par_chunks(chunks).enumerate();
    maps.filter_map(|(map, chunks)| {
        let sum = Sum::of_chunks(chunks);
        (sum.weight() > 0.0).then(|| Cluster {
            sum,
            texel: draw(rsm, map as u32, map * texels, texels, chunks),
        })
    })
    .collect()
}

#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn chunk(rsm: &Rsm, texels: Range<usize>, plan: &ClusterPlan) -> Sum {
    Sum::of_chunk(rsm, texels, plan)
}
