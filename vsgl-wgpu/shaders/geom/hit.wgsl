// The nearest crossing of a ray. Twin of `Hit` in `vsgl-core/src/geom/traverse.rs`.

struct Hit {
    triangle: u32,
    t: f32,
    u: f32,
    v: f32,
}
