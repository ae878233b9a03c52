//! needs: math/vec, phase/lift
// Geometric normals. Twin of `geometric_normal` in `vsgl-core/src/phase/facing.rs`.
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
