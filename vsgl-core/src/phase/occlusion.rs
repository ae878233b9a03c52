//! A shadow map above a cluster's target: which texel holds which direction, and whether a receiver is in shadow.
//!
//! The map is a hemisphere unfolded to a square: its octahedral image, a diamond, turned by an eighth of a turn so that every
//! texel is used. A paraboloid would leave out the corners of its square, more than a fifth of the texels.
//!
//! Sources: Ritschel et al. 2008, "Imperfect Shadow Maps for Efficient Computation of Indirect Illumination"; the octahedral
//! image of a hemisphere: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors".

use super::facing::lift;
use crate::data::Target;
use crate::math::vec::{normalize, orthonormal_basis};
use glam::Vec3;

/// Depth of a direction without a surface.
pub const OPEN: f32 = f32::MAX;
/// Share of its distance by which a receiver is taken to be nearer.
pub const BIAS: f32 = 0.05;

/// Where a map stands.
#[derive(Clone, Copy, Debug, Default)]
pub struct MapFrame {
    /// The point that distances are measured from, just above the target \[m\].
    pub centre: Vec3,
    /// Unit direction of the map's first axis.
    pub x: Vec3,
    /// Unit direction of its second axis.
    pub y: Vec3,
    /// Unit direction of its pole: the target's normal.
    pub z: Vec3,
}

impl MapFrame {
    /// The frame above a target; `least` is [`SceneData::lift`](crate::data::SceneData::lift) \[m\].
    #[inline(always)]
    pub fn new(target: &Target, least: f32) -> Self {
        let position = Vec3::from_array(target.position);
        let z = Vec3::from_array(target.normal);
        let (x, y) = orthonormal_basis(z);
        Self {
            centre: position + z * lift(least, position),
            x,
            y,
            z,
        }
    }

    /// Components of a direction along the axes.
    #[inline(always)]
    pub fn turn(&self, direction: Vec3) -> Vec3 {
        Vec3::new(
            self.x.dot(direction),
            self.y.dot(direction),
            self.z.dot(direction),
        )
    }

    /// A point as the map sees it: from its centre, along its axes \[m\].
    #[inline(always)]
    pub fn local(&self, point: Vec3) -> Vec3 {
        self.turn(point - self.centre)
    }
}

/// Where a direction with `z ≥ 0` lies on a map, in texels from its corner: 0 ..= `side`. Need not be a unit vector, must not be
/// zero.
#[inline(always)]
pub fn place(direction: Vec3, side: u32) -> (f32, f32) {
    let d = direction;
    let sum = (d.x.abs() + d.y.abs()) + d.z;
    let u = (d.x + d.y) / sum;
    let v = (d.x - d.y) / sum;
    let half = 0.5 * side as f32;
    (u * half + half, v * half + half)
}

/// Unit direction of the middle of a texel; `step` is two over the side of the map.
#[inline(always)]
pub fn direction(column: u32, row: u32, step: f32) -> Vec3 {
    let u = (column as f32 + 0.5) * step - 1.0;
    let v = (row as f32 + 0.5) * step - 1.0;
    let x = 0.5 * (u + v);
    let y = 0.5 * (u - v);
    let z = (1.0 - x.abs()) - y.abs();
    normalize(Vec3::new(x, y, z.max(0.0)))
}

/// The four texels about a receiver, and what they must hold to let light through.
#[derive(Clone, Copy, Debug, Default)]
pub struct Probe {
    /// Least column and row of the four.
    pub first: [u32; 2],
    /// What is added to get the others: 1, or 0 in a map of one texel.
    pub next: u32,
    /// Share of the second column, and of the second row.
    pub share: [f32; 2],
    /// Least depth that is open, of the four: columns run first \[m\].
    pub limit: [f32; 4],
    /// The receiver is below the target's surface, or the target below the receiver's: blocked whatever the map holds.
    pub hidden: bool,
}

/// Looks up a receiver, given by its position \[m\] and its unit geometric normal on the side of the eye.
///
/// Depths are compared with the receiver's plane in the directions of the texels where that is nearer than the receiver: a plane
/// does not shadow itself at any slope. Where it is farther, another surface may lie before it, as in a corner, and the receiver's
/// own distance counts.
#[inline(always)]
pub fn probe(frame: &MapFrame, position: Vec3, normal: Vec3, side: u32) -> Probe {
    let seen = frame.local(position);
    let facing = frame.turn(normal);
    let distance = seen.dot(seen).sqrt();
    let plane = seen.dot(facing);
    let hidden = (seen.z <= 0.0) | (plane >= 0.0);
    let above = if hidden { Vec3::Z } else { seen };
    let (u, v) = place(above, side);
    let last = side as f32 - 1.0;
    let (u, v) = ((u - 0.5).min(last).max(0.0), (v - 0.5).min(last).max(0.0));
    let most = (last - 1.0).max(0.0);
    let (column, row) = (u.floor().min(most), v.floor().min(most));
    let (first, next) = ([column as u32, row as u32], last.min(1.0) as u32);
    let step = 2.0 / side as f32;
    let limit = |i: u32, j: u32| {
        let d = direction(first[0] + i * next, first[1] + j * next, step);
        let slope = d.dot(facing);
        let t = plane / (if slope < 0.0 { slope } else { -1.0 });
        let t = if slope < 0.0 { t } else { distance };
        t.min(distance).max(0.5 * distance) * (1.0 - BIAS)
    };
    Probe {
        first,
        next,
        share: [u - column, v - row],
        limit: [limit(0, 0), limit(1, 0), limit(0, 1), limit(1, 1)],
        hidden,
    }
}

/// Share of the light that passes, 0..=1, from the depths of the four texels.
///
/// Source: Reeves, Salesin and Cook 1987, "Rendering Antialiased Shadows with Depth Maps" (comparing before filtering).
#[inline(always)]
pub fn open(probe: &Probe, depth: [f32; 4]) -> f32 {
    let passes = |i: usize| if depth[i] >= probe.limit[i] { 1.0 } else { 0.0 };
    let [across, down] = probe.share;
    let above = passes(0) + (passes(1) - passes(0)) * across;
    let below = passes(2) + (passes(3) - passes(2)) * across;
    let share = above + (below - above) * down;
    if probe.hidden { 0.0 } else { share }
}
