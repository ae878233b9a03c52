//! Rays.

use glam::Vec3;

/// A half line, or a segment where the caller bounds its parameter.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Start \[m\].
    pub origin: Vec3,
    /// Direction; parameters are in units of its length, which need not be one.
    pub direction: Vec3,
    /// One over each component of the direction, finite.
    pub inverse: Vec3,
}

impl Ray {
    /// A ray; components of the direction closer to zero than 1e-18 are taken as that, so that no box test meets
    /// zero times infinity.
    #[inline(always)]
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        let inverse = Vec3::new(
            inverse(direction.x),
            inverse(direction.y),
            inverse(direction.z),
        );
        Self {
            origin,
            direction,
            inverse,
        }
    }
}

#[inline(always)]
fn inverse(x: f32) -> f32 {
    let least = if x < 0.0 { -1e-18 } else { 1e-18 };
    1.0 / (if x.abs() < 1e-18 { least } else { x })
}
