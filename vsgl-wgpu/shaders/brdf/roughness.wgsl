// Roughness matrices: twin of `vsgl-core/src/brdf/roughness.rs`.

struct Roughness {
    xx: f32,
    xy: f32,
    yy: f32,
    determinant: f32,
}

fn roughness_isotropic(alpha: f32) -> Roughness {
    return roughness_aligned(alpha, alpha);
}

fn roughness_aligned(alpha_x: f32, alpha_y: f32) -> Roughness {
    let root = alpha_x * alpha_y;
    return Roughness(alpha_x * alpha_x, 0.0, alpha_y * alpha_y, max(root * root, DETERMINANT_MIN));
}

fn roughness_rotated(alpha_x: f32, alpha_y: f32, cosine: f32, sine: f32) -> Roughness {
    let x2 = alpha_x * alpha_x;
    let y2 = alpha_y * alpha_y;
    let root = alpha_x * alpha_y;
    return Roughness(
        x2 * (cosine * cosine) + y2 * (sine * sine),
        (alpha_x - alpha_y) * (alpha_x + alpha_y) * (cosine * sine),
        x2 * (sine * sine) + y2 * (cosine * cosine),
        max(root * root, DETERMINANT_MIN),
    );
}

fn roughness_from_entries(xx: f32, xy: f32, yy: f32) -> Roughness {
    return Roughness(xx, xy, yy, max(xx * yy - xy * xy, DETERMINANT_MIN));
}

fn roughness_form(own: Roughness, x: f32, y: f32) -> f32 {
    let xx = max(own.xx, F32_MIN_POSITIVE);
    let inner = x + (own.xy / xx) * y;
    return inner * inner * xx + (own.determinant / xx) * (y * y);
}

fn roughness_inverse_form(own: Roughness, x: f32, y: f32) -> f32 {
    let xx = max(own.xx, F32_MIN_POSITIVE);
    let inner = y - (own.xy / xx) * x;
    return x * x / xx + inner * inner * (xx / own.determinant);
}

// The entries xx, yx, yy.
fn roughness_factor(own: Roughness) -> vec3<f32> {
    let root = sqrt(max(own.xx, F32_MIN_POSITIVE));
    return vec3(root, own.xy / root, sqrt(own.determinant) / root);
}
