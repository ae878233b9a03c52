//! needs: math/elementary, math/vec, brdf/ggx, sg/asg, sg/lobe
// Lobes of reflected directions from lobes of normals: twin of `vsgl-core/src/sg/warp.rs`.

fn warp_normal_sharpness(alpha: f32) -> f32 {
    return min(2.0 / max(alpha * alpha, 1e-12), SHARPNESS_MAX);
}

fn warp_reflection_sg(view: vec3<f32>, normal: vec3<f32>, alpha: f32) -> SgLobe {
    let cosine = max(abs(dot(view, normal)), 1e-4);
    return sg_lobe_new(vec_reflect(view, normal), warp_normal_sharpness(alpha) / (4.0 * cosine));
}

fn warp_reflection_asg_local(view: vec3<f32>, alpha_x: f32, alpha_y: f32) -> AsgLobe {
    let cosine = max(abs(view.z), 1e-4);
    let axis = vec_normalize(vec3(-view.x, -view.y, cosine));
    let flat2 = view.x * view.x + view.y * view.y;
    let flat = sqrt(flat2);
    let upright = flat2 < 1e-12;
    let vx = select(view.x / max(flat, 1e-6), 1.0, upright);
    let vy = select(view.y / max(flat, 1e-6), 0.0, upright);
    let plane = vec3(vx * axis.z, vy * axis.z, sqrt(max(1.0 - axis.z * axis.z, 0.0)));
    let across = cross(axis, plane);
    let px = 1.0 / max(alpha_x * alpha_x, 1e-12);
    let py = 1.0 / max(alpha_y * alpha_y, 1e-12);
    let step = 0.5 / cosine;
    let m11 = 0.25 * (px * (vx * vx) + py * (vy * vy));
    let m22 = step * step * (px * (vy * vy) + py * (vx * vx));
    let mixed = 0.5 * step * ((py - px) * (vx * vy));
    let middle = 0.5 * (m11 + m22);
    let unit = 1.0 / middle;
    let apart = 0.5 * (m11 - m22) * unit;
    let m12 = mixed * unit;
    let radius = sqrt(apart * apart + m12 * m12);
    let first = apart >= 0.0;
    let row_x = select(m12, apart + radius, first);
    let row_y = select(radius - apart, m12, first);
    let length = sqrt(row_x * row_x + row_y * row_y);
    let round = length < 1e-12;
    let inverse = 1.0 / select(length, 1.0, round);
    let ex = select(row_x * inverse, 1.0, round);
    let ey = select(row_y * inverse, 0.0, round);
    let larger = middle + middle * radius;
    let determinant = 0.25 * step * step * (px * py);
    return AsgLobe(
        plane * ex + across * ey,
        across * ex - plane * ey,
        axis,
        min(larger, SHARPNESS_MAX),
        min(determinant / larger, SHARPNESS_MAX),
    );
}

fn warp_glossy_asg_2015(view: vec3<f32>, normal: vec3<f32>, alpha: f32, axis: vec3<f32>, sharpness: f32) -> f32 {
    let lobe = asg_reflection_lobe(view, normal, 0.5 * warp_normal_sharpness(alpha));
    let surface = warp_reflection_sg(view, normal, alpha);
    let middle = vec_normalize(axis * min(sharpness, SHARPNESS_MAX) + lobe.z * surface.sharpness);
    return asg_lobe_product_integral(lobe, axis, sharpness) * warp_rest(view, normal, alpha, middle);
}

fn warp_glossy_asg_2016(view: vec3<f32>, normal: vec3<f32>, alpha: f32, axis: vec3<f32>, sharpness: f32) -> f32 {
    let lobe = asg_reflection_lobe(view, normal, 0.5 * warp_normal_sharpness(alpha));
    return asg_lobe_product_integral(lobe, axis, sharpness) * warp_rest(view, normal, alpha, axis);
}

fn warp_rest(view: vec3<f32>, normal: vec3<f32>, alpha: f32, light: vec3<f32>) -> f32 {
    let alpha2 = max(alpha * alpha, 1e-12);
    let v = max(dot(view, normal), 1e-6);
    let o = max(dot(light, normal), 0.0);
    let sum = ggx_reach(v, alpha2) * o + ggx_reach(o, alpha2) * v;
    return o / (2.0 * PI * alpha2 * max(sum, 1e-18));
}

fn warp_glossy_sg_2015(view: vec3<f32>, normal: vec3<f32>, alpha: f32, axis: vec3<f32>, sharpness: f32) -> f32 {
    let surface = warp_reflection_sg(view, normal, alpha);
    let log_norm = lobe_log_integral(surface.sharpness);
    let log_product = lobe_log_inner_product(surface.axis, surface.sharpness, axis, sharpness);
    return elementary_exp(log_product - log_norm);
}
