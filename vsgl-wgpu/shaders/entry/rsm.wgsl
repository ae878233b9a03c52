//! needs: data/index, geom/traverse, phase/rsm
// Reflective shadow maps: which triangle each texel sees, then the virtual point light there. A dispatch a map.

override GLOSSY: bool = true;
override TEXTURES: bool = true;
override NORMAL_MAPS: bool = true;
override COLORS: bool = true;
override UNLIT_ONES: bool = true;
override ANISOTROPY: bool = true;
override MASKS: bool = true;
// Maps have no place for it.
const EMISSION: bool = false;

struct Params {
    map: MapRecord,
    nodes: u32,
    // Texels along a side.
    size: u32,
    // First texel of the map, and texels of all maps.
    first: u32,
    count: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> node: array<BvhNode>;
@group(0) @binding(2) var<storage, read> corner: array<array<f32, 9>>;
@group(0) @binding(3) var<storage, read> corner_normal: array<array<f32, 9>>;
@group(0) @binding(4) var texels: texture_2d_array<u32>;
@group(0) @binding(5) var<storage, read> triangle: array<u32>;
@group(0) @binding(6) var<storage, read_write> triangle_out: array<u32>;
// Columns position, normal, diffuse, specular, grazing, tangent, one after the other.
@group(0) @binding(7) var<storage, read_write> texel_out: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> map_out: array<MapRecord>;
@group(0) @binding(9) var<uniform> columns: TexelLayout;

@compute @workgroup_size(INVOCATIONS)
fn visibility(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    if i >= params.size * params.size {
        return;
    }
    if i == 0u {
        map_out[params.first / (params.size * params.size)] = params.map;
    }
    let sent = rsm_ray(params.map, params.size, i % params.size, i / params.size);
    var id = NO_TRIANGLE;
    if any(sent.flux != vec3(0.0)) {
        id = traverse_closest_hit(params.nodes, sent.ray, F32_MAX).triangle;
    }
    triangle_out[params.first + i] = id;
}

@compute @workgroup_size(INVOCATIONS)
fn surface(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    if i >= params.size * params.size {
        return;
    }
    let at = params.first + i;
    let id = triangle[at];
    var seen = rsm_empty();
    if id != NO_TRIANGLE {
        let sent = rsm_ray(params.map, params.size, i % params.size, i / params.size);
        let found = triangle_cross(sent.ray.origin, sent.ray.direction, corner[id]);
        let hit = Hit(id, found.t, found.u, found.v);
        seen = rsm_texel(params.map, params.size, sent.ray, sent.flux, hit);
    }
    texel_out[at] = seen.position;
    texel_out[params.count + at] = seen.normal;
    texel_out[2u * params.count + at] = seen.diffuse;
    if GLOSSY {
        texel_out[3u * params.count + at] = seen.specular;
        texel_out[4u * params.count + at] = seen.grazing;
    }
    if ANISOTROPY {
        texel_out[5u * params.count + at] = seen.tangent;
    }
}
