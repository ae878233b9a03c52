//! needs: brdf/ggx
// Directional albedo of the GGX lobe: twin of `vsgl-core/src/brdf/albedo.rs`.

struct Albedo {
    a: f32,
    b: f32,
}

fn albedo_weigh(own: Albedo, f0: vec3<f32>, f90: vec3<f32>) -> vec3<f32> {
    return f0 * own.a + f90 * own.b;
}

fn albedo_ggx_albedo(cosine: f32, roughness: f32) -> Albedo {
    let alpha = clamp(roughness, 5e-4, 1.0);
    let mu = clamp(cosine, 0.0, 1.0);
    let s = ggx_reach(mu, alpha * alpha);
    let p = mu / s;
    let r = sqrt(alpha);

    let above_0 = horner_albedo_above_0(alpha);
    let above_1 = horner_albedo_above_1(alpha);
    let above_2 = horner_albedo_above_2(alpha);
    let above = ((ALBEDO_ABOVE_3 * p + above_2) * p + above_1) * p + above_0;
    let below_0 = horner_albedo_below_0(alpha);
    let below_1 = horner_albedo_below_1(alpha);
    let below = (ALBEDO_BELOW_2 * p + below_1) * p + below_0;
    let total = clamp(1.0 - above / below, 0.0, 1.0);

    let c00 = horner_effective_00(s);
    let c01 = horner_effective_01(s);
    let c02 = horner_effective_02(s);
    let c0 = ((EFFECTIVE_03 * r + c02) * r + c01) * r + c00;
    let c10 = horner_effective_10(s);
    let c11 = horner_effective_11(s);
    let c1 = (EFFECTIVE_12 * r + c11) * r + c10;
    let c2 = EFFECTIVE_21 * r + horner_effective_20(s);
    let effective = ((EFFECTIVE_30 * p + c2) * p + c1) * p + c0;
    let bend = 1.0 - clamp(effective, 0.0, 1.0);
    let square = bend * bend;
    let b = total * (square * square * bend);
    return Albedo(total - b, b);
}
