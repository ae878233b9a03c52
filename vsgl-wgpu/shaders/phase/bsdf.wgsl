//! needs: brdf/fresnel, brdf/ggx_local, brdf/roughness, math/elementary, math/vec, phase/surface, sg/anisotropic
// What a surface scatters, and drawing a direction from it. Twin of `vsgl-core/src/phase/bsdf.rs`.
//
// Reads the constants GLOSSY and ANISOTROPY of the entry.

struct Bsdf {
    frame: Frame,
    view: vec3<f32>,
    roughness: Roughness,
    albedo: vec3<f32>,
    layer: vec2<f32>,
    f0: vec3<f32>,
    f90: f32,
    chance: f32,
}

struct Scattered {
    diffuse: vec3<f32>,
    specular: vec3<f32>,
}

// A drawn direction, what is scattered there, and the density.
struct Drawn {
    direction: vec3<f32>,
    scattered: Scattered,
    density: f32,
}

fn bsdf_new(surface: Surface, view: vec3<f32>) -> Bsdf {
    var frame: Frame;
    var roughness: Roughness;
    if ANISOTROPY {
        frame = frame_new(surface.normal, surface.tangent);
        roughness = roughness_aligned(surface.alpha, surface.across);
    } else {
        let basis = vec_orthonormal_basis(surface.normal);
        frame = Frame(basis.x, basis.y, surface.normal);
        roughness = roughness_isotropic(surface.alpha);
    }
    var f0 = vec3(0.0);
    var f90 = 0.0;
    if GLOSSY {
        f0 = surface.f0;
        f90 = surface.f90;
    }
    let local = frame_local(frame, view);
    let mirrored = f0 + (vec3(f90) - f0) * fresnel_schlick_weight(local.z);
    return Bsdf(
        frame,
        local,
        roughness,
        surface.diffuse,
        vec2(surface.dielectric_f0, surface.dielectric_f90),
        f0,
        f90,
        bsdf_chance(vec_luminance(surface.diffuse), vec_luminance(mirrored)),
    );
}

fn bsdf_evaluate(own: Bsdf, light: vec3<f32>) -> Scattered {
    return bsdf_evaluate_local(own, frame_local(own.frame, light));
}

fn bsdf_evaluate_local(own: Bsdf, light: vec3<f32>) -> Scattered {
    let cosine = max(light.z, 0.0);
    let weight = fresnel_schlick_weight(fresnel_half_cosine(own.view, light));
    let through = 1.0 - (own.layer.x + (own.layer.y - own.layer.x) * weight);
    let fresnel = own.f0 + (vec3(own.f90) - own.f0) * weight;
    return Scattered(
        own.albedo * (FRAC_1_PI * through * cosine),
        fresnel * (ggx_local_reflectance(own.view, light, own.roughness) * cosine),
    );
}

fn bsdf_density(own: Bsdf, light: vec3<f32>) -> f32 {
    return bsdf_density_local(own, frame_local(own.frame, light));
}

fn bsdf_density_local(own: Bsdf, light: vec3<f32>) -> f32 {
    let diffuse = max(light.z, 0.0) * FRAC_1_PI;
    let specular = ggx_local_reflected_density(own.view, light, own.roughness);
    return diffuse + (specular - diffuse) * own.chance;
}

fn bsdf_sample(own: Bsdf, point: vec2<f32>, part: f32) -> Drawn {
    var light: vec3<f32>;
    if part < own.chance {
        let half = ggx_local_sample_visible_normal(own.view, own.roughness, point.x, point.y);
        light = vec_normalize(vec_reflect(own.view, half));
    } else {
        let ring = sqrt(point.x);
        let turn = elementary_sin_cos_turns(point.y);
        light = vec3(ring * turn.y, ring * turn.x, sqrt(1.0 - point.x));
    }
    let frame = own.frame;
    let world = (frame.tangent * light.x + frame.bitangent * light.y) + frame.normal * light.z;
    return Drawn(world, bsdf_evaluate_local(own, light), bsdf_density_local(own, light));
}

fn bsdf_is_black(own: Bsdf) -> bool {
    return vec_luminance(own.albedo) + (vec_luminance(own.f0) + own.f90) <= 0.0;
}

fn bsdf_chance(diffuse: f32, specular: f32) -> f32 {
    let share = specular / max(diffuse + specular, F32_MIN_POSITIVE);
    let within = max(min(share, 1.0 - CHANCE_MIN), CHANCE_MIN);
    let glossy = select(0.0, within, specular > 0.0);
    return select(1.0, glossy, diffuse > 0.0);
}
