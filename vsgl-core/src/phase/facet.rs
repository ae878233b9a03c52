//! A triangle over the texels of a shadow map whose middles it covers.

use super::occlusion::{OPEN, place};
use glam::Vec3;

/// Texels along a side of the square that one triangle is drawn in, at most: all of them fewer rounds of a shader's loops than
/// lavapipe runs.
pub const WIDEST: f32 = 64.0;
/// Texels of a map for a radian, at most, in units of its side: half the root of five, at the corners of the square.
pub const STEEPEST: f32 = 1.12;

/// Columns and rows: the first, and one beyond the last.
#[derive(Clone, Copy, Debug, Default)]
pub struct Patch {
    /// First column.
    pub left: u32,
    /// First row.
    pub top: u32,
    /// One beyond the last column; not less than `left`.
    pub right: u32,
    /// One beyond the last row; not less than `top`.
    pub bottom: u32,
}

/// Where the middles of texels may be covered by a triangle with these corners as the map sees them.
///
/// Within a quarter of the map lines are lines, and the corners bound it. Elsewhere the sphere about its box does.
#[inline(always)]
pub fn bounds(corners: &[Vec3; 3], side: u32) -> Patch {
    let [a, b, c] = *corners;
    let (least, most) = (a.min(b).min(c), a.max(b).max(c));
    let quarter = ((least.x >= 0.0) | (most.x <= 0.0)) & ((least.y >= 0.0) | (most.y <= 0.0));
    let all = side as f32;
    let (low, high) = if quarter & (least.z > 0.0) {
        let (p, q, r) = (place(a, side), place(b, side), place(c, side));
        (
            [p.0.min(q.0).min(r.0), p.1.min(q.1).min(r.1)],
            [p.0.max(q.0).max(r.0), p.1.max(q.1).max(r.1)],
        )
    } else {
        let (middle, half) = ((least + most) * 0.5, (most - least) * 0.5);
        let (square, reach) = (middle.dot(middle), half.dot(half));
        // The tangent of the sphere's angle, which is more than the angle.
        let away = square - reach;
        let wide = if away > 0.1 * square {
            (reach / away).sqrt() * (STEEPEST * all)
        } else {
            all
        };
        let at = Vec3::new(middle.x, middle.y, middle.z.max(0.0));
        let (u, v) = place(if at.dot(at) > 0.0 { at } else { Vec3::Z }, side);
        ([u - wide, v - wide], [u + wide, v + wide])
    };
    let begin = low.map(|low| (low - 0.5).ceil().max(0.0).min(all));
    let end = |axis: usize| {
        let end = ((high[axis] - 0.5).floor() + 1.0).max(begin[axis]).min(all);
        end.min(begin[axis] + WIDEST)
    };
    let right = if most.z > 0.0 { end(0) } else { begin[0] };
    Patch {
        left: begin[0] as u32,
        top: begin[1] as u32,
        right: right as u32,
        bottom: end(1) as u32,
    }
}

/// A triangle on its way into a map; vectors as the map sees them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Facet {
    /// Normal, twice the area long.
    pub normal: Vec3,
    /// Distance of the plane times the length of `normal`.
    pub height: f32,
    /// Normals of the planes through the map's centre and the edges: all to the inside, or all to the outside.
    pub edges: [Vec3; 3],
}

/// Where a direction meets a triangle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Meeting {
    /// Depth \[m\]; [`OPEN`] if it does not.
    pub depth: f32,
    /// Barycentric weight of the second corner.
    pub u: f32,
    /// Barycentric weight of the third corner.
    pub v: f32,
}

impl Facet {
    /// The triangle with these corners as the map sees them.
    #[inline(always)]
    pub fn new(corners: &[Vec3; 3]) -> Self {
        let [a, b, c] = *corners;
        let normal = (b - a).cross(c - a);
        Self {
            normal,
            height: a.dot(normal),
            edges: [b.cross(c), c.cross(a), a.cross(b)],
        }
    }

    /// What the middle of a texel sees of it, by its unit direction.
    #[inline(always)]
    pub fn meet(&self, direction: Vec3) -> Meeting {
        let d = direction;
        let slope = d.dot(self.normal);
        let faces = slope * self.height > 0.0;
        let t = self.height / (if faces { slope } else { 1.0 });
        let [e, f, g] = self.edges.map(|edge| d.dot(edge));
        let inside =
            ((e >= 0.0) & (f >= 0.0) & (g >= 0.0)) | ((e <= 0.0) & (f <= 0.0) & (g <= 0.0));
        let sum = (e + f) + g;
        let sum = if sum == 0.0 { 1.0 } else { sum };
        Meeting {
            depth: if faces & inside { t } else { OPEN },
            u: f / sum,
            v: g / sum,
        }
    }
}
