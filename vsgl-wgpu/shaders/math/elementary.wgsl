// Exponential, logarithm and error functions: twin of `vsgl-core/src/math/elementary.rs`, which documents them.
// No built-in transcendental: what a driver calls `exp` or `log` differs from it by up to thousands of roundings.
// `horner_name(x)` is made from the table NAME of the Rust text.

struct Reduced {
    whole: f32,
    scale: f32,
    rest: f32,
    slope: f32,
}

fn elementary_reduce(argument: f32) -> Reduced {
    let x = clamp(argument, EXP_ARGUMENT_MIN, EXP_ARGUMENT_MAX);
    let whole = floor(x * LOG2_E + 0.5);
    let rest = (x - whole * LN_2_HEAD) - whole * LN_2_TAIL;
    let slope = horner_exp_slope(rest);
    let scale = bitcast<f32>(bitcast<u32>(whole + 8388735.0) << 23u);
    return Reduced(whole, scale, rest, slope);
}

fn elementary_exp(x: f32) -> f32 {
    let r = elementary_reduce(x);
    let value = (r.slope * r.rest + 1.0) * r.scale;
    return select(value, 0.0, x < EXP_ARGUMENT_MIN);
}

fn elementary_expm1(x: f32) -> f32 {
    let r = elementary_reduce(max(x, EXPM1_ARGUMENT_MIN));
    let near = r.slope * r.rest;
    let far = near * r.scale + (r.scale - 1.0);
    return select(far, near, r.whole == 0.0);
}

fn elementary_expm1_over_x(x: f32) -> f32 {
    let r = elementary_reduce(max(x, EXPM1_ARGUMENT_MIN));
    let near = r.whole == 0.0;
    let far = (r.slope * r.rest * r.scale + (r.scale - 1.0)) * (1.0 / select(x, 1.0, near));
    return select(far, r.slope, near);
}

fn elementary_log(x: f32) -> f32 {
    let bits = bitcast<u32>(max(x, F32_MIN_POSITIVE));
    let shifted = bits - 0x3f3504f3u;
    let exponent = f32(bitcast<i32>(shifted) >> 23u);
    let mantissa = bitcast<f32>((shifted & 0x007fffffu) + 0x3f3504f3u);
    let m = mantissa - 1.0;
    let p = horner_log(m);
    return p * m + exponent * LN_2;
}

fn elementary_erf(x: f32) -> f32 {
    let u = clamp(x, -3.9, 3.9);
    let s = u * u * ERF_SQUARE - 1.0;
    let p = horner_erf(s);
    let near = clamp(p * u, -1.0, 1.0);
    let right = select(1.0, near, x < 3.9);
    return select(-1.0, right, x > -3.9);
}

fn elementary_exp_minus_square(u: f32) -> f32 {
    let head = bitcast<f32>(bitcast<u32>(u) & 0xfffff000u);
    let rest = (u - head) * (u + head);
    let correction = horner_exp_short(rest);
    return elementary_exp(-(head * head)) * correction;
}

fn elementary_erfc(x: f32) -> f32 {
    let u = min(abs(x), 10.0);
    let tail = elementary_exp_minus_square(u) * elementary_erfc_scaled(u);
    return select(tail, 2.0 - tail, x < 0.0);
}

fn elementary_erfc_scaled(x: f32) -> f32 {
    let u = clamp(x, 0.0, 10.0);
    let q = (u - 2.0) / (u + 2.0);
    let p = horner_erfc_scaled(q);
    let inverse = 1.0 / clamp(x, 10.0, 1e30);
    let r = inverse * inverse;
    let far = ((-1.875 * r + 0.75) * r - 0.5) * r + 1.0;
    return select(far * inverse * INV_SQRT_PI, p / (1.0 + 2.0 * u), x < 10.0);
}

fn elementary_erfc_inverse(value: f32) -> f32 {
    let y = clamp(value, 1e-7, ERFC_VALUE_MAX);
    let w = -elementary_log(y * (2.0 - y));
    let a = w - 2.5;
    let p = horner_erfc_inverse_centre(a);
    let b = sqrt(max(w, 0.0)) - 3.0;
    let t = horner_erfc_inverse_tail(b);
    return select(t, p, w < 5.0) * (1.0 - y);
}

fn elementary_bessel_i0_scaled(x: f32) -> f32 {
    let near = clamp(x, 0.0, 3.75);
    let s = (near * near) * BESSEL_SQUARE;
    let p = horner_bessel_near(s);
    let far = clamp(x, 3.75, 1e30);
    let t = 3.75 / far;
    let q = horner_bessel_far(t);
    return select(q * sqrt(t) * BESSEL_ROOT, p * elementary_exp(-near), x < 3.75);
}

fn elementary_erf_integral(u: f32) -> f32 {
    let v = min(u, 3.5);
    let w = v * v;
    let s = w * ERF_INTEGRAL_SQUARE - 1.0;
    let p = horner_erf_integral(s);
    return select(u - INV_SQRT_PI, p * w, u < 3.5);
}

fn elementary_erfc_integral(x: f32) -> f32 {
    let u = clamp(x, 0.0, 10.0);
    return elementary_exp_minus_square(u) * INV_SQRT_PI * elementary_erfc_integral_scaled(u);
}

fn elementary_erfc_integral_scaled(x: f32) -> f32 {
    let u = clamp(x, 0.0, 1e15);
    let q = (u - 2.0) / (u + 2.0);
    let p = horner_erfc_integral_scaled(q);
    return p / (1.0 + 2.0 * (u * u));
}

// Sine and cosine, as the pair of the Rust text.
fn elementary_sin_cos_turns(turns: f32) -> vec2<f32> {
    let quarter = floor(4.0 * turns + 0.5);
    let u = turns - 0.25 * quarter;
    let square = u * u;
    let p = horner_sine(square);
    let sine = p * u;
    let q = horner_cosine(square);
    let cosine = q * square + 1.0;
    let turn = quarter - 4.0 * floor(0.25 * quarter);
    let odd = turn - 2.0 * floor(0.5 * turn) > 0.5;
    let s = select(sine, cosine, odd);
    let c = select(cosine, sine, odd);
    let sine_negative = turn > 1.5;
    let cosine_negative = abs(turn - 1.5) < 1.0;
    return vec2(select(s, -s, sine_negative), select(c, -c, cosine_negative));
}
