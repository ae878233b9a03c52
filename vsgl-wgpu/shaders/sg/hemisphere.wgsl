//! needs: math/elementary, sg/polar
// Integral of a spherical Gaussian over a hemisphere: twin of `vsgl-core/src/sg/hemisphere.rs`.

fn hemisphere_upper(sharpness: f32) -> f32 {
    return TAU * polar_moments_new(sharpness).mass;
}

fn hemisphere_lower(sharpness: f32) -> f32 {
    let m = polar_moments_new(sharpness);
    return TAU * (m.decay * m.mass);
}

fn hemisphere_log_lower(sharpness: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    return elementary_log(TAU * polar_moments_new(k).mass) - k;
}

fn hemisphere_factor_2018(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness;
    let t = sqrt(k) * ((horner_hemisphere_2018_above(k) * k) / horner_hemisphere_2018_below(k));
    let a = -elementary_expm1(-t * abs(cosine));
    let b = -elementary_expm1(-t);
    let ratio = a * (2.0 - b) / ((2.0 - a) * max(b, 1e-30));
    let signed = select(ratio, -ratio, cosine < 0.0);
    let linear = 0.5 * (1.0 + cosine);
    return select(clamp(0.5 + 0.5 * signed, 0.0, 1.0), linear, t < 1e-6);
}

fn hemisphere_steepness_2022(k: f32) -> f32 {
    return k * sqrt(horner_hemisphere_2022_above(k) / horner_hemisphere_2022_below(k));
}

fn hemisphere_factor_2022(sharpness: f32, cosine: f32) -> f32 {
    let t = hemisphere_steepness_2022(sharpness);
    let ratio = elementary_erf(t * cosine) / max(elementary_erf(t), 1e-30);
    let linear = 0.5 * (1.0 + cosine);
    return select(clamp(0.5 + 0.5 * ratio, 0.0, 1.0), linear, t < 1e-6);
}

fn hemisphere_factor_odd(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness;
    let t = k * sqrt(horner_hemisphere_odd_above(k) / horner_hemisphere_odd_below(k));
    let tz = t * cosine;
    let ratio = elementary_erf(tz) / max(elementary_erf(t), 1e-30);
    let j = min(k, 1e6);
    let depth = HEMISPHERE_BEND * (j * j) / (horner_hemisphere_bend_below(j) * sqrt(j + 1.0));
    let bend = cosine * ((1.0 - cosine) * (1.0 + cosine)) * elementary_exp(-tz * tz) * depth;
    let linear = 0.5 * (1.0 + cosine);
    let bent = clamp(0.5 + 0.5 * ratio - bend, 0.0, 1.0);
    return select(bent, linear, t < 1e-6);
}

fn hemisphere_integral_2018(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let m = polar_moments_new(k);
    let v = hemisphere_factor_2018(k, cosine);
    return TAU * m.mass * (m.decay + v * (1.0 - m.decay));
}

fn hemisphere_integral_2022(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let m = polar_moments_new(k);
    let v = hemisphere_factor_2022(k, cosine);
    return TAU * m.mass * (m.decay + v * (1.0 - m.decay));
}

fn hemisphere_share_2022(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let decay = elementary_exp(-k);
    let v = hemisphere_factor_2022(k, cosine);
    return (v + decay * (1.0 - v)) / (1.0 + decay);
}

fn hemisphere_integral(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let m = polar_moments_new(k);
    let v = hemisphere_factor_odd(k, cosine);
    return TAU * m.mass * (m.decay + v * (1.0 - m.decay));
}

fn hemisphere_share(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let decay = elementary_exp(-k);
    let v = hemisphere_factor_odd(k, cosine);
    return (v + decay * (1.0 - v)) / (1.0 + decay);
}

fn hemisphere_log_integral(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let m = polar_moments_new(k);
    let v = hemisphere_factor_odd(k, cosine);
    let plain = elementary_log(TAU * m.mass * (m.decay + v * (1.0 - m.decay)));

    let z = clamp(cosine, -1.0, 0.0);
    let s = sqrt(max((1.0 - z) * (1.0 + z), 0.0));
    let x = k * s;
    let bessel = elementary_bessel_i0_scaled(x);
    let reach = elementary_expm1_over_x(-2.0 * x) / bessel;
    let across = reach * elementary_erfc_scaled(-k * z * reach * INV_SQRT_PI);
    let far = elementary_log(TAU * bessel * across) - k * (z * z / (1.0 + s));

    let weight = select(0.0, clamp(0.5 * k - 2.0, 0.0, 1.0), cosine < 0.0);
    return plain + weight * (far - plain);
}

fn hemisphere_log_share(sharpness: f32, cosine: f32) -> f32 {
    return hemisphere_log_integral(sharpness, cosine)
        - elementary_log(TAU * polar_moments_sphere(polar_moments_new(sharpness)));
}
