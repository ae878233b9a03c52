//! Surfaces as points of a shadow map: which points a map gets, and which texels a point covers.
//!
//! Points are drawn by the integers of [`SceneData::share`](crate::data::SceneData::share), so that both backends draw the same
//! ones.

use super::occlusion::{MapFrame, OPEN, direction, place};
use super::pdf::unit;
use crate::math::sobol::hash;
use glam::Vec3;

/// Texels that a point covers beyond its own in each direction, at most.
pub const REACH: f32 = 8.0;
/// Area of the disc of a point, in units of the area that the point stands for.
pub const OVERLAP: f32 = 2.0;
/// By how much discs larger than their triangle are set back, in radii: such a disc leaves the surface.
pub const BACK: f32 = 0.5;
/// Texels of a map for a radian, in units of its side: at the pole, along a diagonal of the diamond.
pub const TEXELS_A_RADIAN: f32 = 0.71;
/// Pieces of a triangle for each texel that it covers.
pub const PIECES: f32 = 2.0;
/// Most pieces that one slot makes: with all texels that each may cover, fewer rounds of a shader's loops than lavapipe runs.
pub const PIECES_MAX: u32 = 192;
/// Places of the middle of a piece.
pub const THIRD: f32 = 1.0 / 3.0;
/// Places of the middle of a piece.
pub const TWO_THIRDS: f32 = 2.0 / 3.0;

/// An integer as the nearest number, by exact steps: devices need not round what they convert.
#[inline(always)]
pub fn number(value: u32) -> f32 {
    (value >> 8) as f32 * 256.0 + (value & 255) as f32
}

/// Distance of draws along the shares.
#[inline(always)]
pub fn stride(count: u32) -> u32 {
    u32::MAX / count.max(1)
}

/// Where draw `index` of a map falls among the shares: draws are evenly spaced, each map's from another start.
#[inline(always)]
pub fn draw(map: u32, index: u32, stride: u32) -> u32 {
    index * stride + hash(2 * map) % stride
}

