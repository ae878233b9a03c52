//! The density and its pyramid.

use rayon::prelude::*;
use vsgl_core::data::{Pdf, Rsm};
use vsgl_core::phase::pdf::{level_start, shares, top_level, weight};
use vsgl_core::plan::PdfPlan;

pub(crate) fn run(rsm: &Rsm, plan: &PdfPlan) -> Pdf {
    // Padding to a power of two has no weight and so changes nothing.
    let size = rsm.size.next_power_of_two();
    let (from, to) = (rsm.size as usize, size as usize);
    let texel = |i: usize| {
        let (map, y, x) = (i / (to * to), i / to % to, i % to);
        if x < from && y < from {
            weight(plan.method, rsm, (map * from + y) * from + x)
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
    let totals: Vec<f32> = (0..rsm.maps).map(|map| pdf.total(map)).collect();
    pdf.share = shares(&totals, plan.count);
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
