//! The density and its pyramid.

use super::importance;
use crate::CpuBackend;
use rayon::prelude::*;
use vsgl_core::backend::PdfInputs;
use vsgl_core::data::{Pdf, Rsm};
use vsgl_core::phase::importance::density;
use vsgl_core::phase::pdf::{level_start, shares, top_level};
use vsgl_core::plan::PdfPlan;
use vsgl_core::settings::PdfMethod;

pub(crate) fn run(inputs: &PdfInputs<'_, CpuBackend>, plan: &PdfPlan) -> Pdf {
    let rsm = inputs.rsm;
    let lit = |texel: usize| f32::from(rsm.weight(texel) > 0.0);
    let flux = pyramid(rsm, |texel| rsm.weight(texel));
    // By flux whatever the density: it says where lights of a map go, not how many.
    let share = shares(&totals(&flux), plan.count);
    let pdf = match (plan.method, &plan.importance) {
        (PdfMethod::Flux, _) => flux,
        (PdfMethod::Uniform, _) | (PdfMethod::Brsm, None) => pyramid(rsm, lit),
        (PdfMethod::Brsm, Some(plan)) => {
            let matters = importance::run(inputs, plan);
            let count = totals(&pyramid(rsm, lit));
            let total = totals(&pyramid(rsm, |texel| matters[texel]));
            let texels = (rsm.size * rsm.size) as usize;
            pyramid(rsm, |texel| {
                let map = texel / texels;
                if rsm.weight(texel) > 0.0 {
                    density(matters[texel], total[map], count[map])
                } else {
                    0.0
                }
            })
        }
    };
    Pdf { share, ..pdf }
}

fn totals(pdf: &Pdf) -> Vec<f32> {
    (0..pdf.maps).map(|map| pdf.total(map)).collect()
}

/// All levels over a weight a texel. Padding to a power of two has no weight and so changes nothing.
fn pyramid(rsm: &Rsm, weight: impl Fn(usize) -> f32 + Sync) -> Pdf {
    let size = rsm.size.next_power_of_two();
    let (from, to) = (rsm.size as usize, size as usize);
    let texel = |i: usize| {
        let (map, y, x) = (i / (to * to), i / to % to, i % to);
        if x < from && y < from {
            weight((map * from + y) * from + x)
        } else {
            0.0
        }
    };
    let count = rsm.maps as usize * to * to;
    let weight: Vec<f32> = (0..count).into_par_iter().map(texel).collect();
    let mut pdf = Pdf {
        size,
        maps: rsm.maps,
        weight,
        share: Vec::new(),
    };
    for level in 1..=top_level(size) {
        let sums = level_above(&pdf, level);
        pdf.weight.extend(sums);
    }
    pdf
}

fn level_above(pdf: &Pdf, level: u32) -> Vec<f32> {
    let below = &pdf.weight[level_start(pdf.size, pdf.maps, level - 1)..];
    let side = (pdf.size >> level) as usize;
    let sum = |i: usize| {
        let [a, b, c, d] = quad(i, side).map(|j| below[j]);
        (a + b) + (c + d)
    };
    (0..pdf.maps as usize * side * side)
        .into_par_iter()
        .map(sum)
        .collect()
}

/// The four entries below entry `i` of a level whose maps have `side` texels along a side.
pub(crate) fn quad(i: usize, side: usize) -> [usize; 4] {
    let (map, y, x) = (i / (side * side), i / side % side, i % side);
    let first = (map * 2 * side + 2 * y) * 2 * side + 2 * x;
    [first, first + 1, first + 2 * side, first + 2 * side + 1]
}
