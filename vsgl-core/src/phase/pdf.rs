//! The density on the texels, and drawing from it.

use crate::data::Pdf;
use crate::math::sobol;

/// Shares `count` lights out between maps by their weight; they add up to `count` unless no map has weight.
///
/// Every map with weight gets one at least, and as many as its weight times a common factor, rounded: the greatest factor
/// that gives out no more than `count`. What that leaves, since several maps step up at the next factor, goes to the
/// first of those. With fewer lights than lit maps the heaviest get one each, the first among equals.
///
/// Source: the divisor method of Webster (1832), with a minimum of one. Neither sorts nor needs more than 32 bits: the
/// factor is found by bisecting its bits.
pub fn shares(totals: &[f32], count: u32) -> Vec<u32> {
    let (mut heaviest, mut lit) = (0.0f32, 0);
    for &total in totals {
        heaviest = heaviest.max(total);
        lit += u32::from(total > 0.0);
    }
    if lit == 0 {
        return vec![0; totals.len()];
    }
    let few = count < lit;
    // Grows with the step; step 0 gives out no more than `count`, the last no less.
    let lights = |total: f32, step: u32| {
        if few {
            one_or_none(total, heaviest, step)
        } else {
            share(total, heaviest, step, count)
        }
    };
    let (mut step, mut beyond) = (0, if few { heaviest } else { count as f32 }.to_bits() + 1);
    while beyond - step > 1 {
        let middle = step + (beyond - step) / 2;
        let mut given = 0;
        for &total in totals {
            given += lights(total, middle);
        }
        if given <= count {
            step = middle;
        } else {
            beyond = middle;
        }
    }
    let mut left = count;
    for &total in totals {
        left -= lights(total, step);
    }
    let mut share = Vec::with_capacity(totals.len());
    for &total in totals {
        let sure = lights(total, step);
        let more = (lights(total, step + 1) - sure).min(left);
        left -= more;
        share.push(sure + more);
    }
    share
}

/// One light for maps that are at most so many roundings lighter than the heaviest, the first step being none.
fn one_or_none(total: f32, heaviest: f32, step: u32) -> u32 {
    u32::from(total.to_bits() + step > heaviest.to_bits())
}

/// Lights of a map of weight `total` if those of the heaviest are the number with the bits `step`, at most `count`.
fn share(total: f32, heaviest: f32, step: u32, count: u32) -> u32 {
    let rounded = (total / heaviest * f32::from_bits(step) + 0.5).min(count as f32) as u32;
    if total > 0.0 { rounded.max(1) } else { 0 }
}

/// Index of the first entry of a level of a pyramid.
pub fn level_start(size: u32, maps: u32, level: u32) -> usize {
    (0..level).map(|l| level_count(size, maps, l)).sum()
}

/// Number of entries of a level of a pyramid.
pub fn level_count(size: u32, maps: u32, level: u32) -> usize {
    let side = (size >> level) as usize;
    maps as usize * side * side
}

/// Number of levels above level 0 of a pyramid whose side is a power of two.
pub fn top_level(size: u32) -> u32 {
    size.ilog2()
}

impl Pdf {
    /// Weight of a texel of a level \[W\].
    pub fn at(&self, map: u32, level: u32, x: u32, y: u32) -> f32 {
        let side = (self.size >> level) as usize;
        let index = (map as usize * side + y as usize) * side + x as usize;
        self.weight[level_start(self.size, self.maps, level) + index]
    }

    /// Weight of a whole map \[W\].
    pub fn total(&self, map: u32) -> f32 {
        self.at(map, top_level(self.size), 0, 0)
    }
}

/// A golden-ratio fraction of a turn of 2³².
pub const GOLDEN_TURN: u32 = 2_654_435_769;

/// Point `index` of `count` of a Fibonacci lattice on the unit square.
///
/// The second coordinate is a multiple of the golden ratio in 32-bit integers, exact on every backend. It begins half a step
/// in: a point at 0 would fall on the first texel with any weight, however little that is, for every density.
/// Source: Tokuyoshi 2016, "Modified Filtered Importance Sampling for Virtual Spherical Gaussian Lights", section 5.
pub fn fibonacci(index: u32, count: u32) -> (f32, f32) {
    let turn = index
        .wrapping_mul(GOLDEN_TURN)
        .wrapping_add(GOLDEN_TURN / 2);
    ((index as f32 + 0.5) / count as f32, unit(turn))
}

/// 0 ≤ x < 1 from the upper 24 bits.
pub fn unit(bits: u32) -> f32 {
    sobol::fraction(bits)
}

/// Largest f32 below one.
pub const BELOW_ONE: f32 = 1.0 - 1.0 / 16_777_216.0;

/// Warps a point of the unit square by the density of a map; the result is in texels of level 0.
///
/// Never enters a texel without weight. A map without weight is sampled evenly.
/// Source: Clarberg, Jarosz, Akenine-Möller and Jensen 2005, "Wavelet Importance Sampling", section 4.2.
pub fn warp(pdf: &Pdf, map: u32, u: f32, v: f32) -> (f32, f32) {
    let (mut u, mut v) = (u, v);
    let (mut x, mut y) = (0, 0);
    for level in (0..top_level(pdf.size)).rev() {
        (x, y) = (2 * x, 2 * y);
        let [a, b, c, d] =
            [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| pdf.at(map, level, x + i, y + j));
        let lower;
        (lower, v) = choose(a + b, c + d, v);
        let (left, right) = if lower { (c, d) } else { (a, b) };
        let to_right;
        (to_right, u) = choose(left, right, u);
        x += u32::from(to_right);
        y += u32::from(lower);
    }
    (x as f32 + u, y as f32 + v)
}

