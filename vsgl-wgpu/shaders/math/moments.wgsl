// Weighted mean and variance of points, merged without cancellation: twin of `vsgl-core/src/math/moments.rs`.

struct Moments {
    mean: vec3<f32>,
    spread: f32,
}

fn moments_point(x: vec3<f32>) -> Moments {
    return Moments(x, 0.0);
}

fn moments_merge(own: Moments, weight: f32, other: Moments, other_weight: f32) -> Moments {
    let total = max(weight + other_weight, F32_MIN_POSITIVE);
    let share = other_weight / total;
    let apart = other.mean - own.mean;
    return Moments(
        own.mean + apart * share,
        own.spread + other.spread + dot(apart, apart) * (weight * share),
    );
}

fn moments_scaled(own: Moments, factor: f32) -> Moments {
    return Moments(own.mean, own.spread * factor);
}

struct Scatter {
    mean: vec3<f32>,
    diagonal: vec3<f32>,
    rest: vec3<f32>,
}

fn scatter_point(x: vec3<f32>) -> Scatter {
    return Scatter(x, vec3(0.0), vec3(0.0));
}

fn scatter_merge(own: Scatter, weight: f32, other: Scatter, other_weight: f32) -> Scatter {
    let total = max(weight + other_weight, F32_MIN_POSITIVE);
    let share = other_weight / total;
    let apart = other.mean - own.mean;
    let factor = weight * share;
    let crossed = vec3(apart.x * apart.y, apart.x * apart.z, apart.y * apart.z);
    return Scatter(
        own.mean + apart * share,
        own.diagonal + other.diagonal + (apart * apart) * factor,
        own.rest + other.rest + crossed * factor,
    );
}

fn scatter_scaled(own: Scatter, factor: f32) -> Scatter {
    return Scatter(own.mean, own.diagonal * factor, own.rest * factor);
}
