//! needs: data/lights, geom/traverse, phase/facing, phase/shade
// Light of the lights themselves at one receiver. Twin of `vsgl-core/src/phase/direct.rs`.

struct DirectLight {
    position: vec3<f32>,
    cos_inner: f32,
    axis: vec3<f32>,
    cos_outer: f32,
    intensity: vec3<f32>,
    padding: f32,
}

// What a light brings to a point, shadows left aside.
fn direct_incoming(light: DirectLight, position: vec3<f32>) -> Incoming {
    let apart = light.position - position;
    let distance2 = max(dot(apart, apart), F32_MIN_POSITIVE);
    let direction = vec_normalize(apart);
    let falloff = spot_light_falloff(-dot(direction, light.axis), light.cos_inner, light.cos_outer);
    return Incoming(
        direction,
        SHARPNESS_MAX,
        SHARPNESS_MAX,
        light.intensity * min(falloff / distance2, STRENGTH_MAX),
    );
}

// Radiance to the eye from one light, with a shadow ray where it would shine.
fn direct_radiance(
    nodes: u32,
    lift: f32,
    light: DirectLight,
    receiver: Receiver,
    facing: vec3<f32>,
    colors: Colors,
) -> vec3<f32> {
    let incoming = direct_incoming(light, receiver.position);
    let lambert = shade_lambert_constant(incoming, receiver) * FRAC_1_PI;
    let specular = shade_glossy_point(incoming, receiver);
    let fresnel = colors.f0 + (vec3(colors.f90) - colors.f0) * shade_fresnel_weight(incoming, receiver);
    let reflected = incoming.strength * (colors.albedo * lambert + fresnel * specular);
    if all(reflected == vec3(0.0)) {
        return vec3(0.0);
    }
    let origin = receiver.position + facing * surface_lift(lift, receiver.position);
    let ray = ray_new(origin, light.position - origin);
    if traverse_any_hit(nodes, ray, 1.0) {
        return vec3(0.0);
    }
    return reflected;
}
