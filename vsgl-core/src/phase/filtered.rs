//! Clusters by modified filtered importance sampling: kernels of equal share of the density, that overlap.
//!
//! Source: Tokuyoshi 2016, "Modified Filtered Importance Sampling for Virtual Spherical Gaussian Lights", section 4.

use super::cluster::Sum;
use super::pdf::top_level;
use crate::data::Pdf;

/// A cluster drawn from the density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel {
    /// The map that it lies in.
    pub map: u32,
    /// Column of the centre in texels of level 0.
    pub x: f32,
    /// Row of the centre in texels of level 0.
    pub y: f32,
    /// Mip level of its size, fractional.
    pub level: f32,
    /// What the fluxes of the texels under the kernel are multiplied by.
    pub scale: f32,
}

/// Four texels of one level around a point, with bilinear weights, clamped to the edge.
#[derive(Clone, Copy, Debug)]
struct Footprint {
    columns: [u32; 2],
    rows: [u32; 2],
    weights: [f32; 4],
}

fn footprint(size: u32, x: f32, y: f32, level: u32) -> Footprint {
    let side = size >> level;
    let scale = 1.0 / (1u32 << level) as f32;
    let (left, s) = split(x * scale - 0.5, side);
    let (top, t) = split(y * scale - 0.5, side);
    let next = |i: u32| (i + 1).min(side - 1);
    let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), (1.0 - s) * t, s * t];
    Footprint {
        columns: [left, next(left)],
        rows: [top, next(top)],
        weights,
    }
}

/// Lower neighbour and the fraction beyond it; outside the image the edge.
fn split(x: f32, side: u32) -> (u32, f32) {
    let low = x.floor();
    let fraction = if low < 0.0 { 0.0 } else { x - low };
    ((low.max(0.0) as u32).min(side - 1), fraction)
}

/// Texels, as (level, column, row) with their weights, of a trilinear fetch.
fn taps(size: u32, x: f32, y: f32, level: f32) -> [(u32, u32, u32, f32); 8] {
    let low = (level.max(0.0) as u32).min(top_level(size));
    let high = (low + 1).min(top_level(size));
    let fraction = (level - low as f32).clamp(0.0, 1.0);
    let at = |level: u32, share: f32, i: usize| {
        let f = footprint(size, x, y, level);
        (
            level,
            f.columns[i & 1],
            f.rows[i >> 1],
            f.weights[i] * share,
        )
    };
    std::array::from_fn(|i| {
        if i < 4 {
            at(low, 1.0 - fraction, i)
        } else {
            at(high, fraction, i - 4)
        }
    })
}

/// Mean weight of a texel of level 0 under a trilinear kernel.
fn mean_weight(pdf: &Pdf, map: u32, x: f32, y: f32, level: f32) -> f32 {
    let tap =
        taps(pdf.size, x, y, level).map(|(l, i, j, w)| w * pdf.at(map, l, i, j) / per_texel(l));
    ((tap[0] + tap[1]) + (tap[2] + tap[3])) + ((tap[4] + tap[5]) + (tap[6] + tap[7]))
}

/// Texels of level 0 under one texel of a level.
fn per_texel(level: u32) -> f32 {
    let side = (1u32 << level) as f32;
    side * side
}

/// The kernel around a point: its level is bisected until it holds `overlap / count` of the map's weight.
///
/// Source: algorithm 1 and equations 3 and 5 of the paper.
pub fn kernel(
    pdf: &Pdf,
    map: u32,
    x: f32,
    y: f32,
    count: u32,
    overlap: f32,
    bisections: u32,
) -> Kernel {
    let top = top_level(pdf.size) as f32;
    let total = pdf.total(map);
    let wanted = (overlap / count as f32).min(1.0) * total;
    let (mut low, mut high) = (0.0, top);
    for _ in 0..bisections {
        let middle = 0.5 * (low + high);
        let held = mean_weight(pdf, map, x, y, middle) * area(middle);
        if held < wanted {
            low = middle
        } else {
            high = middle
        }
    }
    let level = if wanted >= total {
        top
    } else {
        0.5 * (low + high)
    };
    let mean = mean_weight(pdf, map, x, y, level);
    let scale = if mean > 0.0 {
        total / (count as f32 * mean)
    } else {
        0.0
    };
    Kernel {
        map,
        x,
        y,
        level,
        scale,
    }
}

/// The kernel around a point as it was at first: its size follows from the density at the centre alone.
///
/// A kernel covers the texels that would hold `overlap / count` of the map's weight if all were like its centre, at least
/// one and at most the whole map. Its totals take the centre's weight for the mean under the kernel, so they are right in
/// the mean only: a kernel that reaches over an edge is too heavy or too light.
///
/// Source: Křivánek and Colbert 2008, "Real-time Shading with Filtered Importance Sampling"; Tokuyoshi 2016, equations 1
/// and 4, the latter for any overlap.
pub fn original(pdf: &Pdf, map: u32, x: f32, y: f32, count: u32, overlap: f32) -> Kernel {
    let top = top_level(pdf.size);
    let texels = per_texel(top);
    let inside = |c: f32| (c as u32).min(pdf.size - 1);
    let own = pdf.at(map, 0, inside(x), inside(y));
    // Texels like this one that together weigh as much as a light should.
    let alike = if own > 0.0 {
        (pdf.total(map) / (count as f32 * own)).min(texels)
    } else {
        0.0
    };
    let covered = (overlap * alike).clamp(1.0, texels);
    let level = if covered >= texels {
        top as f32
    } else {
        crate::math::elementary::log(covered) * LEVELS_PER_NEPER
    };
    Kernel {
        map,
        x,
        y,
        level: level.max(0.0),
        scale: alike,
    }
}

