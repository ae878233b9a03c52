//! needs: math/elementary, math/vec, sg/glossy, sg/lobe
// GGX under a spherical Gaussian light, closest to the exact integral: twin of `vsgl-core/src/sg/glossy_blend.rs`.

fn glossy_blend_shape(own: f32, slope: f32) -> f32 {
    let inverse = min(slope, 33.0);
    let y = 1.0 / inverse;
    let core = inverse * inverse * elementary_exp(1.0 - inverse);
    let one = horner_shape_one(own);
    let two = horner_shape_two(own);
    let three = horner_shape_three(own);
    let flank = ((three * y + two) * y + one) * y;
    let peak = horner_shape_peak(own) * y + horner_shape_peak_rest(own);
    let blurred = flank + core * peak;
    return max(own + (1.0 - own) * blurred, 0.25 * own);
}

fn glossy_view_blended(own: GlossyView, axis: vec3<f32>, sharpness: f32, horizon_sharpness: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let filtered = glossy_view_blur(own, axis, k);
    let flat = max(1.0 - filtered.root, 0.0);
    let bend = 1.0 + (glossy_blend_shape(filtered.own, filtered.slope) - 1.0) * (flat * flat * flat);
    let narrow = glossy_view_masked_share(own, axis, horizon_sharpness) * filtered.density * bend;

    let wide = own.rest / (own.rest + 2.0 * k * own.alpha2);
    let wide2 = wide * wide;
    let weight = wide2 * wide2;
    let quarter = 0.25 * own.rest;
    let blurred = k * (quarter / (quarter + k * own.alpha2));
    let light = elementary_exp(-blurred * vec_one_minus_cos(own.mirrored, axis)) / lobe_integral(blurred);
    return narrow + weight * (own.albedo * light - narrow);
}

fn glossy_blend_blended(view: vec3<f32>, normal: vec3<f32>, alpha: f32, axis: vec3<f32>, sharpness: f32) -> f32 {
    return glossy_view_blended(glossy_view_new(view, normal, alpha), axis, sharpness, sharpness)
        * lobe_integral(sharpness);
}
