//! needs: sg/cosine, sg/glossy, sg/hemisphere, sg/lobe
// NDF filtering in a tangent frame, anisotropic, and refraction: twin of `vsgl-core/src/sg/filtering.rs`.

struct FilteredView {
    view: vec3<f32>,
    ax: f32,
    ay: f32,
    cx: f32,
    cy: f32,
    outgoing: vec3<f32>,
    quarter: f32,
    cos2: f32,
    constant: f32,
    inverse_index2: f32,
    reach: f32,
}

struct Filtered {
    determinant: f32,
    numerator: f32,
    inverse: f32,
    k: f32,
    bent: f32,
}

fn filtered_view_reflection(direction: vec3<f32>, alpha_x: f32, alpha_y: f32) -> FilteredView {
    let z = max(direction.z, VIEW_COSINE_MIN);
    let view = vec3(direction.x, direction.y, z);
    let cos2 = z * z;
    return filtered_view_new(view, alpha_x, alpha_y, vec3(-view.x, -view.y, z), cos2, cos2, 0.25, 1.0);
}

fn filtered_view_refraction(direction: vec3<f32>, alpha_x: f32, alpha_y: f32, index: f32) -> FilteredView {
    let z = max(direction.z, VIEW_COSINE_MIN);
    let view = vec3(direction.x, direction.y, z);
    let excess = (index - 1.0) * (index + 1.0);
    let bent = sqrt(max(excess + z * z, 0.0));
    let inverse = 1.0 / max(index, 1e-3);
    let outgoing = vec3(-view.x * inverse, -view.y * inverse, -bent * inverse);
    let cos2 = max(outgoing.z * outgoing.z, 1e-12);
    let denominator = max(abs(excess / (bent + z)), 1e-4) * inverse;
    let m2 = denominator * denominator;
    return filtered_view_new(
        view, alpha_x, alpha_y, outgoing, cos2, 0.25 * m2, cos2 / m2, inverse * inverse,
    );
}

fn filtered_view_new(
    view: vec3<f32>,
    roughness_x: f32,
    roughness_y: f32,
    direction: vec3<f32>,
    cos2: f32,
    quarter: f32,
    constant: f32,
    inverse_index2: f32,
) -> FilteredView {
    let alpha_x = clamp(roughness_x, GLOSSY_ALPHA_MIN, 1.0);
    let alpha_y = clamp(roughness_y, GLOSSY_ALPHA_MIN, 1.0);
    let ax = alpha_x * alpha_x;
    let ay = alpha_y * alpha_y;
    let cx = max((1.0 - alpha_x) * (1.0 + alpha_x), REST_MIN);
    let cy = max((1.0 - alpha_y) * (1.0 + alpha_y), REST_MIN);
    let wide = max(ax, ay);
    let sharpness = 0.5 * min(cx, cy) / wide;
    let reach = sqrt(ax * (view.x * view.x) + ay * (view.y * view.y) + view.z * view.z);
    let outgoing = direction * sharpness;
    return FilteredView(view, ax, ay, cx, cy, outgoing, quarter, cos2, constant, inverse_index2, reach);
}

fn filtered_view_filter(own: FilteredView, sharpness: f32) -> Filtered {
    let k = min(sharpness, SHARPNESS_MAX);
    let g11 = own.cos2 + own.view.y * own.view.y * own.inverse_index2;
    let g22 = own.cos2 + own.view.x * own.view.x * own.inverse_index2;
    let both = own.cx * own.cy;
    let crossed = 0.5 * (own.ax * own.cy * g22 + own.ay * own.cx * g11);
    let constant = both * own.constant;
    let numerator = (own.quarter * own.ax * own.ay * k + crossed) * k + constant;
    let bent = 0.5 * both * k;
    let denominator = (own.quarter * k + (crossed + 0.5 * both * (g11 + g22))) * k + constant;
    let inverse = 1.0 / max(denominator, F32_MIN_POSITIVE);
    return Filtered(numerator * inverse, numerator, inverse, k, bent);
}

fn filtered_view_half_form(own: FilteredView, f: Filtered, half: vec3<f32>) -> f32 {
    let x2 = half.x * half.x;
    let y2 = half.y * half.y;
    let along = half.x * own.view.x + half.y * own.view.y;
    let plain = own.quarter * f.k * f.k * (own.ay * own.cx * x2 + own.ax * own.cy * y2);
    let bent = f.bent * (own.cos2 * (x2 + y2) + along * along * own.inverse_index2);
    let above = plain + bent + f.numerator * (x2 + y2);
    return max(above * f.inverse + f.determinant * (half.z * half.z), F32_MIN_POSITIVE);
}

