//! needs: math/elementary, math/vec, sg/anisotropic, sg/cosine, sg/extent, sg/glossy, sg/glossy_blend, sg/lobe, sg/vmf, sg/warp, brdf/fresnel, brdf/ggx, data/vsgls
// One receiver against one virtual light. Twin of `vsgl-core/src/phase/shade.rs`.

struct Incoming {
    axis: vec3<f32>,
    sharpness: f32,
    horizon: f32,
    strength: vec3<f32>,
}

struct Receiver {
    position: vec3<f32>,
    normal: vec3<f32>,
    view: vec3<f32>,
    f0: f32,
    f90: f32,
    alpha: f32,
    // Read only by the anisotropic forms.
    tangent: vec3<f32>,
    across: f32,
}

fn receiver_frame(own: Receiver) -> Frame {
    return frame_new(own.normal, own.tangent);
}

struct Colors {
    albedo: vec3<f32>,
    f0: vec3<f32>,
    f90: f32,
}

fn colors_diffuse(colors: Colors, sum: vec3<f32>) -> vec3<f32> {
    return sum * (colors.albedo * FRAC_1_PI);
}

fn colors_glossy(colors: Colors, near: vec3<f32>, grazing: vec3<f32>) -> vec3<f32> {
    return near * colors.f0 + grazing * colors.f90;
}

struct Path {
    direction: vec3<f32>,
    sharpness: f32,
    spread: f32,
}

fn shade_path(position: vec3<f32>, variance: f32, receiver: vec3<f32>) -> Path {
    let apart = position - receiver;
    let distance2 = dot(apart, apart);
    let extent = max(max(variance, distance2 * (1.0 / SHARPNESS_MAX)), VARIANCE_MIN);
    let sharpness = distance2 / extent;
    let spread = 2.0 * elementary_expm1_over_x(-2.0 * sharpness) / extent;
    return Path(vec_normalize(apart), sharpness, spread);
}

fn shade_sharpness_along(sharpness: f32, variance: f32, covariance: array<f32, 6>, direction: vec3<f32>) -> f32 {
    let along = max(max(extent_along(covariance, direction), 1e-12 * variance), VARIANCE_MIN);
    return min(sharpness * (variance / along), SHARPNESS_MAX);
}

fn shade_leaving(position: vec3<f32>, axis: vec3<f32>, bulge: f32, receiver: vec3<f32>) -> vec3<f32> {
    return vec_normalize(receiver - (position + axis * bulge));
}

fn shade_lambert_share(f0: f32, f90: f32, cosine: f32) -> f32 {
    return 1.0 - (f0 + (f90 - f0) * fresnel_schlick_weight(cosine));
}

fn shade_mean_length(complement: f32) -> MeanLength {
    return MeanLength(1.0 - complement, complement);
}

fn shade_incoming_diffuse(light: DiffuseVsgl, receiver: vec3<f32>, normal: vec3<f32>) -> Incoming {
    let path = shade_path(light.position, light.variance, receiver);
    let outgoing = shade_leaving(light.position, light.axis, light.bulge, receiver);
    let blur = shade_sharpness_along(path.sharpness, light.variance, light.covariance, light.axis);
    let sharpness = vmf_convolve_with(shade_mean_length(light.complement), blur);
    let mean_cosine = cosine_mean_clamped_cosine(sharpness, dot(outgoing, light.axis));
    let half = fresnel_half_cosine(light.light, outgoing);
    let factor = mean_cosine * shade_lambert_share(light.f0, light.f90, half) * path.spread;
    return Incoming(
        path.direction,
        path.sharpness,
        shade_sharpness_along(path.sharpness, light.variance, light.covariance, normal),
        light.intensity * factor,
    );
}

// The way of a cluster's specular light: what leaves the sender, and under which lobes.
struct SpecularWay {
    path: Path,
    outgoing: vec3<f32>,
    lobe: f32,
    horizon: f32,
}

fn shade_specular_way(light: SpecularVsgl, receiver: vec3<f32>) -> SpecularWay {
    let path = shade_path(light.position, light.variance, receiver);
    let outgoing = shade_leaving(light.position, light.axis, light.bulge, receiver);
    let across = vmf_mean(path.sharpness);
    let along = shade_sharpness_along(path.sharpness, light.variance, light.covariance, light.axis);
    let lobe = vmf_sharpness(mean_length_convolve(shade_mean_length(light.complement_mirror), across));
    let horizon = vmf_convolve_with(shade_mean_length(light.complement), along);
    return SpecularWay(path, outgoing, lobe, horizon);
}

fn shade_sent(light: SpecularVsgl, way: SpecularWay, masked: f32, normal: vec3<f32>) -> Incoming {
    let reflected = masked * way.path.spread;
    let grazing = fresnel_schlick_weight(fresnel_half_cosine(light.light, way.outgoing));
    let arriving = lobe_product(-light.mirror, light.sharpness_lobe, way.path.direction, way.path.sharpness);
    return Incoming(
        arriving.axis,
        arriving.sharpness,
        shade_sharpness_along(arriving.sharpness, light.variance, light.covariance, normal),
        (light.f0 + (light.f90 - light.f0) * grazing) * reflected,
    );
}

