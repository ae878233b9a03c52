//! Filling the holes of a shadow map: texels that no point fell on take the depth of those about them.
//!
//! Source: Marroquim, Kraus and Cavalcanti 2007, "Efficient Point-Based Rendering Using Image Reconstruction" (pull and push);
//! for shadow maps Ritschel et al. 2008, "Imperfect Shadow Maps for Efficient Computation of Indirect Illumination".

use super::occlusion::OPEN;

/// Smaller images: each texel of the last is eight of the map wide.
pub const LEVELS: u32 = 3;
/// Depths within this factor of the nearest are one surface.
pub const CONSISTENT: f32 = 1.25;

/// Texels along a side of a level; level 0 is the map.
#[inline(always)]
pub fn side(side: u32, level: u32) -> u32 {
    (side + ((1 << level) - 1)) >> level
}

/// Texels of the levels 1 .. `level` of one map.
#[inline(always)]
pub fn before(size: u32, level: u32) -> u32 {
    let area = |l: u32| {
        if l < level {
            side(size, l) * side(size, l)
        } else {
            0
        }
    };
    (area(1) + area(2)) + area(3)
}

/// A texel from the four below it: the greatest depth of the nearest surface among them, if it fills at least two. Texels beyond
/// the edge are [`OPEN`]. Not the mean: what is filled nearer than the surface is, shadows it.
#[inline(always)]
pub fn pull(depth: [f32; 4]) -> f32 {
    let [a, b, c, d] = depth;
    let nearest = a.min(b).min(c.min(d));
    let limit = nearest.min(1e37) * CONSISTENT;
    let is = |depth: f32| if depth <= limit { 1.0 } else { 0.0 };
    let value = |depth: f32| if depth <= limit { depth } else { 0.0 };
    let count = ((is(a) + is(b)) + is(c)) + is(d);
    let greatest = value(a).max(value(b)).max(value(c).max(value(d)));
    if count >= 2.0 { greatest } else { OPEN }
}

/// A texel, filled from the one above it.
#[inline(always)]
pub fn push(depth: f32, above: f32) -> f32 {
    if depth < OPEN { depth } else { above }
}
