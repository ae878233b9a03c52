//! needs: math/elementary, math/vec, brdf/roughness, brdf/visible
// GGX with any roughness matrix, in a tangent frame: twin of `vsgl-core/src/brdf/ggx_local.rs`.

fn ggx_local_distribution(half: vec3<f32>, roughness: Roughness) -> f32 {
    let length2 = dot(half, half);
    let form = max(roughness_inverse_form(roughness, half.x, half.y) + half.z * half.z, F32_MIN_POSITIVE);
    let ratio = length2 / form;
    let value = ratio * ratio / (PI * sqrt(roughness.determinant));
    return select(0.0, value, half.z > 0.0);
}

fn ggx_local_projected_area(direction: vec3<f32>, roughness: Roughness) -> f32 {
    return sqrt(roughness_form(roughness, direction.x, direction.y) + direction.z * direction.z);
}

fn ggx_local_lambda(direction: vec3<f32>, roughness: Roughness) -> f32 {
    let z = max(abs(direction.z), 1e-9);
    let k = sqrt(roughness_form(roughness, direction.x, direction.y)) / z;
    let k2 = k * k;
    return 0.5 * k2 / (sqrt(k2 + 1.0) + 1.0);
}

fn ggx_local_reflectance(view: vec3<f32>, light: vec3<f32>, roughness: Roughness) -> f32 {
    let area = ggx_local_projected_area(view, roughness) * light.z
        + ggx_local_projected_area(light, roughness) * view.z;
    let value = ggx_local_distribution(view + light, roughness) * (0.5 / max(area, 5e-10));
    return select(0.0, value, min(view.z, light.z) > 0.0);
}

fn ggx_local_sample_visible_normal(view: vec3<f32>, roughness: Roughness, u: f32, v: f32) -> vec3<f32> {
    let factor = roughness_factor(roughness);
    let xx = factor.x;
    let yx = factor.y;
    let yy = factor.z;
    let seen = vec_normalize(vec3(xx * view.x + yx * view.y, yy * view.y, view.z));
    let z = (1.0 - v) * (1.0 + seen.z) - seen.z;
    let ring = sqrt(max((1.0 - z) * (1.0 + z), 0.0));
    let turn = elementary_sin_cos_turns(u);
    let half = vec3(ring * turn.y + seen.x, ring * turn.x + seen.y, z + seen.z);
    return vec_normalize(vec3(xx * half.x, yx * half.x + yy * half.y, max(half.z, 0.0)));
}

fn ggx_local_visible_normal_density(view: vec3<f32>, half: vec3<f32>, roughness: Roughness) -> f32 {
    let d = ggx_local_distribution(half, roughness);
    return visible_normal_density(d, dot(view, half), view.z, ggx_local_projected_area(view, roughness));
}

fn ggx_local_reflected_density(view: vec3<f32>, light: vec3<f32>, roughness: Roughness) -> f32 {
    let d = ggx_local_distribution(view + light, roughness);
    return visible_reflected_density(d, view.z, ggx_local_projected_area(view, roughness));
}

fn ggx_local_sample_weight(view: vec3<f32>, light: vec3<f32>, roughness: Roughness) -> f32 {
    let view_area = ggx_local_projected_area(view, roughness);
    let light_area = ggx_local_projected_area(light, roughness);
    return visible_sample_weight(view.z, light.z, view_area, light_area);
}