fn shade_incoming_specular(
    light: SpecularVsgl,
    sender: GlossyView,
    receiver: vec3<f32>,
    normal: vec3<f32>,
) -> Incoming {
    let way = shade_specular_way(light, receiver);
    return shade_sent(light, way, glossy_view_masked(sender, way.outgoing, way.lobe, way.horizon), normal);
}

// The same from a surface with two roughnesses.
fn shade_incoming_anisotropic(
    light: SpecularVsgl,
    sender: AnisotropicView,
    receiver: vec3<f32>,
    normal: vec3<f32>,
) -> Incoming {
    let way = shade_specular_way(light, receiver);
    return shade_sent(light, way, anisotropic_view_masked(sender, way.outgoing, way.lobe, way.horizon), normal);
}

fn shade_sender_view(light: SpecularVsgl) -> GlossyView {
    return glossy_view_new(light.light, light.axis, light.alpha);
}

fn shade_anisotropic_sender_view(light: SpecularVsgl) -> AnisotropicView {
    let tangent = anisotropic_tangent_of(light.axis, light.turn);
    return anisotropic_view_new(light.light, light.axis, tangent, light.alpha, light.across);
}

fn shade_incoming_sg(
    position: vec3<f32>,
    variance: f32,
    axis: vec3<f32>,
    sharpness: f32,
    intensity: vec3<f32>,
    receiver: vec3<f32>,
) -> Incoming {
    let path = shade_path(position, variance, receiver);
    let product = lobe_product(-axis, sharpness, path.direction, path.sharpness);
    let factor = elementary_exp(product.log_amplitude) * lobe_integral(product.sharpness)
        / lobe_integral(path.sharpness);
    return Incoming(product.axis, product.sharpness, product.sharpness, intensity * (factor * path.spread));
}

struct PointSender {
    position: vec3<f32>,
    variance: f32,
    normal: vec3<f32>,
    light: vec3<f32>,
    diffuse: vec3<f32>,
    dielectric_f0: f32,
    dielectric_f90: f32,
    f0: vec3<f32>,
    f90: vec3<f32>,
    alpha: f32,
    across: f32,
    turn: f32,
}

fn shade_incoming_point(light: PointSender, receiver: vec3<f32>) -> Incoming {
    let path = shade_path(light.position, light.variance, receiver);
    let specular = ggx_reflectance(light.light, -path.direction, light.normal, light.alpha);
    return shade_sent_by_point(light, path, specular);
}

fn shade_incoming_anisotropic_point(light: PointSender, receiver: vec3<f32>) -> Incoming {
    let path = shade_path(light.position, light.variance, receiver);
    let frame = frame_new(light.normal, anisotropic_tangent_of(light.normal, light.turn));
    let specular = anisotropic_reflectance(light.light, -path.direction, frame, light.alpha, light.across);
    return shade_sent_by_point(light, path, specular);
}

fn shade_sent_by_point(light: PointSender, path: Path, specular: f32) -> Incoming {
    let outgoing = -path.direction;
    let facing = max(dot(outgoing, light.normal), 0.0) * path.spread;
    let half = fresnel_half_cosine(light.light, outgoing);
    let lambert = shade_lambert_share(light.dielectric_f0, light.dielectric_f90, half) * FRAC_1_PI;
    let fresnel = light.f0 + (light.f90 - light.f0) * fresnel_schlick_weight(half);
    return Incoming(
        path.direction,
        SHARPNESS_MAX,
        SHARPNESS_MAX,
        (light.diffuse * lambert + fresnel * specular) * facing,
    );
}

fn shade_through(incoming: Incoming, receiver: Receiver) -> f32 {
    return shade_lambert_share(receiver.f0, receiver.f90, fresnel_half_cosine(receiver.view, incoming.axis));
}

fn shade_lambert_v13(incoming: Incoming, receiver: Receiver) -> f32 {
    let mean = cosine_mean_clamped_cosine(incoming.horizon, dot(incoming.axis, receiver.normal));
    return mean * shade_through(incoming, receiver);
}

fn shade_lambert_v14(incoming: Incoming, receiver: Receiver) -> f32 {
    let k = incoming.horizon;
    let mean = cosine_interpolated_v14(k, dot(incoming.axis, receiver.normal)) / lobe_integral(k);
    return mean * shade_through(incoming, receiver);
}

fn shade_lambert_2024(incoming: Incoming, receiver: Receiver) -> f32 {
    let k = incoming.horizon;
    let mean = cosine_interpolated_2024(k, dot(incoming.axis, receiver.normal)) / lobe_integral(k);
    return mean * shade_through(incoming, receiver);
}

