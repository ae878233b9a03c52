//! How far apart neighbouring rays meet a surface, which says how much of a texture one of them stands for.

use crate::data::SceneData;
use crate::geom::Hit;
use crate::math::vec::normalize;
use crate::plan::SurfacePlan;
use glam::Vec3;

/// Smallest cosine between ray and triangle that a footprint is stretched by.
pub const GRAZING_MIN: f32 = 1e-6;

/// Change of the barycentric weights of the second and third corner from one ray to the next, along the two axes of a
/// picture or map. Zero: a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Footprint {
    /// From column to column.
    pub x: [f32; 2],
    /// From row to row.
    pub y: [f32; 2],
}

/// A point of a triangle, and how far its neighbours are.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Id of the triangle.
    pub triangle: u32,
    /// Barycentric weight of the second corner.
    pub u: f32,
    /// Barycentric weight of the third corner.
    pub v: f32,
    /// How much of the surface it stands for.
    pub footprint: Footprint,
}

impl Place {
    /// Where a ray has hit, and nothing around it.
    pub fn point(hit: &Hit) -> Self {
        Self {
            triangle: hit.triangle,
            u: hit.u.clamp(0.0, 1.0),
            v: hit.v.clamp(0.0, 1.0),
            footprint: Footprint::default(),
        }
    }

    /// Where a ray along `direction` has hit, if `reads` has textures with what is around it: from it to the next column and
    /// row, rays move by `across` and `down` at this distance \[m\].
    pub fn at_hit(
        scene: &SceneData,
        hit: &Hit,
        direction: Vec3,
        [across, down]: [Vec3; 2],
        reads: &SurfacePlan,
    ) -> Self {
        let point = Self::point(hit);
        if !(reads.textures || reads.normal_maps || reads.anisotropy) {
            return point;
        }
        let corner = &scene.corner[hit.triangle as usize];
        Self {
            footprint: Footprint {
                x: step(corner, direction, across),
                y: step(corner, direction, down),
            },
            ..point
        }
    }
}

/// Change of the weights where a ray along `direction` is moved by `by`, in the plane of the triangle.
///
/// Source: Igehy 1999, "Tracing Ray Differentials", section 3.2 (transfer), for a plane.
pub fn step(corner: &[f32; 9], direction: Vec3, by: Vec3) -> [f32; 2] {
    let a = Vec3::new(corner[0], corner[1], corner[2]);
    let ab = Vec3::new(corner[3], corner[4], corner[5]) - a;
    let ac = Vec3::new(corner[6], corner[7], corner[8]) - a;
    let area = ab.cross(ac);
    let normal = normalize(area);
    let along = normalize(direction);
    let cosine = normal.dot(along);
    let least = if cosine < 0.0 {
        -GRAZING_MIN
    } else {
        GRAZING_MIN
    };
    let cosine = if cosine.abs() < GRAZING_MIN {
        least
    } else {
        cosine
    };
    let moved = by - along * (normal.dot(by) / cosine);
    let twice_area = area.dot(normal);
    let inverse = if twice_area > 0.0 {
        1.0 / twice_area
    } else {
        0.0
    };
    [
        moved.dot(ac.cross(normal)) * inverse,
        moved.dot(normal.cross(ab)) * inverse,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::cross;

    #[test]
    fn steps_are_what_neighbouring_rays_find() {
        let corner = [0.1, -0.3, 0.2, 2.0, 0.1, -0.4, -0.2, 1.5, 0.7];
        let (origin, direction) = (Vec3::new(0.4, 0.2, 5.0), Vec3::new(0.1, 0.05, -1.0));
        for aside in [Vec3::X, Vec3::Y, Vec3::new(0.3, -0.8, 0.5)] {
            let (here, e) = (cross(origin, direction, &corner), 1e-2);
            let turned = cross(origin, direction + aside * e, &corner);
            let moved = cross(origin + aside * e, direction, &corner);
            let by_turn = step(&corner, direction, aside * (e * here.t));
            let by_move = step(&corner, direction, aside * e);
            for (next, [du, dv]) in [(turned, by_turn), (moved, by_move)] {
                assert!((next.u - here.u - du).abs() < 2e-2 * (du.abs() + dv.abs()));
                assert!((next.v - here.v - dv).abs() < 2e-2 * (du.abs() + dv.abs()));
            }
        }
    }

    #[test]
    fn grazing_and_empty_triangles_give_numbers() {
        let flat = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        for corner in [flat, [0.0; 9]] {
            for direction in [Vec3::X, Vec3::new(1.0, 0.0, -1e-9), Vec3::NEG_Z] {
                let [du, dv] = step(&corner, direction, Vec3::new(1e-3, 2e-3, 3e-3));
                assert!(du.is_finite() && dv.is_finite());
            }
        }
    }
}
