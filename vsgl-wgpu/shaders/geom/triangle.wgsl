// Where a ray crosses a triangle. Twin of `vsgl-core/src/geom/triangle.rs`.

struct Crossing {
    hit: bool,
    t: f32,
    u: f32,
    v: f32,
}

fn triangle_cross(origin: vec3<f32>, direction: vec3<f32>, corners: array<f32, 9>) -> Crossing {
    let a = vec3(corners[0], corners[1], corners[2]) - origin;
    let b = vec3(corners[3], corners[4], corners[5]) - origin;
    let c = vec3(corners[6], corners[7], corners[8]) - origin;
    let at_a = dot(cross(c - b, c + b), direction);
    let at_b = dot(cross(a - c, a + c), direction);
    let at_c = dot(cross(b - a, b + a), direction);
    let least = min(min(at_a, at_b), at_c);
    let most = max(max(at_a, at_b), at_c);
    let normal = cross(b - a, c - a);
    let across = dot(normal, direction);
    let volume = at_a + at_b + at_c;
    let inside = (least >= 0.0) || (most <= 0.0);
    let hit = inside && (across != 0.0) && (volume != 0.0);
    let t = dot(normal, a) / select(across, 1.0, across == 0.0);
    let scale = 1.0 / select(volume, 1.0, volume == 0.0);
    return Crossing(hit, t, at_b * scale, at_c * scale);
}
