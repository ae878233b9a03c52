//! needs: data/scene, geom/hit, geom/ray, geom/triangle, phase/mask
// Walking the hierarchy. Twin of `vsgl-core/src/geom/traverse.rs`, which tests each box once and keeps its entry: the same boxes in
// the same order.
//
// Reads `node` and `corner`, which the entry binds.

// Entry and exit parameter of a line through a box.
fn traverse_slab(at: u32, ray: Ray) -> vec2<f32> {
    let low = (node[at].min - ray.origin) * ray.inverse;
    let high = (node[at].max - ray.origin) * ray.inverse;
    let near = min(low, high);
    let far = max(low, high);
    let entry = max(max(near.x, near.y), near.z);
    let exit = min(min(far.x, far.y), far.z);
    return vec2(entry, exit * SLAB_EXIT);
}

// Nearest crossing with `0 < t < t_max`; of equal ones that with the lower triangle id. `nodes` is their number.
fn traverse_closest_hit(nodes: u32, ray: Ray, t_max: f32) -> Hit {
    var hit = Hit(NO_TRIANGLE, t_max, 0.0, 0.0);
    var stack: array<u32, STACK>;
    var held = select(0u, 1u, nodes > 0u);
    stack[0] = 0u;
    while held > 0u {
        held -= 1u;
        let at = stack[held];
        let slab = traverse_slab(at, ray);
        if slab.x > slab.y || slab.y < 0.0 || slab.x > hit.t {
            continue;
        }
        let first = node[at].first;
        let count = node[at].count;
        if count == 0u {
            let left = first;
            let right = first + 1u;
            let left_entry = traverse_slab(left, ray).x;
            let right_entry = traverse_slab(right, ray).x;
            let swap = right_entry < left_entry;
            stack[held] = select(right, left, swap);
            stack[held + 1u] = select(left, right, swap);
            held += 2u;
        } else {
            for (var triangle = first; triangle < first + count; triangle++) {
                let found = triangle_cross(ray.origin, ray.direction, corner[triangle]);
                let nearer = found.t < hit.t
                    || (found.t == hit.t && triangle < hit.triangle && hit.triangle != NO_TRIANGLE);
                if found.hit && found.t > 0.0 && nearer {
                    if mask_covers(triangle, found.u, found.v) {
                        hit = Hit(triangle, found.t, found.u, found.v);
                    }
                }
            }
        }
    }
    return hit;
}

// Whether anything is crossed with `0 < t < t_max`.
fn traverse_any_hit(nodes: u32, ray: Ray, t_max: f32) -> bool {
    var stack: array<u32, STACK>;
    var held = select(0u, 1u, nodes > 0u);
    stack[0] = 0u;
    while held > 0u {
        held -= 1u;
        let at = stack[held];
        let slab = traverse_slab(at, ray);
        if slab.x > slab.y || slab.y < 0.0 || slab.x > t_max {
            continue;
        }
        let first = node[at].first;
        let count = node[at].count;
        if count == 0u {
            stack[held] = first + 1u;
            stack[held + 1u] = first;
            held += 2u;
        } else {
            for (var triangle = first; triangle < first + count; triangle++) {
                let found = triangle_cross(ray.origin, ray.direction, corner[triangle]);
                if found.hit && found.t > 0.0 && found.t < t_max {
                    if mask_covers(triangle, found.u, found.v) {
                        return true;
                    }
                }
            }
        }
    }
    return false;
}
