// Rays. Twin of `vsgl-core/src/geom/ray.rs`.

struct Ray {
    origin: vec3<f32>,
    direction: vec3<f32>,
    inverse: vec3<f32>,
}

fn ray_new(origin: vec3<f32>, direction: vec3<f32>) -> Ray {
    return Ray(
        origin,
        direction,
        vec3(ray_inverse(direction.x), ray_inverse(direction.y), ray_inverse(direction.z)),
    );
}

fn ray_inverse(x: f32) -> f32 {
    let least = select(1e-18, -1e-18, x < 0.0);
    return 1.0 / select(x, least, abs(x) < 1e-18);
}