fn shade_lambert_2022(incoming: Incoming, receiver: Receiver) -> f32 {
    let k = incoming.horizon;
    let mean = cosine_lobes_2022(k, dot(incoming.axis, receiver.normal)) / lobe_integral(k);
    return mean * shade_through(incoming, receiver);
}

fn shade_lambert_2018(incoming: Incoming, receiver: Receiver) -> f32 {
    let k = incoming.horizon;
    let mean = cosine_lobes_2018(k, dot(incoming.axis, receiver.normal)) / lobe_integral(k);
    return mean * shade_through(incoming, receiver);
}

fn shade_lambert_sg_2015(incoming: Incoming, receiver: Receiver) -> f32 {
    let k = incoming.horizon;
    let mean = cosine_sg_2015(k, dot(incoming.axis, receiver.normal)) / lobe_integral(k);
    return mean * shade_through(incoming, receiver);
}

fn shade_lambert_sg_product(incoming: Incoming, receiver: Receiver) -> f32 {
    let k = incoming.horizon;
    let mean = cosine_sg_product(k, dot(incoming.axis, receiver.normal)) / lobe_integral(k);
    return mean * shade_through(incoming, receiver);
}

fn shade_lambert_constant(incoming: Incoming, receiver: Receiver) -> f32 {
    return max(dot(incoming.axis, receiver.normal), 0.0) * shade_through(incoming, receiver);
}

fn shade_glossy_masked(incoming: Incoming, surface: GlossyView) -> f32 {
    return glossy_view_masked(surface, incoming.axis, incoming.sharpness, incoming.horizon);
}

fn shade_glossy_2024(incoming: Incoming, surface: GlossyView) -> f32 {
    return glossy_view_filtered_2024(surface, incoming.axis, incoming.sharpness);
}

fn shade_glossy_blended(incoming: Incoming, surface: GlossyView) -> f32 {
    return glossy_view_blended(surface, incoming.axis, incoming.sharpness, incoming.horizon);
}

fn shade_glossy_sg(incoming: Incoming, receiver: Receiver) -> f32 {
    let reflected = warp_glossy_sg_2015(
        receiver.view, receiver.normal, receiver.alpha, incoming.axis, incoming.sharpness,
    );
    return reflected / lobe_integral(incoming.sharpness);
}

fn shade_glossy_asg_2015(incoming: Incoming, receiver: Receiver) -> f32 {
    let reflected = warp_glossy_asg_2015(
        receiver.view, receiver.normal, receiver.alpha, incoming.axis, incoming.sharpness,
    );
    return reflected / lobe_integral(incoming.sharpness);
}

fn shade_glossy_asg_2013(incoming: Incoming, receiver: Receiver) -> f32 {
    let reflected = warp_glossy_asg_2016(
        receiver.view, receiver.normal, receiver.alpha, incoming.axis, incoming.sharpness,
    );
    return reflected / lobe_integral(incoming.sharpness);
}

fn shade_glossy_point(incoming: Incoming, receiver: Receiver) -> f32 {
    let cosine = max(dot(incoming.axis, receiver.normal), 0.0);
    return ggx_reflectance(receiver.view, incoming.axis, receiver.normal, receiver.alpha) * cosine;
}

fn shade_fresnel_weight(incoming: Incoming, receiver: Receiver) -> f32 {
    return fresnel_schlick_weight(fresnel_half_cosine(receiver.view, incoming.axis));
}

fn shade_anisotropic_view(receiver: Receiver) -> AnisotropicView {
    return anisotropic_view_new(receiver.view, receiver.normal, receiver.tangent, receiver.alpha, receiver.across);
}

fn shade_anisotropic_masked(incoming: Incoming, surface: AnisotropicView) -> f32 {
    return anisotropic_view_masked(surface, incoming.axis, incoming.sharpness, incoming.horizon);
}

fn shade_anisotropic_2024(incoming: Incoming, surface: AnisotropicView) -> f32 {
    return anisotropic_view_filtered_2024(surface, incoming.axis, incoming.sharpness);
}

fn shade_anisotropic_asg_2013(incoming: Incoming, receiver: Receiver) -> f32 {
    let frame = receiver_frame(receiver);
    let sharpness = incoming.sharpness;
    return anisotropic_glossy_asg(receiver.view, frame, receiver.alpha, receiver.across, incoming.axis, sharpness)
        / lobe_integral(sharpness);
}

fn shade_anisotropic_asg_2015(incoming: Incoming, receiver: Receiver) -> f32 {
    let frame = receiver_frame(receiver);
    let sharpness = incoming.sharpness;
    return anisotropic_glossy_asg_2015(receiver.view, frame, receiver.alpha, receiver.across, incoming.axis, sharpness)
        / lobe_integral(sharpness);
}

fn shade_anisotropic_point(incoming: Incoming, receiver: Receiver) -> f32 {
    let cosine = max(dot(incoming.axis, receiver.normal), 0.0);
    let frame = receiver_frame(receiver);
    return anisotropic_reflectance(receiver.view, incoming.axis, frame, receiver.alpha, receiver.across) * cosine;
}
