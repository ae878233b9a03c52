//! needs: data/index, data/lights, phase/emit
// The map of the surfaces that shine.

override GLOSSY: bool = true;
override ANISOTROPY: bool = true;

struct Params {
    map: MapRecord,
    // Texels along a side.
    size: u32,
    // First texel of the map, and texels of all maps.
    first: u32,
    count: u32,
    // Points that there are.
    points: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> emitter: array<EmitterRecord>;
@group(0) @binding(2) var<storage, read_write> triangle_out: array<u32>;
// Columns position, normal, diffuse, specular, grazing, tangent, one after the other.
@group(0) @binding(3) var<storage, read_write> texel_out: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> map_out: array<MapRecord>;

@compute @workgroup_size(INVOCATIONS)
fn emitters(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    let texels = params.size * params.size;
    if i >= texels {
        return;
    }
    if i == 0u {
        map_out[params.first / texels] = params.map;
    }
    let at = params.first + i;
    var made = rsm_empty();
    var id = NO_TRIANGLE;
    let which = emit_point(i, texels, params.points);
    if which < params.points {
        let found = emitter[which];
        id = found.triangle;
        made = emit_texel(found, texels, params.points);
    }
    triangle_out[at] = id;
    texel_out[at] = made.position;
    texel_out[params.count + at] = made.normal;
    texel_out[2u * params.count + at] = made.diffuse;
    if GLOSSY {
        texel_out[3u * params.count + at] = made.specular;
        texel_out[4u * params.count + at] = made.grazing;
    }
    if ANISOTROPY {
        texel_out[5u * params.count + at] = made.tangent;
    }
}
