//! needs: brdf/ggx_local, brdf/roughness, math/vec, sg/asg, sg/filtering, sg/lobe, sg/warp
// Glossy reflection by a surface with two roughnesses, in world space: twin of `vsgl-core/src/sg/anisotropic.rs`.

struct Frame {
    tangent: vec3<f32>,
    bitangent: vec3<f32>,
    normal: vec3<f32>,
}

fn frame_new(normal: vec3<f32>, tangent: vec3<f32>) -> Frame {
    let bitangent = vec_normalize(cross(normal, tangent));
    return Frame(cross(bitangent, normal), bitangent, normal);
}

fn frame_local(own: Frame, v: vec3<f32>) -> vec3<f32> {
    return vec3(dot(v, own.tangent), dot(v, own.bitangent), dot(v, own.normal));
}

struct AnisotropicView {
    frame: Frame,
    local: FilteredView,
}

fn anisotropic_view_new(view: vec3<f32>, normal: vec3<f32>, tangent: vec3<f32>, along: f32, across: f32) -> AnisotropicView {
    let frame = frame_new(normal, tangent);
    return AnisotropicView(frame, filtered_view_reflection(frame_local(frame, view), along, across));
}

fn anisotropic_view_masked(own: AnisotropicView, axis: vec3<f32>, sharpness: f32, horizon_sharpness: f32) -> f32 {
    return filtered_view_masked(own.local, frame_local(own.frame, axis), sharpness, horizon_sharpness);
}

fn anisotropic_view_filtered_2024(own: AnisotropicView, axis: vec3<f32>, sharpness: f32) -> f32 {
    return filtered_view_filtered_2024(own.local, frame_local(own.frame, axis), sharpness);
}

fn anisotropic_reflectance(view: vec3<f32>, light: vec3<f32>, frame: Frame, along: f32, across: f32) -> f32 {
    let roughness = roughness_aligned(along, across);
    return ggx_local_reflectance(frame_local(frame, view), frame_local(frame, light), roughness);
}

fn anisotropic_glossy_asg(
    eye: vec3<f32>,
    frame: Frame,
    along: f32,
    across: f32,
    axis: vec3<f32>,
    sharpness: f32,
) -> f32 {
    let view = frame_local(frame, eye);
    let light = frame_local(frame, axis);
    let lobe = warp_reflection_asg_local(view, along, across);
    return asg_lobe_product_integral(lobe, light, sharpness) * anisotropic_rest(view, light, along, across);
}

fn anisotropic_glossy_asg_2015(
    eye: vec3<f32>,
    frame: Frame,
    along: f32,
    across: f32,
    axis: vec3<f32>,
    sharpness: f32,
) -> f32 {
    let view = frame_local(frame, eye);
    let light = frame_local(frame, axis);
    let lobe = warp_reflection_asg_local(view, along, across);
    let own = 2.0 * (sqrt(lobe.sharpness_x) * sqrt(lobe.sharpness_y));
    let middle = vec_normalize(light * min(sharpness, SHARPNESS_MAX) + lobe.z * own);
    return asg_lobe_product_integral(lobe, light, sharpness) * anisotropic_rest(view, middle, along, across);
}

fn anisotropic_rest(view: vec3<f32>, light: vec3<f32>, along: f32, across: f32) -> f32 {
    let roughness = roughness_aligned(along, across);
    let v = max(view.z, 1e-6);
    let o = max(light.z, 0.0);
    let masked = ggx_local_projected_area(view, roughness) * o + ggx_local_projected_area(light, roughness) * v;
    let peak = max(along * across, 1e-12);
    return o / (2.0 * PI * peak * max(masked, 1e-18));
}

fn anisotropic_turn_of(normal: vec3<f32>, tangent: vec3<f32>) -> f32 {
    let basis = vec_orthonormal_basis(normal);
    let along = dot(tangent, basis.x);
    let across = dot(tangent, basis.y);
    let length = sqrt(along * along + across * across);
    let turn = across / max(length, 1e-18);
    return select(turn, -turn, along < 0.0);
}

fn anisotropic_tangent_of(normal: vec3<f32>, turn: f32) -> vec3<f32> {
    let basis = vec_orthonormal_basis(normal);
    return basis.x * sqrt(max((1.0 - turn) * (1.0 + turn), 0.0)) + basis.y * turn;
}
