//! needs: math/elementary, math/vec, brdf/roughness, brdf/visible
// Beckmann's distribution with any roughness matrix, in a tangent frame: twin of `vsgl-core/src/brdf/beckmann.rs`.

fn beckmann_distribution(half: vec3<f32>, roughness: Roughness) -> f32 {
    let z = max(half.z, 1e-18);
    let ratio = dot(half, half) / (z * z);
    let exponent = min(roughness_inverse_form(roughness, half.x / z, half.y / z), 1e38);
    let peak = (min(ratio, 1e18) * min(ratio, 1e18)) / (PI * sqrt(roughness.determinant));
    let value = elementary_exp(-exponent) * min(peak, 1e37);
    return select(0.0, value, half.z > 0.0);
}

fn beckmann_log_distribution(half: vec3<f32>, roughness: Roughness) -> f32 {
    let z = max(half.z, 1e-18);
    let length2 = max(dot(half, half), F32_MIN_POSITIVE);
    let x = half.x / z;
    let y = half.y / z;
    let exponent = min(roughness_inverse_form(roughness, x, y), 1e38);
    let cos2 = max(z * z / length2, F32_MIN_POSITIVE);
    let value = -exponent - elementary_log(PI * sqrt(roughness.determinant)) - 2.0 * elementary_log(cos2);
    return select(-F32_MAX, value, half.z > 0.0);
}

fn beckmann_projected_area(direction: vec3<f32>, roughness: Roughness) -> f32 {
    let root = max(sqrt(roughness_form(roughness, direction.x, direction.y)), 1e-18);
    let z = abs(direction.z);
    let a = z / root;
    return z * elementary_erf(a) + root * INV_SQRT_PI * elementary_exp(-min(a * a, 1e4));
}

fn beckmann_lambda(direction: vec3<f32>, roughness: Roughness) -> f32 {
    let root = max(sqrt(roughness_form(roughness, direction.x, direction.y)), 1e-18);
    let a = max(abs(direction.z) / root, 1e-9);
    return 0.5 * elementary_erfc_integral(a) / a;
}

fn beckmann_reflectance(view: vec3<f32>, light: vec3<f32>, roughness: Roughness) -> f32 {
    let area = beckmann_projected_area(view, roughness) * light.z
        + beckmann_projected_area(light, roughness) * view.z;
    let value = beckmann_distribution(view + light, roughness) * (0.5 / max(area, 5e-10));
    return select(0.0, value, min(view.z, light.z) > 0.0);
}

fn beckmann_visible_slope(cosine: f32, sine: f32, u: f32) -> f32 {
    let cot = cosine / max(sine, 1e-9);
    let end = elementary_erfc(-cot);
    let all_slopes = cosine * end + sine * INV_SQRT_PI * elementary_exp(-min(cot * cot, 1e4));
    let goal = u * all_slopes;
    let rest = max(1.0 - u, 0.0);
    let bend = min(1.65 * sine, 1.0);
    var beta = end * (1.0 - (rest + bend * (sqrt(rest) - rest)));
    beta = beckmann_towards(beta, goal, cosine, sine, end);
    beta = beckmann_towards(beta, goal, cosine, sine, end);
    beta = beckmann_towards(beta, goal, cosine, sine, end);
    beta = beckmann_towards(beta, goal, cosine, sine, end);
    return elementary_erfc_inverse(beta);
}

fn beckmann_towards(beta: f32, goal: f32, cosine: f32, sine: f32, end: f32) -> f32 {
    let slope = elementary_erfc_inverse(beta);
    let value = cosine * beta + sine * INV_SQRT_PI * elementary_exp(-slope * slope);
    let derivative = max(cosine + sine * slope, 1e-6);
    return max(min(beta + (goal - value) / derivative, end), 1e-7);
}

fn beckmann_sample_visible_normal(view: vec3<f32>, roughness: Roughness, u: f32, v: f32) -> vec3<f32> {
    let factor = roughness_factor(roughness);
    let xx = factor.x;
    let yx = factor.y;
    let yy = factor.z;
    let seen = vec_normalize(vec3(xx * view.x + yx * view.y, yy * view.y, max(view.z, 0.0)));
    let sine = sqrt(seen.x * seen.x + seen.y * seen.y);
    let tilted = sine > 1e-12;
    let turn_x = select(1.0, seen.x / max(sine, 1e-12), tilted);
    let turn_y = select(0.0, seen.y / max(sine, 1e-12), tilted);
    let along = beckmann_visible_slope(seen.z, sine, u);
    let across = elementary_erfc_inverse(2.0 * v);
    let x = turn_x * along - turn_y * across;
    let y = turn_y * along + turn_x * across;
    return vec_normalize(vec3(xx * x, yx * x + yy * y, 1.0));
}

fn beckmann_visible_normal_density(view: vec3<f32>, half: vec3<f32>, roughness: Roughness) -> f32 {
    let d = beckmann_distribution(half, roughness);
    return visible_normal_density(d, dot(view, half), view.z, beckmann_projected_area(view, roughness));
}

fn beckmann_reflected_density(view: vec3<f32>, light: vec3<f32>, roughness: Roughness) -> f32 {
    let d = beckmann_distribution(view + light, roughness);
    return visible_reflected_density(d, view.z, beckmann_projected_area(view, roughness));
}

fn beckmann_sample_weight(view: vec3<f32>, light: vec3<f32>, roughness: Roughness) -> f32 {
    let view_area = beckmann_projected_area(view, roughness);
    let light_area = beckmann_projected_area(light, roughness);
    return visible_sample_weight(view.z, light.z, view_area, light_area);
}