fn filtered_view_area(own: FilteredView, f: Filtered) -> f32 {
    let x2 = own.view.x * own.view.x;
    let y2 = own.view.y * own.view.y;
    let plain = own.quarter * f.k * f.k * (own.ax * own.cy * x2 + own.ay * own.cx * y2);
    let above = plain + (f.bent * own.cos2 + f.numerator) * (x2 + y2);
    return sqrt(above * f.inverse + own.view.z * own.view.z);
}

fn filtered_view_reflected_density(own: FilteredView, axis: vec3<f32>, sharpness: f32) -> f32 {
    let f = filtered_view_filter(own, sharpness);
    let half = own.view + axis;
    let length2 = dot(half, half);
    let form = filtered_view_half_form(own, f, half);
    let shape = sqrt(f.determinant) * (f.determinant * length2 / form) * (length2 / form);
    return shape / (4.0 * PI * filtered_view_area(own, f));
}

fn filtered_view_density(own: FilteredView, axis: vec3<f32>, sharpness: f32) -> f32 {
    let f = filtered_view_filter(own, sharpness);
    let half = own.view + axis;
    let length2 = dot(half, half);
    let form = filtered_view_half_form(own, f, half);
    let root = sqrt(f.determinant);
    let density = root * (f.determinant * length2 / form) * (length2 / form)
        / (4.0 * PI * filtered_view_area(own, f));
    let level = max(f.determinant * (half.z * half.z), F32_MIN_POSITIVE);
    let unblurred = sqrt(own.ax * own.ay) / max(root, F32_MIN_POSITIVE);
    return glossy_core_on_tail(unblurred, root, form / level) * density;
}

fn filtered_view_refracted_density(own: FilteredView, axis: vec3<f32>, sharpness: f32, index: f32) -> f32 {
    let f = filtered_view_filter(own, sharpness);
    let half = own.view + axis * index;
    let form = filtered_view_half_form(own, f, half);
    let view_side = dot(own.view, half);
    let light_side = dot(axis, half);
    let crossing = max(-view_side * light_side, 0.0);
    let shape = sqrt(f.determinant) * (f.determinant / form) * (crossing / form);
    let transmitted = select(0.0, shape, own.outgoing.z < 0.0);
    return transmitted * (index * index) / (PI * filtered_view_area(own, f));
}

// Share above the surface, and that times masking.
fn filtered_view_shares(own: FilteredView, axis: vec3<f32>, sharpness: f32, side: f32) -> vec2<f32> {
    let sum = own.outgoing + axis * min(sharpness, SHARPNESS_MAX);
    let length = sqrt(dot(sum, sum));
    let z = clamp(side * sum.z / max(length, 1e-18), -1.0, 1.0);
    let k = min(length, SHARPNESS_MAX);
    let share = hemisphere_share_2022(k, z);
    let mean = cosine_mean_clamped_cosine(k, z);
    let x2 = sum.x * sum.x;
    let y2 = sum.y * sum.y;
    let weight = x2 + y2;
    let mixed = (own.ax * x2 + own.ay * y2) / max(weight, 1e-30);
    let a = select(max(own.ax, own.ay), mixed, weight > 1e-30);
    let light_reach = sqrt(a * (share * share) + max(1.0 - a, 0.0) * (mean * mean));
    let above = 2.0 * mean * own.reach * share;
    return vec2(share, above / max(own.reach * mean + own.view.z * light_reach, 1e-30));
}

fn filtered_view_filtered_2024(own: FilteredView, axis: vec3<f32>, sharpness: f32) -> f32 {
    return filtered_view_shares(own, axis, sharpness, 1.0).x
        * filtered_view_reflected_density(own, axis, sharpness);
}

fn filtered_view_masked(own: FilteredView, axis: vec3<f32>, sharpness: f32, horizon_sharpness: f32) -> f32 {
    return filtered_view_shares(own, axis, horizon_sharpness, 1.0).y
        * filtered_view_density(own, axis, sharpness);
}

fn filtered_view_transmitted_2024(own: FilteredView, axis: vec3<f32>, sharpness: f32, index: f32) -> f32 {
    return filtered_view_shares(own, axis, sharpness, -1.0).x
        * filtered_view_refracted_density(own, axis, sharpness, index);
}

fn filtering_masked(view: vec3<f32>, alpha_x: f32, alpha_y: f32, axis: vec3<f32>, sharpness: f32) -> f32 {
    return filtered_view_masked(filtered_view_reflection(view, alpha_x, alpha_y), axis, sharpness, sharpness)
        * lobe_integral(sharpness);
}

fn filtering_filtered_2024(view: vec3<f32>, alpha_x: f32, alpha_y: f32, axis: vec3<f32>, sharpness: f32) -> f32 {
    return filtered_view_filtered_2024(filtered_view_reflection(view, alpha_x, alpha_y), axis, sharpness)
        * lobe_integral(sharpness);
}
