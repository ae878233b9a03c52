//! needs: data/lights, geom/traverse, phase/facing, phase/shade
// Light of the lights themselves at one receiver. Twin of `vsgl-core/src/phase/direct.rs`.

// What a light brings to a point, shadows left aside.
fn direct_incoming(light: LightRecord, position: vec3<f32>) -> Incoming {
    let apart = light.position - position;
    let distance2 = max(dot(apart, apart), F32_MIN_POSITIVE);
    var direction = -light.axis;
    var share = 1.0;
    if light.parallel == 0u {
        direction = vec_normalize(apart);
        let falloff = spot_light_falloff(-dot(direction, light.axis), light.cos_inner, light.cos_outer);
        let left = falloff * light_window(distance2, light.inverse_range2);
        share = min(left / distance2, STRENGTH_MAX);
    }
    return Incoming(direction, SHARPNESS_MAX, SHARPNESS_MAX, light.intensity * share);
}

// Direction of a shadow ray, and the parameter at its end.
struct Way {
    towards: vec3<f32>,
    end: f32,
}

// Up to a light, or out of the scene.
fn direct_way(light: LightRecord, incoming: Incoming, origin: vec3<f32>) -> Way {
    if light.parallel != 0u {
        return Way(incoming.axis, F32_MAX);
    }
    return Way(light.position - origin, 1.0);
}

// Radiance to the eye from one light, with a shadow ray where it would shine.
fn direct_radiance(
    nodes: u32,
    lift: f32,
    light: LightRecord,
    receiver: Receiver,
    facing: vec3<f32>,
    colors: Colors,
) -> vec3<f32> {
    let incoming = direct_incoming(light, receiver.position);
    let lambert = shade_lambert_constant(incoming, receiver) * FRAC_1_PI;
    var specular = 0.0;
    if ANISOTROPIC_RECEIVERS {
        specular = shade_anisotropic_point(incoming, receiver);
    } else {
        specular = shade_glossy_point(incoming, receiver);
    }
    let fresnel = colors.f0 + (vec3(colors.f90) - colors.f0) * shade_fresnel_weight(incoming, receiver);
    let reflected = incoming.strength * (colors.albedo * lambert + fresnel * specular);
    if all(reflected == vec3(0.0)) {
        return vec3(0.0);
    }
    let origin = receiver.position + facing * surface_lift(lift, receiver.position);
    let way = direct_way(light, incoming, origin);
    if traverse_any_hit(nodes, ray_new(origin, way.towards), way.end) {
        return vec3(0.0);
    }
    return reflected;
}
