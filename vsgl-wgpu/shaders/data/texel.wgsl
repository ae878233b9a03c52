// A texel of a reflective shadow map. Twin of `Texel` in `vsgl-core/src/phase/rsm.rs`.

struct Texel {
    position: vec4<f32>,
    normal: vec4<f32>,
    diffuse: vec4<f32>,
    specular: vec4<f32>,
    grazing: vec4<f32>,
    tangent: vec4<f32>,
}

fn rsm_empty() -> Texel {
    return Texel(
        vec4(0.0),
        vec4(0.0, 0.0, 1.0, 0.0),
        vec4(0.0),
        vec4(0.0, 0.0, 0.0, 1.0),
        vec4(0.0),
        vec4(0.0),
    );
}
