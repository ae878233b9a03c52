// Exact partition of texels: twin of `vsgl-core/src/phase/partition.rs`.

// Position and normal apart, where the Rust text has them in one array.
struct Features {
    position: vec3<f32>,
    weight: f32,
    normal: vec3<f32>,
    deviation_position: vec3<f32>,
    deviation_normal: vec3<f32>,
}

fn features_texel(place: vec4<f32>, normal: vec3<f32>) -> Features {
    return Features(place.xyz, place.w, normal, vec3(0.0), vec3(0.0));
}

fn features_merge(own: Features, other: Features) -> Features {
    let total = own.weight + other.weight;
    let share = other.weight / max(total, F32_MIN_POSITIVE);
    let factor = own.weight * share;
    let apart_position = other.position - own.position;
    let apart_normal = other.normal - own.normal;
    return Features(
        own.position + apart_position * share,
        total,
        own.normal + apart_normal * share,
        (own.deviation_position + other.deviation_position) + (apart_position * apart_position) * factor,
        (own.deviation_normal + other.deviation_normal) + (apart_normal * apart_normal) * factor,
    );
}

fn features_scale(own: Features) -> f32 {
    let spread = (own.deviation_position.x + own.deviation_position.y) + own.deviation_position.z;
    return 1.0 / max(spread / max(own.weight, F32_MIN_POSITIVE), F32_MIN_POSITIVE);
}

struct Statistics {
    priority: f32,
    // 0 to 2 for the position, 4 to 6 for the normal.
    axis: u32,
    threshold: f32,
    widest: f32,
}

fn statistics_new(whole: Features, scale: f32) -> Statistics {
    var made = Statistics(0.0, 0u, 0.0, 0.0);
    for (var i = 0u; i < 3u; i += 1u) {
        made = statistics_add(made, i, whole.deviation_position[i] * scale, whole.position[i]);
    }
    for (var i = 0u; i < 3u; i += 1u) {
        made = statistics_add(made, 4u + i, whole.deviation_normal[i] * NORMAL_SCALE, whole.normal[i]);
    }
    return made;
}

fn statistics_add(own: Statistics, axis: u32, width: f32, mean: f32) -> Statistics {
    let priority = own.priority + width;
    if width > own.widest {
        return Statistics(priority, axis, mean, width);
    }
    return Statistics(priority, own.axis, own.threshold, own.widest);
}
