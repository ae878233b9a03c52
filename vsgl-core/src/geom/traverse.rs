//! Walking the hierarchy.

use super::order::{greater, lesser};
use super::ray::Ray;
use super::triangle::{Crossing, cross};
use crate::data::{Element, NO_TRIANGLE, Scalar};
use glam::{Vec3, Vec3A};

/// By how much exits from boxes are moved outwards: more than the rounding of the slab test.
pub const SLAB_EXIT: f32 = 1.000_000_4;
/// Depth that a walk can hold.
pub const STACK: usize = 64;
/// Rays that walk together in [`any_hit_block`].
pub const LANES: usize = 16;

/// Node of the binary hierarchy, 32 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct BvhNode {
    /// Least corner of the box \[m\].
    pub min: [f32; 3],
    /// Leaf: first triangle. Inner node: index of the left child; the right one follows it.
    pub first: u32,
    /// Greatest corner of the box \[m\].
    pub max: [f32; 3],
    /// Leaf: number of triangles. Inner node: 0.
    pub count: u32,
}

impl Element for BvhNode {
    const SCALAR: Scalar = Scalar::U32;
}

/// The nearest crossing of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Id of the triangle, or [`NO_TRIANGLE`].
    pub triangle: u32,
    /// Parameter along the ray.
    pub t: f32,
    /// Barycentric weight of the second corner.
    pub u: f32,
    /// Barycentric weight of the third corner.
    pub v: f32,
}

/// Where triangles are there: a crossing counts only where its triangle covers it.
pub trait Covers {
    /// Everywhere: nothing else is asked.
    const ALWAYS: bool;

    /// Whether a triangle has no holes: [`Covers::covers`] is true all over it.
    fn is_whole(&self, triangle: u32) -> bool;
    /// Whether a triangle is there at a point, given by the weights of its second and third corner.
    fn covers(&self, triangle: u32, u: f32, v: f32) -> bool;
}

/// Triangles without holes.
#[derive(Clone, Copy, Debug)]
pub struct Opaque;

impl Covers for Opaque {
    const ALWAYS: bool = true;

    #[inline(always)]
    fn is_whole(&self, _: u32) -> bool {
        true
    }

    #[inline(always)]
    fn covers(&self, _: u32, _: f32, _: f32) -> bool {
        true
    }
}

/// Entry and exit parameter of a line through a box; it misses where entry is greater than exit.
///
/// The exit is moved outwards by [`SLAB_EXIT`], so that no hit inside is lost
/// (Ize 2013, "Robust BVH Ray Traversal").
#[inline(always)]
fn slab(node: &BvhNode, ray: &Ray) -> (f32, f32) {
    let low = (Vec3::from_array(node.min) - ray.origin) * ray.inverse;
    let high = (Vec3::from_array(node.max) - ray.origin) * ray.inverse;
    let entry = greater(
        greater(lesser(low.x, high.x), lesser(low.y, high.y)),
        lesser(low.z, high.z),
    );
    let exit = lesser(
        lesser(greater(low.x, high.x), greater(low.y, high.y)),
        greater(low.z, high.z),
    );
    (entry, exit * SLAB_EXIT)
}

/// A ray as its box tests take it: three numbers in one register.
struct Wide {
    origin: Vec3A,
    inverse: Vec3A,
}

impl Wide {
    fn new(ray: &Ray) -> Self {
        Self {
            origin: ray.origin.into(),
            inverse: ray.inverse.into(),
        }
    }

    /// [`slab`], with the same bits.
    #[inline(always)]
    fn slab(&self, node: &BvhNode) -> (f32, f32) {
        let low = (Vec3A::from_array(node.min) - self.origin) * self.inverse;
        let high = (Vec3A::from_array(node.max) - self.origin) * self.inverse;
        let (near, far) = (low.min(high), low.max(high));
        (near.max_element(), far.min_element() * SLAB_EXIT)
    }
}

/// Whether a ray that ends at `t_max` meets a box that it enters and leaves there.
#[inline(always)]
fn meets((entry, exit): (f32, f32), t_max: f32) -> bool {
    !((entry > exit) | (exit < 0.0) | (entry > t_max))
}

