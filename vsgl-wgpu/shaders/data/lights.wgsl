// Lights and the frames of their maps. Twins of `MapRecord` in `vsgl-core/src/data/rsm.rs` and of `SpotLight`.

struct MapRecord {
    position: vec3<f32>,
    tan_half_fov: f32,
    axis: vec3<f32>,
    cos_inner: f32,
    right: vec3<f32>,
    cos_outer: f32,
    up: vec3<f32>,
    solid_angle: f32,
    intensity: vec3<f32>,
    padding: f32,
}

// Share of the on-axis intensity in a direction at `cosine` to the axis.
fn spot_light_falloff(cosine: f32, cos_inner: f32, cos_outer: f32) -> f32 {
    let width = max(cos_inner - cos_outer, 1e-7);
    let t = max(min((cosine - cos_outer) / width, 1.0), 0.0);
    return t * t;
}
