//! needs: data/words, math/vec, phase/footprint, phase/normal_map, phase/texture
// Which way a surface is stretched, and by how much. Twin of `vsgl-core/src/phase/anisotropy.rs`.

struct Stretch {
    tangent: vec3<f32>,
    along: f32,
    across: f32,
}

fn anisotropy_stretch(
    material: MaterialRecord,
    place: Place,
    smooth_normal: vec3<f32>,
    normal: vec3<f32>,
    alpha: f32,
) -> Stretch {
    var strength = material.anisotropy;
    let cosine = material.anisotropy_cos;
    let sine = material.anisotropy_sin;
    var x = cosine;
    var y = sine;
    if TEXTURES {
        if material.anisotropy_texture != NO_TEXTURE {
            let texel = texture_sample(material.anisotropy_texture, place, false);
            let s = 2.0 * texel.x - 1.0;
            let t = 2.0 * texel.y - 1.0;
            x = cosine * s - sine * t;
            y = sine * s + cosine * t;
            strength = strength * texel.z;
        }
    }
    let found = anisotropy_direction(material, place, smooth_normal);
    let tangent = found.xyz;
    let bitangent = cross(smooth_normal, tangent) * found.w;
    let along = tangent * x + bitangent * y;
    let flat_part = along - normal * dot(normal, along);
    let none = dot(flat_part, flat_part) <= TANGENT_MIN;
    strength = select(strength, 0.0, none);
    return Stretch(
        select(vec_normalize(flat_part), vec_orthonormal_basis(normal).x, none),
        alpha + (1.0 - alpha) * (strength * strength),
        alpha,
    );
}

fn anisotropy_direction(material: MaterialRecord, place: Place, smooth_normal: vec3<f32>) -> vec4<f32> {
    if TEXTURES {
        if material.normal_texture != NO_TEXTURE {
            return normal_map_tangent(words_texture(material.normal_texture), place, smooth_normal);
        }
        if material.anisotropy_texture != NO_TEXTURE {
            return normal_map_tangent(words_texture(material.anisotropy_texture), place, smooth_normal);
        }
    }
    return normal_map_tangent_of_mesh(place, smooth_normal);
}