/// Nearest crossing with `0 < t < t_max`; of equal ones that with the lower triangle id.
///
/// Boxes are entered in the order in which the shader enters them, by the same tests; each is tested once here, and a box with a
/// nearer crossing in front of it is left out by the entry that was kept.
pub fn closest_hit<C: Covers>(
    nodes: &[BvhNode],
    corners: &[[f32; 9]],
    ray: &Ray,
    t_max: f32,
    covers: &C,
) -> Hit {
    let mut hit = Hit {
        triangle: NO_TRIANGLE,
        t: t_max,
        u: 0.0,
        v: 0.0,
    };
    let wide = Wide::new(ray);
    let mut stack = [(0u32, 0.0f32); STACK];
    let mut held = 0;
    if let Some(root) = nodes.first() {
        let slab = wide.slab(root);
        if meets(slab, t_max) {
            stack[0] = (0, slab.0);
            held = 1;
        }
    }
    while held > 0 {
        held -= 1;
        let (at, entry) = stack[held];
        if entry > hit.t {
            continue;
        }
        let mut node = &nodes[at as usize];
        while node.count == 0 {
            let (left, right) = (node.first, node.first + 1);
            let (left_node, right_node) = (&nodes[left as usize], &nodes[right as usize]);
            let (left_slab, right_slab) = (wide.slab(left_node), wide.slab(right_node));
            node = match (meets(left_slab, hit.t), meets(right_slab, hit.t)) {
                // The nearer child is walked first, the left one if neither is.
                (true, true) if right_slab.0 < left_slab.0 => {
                    stack[held] = (left, left_slab.0);
                    held += 1;
                    right_node
                }
                (true, true) => {
                    stack[held] = (right, right_slab.0);
                    held += 1;
                    left_node
                }
                (true, false) => left_node,
                (false, true) => right_node,
                (false, false) => break,
            };
        }
        // Of an inner node without a child on the way nothing is left.
        for triangle in node.first..node.first + node.count {
            let found = cross(ray.origin, ray.direction, &corners[triangle as usize]);
            let Crossing { t, u, v, .. } = found;
            let nearer =
                t < hit.t || (t == hit.t && triangle < hit.triangle && hit.triangle != NO_TRIANGLE);
            if found.hit && t > 0.0 && nearer && (C::ALWAYS || covers.covers(triangle, u, v)) {
                hit = Hit { triangle, t, u, v };
            }
        }
    }
    hit
}

/// Whether anything is crossed with `0 < t < t_max`.
pub fn any_hit<C: Covers>(
    nodes: &[BvhNode],
    corners: &[[f32; 9]],
    ray: &Ray,
    t_max: f32,
    covers: &C,
) -> bool {
    let wide = Wide::new(ray);
    let mut stack = [0u32; STACK];
    let mut held = usize::from(
        nodes
            .first()
            .is_some_and(|root| meets(wide.slab(root), t_max)),
    );
    while held > 0 {
        held -= 1;
        let mut node = &nodes[stack[held] as usize];
        while node.count == 0 {
            let (left, right) = (node.first, node.first + 1);
            let (left_node, right_node) = (&nodes[left as usize], &nodes[right as usize]);
            let left_met = meets(wide.slab(left_node), t_max);
            let right_met = meets(wide.slab(right_node), t_max);
            node = match (left_met, right_met) {
                (true, true) => {
                    stack[held] = right;
                    held += 1;
                    left_node
                }
                (true, false) => left_node,
                (false, true) => right_node,
                (false, false) => break,
            };
        }
        for triangle in node.first..node.first + node.count {
            let found = cross(ray.origin, ray.direction, &corners[triangle as usize]);
            let Crossing { hit, t, u, v } = found;
            if hit && t > 0.0 && t < t_max && (C::ALWAYS || covers.covers(triangle, u, v)) {
                return true;
            }
        }
    }
    false
}

