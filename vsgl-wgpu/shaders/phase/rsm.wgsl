//! needs: brdf/albedo, data/lights, data/texel, geom/ray, math/vec, phase/facing, phase/footprint, phase/surface
// What a light sees through one texel of its map. Twin of `vsgl-core/src/phase/rsm.rs`.

struct RsmRay {
    ray: Ray,
    // Flux that leaves the light through the texel.
    flux: vec3<f32>,
}

fn rsm_ray(map: MapRecord, size: u32, x: u32, y: u32) -> RsmRay {
    let side = 2.0 * map.tan_half_fov / f32(size);
    let across = (f32(x) + 0.5) * side - map.tan_half_fov;
    let upwards = map.tan_half_fov - (f32(y) + 0.5) * side;
    let right = map.right * across;
    let up = map.up * upwards;
    if map.kind == MAP_PARALLEL {
        return RsmRay(ray_new((map.position + right) + up, map.axis), map.intensity * map.solid_angle);
    }
    let direction = (map.axis + right) + up;
    let cosine = 1.0 / sqrt((1.0 + across * across) + upwards * upwards);
    let from_cone = select(cosine, dot(direction, map.cone) * cosine, map.kind == MAP_FACE);
    let falloff = spot_light_falloff(from_cone, map.cos_inner, map.cos_outer);
    let solid_angle = map.solid_angle * (cosine * cosine * cosine);
    return RsmRay(ray_new(map.position, direction), map.intensity * (falloff * solid_angle));
}

// The texel at a hit of its ray.
fn rsm_texel(map: MapRecord, size: u32, ray: Ray, sent: vec3<f32>, hit: Hit) -> Texel {
    let step = 2.0 * map.tan_half_fov / f32(size) * select(hit.t, 1.0, map.kind == MAP_PARALLEL);
    let place = place_at_hit(hit, ray.direction, map.right * step, map.up * -step);
    let seen = surface_at_hit(place, ray.direction);
    let length = sqrt(dot(ray.direction, ray.direction));
    let light = ray.direction * (-1.0 / length);
    let normal = surface_geometric_normal(hit.triangle, light);
    let facing = max(dot(normal, light), FOOTPRINT_COSINE_MIN);
    let distance = hit.t * length;
    let flux = sent * light_window(distance * distance, map.inverse_range2);
    let side = 2.0 * map.tan_half_fov / f32(size) * hit.t;
    let parallel = map.kind == MAP_PARALLEL;
    let across = select(side * side, map.solid_angle, parallel);
    let slant = select(length * facing, facing, parallel);
    let area = across / slant;
    var alpha = seen.alpha;
    if ANISOTROPY {
        alpha = sqrt(seen.alpha * seen.across);
    }
    let albedo = albedo_ggx_albedo(dot(seen.normal, light), alpha);
    let f0 = seen.f0 * flux;
    let f90 = flux * seen.f90;
    return Texel(
        vec4(seen.position, area),
        vec4(seen.normal, seen.dielectric_f90),
        vec4(seen.diffuse * flux, seen.dielectric_f0),
        vec4(f0, seen.alpha),
        vec4(f90, vec_luminance(albedo_weigh(albedo, f0, f90))),
        vec4(seen.tangent, seen.across),
    );
}
