//! Clusters of the texels that are nearest to centres drawn from the density, in space.
//!
//! Every texel with weight goes to the nearest centre of its own map, the first among equals; a cluster is the texels of a
//! centre, in ascending order, and centres without texels make no light. So energy is kept exactly, as by the partition.
//!
//! Source: the comparison by one step of k-means in Tokuyoshi 2016, "Modified Filtered Importance Sampling for Virtual
//! Spherical Gaussian Lights", section 5.
//!
//! Which centre is nearest does not depend on how it is found. Centres are put in the order of [`key`], in which neighbours
//! of the map are neighbours of the list. [`WIDTH`] centres in a row share a box, as many boxes a wider one; what lies
//! beyond the nearest centre so far is passed over. A box is never farther than a centre inside it, in every rounding:
//! differences, squares and sums all keep order.

use super::pdf::{fibonacci, warp};
use crate::data::Pdf;
use glam::Vec3;
use std::ops::Range;

/// Centres in a box, and boxes in a wider one.
pub const WIDTH: usize = 16;

/// Coordinates of a centre that is no texel with weight: farther than any other, but not infinitely.
pub const FAR: f32 = 1e18;

/// Centres that a map gets: its share of the lights, and one at least where it has weight. With more lit maps than lights
/// there are as many clusters as lit maps.
pub fn centres(pdf: &Pdf, map: u32) -> u32 {
    let share = pdf.share[map as usize];
    if pdf.total(map) > 0.0 {
        share.max(1)
    } else {
        share
    }
}

/// Column and row of the texel that centre `index` of the `count` of a map is drawn from; `size` texels along a side.
pub fn drawn(pdf: &Pdf, map: u32, size: u32, index: u32, count: u32) -> (u32, u32) {
    let (u, v) = fibonacci(index, count);
    let (x, y) = warp(pdf, map, u, v);
    ((x as u32).min(size - 1), (y as u32).min(size - 1))
}

/// Place of a texel in the order of centres: by map, then along a curve that visits a quarter of the map after the other, and
/// each in the same way. `size` is a power of two.
///
/// Source: Morton 1966, "A Computer Oriented Geodetic Data Base".
pub fn key(map: u32, size: u32, x: u32, y: u32) -> u32 {
    map * (size * size) + (spread(x) | (spread(y) << 1))
}

/// The lower 16 bits with a zero between any two.
fn spread(x: u32) -> u32 {
    let x = (x | (x << 8)) & 0x00ff_00ff;
    let x = (x | (x << 4)) & 0x0f0f_0f0f;
    let x = (x | (x << 2)) & 0x3333_3333;
    (x | (x << 1)) & 0x5555_5555
}

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least coordinates \[m\].
    pub low: Vec3,
    /// Greatest coordinates \[m\].
    pub high: Vec3,
}

impl Bounds {
    /// The box of a point.
    pub fn point(x: Vec3) -> Self {
        Self { low: x, high: x }
    }

    /// The box of two.
    pub fn join(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Squared distance of a point \[m²\]; 0 inside.
    pub fn distance2(&self, x: Vec3) -> f32 {
        let outside = (self.low - x).max(x - self.high).max(Vec3::ZERO);
        outside.dot(outside)
    }
}

/// A centre in the list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Centre {
    /// Position of its texel \[m\].
    pub position: Vec3,
    /// Its number in the order in which centres were drawn, over all maps.
    pub number: u32,
}

/// The nearest centre so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Its number.
    pub number: u32,
    /// Its squared distance \[m²\].
    pub distance2: f32,
}

impl Nearest {
    /// This one or another centre, whichever is nearer to a point; the one of lower number among equals.
    pub fn or(self, centre: &Centre, x: Vec3) -> Self {
        let apart = centre.position - x;
        let distance2 = apart.dot(apart);
        let is_nearer = distance2 < self.distance2
            || (distance2 == self.distance2 && centre.number < self.number);
        if is_nearer {
            Self {
                number: centre.number,
                distance2,
            }
        } else {
            self
        }
    }
}

/// Centres of all maps in the order of [`key`], with their boxes.
#[derive(Clone, Debug)]
pub struct Centres {
    list: Vec<Centre>,
    boxes: Vec<Bounds>,
    wider: Vec<Bounds>,
}

impl Centres {
    /// From the list.
    pub fn new(list: Vec<Centre>) -> Self {
        let points: Vec<_> = list.iter().map(|c| Bounds::point(c.position)).collect();
        let boxes = joined(&points);
        let wider = joined(&boxes);
        Self { list, boxes, wider }
    }

