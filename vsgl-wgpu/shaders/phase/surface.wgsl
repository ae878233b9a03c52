//! needs: data/words, math/vec, phase/anisotropy, phase/color, phase/footprint, phase/normal_map, phase/texture
// The surface at a hit. Twin of `vsgl-core/src/phase/surface.rs`.
//
// Reads `corner` and `corner_normal`, which the entry binds, and its constants TEXTURES, NORMAL_MAPS, COLORS, UNLIT_ONES,
// ANISOTROPY and EMISSION, which are the plan for surfaces.

struct Surface {
    position: vec3<f32>,
    normal: vec3<f32>,
    diffuse: vec3<f32>,
    dielectric_f0: f32,
    dielectric_f90: f32,
    f0: vec3<f32>,
    f90: f32,
    alpha: f32,
    tangent: vec3<f32>,
    across: f32,
    emission: vec3<f32>,
}

// The surface at a place that a ray along `direction` (any length) has hit.
fn surface_at_hit(place: Place, direction: vec3<f32>) -> Surface {
    let triangle = place.triangle;
    let position = surface_interpolate(corner[triangle], place.u, place.v);
    let smooth_normal = vec_normalize(surface_interpolate(corner_normal[triangle], place.u, place.v));
    let from_behind = dot(smooth_normal, direction) > 0.0;

    let record = words_material(triangle);
    var base = record.base_color;
    var metallic = record.metallic;
    var roughness = record.roughness;
    var reflectance = record.reflectance;
    var specular = record.specular;
    if TEXTURES {
        if record.base_color_texture != NO_TEXTURE {
            base = base * texture_sample(record.base_color_texture, place, true).xyz;
        }
        if record.metallic_roughness_texture != NO_TEXTURE {
            let factors = texture_sample(record.metallic_roughness_texture, place, false);
            roughness = roughness * factors.y;
            metallic = metallic * factors.z;
        }
        if record.specular_texture != NO_TEXTURE {
            specular = specular * texture_sample(record.specular_texture, place, false).w;
        }
        if record.specular_color_texture != NO_TEXTURE {
            reflectance = reflectance * texture_sample(record.specular_color_texture, place, true).xyz;
        }
    }
    if COLORS {
        if columns.corner_color != NO_WORDS {
            base = base * color_of_vertices(place).xyz;
        }
    }
    var normal = smooth_normal;
    var mapped = false;
    if NORMAL_MAPS {
        mapped = record.normal_texture != NO_TEXTURE;
        if mapped {
            normal = normal_map_mapped(record, place, smooth_normal);
        }
    }
    normal = select(normal, -normal, from_behind);
    if NORMAL_MAPS {
        if mapped {
            normal = normal_map_facing(normal, direction);
        }
    }
    var unlit = false;
    if UNLIT_ONES {
        unlit = (record.flags & UNLIT) != 0u;
    }
    var emission = vec3(0.0);
    if unlit {
        emission = base;
    } else if EMISSION {
        emission = surface_emitted(record, place, direction);
    }
    if unlit {
        base = vec3(0.0);
        metallic = 0.0;
        specular = 0.0;
    }
    let alpha = max(roughness * roughness, ALPHA_MIN);
    var stretch = Stretch(vec3(0.0), alpha, 0.0);
    if ANISOTROPY {
        stretch = anisotropy_stretch(record, place, smooth_normal, normal, alpha);
    }
    let dielectric = min(reflectance, vec3(1.0)) * specular;
    return Surface(
        position,
        normal,
        (1.0 - metallic) * base,
        max(max(dielectric.x, dielectric.y), dielectric.z),
        specular,
        dielectric + (base - dielectric) * metallic,
        specular + (1.0 - specular) * metallic,
        stretch.along,
        stretch.tangent,
        stretch.across,
        emission,
    );
}

// Radiance that a place sends against `direction` by itself.
fn surface_emitted(record: MaterialRecord, place: Place, direction: vec3<f32>) -> vec3<f32> {
    let c = corner[place.triangle];
    let a = vec3(c[0], c[1], c[2]);
    let ab = vec3(c[3], c[4], c[5]) - a;
    let ac = vec3(c[6], c[7], c[8]) - a;
    if (record.flags & DOUBLE_SIDED) == 0u && dot(cross(ab, ac), direction) > 0.0 {
        return vec3(0.0);
    }
    if TEXTURES {
        if record.emissive_texture != NO_TEXTURE {
            return record.emission * texture_sample(record.emissive_texture, place, true).xyz;
        }
    }
    return record.emission;
}

fn surface_interpolate(corners: array<f32, 9>, u: f32, v: f32) -> vec3<f32> {
    let a = vec3(corners[0], corners[1], corners[2]);
    let ab = vec3(corners[3], corners[4], corners[5]) - a;
    let ac = vec3(corners[6], corners[7], corners[8]) - a;
    return (a + ab * u) + ac * v;
}
