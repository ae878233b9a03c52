// Isotropic GGX in any one frame: twin of `vsgl-core/src/brdf/ggx.rs`.

fn ggx_distribution(half: vec3<f32>, normal: vec3<f32>, alpha: f32) -> f32 {
    let alpha2 = alpha * alpha;
    let upright = dot(half, normal);
    let tangent = cross(normal, half);
    let form = max(dot(tangent, tangent) + alpha2 * (upright * upright), F32_MIN_POSITIVE);
    let ratio = dot(half, half) / form;
    let value = alpha2 * ratio * ratio * (1.0 / PI);
    return select(0.0, value, upright > 0.0);
}

fn ggx_reach(cosine: f32, alpha2: f32) -> f32 {
    return sqrt(alpha2 + max(1.0 - alpha2, 0.0) * (cosine * cosine));
}

fn ggx_lambda(cosine: f32, alpha: f32) -> f32 {
    let c = clamp(abs(cosine), 1e-9, 1.0);
    let slope = alpha / c;
    let k2 = slope * slope * ((1.0 - c) * (1.0 + c));
    return 0.5 * k2 / (sqrt(k2 + 1.0) + 1.0);
}

fn ggx_visibility(view_cosine: f32, light_cosine: f32, alpha: f32) -> f32 {
    let alpha2 = alpha * alpha;
    let sum = ggx_reach(view_cosine, alpha2) * light_cosine + ggx_reach(light_cosine, alpha2) * view_cosine;
    return 0.5 / max(sum, 5e-10);
}

fn ggx_reflectance(view: vec3<f32>, light: vec3<f32>, normal: vec3<f32>, alpha: f32) -> f32 {
    let v = dot(view, normal);
    let o = dot(light, normal);
    let value = ggx_distribution(view + light, normal, alpha) * ggx_visibility(max(v, 0.0), max(o, 0.0), alpha);
    return select(0.0, value, min(v, o) > 0.0);
}
