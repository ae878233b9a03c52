//! needs: math/vec
// Lights and the frames of their maps. Twins of `MapRecord` in `vsgl-core/src/data/rsm.rs`, of `LightRecord` in `light.rs` there
// and of `vsgl-core/src/scene/light.rs`.

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
    kind: f32,
    cone: vec3<f32>,
    inverse_range2: f32,
}

// Direction from a position to the light, of any length.
fn map_record_to_light(record: MapRecord, position: vec3<f32>) -> vec3<f32> {
    return select(record.position - position, -record.axis, record.kind >= MAP_PARALLEL);
}

// Unit direction from a position to the light; zero for emitters.
fn map_record_light(record: MapRecord, position: vec3<f32>) -> vec3<f32> {
    return select(
        vec_normalize(map_record_to_light(record, position)),
        vec3(0.0),
        record.kind == MAP_EMITTERS,
    );
}

// The side of a texel's surface that its light leaves: a direction of any length.
fn map_record_lit_side(record: MapRecord, position: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    if record.kind == MAP_EMITTERS {
        return normal;
    }
    return map_record_to_light(record, position);
}

struct LightRecord {
    position: vec3<f32>,
    cos_inner: f32,
    axis: vec3<f32>,
    cos_outer: f32,
    intensity: vec3<f32>,
    inverse_range2: f32,
    parallel: u32,
    passed: u32,
    padding: array<u32, 2>,
}

// Share of the on-axis intensity in a direction at `cosine` to the axis.
fn spot_light_falloff(cosine: f32, cos_inner: f32, cos_outer: f32) -> f32 {
    let width = max(cos_inner - cos_outer, 1e-7);
    let t = max(min((cosine - cos_outer) / width, 1.0), 0.0);
    return t * t;
}

// Share of a light that is left at a distance.
fn light_window(distance2: f32, inverse_range2: f32) -> f32 {
    let t = min(distance2 * inverse_range2, 1.0);
    return 1.0 - t * t;
}
