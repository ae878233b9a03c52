//! Clusters by filtered importance sampling: trilinear kernels, of modified and of original size, and square ones.

use super::cluster::Cluster;
use super::pdf::quad;
use rayon::prelude::*;
use vsgl_core::data::{Pdf, Rsm};
use vsgl_core::phase::cluster::Sum;
use vsgl_core::phase::filtered::{self, kernel, original};
use vsgl_core::phase::filtered_box::{self, square};
use vsgl_core::phase::pdf::{fibonacci, level_start, top_level, warp};
use vsgl_core::plan::ClusterPlan;
use vsgl_core::settings::Clustering;

pub(crate) fn run(rsm: &Rsm, pdf: &Pdf, plan: &ClusterPlan) -> (Vec<Cluster>, Vec<[f32; 4]>) {
    let pyramid = Pyramid::new(rsm, pdf, plan);
    let draws: Vec<(u32, u32, u32)> = (0..pdf.maps)
        .flat_map(|map| {
            (0..pdf.share[map as usize]).map(move |i| (map, i, pdf.share[map as usize]))
        })
        .collect();
    let made: Vec<(Cluster, [f32; 4])> = draws
        .into_par_iter()
        .map(|(map, index, count)| {
            let (u, v) = fibonacci(index, count);
            let (x, y) = warp(pdf, map, u, v);
            let (sum, kernel) = match plan.method {
                Clustering::FilteredBox => {
                    let square = square(pdf, map, x, y, count, plan.kernel, plan.bisections);
                    let at = |level, x, y| pyramid.at(map, level, x, y);
                    (filtered_box::sum(pdf.size, &square, at), square.record())
                }
                method => {
                    let kernel = if method == Clustering::FilteredOriginal {
                        original(pdf, map, x, y, count, plan.kernel)
                    } else {
                        kernel(pdf, map, x, y, count, plan.kernel, plan.bisections)
                    };
                    let at = |level, x, y| pyramid.at(map, level, x, y);
                    (filtered::sum(pdf.size, &kernel, at), kernel.record())
                }
            };
            // The centre itself was drawn by weight.
            let inside = |c: f32| (c as u32).min(rsm.size - 1);
            let texel = (map * rsm.size + inside(y)) * rsm.size + inside(x);
            (Cluster { sum, texel }, kernel)
        })
        .collect();
    made.into_iter().unzip()
}

/// Sums over the texels of all levels, laid out like the density's.
struct Pyramid {
    size: u32,
    maps: u32,
    sums: Vec<Sum>,
}

impl Pyramid {
    fn new(rsm: &Rsm, pdf: &Pdf, plan: &ClusterPlan) -> Self {
        let (from, to) = (rsm.size as usize, pdf.size as usize);
        let texel = |i: usize| {
            let (map, y, x) = (i / (to * to), i / to % to, i % to);
            if x < from && y < from {
                Sum::texel(rsm, (map * from + y) * from + x, plan)
            } else {
                Sum::default()
            }
        };
        let mut sums: Vec<Sum> = (0..rsm.maps as usize * to * to)
            .into_par_iter()
            .map(texel)
            .collect();
        for level in 1..=top_level(pdf.size) {
            let side = (pdf.size >> level) as usize;
            let below = &sums[level_start(pdf.size, pdf.maps, level - 1)..];
            let merge = |i: usize| {
                let [a, b, c, d] = quad(i, side).map(|j| below[j]);
                a.merge(b).merge(c.merge(d))
            };
            let above: Vec<Sum> = (0..rsm.maps as usize * side * side)
                .into_par_iter()
                .map(merge)
                .collect();
            sums.extend(above);
        }
        Self {
            size: pdf.size,
            maps: pdf.maps,
            sums,
        }
    }

    fn at(&self, map: u32, level: u32, x: u32, y: u32) -> Sum {
        let side = (self.size >> level) as usize;
        let index = (map as usize * side + y as usize) * side + x as usize;
        self.sums[level_start(self.size, self.maps, level) + index]
    }
}
