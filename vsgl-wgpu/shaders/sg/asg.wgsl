//! needs: math/elementary, math/vec
// Anisotropic spherical Gaussians: twin of `vsgl-core/src/sg/asg.rs`.

struct AsgLobe {
    x: vec3<f32>,
    y: vec3<f32>,
    z: vec3<f32>,
    sharpness_x: f32,
    sharpness_y: f32,
}

fn asg_lobe_evaluate(own: AsgLobe, direction: vec3<f32>) -> f32 {
    let x = dot(direction, own.x);
    let y = dot(direction, own.y);
    let exponent = (own.sharpness_x * x) * x + (own.sharpness_y * y) * y;
    return max(dot(direction, own.z), 0.0) * elementary_exp(-exponent);
}

fn asg_lobe_product_integral(own: AsgLobe, axis: vec3<f32>, sharpness: f32) -> f32 {
    let half = 0.5 * min(sharpness, SHARPNESS_MAX);
    let eta_x = min(own.sharpness_x, SHARPNESS_MAX);
    let eta_y = min(own.sharpness_y, SHARPNESS_MAX);
    let sum_x = max(eta_x + half, 1e-6);
    let sum_y = max(eta_y + half, 1e-6);
    let wide = AsgLobe(own.x, own.y, own.z, eta_x * (half / sum_x), eta_y * (half / sum_y));
    return PI * asg_lobe_evaluate(wide, axis) / (sqrt(sum_x) * sqrt(sum_y));
}

fn asg_reflection_lobe(view: vec3<f32>, normal: vec3<f32>, half_sharpness: f32) -> AsgLobe {
    let cosine = max(abs(dot(view, normal)), 1e-6);
    let z = vec_normalize(vec_reflect(view, normal));
    let across = cross(view, normal);
    let squared = dot(across, across);
    let any_tangent = vec_orthonormal_basis(z).x;
    let raw = select(across, any_tangent, squared < 1e-12);
    let x = vec_normalize(raw - z * dot(z, raw));
    let y = cross(z, x);
    let quarter = 0.25 * half_sharpness;
    return AsgLobe(x, y, z, min(quarter / (cosine * cosine), SHARPNESS_MAX), quarter);
}
