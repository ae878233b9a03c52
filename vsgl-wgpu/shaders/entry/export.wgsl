//! needs: data/index
// One bounce into a texture of a host: stored by `store_half` and `store_float`, or drawn by `vertex` and `fragment`.

struct Params {
    width: u32,
    height: u32,
    // Whether there are the columns of one bounce: none, the diffuse one, the glossy one too.
    columns: u32,
    // The greatest number of the host's format.
    most: f32,
}

@group(0) @binding(0) var<uniform> params: Params;
// Columns direct, indirect_diffuse, indirect_glossy.
@group(0) @binding(1) var<storage, read> radiance: array<f32>;
@group(0) @binding(2) var target_half: texture_storage_2d<rgba16float, write>;
@group(0) @binding(3) var target_float: texture_storage_2d<rgba32float, write>;

fn indirect_at(i: u32) -> vec4<f32> {
    var sum = vec3(0.0);
    for (var column = 1u; column <= params.columns; column++) {
        let at = 3u * (column * (params.width * params.height) + i);
        sum += vec3(radiance[at], radiance[at + 1u], radiance[at + 2u]);
    }
    return vec4(min(sum, vec3(params.most)), 1.0);
}

@compute @workgroup_size(INVOCATIONS)
fn store_half(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    if i < params.width * params.height {
        textureStore(target_half, vec2(i % params.width, i / params.width), indirect_at(i));
    }
}

@compute @workgroup_size(INVOCATIONS)
fn store_float(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    if i < params.width * params.height {
        textureStore(target_float, vec2(i % params.width, i / params.width), indirect_at(i));
    }
}

// One triangle over the whole picture.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let x = select(-1.0, 3.0, index == 1u);
    let y = select(-1.0, 3.0, index == 2u);
    return vec4(x, y, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) place: vec4<f32>) -> @location(0) vec4<f32> {
    let x = u32(place.x);
    let y = u32(place.y);
    return indirect_at(y * params.width + x);
}
