//! needs: math/elementary, math/vec, brdf/albedo, sg/cosine, sg/hemisphere, sg/lobe
// Isotropic GGX under a spherical Gaussian light by NDF filtering: twin of `vsgl-core/src/sg/glossy.rs`.

// `det`, `den` and `spread` are arrays in the Rust text.
struct GlossyView {
    view: vec3<f32>,
    normal: vec3<f32>,
    cross: vec3<f32>,
    view_cosine: f32,
    view_sine2: f32,
    view_reach: f32,
    alpha2: f32,
    rest: f32,
    mirrored: vec3<f32>,
    albedo: f32,
    reflected: vec3<f32>,
    det: vec3<f32>,
    den: vec2<f32>,
    spread: vec2<f32>,
}

struct Blur {
    density: f32,
    root: f32,
    slope: f32,
    own: f32,
}

fn glossy_view_new(view: vec3<f32>, normal: vec3<f32>, roughness: f32) -> GlossyView {
    let alpha = clamp(roughness, GLOSSY_ALPHA_MIN, 1.0);
    let alpha2 = alpha * alpha;
    let rest = max((1.0 - alpha) * (1.0 + alpha), REST_MIN);
    let view_cosine = max(dot(view, normal), VIEW_COSINE_MIN);
    let cosine2 = view_cosine * view_cosine;
    let crossed = cross(normal, view);
    let view_sine2 = dot(crossed, crossed);
    let both = 1.0 + cosine2;
    let mirrored = vec_reflect(view, normal);
    let albedo = albedo_ggx_albedo(view_cosine, alpha);
    return GlossyView(
        view,
        normal,
        crossed,
        view_cosine,
        view_sine2,
        sqrt(alpha2 * view_sine2 + cosine2),
        alpha2,
        rest,
        mirrored,
        albedo.a + albedo.b,
        mirrored * (0.5 * rest / alpha2),
        vec3(0.25 * rest * rest, 0.5 * alpha2 * rest * both, cosine2 * alpha2 * alpha2),
        vec2(0.5 * rest * both, cosine2),
        vec2(0.5 * rest * rest, cosine2 * alpha2 * rest),
    );
}

fn glossy_view_view_cosine(own: GlossyView) -> f32 {
    return own.view_cosine;
}

fn glossy_view_alpha2(own: GlossyView) -> f32 {
    return own.alpha2;
}

fn glossy_view_blur(own: GlossyView, axis: vec3<f32>, sharpness: f32) -> Blur {
    let k = min(sharpness, SHARPNESS_MAX);
    let half = own.view + axis;
    let length2 = dot(half, half);
    let tangent = cross(own.normal, half);
    let tangent2 = dot(tangent, tangent);
    let upright = dot(own.normal, half);
    let along = dot(tangent, own.cross);
    let cosine2 = own.view_cosine * own.view_cosine;

    let det_above = (own.det[2] * k + own.det[1]) * k + own.det[0];
    let inverse = 1.0 / ((own.den[1] * k + own.den[0]) * k + own.det[0]);
    let det = det_above * inverse;
    let bent = cosine2 * tangent2 + along * along;
    let form_above = (own.spread[1] * tangent2 * k + own.spread[0] * bent) * k + det_above * tangent2;
    let level = max(det * (upright * upright), F32_MIN_POSITIVE);
    let form = max(form_above * inverse + level, F32_MIN_POSITIVE);
    let view_above = ((own.spread[1] * k + own.spread[0] * cosine2) * k + det_above) * own.view_sine2;
    let area = sqrt(view_above * inverse + cosine2);
    let root = sqrt(det);
    let density = root * (det * length2 / form) * (length2 / form) / (4.0 * PI * area);
    return Blur(density, root, form / level, sqrt(own.det[2] * k * k / det_above));
}

fn glossy_core_on_tail(unblurred: f32, root: f32, steepness: f32) -> f32 {
    let tail = min(unblurred + (1.0 - unblurred) * (root * root), 1.0);
    let core = 1.0 - tail;
    let core2 = core * core;
    let core4 = core2 * core2;
    let core8 = core4 * core4;
    let core16 = core8 * core8;
    let sharp = CORE_SLIGHT + CORE_LINEAR * core + CORE_STRONG * (core16 * core16);
    let slope = min(steepness, 1e12);
    let gaussian = sharp * elementary_exp(sharp - sharp * slope) * (slope * slope);
    return tail + core * gaussian;
}

fn glossy_view_density_2024(own: GlossyView, axis: vec3<f32>, sharpness: f32) -> f32 {
    return glossy_view_blur(own, axis, sharpness).density;
}

fn glossy_view_density(own: GlossyView, axis: vec3<f32>, sharpness: f32) -> f32 {
    let blur = glossy_view_blur(own, axis, sharpness);
    return glossy_core_on_tail(own.alpha2 / blur.root, blur.root, blur.slope) * blur.density;
}

// Sharpness and cosine.
fn glossy_view_horizon_lobe(own: GlossyView, axis: vec3<f32>, sharpness: f32) -> vec2<f32> {
    let sum = own.reflected + axis * min(sharpness, SHARPNESS_MAX);
    let length = sqrt(dot(sum, sum));
    let z = dot(sum, own.normal) / max(length, 1e-18);
    return vec2(min(length, SHARPNESS_MAX), clamp(z, -1.0, 1.0));
}

fn glossy_view_share(own: GlossyView, axis: vec3<f32>, sharpness: f32) -> f32 {
    let h = glossy_view_horizon_lobe(own, axis, sharpness);
    return hemisphere_share_2022(h.x, h.y);
}

fn glossy_view_masked_share(own: GlossyView, axis: vec3<f32>, sharpness: f32) -> f32 {
    let h = glossy_view_horizon_lobe(own, axis, sharpness);
    let share = hemisphere_share_2022(h.x, h.y);
    let mean = cosine_mean_clamped_cosine(h.x, h.y);
    let light_reach = sqrt(own.alpha2 * (share * share) + own.rest * (mean * mean));
    let above = 2.0 * mean * own.view_reach * share;
    let below = own.view_reach * mean + own.view_cosine * light_reach;
    return above / max(below, 1e-30);
}

fn glossy_view_masked(own: GlossyView, axis: vec3<f32>, sharpness: f32, horizon_sharpness: f32) -> f32 {
    return glossy_view_masked_share(own, axis, horizon_sharpness) * glossy_view_density(own, axis, sharpness);
}

fn glossy_view_filtered_2024(own: GlossyView, axis: vec3<f32>, sharpness: f32) -> f32 {
    return glossy_view_share(own, axis, sharpness) * glossy_view_density_2024(own, axis, sharpness);
}

fn glossy_masked(view: vec3<f32>, normal: vec3<f32>, alpha: f32, axis: vec3<f32>, sharpness: f32) -> f32 {
    return glossy_view_masked(glossy_view_new(view, normal, alpha), axis, sharpness, sharpness)
        * lobe_integral(sharpness);
}

fn glossy_filtered_2024(view: vec3<f32>, normal: vec3<f32>, alpha: f32, axis: vec3<f32>, sharpness: f32) -> f32 {
    return glossy_view_filtered_2024(glossy_view_new(view, normal, alpha), axis, sharpness)
        * lobe_integral(sharpness);
}