    /// The number of the centre nearest to a point, among those in a range of the list, which are numbered from the start
    /// of the range on. Begins at place `near` of the list.
    pub fn nearest(&self, range: Range<usize>, near: usize, x: Vec3) -> u32 {
        let mut best = Nearest {
            number: range.start as u32,
            distance2: f32::MAX,
        };
        let first = near / WIDTH;
        best = self.scan(best, first, &range, x);
        for w in range.start / (WIDTH * WIDTH)..range.end.div_ceil(WIDTH * WIDTH) {
            if self.wider[w].distance2(x) <= best.distance2 {
                let low = (w * WIDTH).max(range.start / WIDTH);
                let high = ((w + 1) * WIDTH).min(range.end.div_ceil(WIDTH));
                for b in low..high {
                    if b != first && self.boxes[b].distance2(x) <= best.distance2 {
                        best = self.scan(best, b, &range, x);
                    }
                }
            }
        }
        best.number
    }

    /// Looks at all centres of a box that are in the range.
    fn scan(&self, mut best: Nearest, b: usize, range: &Range<usize>, x: Vec3) -> Nearest {
        let (low, high) = (
            (b * WIDTH).max(range.start),
            ((b + 1) * WIDTH).min(range.end),
        );
        for centre in &self.list[low..high] {
            best = best.or(centre, x);
        }
        best
    }
}

/// Boxes of [`WIDTH`] at a time.
fn joined(bounds: &[Bounds]) -> Vec<Bounds> {
    let join = |some: &[Bounds]| some[1..].iter().fold(some[0], |all, b| all.join(*b));
    bounds.chunks(WIDTH).map(join).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_visit_every_texel_once() {
        let mut keys: Vec<u32> = (0..2 * 16 * 16)
            .map(|i| key(i / 256, 16, i % 16, i / 16 % 16))
            .collect();
        assert_eq!(key(0, 16, 1, 0), 1);
        assert_eq!(key(1, 4096, 4095, 4095), (1 << 25) - 1);
        keys.sort_unstable();
        assert!(keys.iter().enumerate().all(|(i, k)| i as u32 == *k));
    }

    /// Points of a coarse grid, so that many lie equally far or in one place.
    fn point(i: u32, seed: u32) -> Vec3 {
        let bits = i
            .wrapping_add(seed)
            .wrapping_mul(2_654_435_769)
            .rotate_left(11)
            .wrapping_mul(0x85eb_ca6b);
        Vec3::new(
            (bits >> 3 & 7) as f32,
            (bits >> 9 & 7) as f32,
            (bits >> 17 & 3) as f32,
        )
    }

    #[test]
    fn the_search_finds_what_looking_at_all_finds() {
        for count in [1u32, 15, 16, 17, 300, 1000] {
            let mut list: Vec<Centre> = (0..count)
                .map(|i| Centre {
                    position: if i % 5 == 2 {
                        Vec3::splat(FAR)
                    } else {
                        point(i, 7)
                    },
                    number: i,
                })
                .collect();
            // Two maps, each by place, as keys would do it.
            let middle = (count / 3) as usize;
            for part in [0..middle, middle..count as usize] {
                list[part].sort_by(|a, b| {
                    a.position
                        .to_array()
                        .partial_cmp(&b.position.to_array())
                        .expect("numbers")
                });
            }
            let centres = Centres::new(list.clone());
            for range in [0..middle, middle..count as usize] {
                if range.is_empty() {
                    continue;
                }
                for i in 0..200 {
                    let x = point(i, 900) * 1.3 - Vec3::splat(0.5);
                    let expected = list[range.clone()]
                        .iter()
                        .map(|c| ((c.position - x).length_squared(), c.number))
                        .min_by(|a, b| a.partial_cmp(b).expect("numbers"))
                        .expect("some");
                    let near = range.start + i as usize % range.len();
                    assert_eq!(centres.nearest(range.clone(), near, x), expected.1);
                }
            }
        }
    }

    #[test]
    fn maps_have_a_centre_if_they_have_weight() {
        let pdf = Pdf {
            size: 1,
            maps: 3,
            weight: vec![2.0, 0.0, 1.0],
            share: vec![2, 0, 0],
        };
        assert_eq!([0, 1, 2].map(|map| centres(&pdf, map)), [2, 0, 1]);
    }
}
