//! needs: math/vec
// Geometric normals and where rays start. Twin of `geometric_normal` and `lift` in `vsgl-core/src/phase/surface.rs`, apart
// from the material so that shadow rays bind no more than corners.
//
// Reads `corner`, which the entry binds.

// Geometric unit normal of a triangle on the side that `towards` points to.
fn surface_geometric_normal(triangle: u32, towards: vec3<f32>) -> vec3<f32> {
    let c = corner[triangle];
    let a = vec3(c[0], c[1], c[2]);
    let edge = vec3(c[3], c[4], c[5]) - a;
    let other = vec3(c[6], c[7], c[8]) - a;
    let normal = vec_normalize(cross(edge, other));
    return select(normal, -normal, dot(normal, towards) < 0.0);
}

// Distance by which a ray's origin is lifted off a surface.
fn surface_lift(least: f32, position: vec3<f32>) -> f32 {
    let p = abs(position);
    return least + LIFT * max(max(p.x, p.y), p.z);
}
