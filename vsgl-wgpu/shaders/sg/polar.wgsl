//! needs: math/elementary
// Moments of a lobe over its own hemisphere: twin of `vsgl-core/src/sg/polar.rs`.

struct PolarMoments {
    decay: f32,
    mass: f32,
    upper: f32,
    lower: f32,
}

fn polar_moments_new(sharpness: f32) -> PolarMoments {
    let k = min(sharpness, SHARPNESS_MAX);
    let decay = elementary_exp(-k);
    let inverse = 1.0 / max(k, 1.0);
    let mass_far = (1.0 - decay) * inverse;
    let upper_far = (1.0 - mass_far) * inverse;
    let lower_far = (mass_far - decay) * inverse;
    let near = min(k, 1.0);
    let p = horner_polar_upper(near);
    let mass_near = 1.0 - near * p;
    let lower_near = mass_near - p;
    let small = k < 1.0;
    return PolarMoments(
        decay,
        select(mass_far, mass_near, small),
        select(upper_far, p, small),
        select(lower_far, lower_near, small),
    );
}

fn polar_moments_sphere(own: PolarMoments) -> f32 {
    return own.mass * (1.0 + own.decay);
}
