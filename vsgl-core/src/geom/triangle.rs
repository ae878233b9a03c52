//! Where a ray crosses a triangle.

use super::order::{greater, lesser};
use glam::Vec3;

/// A crossing of a ray and a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Whether there is one; the other fields mean nothing without.
    pub hit: bool,
    /// Parameter along the ray.
    pub t: f32,
    /// Barycentric weight of the second corner.
    pub u: f32,
    /// Barycentric weight of the third corner.
    pub v: f32,
}

/// Crossing of the line `origin + t direction` with the triangle, both sides alike.
///
/// Watertight: two triangles that share an edge compute exact negatives of each other for it, and an edge function
/// of exactly zero counts as inside, so no ray passes between them.
///
/// Edge functions are signed volumes of direction and edge, relative to the origin. Idea: Davidovič, Engelhardt,
/// Georgiev, Slusallek and Dachsbacher 2012, "3D Rasterization: A Bridge between Rasterization and Ray Casting".
#[inline(always)]
pub fn cross(origin: Vec3, direction: Vec3, corner: &[f32; 9]) -> Crossing {
    let a = Vec3::new(corner[0], corner[1], corner[2]) - origin;
    let b = Vec3::new(corner[3], corner[4], corner[5]) - origin;
    let c = Vec3::new(corner[6], corner[7], corner[8]) - origin;
    // The edge's vector changes sign with its direction, the sum of its ends does not.
    let at_a = (c - b).cross(c + b).dot(direction);
    let at_b = (a - c).cross(a + c).dot(direction);
    let at_c = (b - a).cross(b + a).dot(direction);
    let least = lesser(lesser(at_a, at_b), at_c);
    let most = greater(greater(at_a, at_b), at_c);
    let normal = (b - a).cross(c - a);
    let across = normal.dot(direction);
    let volume = at_a + at_b + at_c;
    let hit = (least >= 0.0) | (most <= 0.0);
    let hit = hit & (across != 0.0) & (volume != 0.0);
    let t = normal.dot(a) / (if across == 0.0 { 1.0 } else { across });
    let scale = 1.0 / (if volume == 0.0 { 1.0 } else { volume });
    Crossing {
        hit,
        t,
        u: at_b * scale,
        v: at_c * scale,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

    #[test]
    fn barycentrics_and_distance() {
        let crossing = cross(Vec3::new(0.25, 0.5, 2.0), Vec3::NEG_Z, &CORNERS);
        assert!(crossing.hit);
        assert!((crossing.t - 2.0).abs() < 1e-6);
        assert!((crossing.u - 0.25).abs() < 1e-6 && (crossing.v - 0.5).abs() < 1e-6);
    }

    #[test]
    fn misses_and_degenerate_triangles() {
        assert!(!cross(Vec3::new(0.75, 0.75, 2.0), Vec3::NEG_Z, &CORNERS).hit);
        assert!(!cross(Vec3::new(0.25, 0.25, 2.0), Vec3::X, &CORNERS).hit);
        assert!(!cross(Vec3::new(0.0, 0.0, 2.0), Vec3::NEG_Z, &[0.0; 9]).hit);
        let line = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0];
        assert!(!cross(Vec3::new(0.5, 0.0, 2.0), Vec3::NEG_Z, &line).hit);
    }

    #[test]
    fn a_shared_edge_is_never_missed() {
        let other = [1.0, 0.0, 0.0, 1.0, 1.0, 0.3, 0.0, 1.0, 0.0];
        for i in 0..10_000 {
            let s = (i as f32 + 0.37) / 10_000.0;
            let point = Vec3::new(1.0 - s, s, 0.0);
            let eye = Vec3::new(0.31 + s, 0.17 - s, 3.0 + 5.0 * s);
            let (first, second) = (
                cross(eye, point - eye, &CORNERS),
                cross(eye, point - eye, &other),
            );
            assert!(first.hit || second.hit, "edge missed at {s}");
        }
    }
}
