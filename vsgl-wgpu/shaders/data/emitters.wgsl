// Points of surfaces that shine, and the triangles. Twin of `vsgl-core/src/data/emitter.rs`.

struct EmitterRecord {
    position: vec3<f32>,
    area: f32,
    normal: vec3<f32>,
    triangle: u32,
    flux: vec3<f32>,
    padding: u32,
}

struct LampRecord {
    triangle: u32,
    by_power: u32,
    evenly: u32,
    padding: u32,
}
