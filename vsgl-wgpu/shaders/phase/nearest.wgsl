//! needs: data/nearest
// Clusters of the texels nearest to centres: keys, boxes and distances. Twin of `vsgl-core/src/phase/nearest.rs`, apart from what
// binds the density and the centres, which is in `entry/nearest.wgsl`.

fn nearest_key(map_number: u32, size: u32, x: u32, y: u32) -> u32 {
    return map_number * (size * size) + (nearest_spread(x) | (nearest_spread(y) << 1u));
}

fn nearest_spread(value: u32) -> u32 {
    var x = value;
    x = (x | (x << 8u)) & 0x00ff00ffu;
    x = (x | (x << 4u)) & 0x0f0f0f0fu;
    x = (x | (x << 2u)) & 0x33333333u;
    return (x | (x << 1u)) & 0x55555555u;
}

fn bounds_join(own: Bounds, other: Bounds) -> Bounds {
    return Bounds(min(own.low, other.low), max(own.high, other.high));
}

fn bounds_distance2(own: Bounds, x: vec3<f32>) -> f32 {
    let outside = max(max(own.low - x, x - own.high), vec3(0.0));
    return dot(outside, outside);
}

struct Nearest {
    number: u32,
    distance2: f32,
}

fn nearest_or(own: Nearest, other: Centre, x: vec3<f32>) -> Nearest {
    let apart = other.position - x;
    let distance2 = dot(apart, apart);
    let is_nearer = distance2 < own.distance2
        || (distance2 == own.distance2 && other.number < own.number);
    return Nearest(
        select(own.number, other.number, is_nearer),
        select(own.distance2, distance2, is_nearer),
    );
}
