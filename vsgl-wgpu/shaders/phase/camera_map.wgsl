//! needs: brdf/albedo, data/lights, data/texel, math/vec
// The camera as a light. Twin of `vsgl-core/src/phase/camera_map.rs`.

fn camera_map_sample(number: u32, side: u32, samples: u32) -> u32 {
    let place = 2u * number + 1u;
    let twice = 2u * side;
    return place * (samples / twice) + place * (samples % twice) / twice;
}

// The texel that takes a sample, from the columns of the G-buffer: `alpha` and the tangent's are 1 where it has none of these.
fn camera_map_texel(
    map: MapRecord,
    position: vec3<f32>,
    normal: vec4<f32>,
    diffuse: vec4<f32>,
    specular: vec4<f32>,
    at_grazing: f32,
    tangent: vec4<f32>,
) -> Texel {
    let apart = map.position - position;
    let cosine = dot(normal.xyz, vec_normalize(apart));
    let area = dot(apart, apart) * map.solid_angle / max(cosine, FOOTPRINT_COSINE_MIN);
    let flux = map.intensity.x;
    let f0 = specular.xyz * flux;
    let f90 = vec3(at_grazing * flux);
    var rough = specular.w;
    if ANISOTROPY {
        rough = sqrt(specular.w * tangent.w);
    }
    let albedo = albedo_ggx_albedo(cosine, rough);
    return Texel(
        vec4(position, area),
        normal,
        vec4(diffuse.xyz * flux, diffuse.w),
        vec4(f0, specular.w),
        vec4(f90, vec_luminance(albedo_weigh(albedo, f0, f90))),
        tangent,
    );
}
