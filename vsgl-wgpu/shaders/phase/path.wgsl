//! needs: data/emitters, data/view, geom/traverse, math/sobol, phase/bsdf, phase/direct, phase/draw, phase/facing, phase/mask, phase/surface
// Paths of light from the eye. Twin of `vsgl-core/src/phase/path.rs`.
//
// Reads `params`, `direct_light` and `lamp` of the entry, and its constant EMITTERS.

struct Light {
    direct: vec3<f32>,
    indirect_diffuse: vec3<f32>,
    indirect_glossy: vec3<f32>,
}

fn path_stream(seed: u32, x: u32, y: u32) -> u32 {
    return sobol_combine(sobol_combine(seed, x), y);
}

fn path_camera_ray(view: View, x: u32, y: u32, at: vec2<f32>) -> Ray {
    let scale = 2.0 * view.tan_half_fov / f32(view.height);
    let across = ((f32(x * view.stride) + at.x) - 0.5 * f32(view.width)) * scale;
    let upwards = (0.5 * f32(view.height) - (f32(y * view.stride) + at.y)) * scale;
    let direction = (view.forward + view.right * across) + view.up * upwards;
    return ray_new(view.eye, vec_normalize(direction));
}

// A surface that a path has met.
struct Met {
    hit: Hit,
    surface: Surface,
    bsdf: Bsdf,
    facing: vec3<f32>,
    origin: vec3<f32>,
}

fn path_meet(hit: Hit, ray: Ray) -> Met {
    let place = path_point(hit);
    let surface = surface_at_hit(place, ray.direction);
    let view = -ray.direction;
    let facing = surface_geometric_normal(hit.triangle, view);
    return Met(
        hit,
        surface,
        bsdf_new(surface, view),
        facing,
        surface.position + facing * surface_lift(params.lift, surface.position),
    );
}

fn path_point(hit: Hit) -> Place {
    return Place(
        hit.triangle,
        max(min(hit.u, 1.0), 0.0),
        max(min(hit.v, 1.0), 0.0),
        vec2(0.0),
        vec2(0.0),
    );
}

// What is reflected to where the path came from; nothing from below the surface.
fn path_reflected(met: Met, direction: vec3<f32>, strength: vec3<f32>) -> vec3<f32> {
    let scattered = bsdf_evaluate(met.bsdf, direction);
    return select(
        vec3(0.0),
        (scattered.diffuse + scattered.specular) * strength,
        dot(direction, met.facing) > 0.0,
    );
}

// Twice the area of a triangle along its geometric normal.
fn path_area_vector(triangle: u32) -> vec3<f32> {
    let c = corner[triangle];
    let a = vec3(c[0], c[1], c[2]);
    let ab = vec3(c[3], c[4], c[5]) - a;
    let ac = vec3(c[6], c[7], c[8]) - a;
    return cross(ab, ac);
}