/// [`any_hit`] with `t_max` 1 for a block of rays that walk together; only where `open` is true is the answer asked.
///
/// Gives each ray the answer that [`any_hit`] gives it. Returns 1 where something is crossed or nothing was asked,
/// else 0.
#[inline(always)]
pub fn any_hit_block<C: Covers>(
    nodes: &[BvhNode],
    corners: &[[f32; 9]],
    origin: &[[f32; LANES]; 3],
    direction: &[[f32; LANES]; 3],
    open: &[bool; LANES],
    covers: &C,
) -> [u32; LANES] {
    let mut inverse = [[0.0f32; LANES]; 3];
    let mut blocked = [0u32; LANES];
    for lane in 0..LANES {
        let ray = Ray::new(
            Vec3::ZERO,
            Vec3::new(direction[0][lane], direction[1][lane], direction[2][lane]),
        );
        inverse[0][lane] = ray.inverse.x;
        inverse[1][lane] = ray.inverse.y;
        inverse[2][lane] = ray.inverse.z;
        blocked[lane] = u32::from(!open[lane]);
    }
    let mut stack = [0u32; STACK];
    let mut held = usize::from(!nodes.is_empty());
    while held > 0 {
        held -= 1;
        let node = &nodes[stack[held] as usize];
        let mut met = [0u32; LANES];
        for lane in 0..LANES {
            let ray = Ray {
                origin: Vec3::new(origin[0][lane], origin[1][lane], origin[2][lane]),
                direction: Vec3::ZERO,
                inverse: Vec3::new(inverse[0][lane], inverse[1][lane], inverse[2][lane]),
            };
            let (entry, exit) = slab(node, &ray);
            met[lane] =
                u32::from((entry <= exit) & (exit >= 0.0) & (entry <= 1.0)) & (1 - blocked[lane]);
        }
        if met.iter().all(|&m| m == 0) {
            continue;
        }
        if node.count == 0 {
            stack[held] = node.first + 1;
            stack[held + 1] = node.first;
            held += 2;
            continue;
        }
        for triangle in node.first..node.first + node.count {
            let corner = corners[triangle as usize];
            let at = |lane: usize| {
                let from = Vec3::new(origin[0][lane], origin[1][lane], origin[2][lane]);
                let along = Vec3::new(direction[0][lane], direction[1][lane], direction[2][lane]);
                cross(from, along, &corner)
            };
            let mut crossed = [0u32; LANES];
            for lane in 0..LANES {
                let found = at(lane);
                // Rays whose box test failed cannot cross: the box test is conservative.
                crossed[lane] =
                    u32::from(found.hit & (found.t > 0.0) & (found.t < 1.0)) & met[lane];
            }
            // Holes are looked at ray by ray, and only where there is a crossing: lanes stay side by side above.
            if C::ALWAYS || crossed.iter().all(|&c| c == 0) || covers.is_whole(triangle) {
                for lane in 0..LANES {
                    blocked[lane] |= crossed[lane];
                }
            } else {
                for lane in 0..LANES {
                    if crossed[lane] > blocked[lane] {
                        let found = at(lane);
                        blocked[lane] = u32::from(covers.covers(triangle, found.u, found.v));
                    }
                }
            }
        }
        if blocked.iter().all(|&b| b == 1) {
            break;
        }
    }
    blocked
}

#[cfg(test)]
mod tests {
    use super::super::build;
    use super::*;

    /// A closed octahedron-like star of triangles, subdivided by index arithmetic.
    fn soup() -> Vec<[f32; 9]> {
        let hash = |n: u32| {
            let n = n.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            let n = ((n >> ((n >> 28) + 4)) ^ n).wrapping_mul(277_803_737);
            ((n >> 22) ^ n) as f32 / u32::MAX as f32
        };
        (0..500u32)
            .map(|i| {
                let mut corner = [0.0; 9];
                for k in 0..9 {
                    corner[k as usize] = hash(i * 3 + k % 3) * 4.0 + hash(i * 9 + k) * 0.6;
                }
                corner
            })
            .collect()
    }

    fn rays() -> impl Iterator<Item = Ray> {
        (0..2000u32).map(|i| {
            let a = i as f32 * 0.618_034;
            let origin = Vec3::new(a.fract() * 5.0, (a * 7.0).fract() * 5.0, -1.0);
            let direction = match i % 4 {
                0 => Vec3::Z,
                1 => Vec3::new(0.3, -0.2, 1.0) * 6.0,
                2 => Vec3::new((a * 3.0).fract() - 0.5, (a * 5.0).fract() - 0.5, 1.0) * 5.0,
                _ => Vec3::new(0.0, 0.1, 2.0),
            };
            Ray::new(origin, direction)
        })
    }

    #[test]
    fn walks_agree_with_trying_every_triangle() {
        let bvh = build(&soup());
        let corners: Vec<[f32; 9]> = bvh.order.iter().map(|&i| soup()[i as usize]).collect();
        let mut hits = 0;
        for ray in rays() {
            let mut expected = Hit {
                triangle: NO_TRIANGLE,
                t: 1.0,
                u: 0.0,
                v: 0.0,
            };
            for (id, corner) in corners.iter().enumerate() {
                let found = cross(ray.origin, ray.direction, corner);
                if found.hit && found.t > 0.0 && found.t < expected.t {
                    expected = Hit {
                        triangle: id as u32,
                        t: found.t,
                        u: found.u,
                        v: found.v,
                    };
                }
            }
            assert_eq!(
                closest_hit(&bvh.nodes, &corners, &ray, 1.0, &Opaque),
                expected
            );
            assert_eq!(
                any_hit(&bvh.nodes, &corners, &ray, 1.0, &Opaque),
                expected.triangle != NO_TRIANGLE
            );
            hits += usize::from(expected.triangle != NO_TRIANGLE);
        }
        assert!(hits > 200 && hits < 1900, "{hits} of 2000 rays hit");
    }

    /// Holes in every other triangle, and in half of each.
    struct Sieve;

    impl Covers for Sieve {
        const ALWAYS: bool = false;

        fn is_whole(&self, _: u32) -> bool {
            false
        }

        fn covers(&self, triangle: u32, u: f32, _: f32) -> bool {
            triangle.is_multiple_of(2) && u < 0.5
        }
    }

