//! needs: math/elementary, sg/hemisphere, sg/lobe, sg/polar, sg/vmf
// Integral of a spherical Gaussian against a clamped cosine: twin of `vsgl-core/src/sg/cosine.rs`.

fn cosine_upper(sharpness: f32) -> f32 {
    return TAU * polar_moments_new(sharpness).upper;
}

fn cosine_lower(sharpness: f32) -> f32 {
    let m = polar_moments_new(sharpness);
    return TAU * (m.decay * m.lower);
}

fn cosine_log_lower(sharpness: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    return elementary_log(TAU * polar_moments_new(k).lower) - k;
}

fn cosine_constant(sharpness: f32, cosine: f32) -> f32 {
    return lobe_integral(sharpness) * max(cosine, 0.0);
}

fn cosine_sg_2015(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let sum = k + COSINE_SHARPNESS_2015;
    return elementary_exp((cosine - 1.0) * (k / sum) * COSINE_SHARPNESS_2015) * (TAU / sum);
}

fn cosine_sg_iwasaki_2012(sharpness: f32, cosine: f32) -> f32 {
    return cosine_sg_2015(sharpness, cosine) * (PI / lobe_integral(COSINE_SHARPNESS_2015));
}

fn cosine_sg_product(sharpness: f32, cosine: f32) -> f32 {
    let axis = cosine_axis(cosine);
    return lobe_inner_product(axis, sharpness, vec3(0.0, 0.0, 1.0), COSINE_SHARPNESS_2015)
        * (PI / lobe_integral(COSINE_SHARPNESS_2015));
}

// First of `axis_and_normal`; the normal is +z.
fn cosine_axis(cosine: f32) -> vec3<f32> {
    let sine = sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0));
    return vec3(sine, 0.0, cosine);
}

// Amplitude, sharpness, cosine.
fn cosine_widened(k: f32, z: f32, wide: f32) -> vec3<f32> {
    let p = lobe_product(cosine_axis(z), k, vec3(0.0, 0.0, 1.0), wide);
    return vec3(elementary_exp(p.log_amplitude), p.sharpness, clamp(p.axis.z, -1.0, 1.0));
}

fn cosine_lobes_2018(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let w = cosine_widened(k, cosine, LOBES_2018_WIDE);
    let product = LOBES_2018_PRODUCT * w.x * hemisphere_integral_2018(w.y, w.z);
    return max(product - LOBES_2018_CONSTANT * hemisphere_integral_2018(k, cosine), 0.0);
}

fn cosine_lobes_2022(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let w = cosine_widened(k, cosine, LOBES_2022_WIDE);
    let product = LOBES_2022_PRODUCT * w.x * hemisphere_integral_2022(w.y, w.z);
    return max(product - LOBES_2022_CONSTANT * hemisphere_integral_2022(k, cosine), 0.0);
}

fn cosine_factor(t: f32, z: f32) -> f32 {
    let fold = elementary_erf_integral(t) - elementary_erf_integral(t * abs(z));
    return 0.5 * (1.0 + z) - fold * (0.5 / max(t, 1e-30));
}

fn cosine_steepness_2024(k: f32) -> f32 {
    let above = horner_cosine_2024_above(k);
    let below = horner_cosine_2024_below(k);
    return k * sqrt(above / (2.0 * below));
}

fn cosine_steepness_v13(k: f32) -> f32 {
    let above = horner_cosine_v13_above(k);
    let below = horner_cosine_v13_below(k);
    return k * sqrt(above / (2.0 * below));
}

fn cosine_factor_2024(k: f32, z: f32) -> f32 {
    return clamp(cosine_factor(cosine_steepness_2024(k), z), 0.0, 1.0);
}

