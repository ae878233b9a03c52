//! needs: brdf/albedo, data/host, data/index, data/lights, data/scene, phase/facing
// A reflective shadow map from textures of a host. A dispatch a map.

override GLOSSY: bool = true;
// As in `entry/import_gbuffer.wgsl`.
override POSITIONS: bool = false;
override BIASED: bool = false;
override MATERIALS: bool = true;
override SCENE: bool = true;
// Whether `colors` holds the reflected flux of each texel, or base colours.
override FLUX: bool = false;
// Rays of a host's scene may meet masks, which its materials say.
const MASKS: bool = true;

struct Params {
    host: Host,
    map: MapRecord,
    // From the light to the place (0, 0) of clip space, in a plane across the view.
    centre: vec3<f32>,
    // First texel of the map, and texels of all maps.
    first: u32,
    // What one unit of clip space adds to it along each side.
    across: vec3<f32>,
    count: u32,
    upwards: vec3<f32>,
    padding: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var place: texture_2d<f32>;
@group(0) @binding(2) var normals: texture_2d<f32>;
@group(0) @binding(3) var colors: texture_2d<f32>;
@group(0) @binding(4) var materials: texture_2d<f32>;
@group(0) @binding(5) var<storage, read> node: array<BvhNode>;
@group(0) @binding(6) var<storage, read> corner: array<array<f32, 9>>;
@group(0) @binding(7) var<storage, read_write> triangle_out: array<u32>;
// Columns position, normal, diffuse, specular, grazing, one after the other.
@group(0) @binding(8) var<storage, read_write> texel_out: array<vec4<f32>>;
@group(0) @binding(9) var<storage, read_write> map_out: array<MapRecord>;
@group(0) @binding(10) var texels: texture_2d_array<u32>;
@group(0) @binding(11) var<uniform> columns: TexelLayout;

@compute @workgroup_size(INVOCATIONS)
fn import_rsm(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let host = params.host;
    let map = params.map;
    let size = host.width;
    let i = item_index(invocation, groups);
    if i >= size * size {
        return;
    }
    if i == 0u {
        map_out[params.first / (size * size)] = map;
    }
    let texel = vec2(i % size, i / size);
    let clip = host_clip(host, texel);
    let direction = params.centre + (params.across * clip.x + params.upwards * clip.y);
    let length = sqrt(dot(direction, direction));
    // A texel is a parallelogram on the plane: its area, seen from the light.
    let side = 2.0 / f32(size);
    let volume = abs(dot(direction, cross(params.across, params.upwards))) * (side * side);
    let solid_angle = volume / (length * length * length);
    let falloff = spot_light_falloff(dot(direction, map.cone) / length, map.cos_inner, map.cos_outer);
    var flux = map.intensity * (falloff * solid_angle);

    var found = host_surface(host, texel);
    let apart = map.position - found.position;
    let distance = sqrt(dot(apart, apart));
    let light = apart / max(distance, 1e-18);
    flux = flux * light_window(distance * distance, map.inverse_range2);
    var id = NO_TRIANGLE;
    var position = vec4(0.0);
    var normal = vec4(0.0, 0.0, 1.0, 0.0);
    var diffuse = vec4(0.0);
    var specular = vec4(0.0, 0.0, 0.0, 1.0);
    var grazing = vec4(0.0);
    if found.seen && any(flux > vec3(0.0)) {
        found.normal = select(found.normal, -found.normal, dot(found.normal, light) < 0.0);
        var facing = found.normal;
        id = 0u;
        if SCENE {
            let there = host_on_scene(host, map.position, found);
            id = there.triangle;
            found.position = there.position;
            if id != NO_TRIANGLE {
                facing = surface_geometric_normal(id, light);
            }
        }
        let cosine = max(dot(facing, light), FOOTPRINT_COSINE_MIN);
        position = vec4(found.position, solid_angle * (distance * distance) / cosine);
        normal = vec4(found.normal, 1.0);
        if FLUX {
            diffuse = vec4(found.base, host.dielectric_f0);
        } else {
            let base = min(found.base, vec3(1.0));
            let dielectric = vec3(host.dielectric_f0);
            let f0 = (dielectric + (base - dielectric) * found.metallic) * flux;
            diffuse = vec4((1.0 - found.metallic) * base * flux, host.dielectric_f0);
            specular = vec4(f0, found.alpha);
            let albedo = albedo_ggx_albedo(dot(found.normal, light), found.alpha);
            grazing = vec4(flux, vec_luminance(albedo_weigh(albedo, f0, flux)));
        }
    }
    let at = params.first + i;
    triangle_out[at] = id;
    texel_out[at] = position;
    texel_out[params.count + at] = normal;
    texel_out[2u * params.count + at] = diffuse;
    if GLOSSY {
        texel_out[3u * params.count + at] = specular;
        texel_out[4u * params.count + at] = grazing;
    }
}