/// Mip levels for each factor e of the area.
const LEVELS_PER_NEPER: f32 = 0.5 / std::f32::consts::LN_2;

/// Texels of level 0 under a kernel of fractional level: `4^level`.
fn area(level: f32) -> f32 {
    let whole = level.floor();
    per_texel(whole as u32) * four_to_the(level - whole)
}

/// `4^x` for 0 ≤ x < 1.
fn four_to_the(x: f32) -> f32 {
    crate::math::elementary::exp(x * (2.0 * std::f32::consts::LN_2))
}

/// The sum under a kernel: texels of the pyramid `at(level, column, row)` merged by their trilinear weights.
pub fn sum(size: u32, kernel: &Kernel, at: impl Fn(u32, u32, u32) -> Sum) -> Sum {
    let tap = taps(size, kernel.x, kernel.y, kernel.level)
        .map(|(l, i, j, w)| at(l, i, j).scaled(w / per_texel(l) * kernel.scale));
    let low = tap[0].merge(tap[1]).merge(tap[2].merge(tap[3]));
    let high = tap[4].merge(tap[5]).merge(tap[6].merge(tap[7]));
    low.merge(high)
}

impl Kernel {
    /// The column of the resource: map, centre, side in texels of level 0.
    pub fn record(&self) -> [f32; 4] {
        [self.map as f32, self.x, self.y, area(self.level).sqrt()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phase::pdf::{level_count, pyramid, top_level};

    /// A pyramid over constant weights.
    fn even(size: u32) -> Pdf {
        let mut weight = Vec::new();
        for level in 0..=top_level(size) {
            weight.extend(std::iter::repeat_n(
                per_texel(level),
                level_count(size, 1, level),
            ));
        }
        Pdf {
            size,
            maps: 1,
            weight,
            share: vec![1],
        }
    }

    #[test]
    fn on_an_even_density_kernels_have_equal_area_and_unit_scale() {
        let pdf = even(64);
        for count in [1, 4, 16, 100, 4096] {
            let k = kernel(&pdf, 0, 20.3, 41.9, count, 1.0, 24);
            let side = (4096.0 / count as f32).sqrt();
            assert!((k.record()[3] / side - 1.0).abs() < 2e-3, "{count}: {k:?}");
            assert!(
                (k.scale - 4096.0 / count as f32).abs() < 1e-2 * k.scale,
                "{count}: {k:?}"
            );
        }
        let all = kernel(&pdf, 0, 1.0, 1.0, 1, 4.0, 12);
        assert_eq!(all.level, 6.0);
    }

    #[test]
    fn original_kernels_take_their_centre_for_all() {
        let pdf = even(64);
        for count in [1, 4, 16, 100, 4096, 10_000] {
            let k = original(&pdf, 0, 20.3, 41.9, count, 1.0);
            let share = 4096.0 / count as f32;
            let side = share.sqrt().max(1.0);
            assert!((k.record()[3] / side - 1.0).abs() < 1e-3, "{count}: {k:?}");
            assert!((k.scale / share - 1.0).abs() < 1e-6, "{count}: {k:?}");
        }
        // A dark texel beside bright ones: its kernel is the whole map, and no heavier than that.
        let mut weight = vec![1.0; 64];
        weight[9] = 1e-6;
        let pdf = pyramid(8, weight);
        let k = original(&pdf, 0, 1.5, 1.5, 16, 1.0);
        assert_eq!((k.level, k.scale), (3.0, 64.0));
        // Twice the overlap is wider, not heavier.
        let (one, two) = [1.0, 2.0]
            .map(|k| original(&pdf, 0, 5.5, 5.5, 16, k))
            .into();
        assert!(two.level > one.level + 0.49 && two.scale == one.scale);
    }

    #[test]
    fn taps_are_a_partition_of_one_and_stay_inside() {
        for (x, y, level) in [
            (0.0, 0.0, 0.0),
            (63.99, 0.2, 2.7),
            (31.0, 64.0, 6.0),
            (10.0, 10.0, 5.999),
        ] {
            let taps = taps(64, x, y, level);
            let total: f32 = taps.iter().map(|t| t.3).sum();
            assert!((total - 1.0).abs() < 1e-6);
            assert!(
                taps.iter()
                    .all(|&(l, i, j, _)| l <= 6 && i < 64 >> l && j < 64 >> l)
            );
        }
    }
}
