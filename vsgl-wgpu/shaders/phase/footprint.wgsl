//! needs: geom/hit, math/vec
// How far apart neighbouring rays meet a surface. Twin of `vsgl-core/src/phase/footprint.rs`.
//
// Reads `corner`, which the entry binds.

// A point of a triangle, and by how much the weights of its corners change to the next column (x) and row (y).
struct Place {
    triangle: u32,
    u: f32,
    v: f32,
    x: vec2<f32>,
    y: vec2<f32>,
}

fn place_at_hit(hit: Hit, direction: vec3<f32>, across: vec3<f32>, down: vec3<f32>) -> Place {
    return Place(
        hit.triangle,
        max(min(hit.u, 1.0), 0.0),
        max(min(hit.v, 1.0), 0.0),
        footprint_step(corner[hit.triangle], direction, across),
        footprint_step(corner[hit.triangle], direction, down),
    );
}

// Change of the weights where a ray along `direction` is moved by `by`, in the plane of the triangle.
fn footprint_step(corners: array<f32, 9>, direction: vec3<f32>, by: vec3<f32>) -> vec2<f32> {
    let a = vec3(corners[0], corners[1], corners[2]);
    let ab = vec3(corners[3], corners[4], corners[5]) - a;
    let ac = vec3(corners[6], corners[7], corners[8]) - a;
    let area = cross(ab, ac);
    let normal = vec_normalize(area);
    let along = vec_normalize(direction);
    let slope = dot(normal, along);
    let least = select(GRAZING_MIN, -GRAZING_MIN, slope < 0.0);
    let cosine = select(slope, least, abs(slope) < GRAZING_MIN);
    let moved = by - along * (dot(normal, by) / cosine);
    let twice_area = dot(area, normal);
    let inverse = select(0.0, 1.0 / select(1.0, twice_area, twice_area > 0.0), twice_area > 0.0);
    return vec2(dot(moved, cross(ac, normal)) * inverse, dot(moved, cross(normal, ab)) * inverse);
}
