//! needs: geom/traverse, math/vec
// Surfaces that a host found itself, in its own textures.
//
// Reads `place`, `normals`, `colors` and `materials`, and for `host_on_scene` what rays read, all of which the entry binds.

struct Host {
    // From clip space to the world.
    to_world: mat4x4<f32>,
    // Depth where there is nothing.
    background: f32,
    // Factors where they are in no texture, and channels where they are.
    roughness: f32,
    metallic: f32,
    roughness_channel: u32,
    metallic_channel: u32,
    dielectric_f0: f32,
    width: u32,
    height: u32,
    nodes: u32,
    padding_a: u32,
    padding_b: u32,
    padding_c: u32,
}

struct HostSurface {
    seen: bool,
    position: vec3<f32>,
    normal: vec3<f32>,
    base: vec3<f32>,
    metallic: f32,
    alpha: f32,
}

// Where a texel's centre lies in clip space.
fn host_clip(host: Host, at: vec2<u32>) -> vec2<f32> {
    let x = (f32(at.x) + 0.5) / f32(host.width);
    let y = (f32(at.y) + 0.5) / f32(host.height);
    return vec2(2.0 * x - 1.0, 1.0 - 2.0 * y);
}

// Neither NaN nor infinite.
fn host_is_finite(v: vec3<f32>) -> bool {
    let exponents = bitcast<vec3<u32>>(v) & vec3(0x7f800000u);
    return all(exponents != vec3(0x7f800000u));
}

// The surface in a texel, its normal as the host has it. Whatever is not a number is no surface.
fn host_surface(host: Host, at: vec2<u32>) -> HostSurface {
    let stored = textureLoad(place, at, 0);
    var position = stored.xyz;
    var seen = stored.w != 0.0;
    if !POSITIONS {
        let world = host.to_world * vec4(host_clip(host, at), stored.x, 1.0);
        position = world.xyz / world.w;
        seen = stored.x != host.background;
    }
    var normal = textureLoad(normals, at, 0).xyz;
    if BIASED {
        normal = 2.0 * normal - 1.0;
    }
    let color = textureLoad(colors, at, 0).xyz;
    var roughness = host.roughness;
    var metallic = host.metallic;
    if MATERIALS {
        let factors = textureLoad(materials, at, 0);
        roughness = factors[host.roughness_channel];
        metallic = factors[host.metallic_channel];
    }
    let finite = host_is_finite(position) && host_is_finite(normal) && host_is_finite(color)
        && host_is_finite(vec3(roughness, metallic, 0.0));
    roughness = max(min(roughness, 1.0), 0.0);
    return HostSurface(
        seen && finite && dot(normal, normal) > 0.0,
        position,
        vec_normalize(normal),
        max(color, vec3(0.0)),
        max(min(metallic, 1.0), 0.0),
        max(roughness * roughness, ALPHA_MIN),
    );
}

// The surface as the scene has it: on the triangle that is seen there from `eye`, else on the one below. Positions from depths
// lie off their triangles by more than the ends of rays are lifted, and would shadow themselves.
struct HostOnScene {
    triangle: u32,
    position: vec3<f32>,
}

fn host_on_scene(host: Host, eye: vec3<f32>, surface: HostSurface) -> HostOnScene {
    let apart = surface.position - eye;
    var hit = traverse_closest_hit(host.nodes, ray_new(eye, apart), 1.01);
    if hit.triangle == NO_TRIANGLE || hit.t < 0.99 {
        let height = 0.01 * sqrt(dot(apart, apart));
        let above = surface.position + surface.normal * height;
        hit = traverse_closest_hit(host.nodes, ray_new(above, -surface.normal), 2.0 * height);
    }
    if hit.triangle == NO_TRIANGLE {
        return HostOnScene(NO_TRIANGLE, surface.position);
    }
    let corners = corner[hit.triangle];
    let a = vec3(corners[0], corners[1], corners[2]);
    let ab = vec3(corners[3], corners[4], corners[5]) - a;
    let ac = vec3(corners[6], corners[7], corners[8]) - a;
    return HostOnScene(hit.triangle, a + (ab * hit.u + ac * hit.v));
}