    /// Origins and directions of a block of rays, component by component.
    fn lanes(block: &[Ray]) -> ([[f32; LANES]; 3], [[f32; LANES]; 3]) {
        let lane = |f: fn(&Ray) -> f32| std::array::from_fn(|i| f(&block[i]));
        (
            [
                lane(|r| r.origin.x),
                lane(|r| r.origin.y),
                lane(|r| r.origin.z),
            ],
            [
                lane(|r| r.direction.x),
                lane(|r| r.direction.y),
                lane(|r| r.direction.z),
            ],
        )
    }

    #[test]
    fn rays_pass_where_triangles_are_not() {
        let bvh = build(&soup());
        let corners: Vec<[f32; 9]> = bvh.order.iter().map(|&i| soup()[i as usize]).collect();
        let rays: Vec<Ray> = rays().collect();
        let mut passed = 0;
        for block in rays.chunks_exact(LANES) {
            let (origin, direction) = lanes(block);
            let open = &[true; LANES];
            let together = any_hit_block(&bvh.nodes, &corners, &origin, &direction, open, &Sieve);
            for (ray, together) in block.iter().zip(together) {
                let crossings = corners.iter().enumerate().filter_map(|(id, corner)| {
                    let found = cross(ray.origin, ray.direction, corner);
                    let inside = found.hit && found.t > 0.0 && found.t < 1.0;
                    (inside && Sieve.covers(id as u32, found.u, 0.0)).then_some(found.t)
                });
                let nearest = crossings.fold(1.0, f32::min);
                let hit = closest_hit(&bvh.nodes, &corners, ray, 1.0, &Sieve);
                assert_eq!(hit.t, nearest);
                assert_eq!(
                    any_hit(&bvh.nodes, &corners, ray, 1.0, &Sieve),
                    nearest < 1.0
                );
                assert_eq!(together == 1, nearest < 1.0);
                let whole = any_hit(&bvh.nodes, &corners, ray, 1.0, &Opaque);
                passed += usize::from(whole && nearest == 1.0);
            }
        }
        assert!(passed > 50, "only {passed} rays pass through a hole");
    }

    #[test]
    fn a_block_of_rays_gets_the_answers_of_single_rays() {
        let bvh = build(&soup());
        let corners: Vec<[f32; 9]> = bvh.order.iter().map(|&i| soup()[i as usize]).collect();
        let rays: Vec<Ray> = rays().collect();
        for block in rays.chunks_exact(LANES) {
            let (origin, direction) = lanes(block);
            let got = any_hit_block(
                &bvh.nodes,
                &corners,
                &origin,
                &direction,
                &[true; LANES],
                &Opaque,
            );
            for (ray, got) in block.iter().zip(got) {
                assert_eq!(got == 1, any_hit(&bvh.nodes, &corners, ray, 1.0, &Opaque));
            }
        }
    }

    #[test]
    fn no_ray_leaves_a_closed_box_even_along_its_planes() {
        let mut corners = Vec::new();
        for axis in 0..3usize {
            for side in [-1.0f32, 1.0] {
                let point = |s: f32, t: f32| {
                    let mut p = [0.0; 3];
                    p[axis] = side;
                    p[(axis + 1) % 3] = s;
                    p[(axis + 2) % 3] = t;
                    p
                };
                for [p, q, r] in [
                    [point(-1.0, -1.0), point(1.0, -1.0), point(1.0, 1.0)],
                    [point(-1.0, -1.0), point(1.0, 1.0), point(-1.0, 1.0)],
                ] {
                    corners.push([p[0], p[1], p[2], q[0], q[1], q[2], r[0], r[1], r[2]]);
                }
            }
        }
        let bvh = build(&corners);
        let corners: Vec<[f32; 9]> = bvh.order.iter().map(|&i| corners[i as usize]).collect();
        for i in 0..40_000u32 {
            let a = f64::from(i) * 0.618_033_988_749;
            let fract = |f: f64| ((a * f).fract() - 0.5) as f32;
            let origin = Vec3::new(fract(1.0) * 1.9, fract(13.0) * 1.9, 0.0);
            let direction = match i % 5 {
                0 => Vec3::X,
                1 => Vec3::NEG_Y,
                2 => Vec3::new(1.0, 1.0, 0.0),
                3 => Vec3::ONE - origin,
                _ => Vec3::new(fract(3.0), fract(7.0), fract(11.0)),
            };
            let hit = closest_hit(
                &bvh.nodes,
                &corners,
                &Ray::new(origin, direction),
                f32::MAX,
                &Opaque,
            );
            assert_ne!(
                hit.triangle, NO_TRIANGLE,
                "ray {i} from {origin} along {direction}"
            );
        }
    }
}
