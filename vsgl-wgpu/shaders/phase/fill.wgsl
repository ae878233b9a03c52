// Filling the holes of a shadow map. Twin of `vsgl-core/src/phase/fill.rs`.

// Texels along a side of a level; level 0 is the map.
fn fill_side(side: u32, level: u32) -> u32 {
    return (side + ((1u << level) - 1u)) >> level;
}

fn fill_area(side: u32, level: u32, end: u32) -> u32 {
    let own = fill_side(side, level);
    return select(0u, own * own, level < end);
}

// Texels of the levels 1 .. `level` of one map.
fn fill_before(side: u32, level: u32) -> u32 {
    return (fill_area(side, 1u, level) + fill_area(side, 2u, level)) + fill_area(side, 3u, level);
}

fn fill_value(depth: f32, limit: f32) -> f32 {
    return select(0.0, depth, depth <= limit);
}

// A texel from the four below it.
fn fill_pull(depth: vec4<f32>) -> f32 {
    let nearest = min(min(depth.x, depth.y), min(depth.z, depth.w));
    let limit = min(nearest, 1e37) * FILL_CONSISTENT;
    let same = select(vec4(0.0), vec4(1.0), depth <= vec4(limit));
    let count = ((same.x + same.y) + same.z) + same.w;
    let above = max(fill_value(depth.x, limit), fill_value(depth.y, limit));
    let below = max(fill_value(depth.z, limit), fill_value(depth.w, limit));
    return select(F32_MAX, max(above, below), count >= 2.0);
}

// A texel, filled from the one above it.
fn fill_push(depth: f32, above: f32) -> f32 {
    return select(above, depth, depth < F32_MAX);
}
