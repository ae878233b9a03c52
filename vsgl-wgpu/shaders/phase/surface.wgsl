//! needs: data/words, math/vec, geom/traverse, phase/texture
// The surface at a hit. Twin of `vsgl-core/src/phase/surface.rs`.
//
// Reads `corner` and `corner_normal`, which the entry binds.

struct Surface {
    position: vec3<f32>,
    normal: vec3<f32>,
    diffuse: vec3<f32>,
    dielectric_f0: f32,
    dielectric_f90: f32,
    f0: vec3<f32>,
    f90: f32,
    alpha: f32,
}

// The surface at a hit of a ray that runs along `direction` (any length).
fn surface_at_hit(hit: Hit, direction: vec3<f32>) -> Surface {
    let triangle = hit.triangle;
    let u = max(min(hit.u, 1.0), 0.0);
    let v = max(min(hit.v, 1.0), 0.0);
    let position = surface_interpolate(corner[triangle], u, v);
    let smooth_normal = vec_normalize(surface_interpolate(corner_normal[triangle], u, v));
    let normal = select(smooth_normal, -smooth_normal, dot(smooth_normal, direction) > 0.0);

    let record = words_material(triangle);
    var base = record.base_color;
    var metallic = record.metallic;
    var roughness = record.roughness;
    if TEXTURED {
        if record.base_color_texture != NO_TEXTURE {
            base = base * texture_sample(record.base_color_texture, triangle, u, v, true).xyz;
        }
        if record.metallic_roughness_texture != NO_TEXTURE {
            let factors = texture_sample(record.metallic_roughness_texture, triangle, u, v, false);
            roughness = roughness * factors.y;
            metallic = metallic * factors.z;
        }
    }
    let dielectric = min(record.reflectance, vec3(1.0)) * record.specular;
    return Surface(
        position,
        normal,
        (1.0 - metallic) * base,
        max(max(dielectric.x, dielectric.y), dielectric.z),
        record.specular,
        dielectric + (base - dielectric) * metallic,
        record.specular + (1.0 - record.specular) * metallic,
        max(roughness * roughness, ALPHA_MIN),
    );
}

fn surface_interpolate(corners: array<f32, 9>, u: f32, v: f32) -> vec3<f32> {
    let a = vec3(corners[0], corners[1], corners[2]);
    let ab = vec3(corners[3], corners[4], corners[5]) - a;
    let ac = vec3(corners[6], corners[7], corners[8]) - a;
    return (a + ab * u) + ac * v;
}
