// Where rays start. Twin of `lift` in `vsgl-core/src/phase/facing.rs`, apart from normals, which bind corners.

// Distance by which a ray's origin is lifted off a surface.
fn surface_lift(least: f32, position: vec3<f32>) -> f32 {
    let p = abs(position);
    return least + LIFT * max(max(p.x, p.y), p.z);
}
