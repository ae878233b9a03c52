//! needs: math/elementary, math/vec
// The spherical Gaussian, its integral and products: twin of `vsgl-core/src/sg/lobe.rs`.

struct SgLobe {
    axis: vec3<f32>,
    sharpness: f32,
    log_amplitude: f32,
}

fn sg_lobe_new(axis: vec3<f32>, sharpness: f32) -> SgLobe {
    return SgLobe(axis, clamp(sharpness, 0.0, SHARPNESS_MAX), 0.0);
}

fn sg_lobe_evaluate(own: SgLobe, direction: vec3<f32>) -> f32 {
    return elementary_exp(own.log_amplitude - own.sharpness * vec_one_minus_cos(direction, own.axis));
}

fn sg_lobe_integral(own: SgLobe) -> f32 {
    return elementary_exp(own.log_amplitude) * lobe_integral(own.sharpness);
}

fn sg_lobe_log_integral(own: SgLobe) -> f32 {
    return own.log_amplitude + lobe_log_integral(own.sharpness);
}

fn lobe_evaluate(axis: vec3<f32>, sharpness: f32, direction: vec3<f32>) -> f32 {
    return elementary_exp(-min(sharpness, SHARPNESS_MAX) * vec_one_minus_cos(direction, axis));
}

fn lobe_integral(sharpness: f32) -> f32 {
    return 4.0 * PI * elementary_expm1_over_x(-2.0 * min(sharpness, SHARPNESS_MAX));
}

fn lobe_log_integral(sharpness: f32) -> f32 {
    return elementary_log(lobe_integral(sharpness));
}

fn lobe_integral_sharp(sharpness: f32) -> f32 {
    return TAU / clamp(sharpness, 1e-30, SHARPNESS_MAX);
}

fn lobe_product(a_axis: vec3<f32>, a_sharpness: f32, b_axis: vec3<f32>, b_sharpness: f32) -> SgLobe {
    let a = min(a_sharpness, SHARPNESS_MAX);
    let b = min(b_sharpness, SHARPNESS_MAX);
    let larger = max(a, b);
    let smaller = min(a, b);
    let unit = 1.0 / max(larger, F32_MIN_POSITIVE);
    let ra = a * unit;
    let rb = b * unit;
    let sum = a_axis * ra + b_axis * rb;
    let length = sqrt(dot(sum, sum));
    let cancelled = length < 1e-18;
    let inverse = 1.0 / select(length, 1.0, cancelled);
    let unit_axis = sum * inverse;
    let axis = select(unit_axis, b_axis, cancelled);
    let log_amplitude = -2.0 * vec_one_minus_cos(a_axis, b_axis) * smaller / max(ra + rb + length, 1.0);
    return SgLobe(axis, larger * length, log_amplitude);
}

// Sharpness and logarithm of the amplitude.
fn lobe_product_by_chord(a_sharpness: f32, b_sharpness: f32, chord2: f32) -> vec2<f32> {
    let a = min(a_sharpness, SHARPNESS_MAX);
    let b = min(b_sharpness, SHARPNESS_MAX);
    let larger = max(a, b);
    let ratio = min(a, b) / max(larger, F32_MIN_POSITIVE);
    let apart = 1.0 - ratio;
    let length = sqrt(apart * apart + ratio * max(4.0 - chord2, 0.0));
    let log_amplitude = -chord2 * min(a, b) / (1.0 + ratio + length);
    return vec2(larger * length, log_amplitude);
}

fn lobe_inner_product(a_axis: vec3<f32>, a_sharpness: f32, b_axis: vec3<f32>, b_sharpness: f32) -> f32 {
    return sg_lobe_integral(lobe_product(a_axis, a_sharpness, b_axis, b_sharpness));
}

fn lobe_log_inner_product(a_axis: vec3<f32>, a_sharpness: f32, b_axis: vec3<f32>, b_sharpness: f32) -> f32 {
    return sg_lobe_log_integral(lobe_product(a_axis, a_sharpness, b_axis, b_sharpness));
}

fn lobe_inner_product_sharp(a_axis: vec3<f32>, a_sharpness: f32, b_axis: vec3<f32>, b_sharpness: f32) -> f32 {
    let a = min(a_sharpness, SHARPNESS_MAX);
    let b = min(b_sharpness, SHARPNESS_MAX);
    let sum = max(a + b, 1e-30);
    return TAU * elementary_exp(-vec_one_minus_cos(a_axis, b_axis) * a * (b / sum)) / sum;
}