// Triangles that shine below this one.
fn path_lamps_below(triangle: u32) -> u32 {
    var low = 0u;
    var high = params.lamps;
    while low < high {
        let middle = low + (high - low) / 2u;
        if lamp[middle].triangle < triangle {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    return low;
}

fn path_emitter_density(triangle: u32, area: f32) -> f32 {
    if !EMITTERS {
        return 0.0;
    }
    let index = path_lamps_below(triangle);
    if index == params.lamps {
        return 0.0;
    }
    if lamp[index].triangle != triangle {
        return 0.0;
    }
    return draw_lamp_chance(index) / max(area, F32_MIN_POSITIVE);
}

fn path_heuristic(other: f32) -> f32 {
    let ratio = min(other, 1e18);
    return 1.0 / (1.0 + ratio * ratio);
}

// A path on its way.
struct Walk {
    light: Light,
    diffuse: vec3<f32>,
    glossy: vec3<f32>,
    density: f32,
    // Whether it goes on, and along which ray.
    goes_on: bool,
    ray: Ray,
}

fn walk_add(own: Walk, depth: u32, light: vec3<f32>) -> Walk {
    var walk = own;
    let diffuse = walk.diffuse * light;
    let glossy = walk.glossy * light;
    if depth < 3u {
        walk.light.direct += diffuse + glossy;
    } else {
        walk.light.indirect_diffuse += diffuse;
        walk.light.indirect_glossy += glossy;
    }
    return walk;
}

fn walk_shine(own: Walk, depth: u32, met: Met, ray: Ray) -> Walk {
    let emission = met.surface.emission;
    if all(emission == vec3(0.0)) {
        return own;
    }
    if depth == 1u {
        return walk_add(own, depth, emission);
    }
    if (words_material(met.hit.triangle).flags & UNLIT) != 0u {
        return own;
    }
    let twice = path_area_vector(met.hit.triangle);
    let area = 0.5 * sqrt(dot(twice, twice));
    let cosine = max(abs(dot(met.facing, -ray.direction)), F32_MIN_POSITIVE);
    let drawn = path_emitter_density(met.hit.triangle, area);
    let distance2 = min(met.hit.t * met.hit.t, 1e18);
    let other = drawn * (distance2 / cosine) / max(own.density, F32_MIN_POSITIVE);
    return walk_add(own, depth, emission * path_heuristic(other));
}

fn walk_connect_light(own: Walk, depth: u32, met: Met, which: f32) -> Walk {
    let drawn = draw_light(which);
    if drawn.index == params.lights {
        return own;
    }
    let light = direct_light[drawn.index];
    let incoming = direct_incoming(light, met.surface.position);
    let reflected = path_reflected(met, incoming.axis, incoming.strength / drawn.chance);
    if all(reflected == vec3(0.0)) {
        return own;
    }
    let way = direct_way(light, incoming, met.origin);
    if traverse_any_hit(params.nodes, ray_new(met.origin, way.towards), way.end) {
        return own;
    }
    return walk_add(own, depth + 1u, reflected);
}

fn walk_connect_emitter(own: Walk, depth: u32, met: Met, which: f32, at: vec2<f32>) -> Walk {
    let chosen = draw_lamp(which);
    if chosen.index == params.lamps {
        return own;
    }
    let triangle = lamp[chosen.index].triangle;
    let root = sqrt(at.x);
    let place = path_point(Hit(triangle, 0.0, root * (1.0 - at.y), root * at.y));
    let position = surface_interpolate(corner[triangle], place.u, place.v);
    let apart = position - met.surface.position;
    let distance2 = max(dot(apart, apart), F32_MIN_POSITIVE);
    let direction = vec_normalize(apart);
    let twice = path_area_vector(triangle);
    let area = 0.5 * sqrt(dot(twice, twice));
    let side = vec_normalize(twice);
    let cosine = abs(dot(side, direction));
    let drawn = chosen.chance / max(area, F32_MIN_POSITIVE);
    let density = drawn * (distance2 / max(cosine, 1e-9));
    if cosine <= 0.0 || density <= 0.0 || !mask_covers(triangle, place.u, place.v) {
        return own;
    }
    let emission = surface_emitted(words_material(triangle), place, direction);
    let weight = path_heuristic(bsdf_density(met.bsdf, direction) / density) / density;
    let reflected = path_reflected(met, direction, emission * weight);
    if all(reflected == vec3(0.0)) {
        return own;
    }
    let facing = select(side, -side, dot(side, direction) > 0.0);
    let end = position + facing * surface_lift(params.lift, position);
    if traverse_any_hit(params.nodes, ray_new(met.origin, end - met.origin), 1.0) {
        return own;
    }
    return walk_add(own, depth + 1u, reflected);
}

fn walk_scatter(own: Walk, depth: u32, met: Met, index: u32, stream: u32) -> Walk {
    var walk = own;
    walk.goes_on = false;
    if bsdf_is_black(met.bsdf) {
        return walk;
    }
    let pair = 1u + PATH_PAIRS * (depth - 1u);
    let which_part = sobol_point(index, pair, stream);
    let on_emitter = sobol_point(index, pair + 1u, stream);
    let towards = sobol_point(index, pair + 2u, stream);
    let roulette_emitter = sobol_point(index, pair + 3u, stream);
    walk = walk_connect_light(walk, depth, met, which_part.x);
    if EMITTERS {
        walk = walk_connect_emitter(walk, depth, met, roulette_emitter.y, on_emitter);
    }
    if depth + 1u == params.max_depth && !EMISSION {
        return walk;
    }
    let drawn = bsdf_sample(met.bsdf, towards, which_part.y);
    let both = drawn.scattered.diffuse + drawn.scattered.specular;
    if drawn.density <= 0.0 || all(both == vec3(0.0)) || dot(drawn.direction, met.facing) <= 0.0 {
        return walk;
    }
    let share = 1.0 / drawn.density;
    if depth == 1u {
        walk.diffuse = drawn.scattered.diffuse * share;
        walk.glossy = drawn.scattered.specular * share;
    } else {
        let through = both * share;
        walk.diffuse = walk.diffuse * through;
        walk.glossy = walk.glossy * through;
    }
    walk.density = drawn.density;
    if depth + 1u >= ROULETTE_DEPTH {
        let left = vec_luminance(walk.diffuse + walk.glossy);
        let chance = max(min(left, GO_ON_MOST), GO_ON_LEAST);
        if roulette_emitter.x >= chance {
            return walk;
        }
        walk.diffuse = walk.diffuse / chance;
        walk.glossy = walk.glossy / chance;
    }
    walk.goes_on = true;
    walk.ray = ray_new(met.origin, drawn.direction);
    return walk;
}

// The path of sample `index` through a pixel.
fn path_sample(x: u32, y: u32, index: u32) -> Light {
    let stream = path_stream(params.seed, x, y);
    var walk: Walk;
    walk.diffuse = vec3(1.0);
    walk.ray = path_camera_ray(params.view, x, y, sobol_point(index, 0u, stream));
    for (var depth = 1u; depth <= params.max_depth; depth++) {
        let ray = walk.ray;
        let hit = traverse_closest_hit(params.nodes, ray, F32_MAX);
        if hit.triangle == NO_TRIANGLE {
            break;
        }
        let met = path_meet(hit, ray);
        walk = walk_shine(walk, depth, met, ray);
        if depth == params.max_depth {
            break;
        }
        walk = walk_scatter(walk, depth, met, index, stream);
        if !walk.goes_on {
            break;
        }
    }
    return walk.light;
}
