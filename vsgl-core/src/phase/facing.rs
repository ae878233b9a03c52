//! The side of a triangle, and where rays that leave it start.

use crate::data::SceneData;
use crate::math::vec::normalize;
use glam::Vec3;

/// By how much ray origins are lifted off surfaces, in units of the largest coordinate.
pub const LIFT: f32 = 8e-6;

/// Geometric unit normal of a triangle on the side that `towards` points to.
pub fn geometric_normal(scene: &SceneData, triangle: u32, towards: Vec3) -> Vec3 {
    let c = &scene.corner[triangle as usize];
    let a = Vec3::new(c[0], c[1], c[2]);
    let edge = Vec3::new(c[3], c[4], c[5]) - a;
    let other = Vec3::new(c[6], c[7], c[8]) - a;
    let normal = normalize(edge.cross(other));
    if normal.dot(towards) < 0.0 {
        -normal
    } else {
        normal
    }
}

/// Distance by which a ray's origin is lifted off a surface at `position` \[m\]: some hundred roundings of a coordinate.
#[inline(always)]
pub fn lift(least: f32, position: Vec3) -> f32 {
    let p = position.abs();
    least + LIFT * p.x.max(p.y).max(p.z)
}
