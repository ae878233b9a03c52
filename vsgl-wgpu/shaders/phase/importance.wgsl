// How much each texel matters to what the camera sees. Twin of `vsgl-core/src/phase/importance.rs`.

fn importance_first_light(x: u32, y: u32) -> u32 {
    return x % INTERLEAVE + INTERLEAVE * (y % INTERLEAVE);
}

fn importance_density(matters: f32, total: f32, lit: f32) -> f32 {
    var part = 0.0;
    if total >= F32_MIN_POSITIVE {
        part = matters / total;
    }
    return (part * lit) * IMPORTANCE_KEPT + IMPORTANCE_FLOOR;
}