/// Chooses the second of two weights where `u` lies beyond the share of the first, and stretches `u` to 0..1 again.
fn choose(first: f32, second: f32, u: f32) -> (bool, f32) {
    let total = first + second;
    let share = if total > 0.0 { first / total } else { 0.5 };
    let take = second > 0.0 && (u >= share || first <= 0.0) || (total <= 0.0 && u >= share);
    let (from, width) = if take {
        (u - share, 1.0 - share)
    } else {
        (u, share)
    };
    // A share of 0 or 1 was not entered; what rounding leaves outside comes back inside.
    let rest = if width > 0.0 { from / width } else { 0.0 };
    (take, rest.clamp(0.0, BELOW_ONE))
}

/// A pyramid over given weights of level 0.
#[cfg(test)]
pub(crate) fn pyramid(size: u32, weight: Vec<f32>) -> Pdf {
    let mut pdf = Pdf {
        size,
        maps: 1,
        weight,
        share: vec![1],
    };
    for level in 0..top_level(size) {
        for y in 0..size >> (level + 1) {
            for x in 0..size >> (level + 1) {
                let w = |i, j| pdf.at(0, level, 2 * x + i, 2 * y + j);
                let sum = (w(0, 0) + w(1, 0)) + (w(0, 1) + w(1, 1));
                pdf.weight.push(sum);
            }
        }
    }
    pdf
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_as_near_to_the_weights_as_whole_numbers_can() {
        let totals: Vec<f32> = (0..50)
            .map(|i| 1.0 + (i * i * 7 % 31) as f32 * 0.13)
            .collect();
        let sum: f32 = totals.iter().sum();
        for count in [100, 1000, 65_536] {
            let share = shares(&totals, count);
            assert_eq!(share.iter().sum::<u32>(), count);
            for (&share, &total) in share.iter().zip(&totals) {
                let ideal = total / sum * count as f32;
                assert!((share as f32 - ideal).abs() < 1.0, "{share} for {ideal}");
            }
        }
    }

    #[test]
    fn shares_among_equals_and_extremes() {
        assert_eq!(shares(&[1.0; 5], 3), [1, 1, 1, 0, 0]);
        assert_eq!(shares(&[1.0; 5], 7), [2, 2, 1, 1, 1]);
        assert_eq!(shares(&[2.0, 3.0, 3.0, 3.0], 2), [0, 1, 1, 0]);
        assert_eq!(shares(&[f32::MAX, f32::MAX], 9), [5, 4]);
        assert_eq!(shares(&[1e-45, 0.0], 65_536), [65_536, 0]);
        assert_eq!(shares(&[1e-45, f32::MAX], 65_536), [1, 65_535]);
        assert!(shares(&[], 4).is_empty());
    }

    #[test]
    fn shares_add_up_and_leave_no_lit_map_out() {
        assert_eq!(shares(&[1.0, 1.0, 2.0], 8), [2, 2, 4]);
        assert_eq!(shares(&[1e-9, 1.0], 10), [1, 9]);
        assert_eq!(shares(&[1.0, 3.0, 2.0], 2), [0, 1, 1]);
        assert_eq!(shares(&[0.0, 0.0], 5), [0, 0]);
        for count in 1..40 {
            let share = shares(&[0.3, 5.0, 0.0, 1.7, 1.7], count);
            assert_eq!(share.iter().sum::<u32>(), count);
            assert_eq!(share[2], 0);
        }
    }

    #[test]
    fn warped_points_fall_by_weight_and_never_on_none() {
        let weight: Vec<f32> = (0..64)
            .map(|i| if i % 3 == 0 { 0.0 } else { (i % 7) as f32 })
            .collect();
        let total: f32 = weight.iter().sum();
        let pdf = pyramid(8, weight.clone());
        let mut hits = [0.0f32; 64];
        let count = 1 << 16;
        for i in 0..count {
            let (u, v) = fibonacci(i, count);
            let (x, y) = warp(&pdf, 0, u, v);
            hits[(y as usize) * 8 + x as usize] += 1.0;
        }
        for (hit, w) in hits.iter().zip(&weight) {
            let expected = w / total * count as f32;
            assert!(
                (hit - expected).abs() <= 0.02 * expected + 40.0,
                "{hit} {expected}"
            );
            assert!(*w > 0.0 || *hit == 0.0);
        }
    }

    #[test]
    fn a_map_without_weight_is_sampled_evenly() {
        let pdf = pyramid(4, vec![0.0; 16]);
        for (u, v) in [(0.0, 0.0), (0.3, 0.7), (0.99, 0.99)] {
            let (x, y) = warp(&pdf, 0, u, v);
            assert!(
                (x - 4.0 * u).abs() < 1e-4 && (y - 4.0 * v).abs() < 1e-4,
                "{u} {v} to {x} {y}"
            );
        }
    }
}