fn cosine_correction_v13(k: f32, z: f32) -> f32 {
    let j = min(k, 1e4);
    let one = horner_cosine_v13_one(j);
    let nought = horner_cosine_v13_nought(j);
    let root = sqrt(one);
    let one_power = one * root * sqrt(root);
    let nought_power = nought * nought * sqrt(nought);
    let square = z * z;
    let mixed = V13_NOUGHT * one_power + V13_ONE * square * nought_power;
    return j * j * j * mixed / (one_power * nought_power);
}

fn cosine_factor_v13(k: f32, z: f32) -> f32 {
    let t = cosine_steepness_v13(k);
    let tz = t * z;
    let even = (1.0 - z) * (1.0 + z) * elementary_exp(-tz * tz) * cosine_correction_v13(k, z);
    return clamp(cosine_factor(t, z) + even, 0.0, 1.0);
}

fn cosine_factor_v14(k: f32, z: f32) -> f32 {
    let above = horner_cosine_v14_above(k);
    let below = horner_cosine_v14_below(k);
    let t = k * sqrt(above / (2.0 * below));
    let j = min(k, 1e4);
    let a = j * j + V14_NOUGHT_BELOW;
    let b = horner_cosine_v14_one(j);
    let c = horner_cosine_v14_two(j);
    let root = sqrt(b);
    let nought = V14_NOUGHT * j / (a * a * sqrt(a));
    let one = V14_ONE * j / (b * root * sqrt(root));
    let two = horner_cosine_v14_two_above(j) / (c * sqrt(c));
    let square = z * z;
    let correction = ((two * square + one) * square + nought) * (j * j);
    let tz = t * z;
    let even = (1.0 - z) * (1.0 + z) * elementary_exp(-tz * tz) * correction;
    return clamp(cosine_factor(t, z) + even, 0.0, 1.0);
}

fn cosine_interpolated_2024(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let m = polar_moments_new(k);
    let low = m.decay * m.lower;
    return TAU * (low + cosine_factor_2024(k, cosine) * (m.upper - low));
}

fn cosine_interpolated_v13(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let m = polar_moments_new(k);
    let low = m.decay * m.lower;
    return TAU * (low + cosine_factor_v13(k, cosine) * (m.upper - low));
}

fn cosine_interpolated_v14(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let m = polar_moments_new(k);
    let low = m.decay * m.lower;
    return TAU * (low + cosine_factor_v14(k, cosine) * (m.upper - low));
}

fn cosine_log_interpolated(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let m = polar_moments_new(k);
    let low = m.decay * m.lower;
    let above = elementary_log(low + cosine_factor_v13(k, cosine) * (m.upper - low));

    let z = min(cosine, 0.0);
    let t = cosine_steepness_v13(k);
    let sine2 = (1.0 - z) * (1.0 + z);
    let own = elementary_erfc_integral_scaled(-t * z);
    let end = elementary_erfc_integral_scaled(t) * elementary_exp(-(t * t) * sine2);
    let step = max(own - end, 0.0) * (0.5 * INV_SQRT_PI / max(t, 1e-30));
    let factor = step + sine2 * cosine_correction_v13(k, z);
    let rate = 2.0 * (t * t) * (z * z) / (1.0 + sqrt(max(sine2, 0.0)));
    let bent = elementary_log(factor * (m.upper - low)) - rate;
    let least = elementary_log(m.lower) - k;
    let larger = max(bent, least);
    let below = larger + elementary_log(1.0 + elementary_exp(min(bent, least) - larger));
    let far = cosine < 0.0 && k > 1.0;
    return elementary_log(TAU) + select(above, below, far);
}

fn cosine_mean_clamped_cosine(sharpness: f32, cosine: f32) -> f32 {
    let k = min(sharpness, SHARPNESS_MAX);
    let m = polar_moments_new(k);
    let low = m.decay * m.lower;
    return (low + cosine_factor_v13(k, cosine) * (m.upper - low)) / polar_moments_sphere(m);
}

fn cosine_odd_part(sharpness: f32, cosine: f32) -> f32 {
    return cosine * lobe_integral(sharpness) * vmf_mean_length(sharpness);
}