/// First share beyond a draw: its index is the triangle's; the number of shares if there is none.
pub fn find(share: &[u32], wanted: u32) -> u32 {
    let (mut low, mut high) = (0, share.len() as u32);
    while low < high {
        let middle = low + (high - low) / 2;
        if share[middle as usize] > wanted {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    low
}

/// A point of a triangle, and the part of its area that it stands for.
#[derive(Clone, Copy, Debug, Default)]
pub struct Point {
    /// Barycentric weight of the second corner.
    pub u: f32,
    /// Barycentric weight of the third corner.
    pub v: f32,
    /// Area that the point stands for, in units of the triangle's.
    pub area: f32,
    /// Its disc ends at the edges of the triangle.
    pub clip: bool,
}

/// The point of a triangle that a draw falls on; `low` and `high` are the shares before the triangle and with it.
///
/// Draws run along the shares and, by their reversed bits, across: on a large triangle they are evenly spread.
/// Source: Hammersley 1960, "Monte Carlo Methods for Solving Multivariable Problems".
#[inline(always)]
pub fn random_point(map: u32, index: u32, draw: u32, low: u32, high: u32, stride: u32) -> Point {
    let width = number(high - low);
    let along = (number(draw - low) / width).min(1.0);
    let across = unit(index.reverse_bits().wrapping_add(hash(2 * map + 1)));
    let root = along.sqrt();
    let area = number(stride) / width;
    Point {
        u: root - root * across,
        v: root * across,
        area,
        clip: area <= 1.0,
    }
}

/// The pieces of a triangle that a slot makes in its map.
#[derive(Clone, Copy, Debug, Default)]
pub struct Slot {
    /// The triangle is cut into the square of this many pieces.
    pub cuts: u32,
    /// First piece of this slot.
    pub first: u32,
    /// Number of slots of this triangle: pieces are dealt out to them.
    pub slots: u32,
    /// Area that a piece stands for, in units of the triangle's.
    pub area: f32,
    /// Every map has this triangle.
    pub everywhere: bool,
}

/// Number of draws of a map below a share.
#[inline(always)]
fn draws_below(share: u32, start: u32, stride: u32) -> u32 {
    let beyond = share.max(start + 1) - start - 1;
    if share > start {
        beyond / stride + 1
    } else {
        0
    }
}

/// The slot of a draw, for a triangle with these corners as the map sees them.
#[inline(always)]
pub fn slot(
    map: u32,
    index: u32,
    low: u32,
    high: u32,
    stride: u32,
    corners: &[Vec3; 3],
    side: u32,
) -> Slot {
    let start = hash(2 * map) % stride;
    let before = draws_below(low, start, stride);
    let slots = (draws_below(high, start, stride) - before).max(1);
    let texels = solid_angle(corners) * (side * side) as f32 * (0.5 * std::f32::consts::FRAC_1_PI);
    let wanted = (texels * PIECES).sqrt().ceil();
    let most = number(slots * PIECES_MAX).sqrt().floor();
    let cuts = wanted.min(most).max(1.0);
    let everywhere = high - low >= stride;
    let part = 1.0 / (cuts * cuts);
    let area = if everywhere {
        part
    } else {
        part * (number(stride) / number(high - low))
    };
    Slot {
        cuts: cuts as u32,
        first: index - before.min(index),
        slots,
        area,
        everywhere,
    }
}

/// Solid angle of a triangle from the origin \[sr\], too small where it is large: the area of the flat triangle of the
/// directions of its corners.
#[inline(always)]
fn solid_angle(corners: &[Vec3; 3]) -> f32 {
    let [a, b, c] = corners.map(crate::math::vec::normalize);
    let normal = (b - a).cross(c - a);
    0.5 * normal.dot(normal).sqrt()
}

/// The middle of a piece: row `r` of the cut triangle has `2r + 1` pieces.
#[inline(always)]
pub fn piece(slot: &Slot, index: u32) -> Point {
    let row = number(index).sqrt().floor();
    let rank = index - row as u32 * row as u32;
    let upright = rank & 1 == 0;
    let along = row + if upright { TWO_THIRDS } else { THIRD };
    let across = number(rank >> 1) + if upright { THIRD } else { TWO_THIRDS };
    let cuts = number(slot.cuts);
    Point {
        u: (along - across) / cuts,
        v: across / cuts,
        area: slot.area,
        clip: slot.everywhere,
    }
}

/// The middle of a triangle that stands for `count` of its size.
#[inline(always)]
pub fn middle(count: u32) -> Point {
    Point {
        u: THIRD,
        v: THIRD,
        area: number(count),
        clip: false,
    }
}

/// A point on its way into a map.
#[derive(Clone, Copy, Debug, Default)]
pub struct Splat {
    /// The point \[m\], as the map sees it; likewise all vectors.
    pub point: Vec3,
    /// Its distance from the map's centre \[m\].
    pub distance: f32,
    /// Normal of its triangle, twice its area long.
    pub normal: Vec3,
    /// Distance of its plane times the length of `normal`.
    pub height: f32,
    /// Normals of the planes through the map's centre and the edges of the triangle: all to the inside, or all to the outside.
    pub edges: [Vec3; 3],
    /// Its disc ends at the edges of the triangle.
    pub clip: bool,
    /// Radius of its disc \[m\].
    pub radius: f32,
    /// Its texel: column, row.
    pub texel: [u32; 2],
    /// Texels that its disc may cover beyond that one in each direction.
    pub reach: u32,
    /// It is above the map's horizon; otherwise it covers nothing.
    pub above: bool,
}

impl Splat {
    /// The splat of a point of a triangle with these corners as the map sees them.
    #[inline(always)]
    pub fn new(corners: &[Vec3; 3], from: &Point, side: u32) -> Self {
        let [a, b, c] = *corners;
        let point = (a + (b - a) * from.u) + (c - a) * from.v;
        let normal = (b - a).cross(c - a);
        let distance = point.dot(point).sqrt();
        let area = (normal.dot(normal).sqrt() * 0.5) * from.area;
        let radius = (area * (OVERLAP * std::f32::consts::FRAC_1_PI)).sqrt();
        let above = (point.z > 0.0) & (distance > 0.0);
        let (u, v) = place(if above { point } else { Vec3::Z }, side);
        let last = side as f32 - 1.0;
        let reach = (radius / distance.max(f32::MIN_POSITIVE)) * (TEXELS_A_RADIAN * side as f32);
        Self {
            point,
            distance,
            normal,
            height: a.dot(normal),
            edges: [b.cross(c), c.cross(a), a.cross(b)],
            clip: from.clip,
            radius,
            texel: [u, v].map(|at| at.floor().min(last).max(0.0) as u32),
            reach: reach.ceil().min(REACH) as u32,
            above,
        }
    }

    /// Columns that it may cover, or rows with `axis` 1: the first, and one beyond the last.
    #[inline(always)]
    pub fn range(&self, axis: usize, side: u32) -> [u32; 2] {
        let at = self.texel[axis];
        [at - at.min(self.reach), (at + self.reach + 1).min(side)]
    }

    /// Depth that it gives a texel \[m\]; [`OPEN`] if it does not cover its middle. Its own texel's middle it covers whatever
    /// its radius, unless the triangle ends before.
    #[inline(always)]
    pub fn depth(&self, column: u32, row: u32, step: f32) -> f32 {
        let d = direction(column, row, step);
        let slope = d.dot(self.normal);
        let faces = slope * self.height > 0.0;
        let t = self.height / (if faces { slope } else { 1.0 });
        let t = if faces { t } else { self.distance };
        let apart = d * t - self.point;
        let near = apart.dot(apart) <= self.radius * self.radius;
        let [e, f, g] = self.edges.map(|edge| d.dot(edge));
        let inside =
            ((e >= 0.0) & (f >= 0.0) & (g >= 0.0)) | ((e <= 0.0) & (f <= 0.0) & (g <= 0.0));
        let own = (column == self.texel[0]) & (row == self.texel[1]);
        // Of a disc that leaves its triangle, no texel is farther off than it is wide, and all are set back.
        let free = t
            .min(self.distance + self.radius)
            .max(self.distance - self.radius);
        let free = free + BACK * self.radius;
        let clipped = faces & inside & (near | own);
        let whole = (faces & near) | own;
        let covers = if self.clip { clipped } else { whole };
        let depth = if self.clip { t } else { free };
        if covers { depth } else { OPEN }
    }
}

/// Corners of a triangle as a map sees them.
#[inline(always)]
pub fn corners(frame: &MapFrame, corner: &[f32; 9]) -> [Vec3; 3] {
    let c = corner;
    [
        frame.local(Vec3::new(c[0], c[1], c[2])),
        frame.local(Vec3::new(c[3], c[4], c[5])),
        frame.local(Vec3::new(c[6], c[7], c[8])),
    ]
}
