//! needs: data/index
// Triangle ids by the rasteriser: `vertex` and `fragment` draw them, `ids` brings them into the column that the camera's rays
// would fill.

struct Params {
    eye: vec3<f32>,
    // Distance of the near plane.
    near: f32,
    right: vec3<f32>,
    scale_x: f32,
    up: vec3<f32>,
    scale_y: f32,
    forward: vec3<f32>,
    offset_x: f32,
    offset_y: f32,
    // Samples in a row, and rows.
    width: u32,
    height: u32,
    padding: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// Nine numbers a triangle.
@group(0) @binding(1) var<storage, read> corner: array<f32>;
@group(0) @binding(2) var ids_drawn: texture_2d<u32>;
@group(0) @binding(3) var<storage, read_write> triangle_out: array<u32>;

struct Drawn {
    @builtin(position) place: vec4<f32>,
    @location(0) @interpolate(flat) id: u32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Drawn {
    let at = 3u * index;
    let apart = vec3(corner[at], corner[at + 1u], corner[at + 2u]) - params.eye;
    let depth = dot(apart, params.forward);
    let across = dot(apart, params.right) * params.scale_x + depth * params.offset_x;
    let upwards = dot(apart, params.up) * params.scale_y + depth * params.offset_y;
    // The nearest is the largest, which spreads the precision of floats evenly.
    return Drawn(vec4(across, upwards, params.near, depth), index / 3u);
}

@fragment
fn fragment(drawn: Drawn) -> @location(0) u32 {
    return drawn.id;
}

@compute @workgroup_size(INVOCATIONS)
fn ids(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    if i >= params.width * params.height {
        return;
    }
    triangle_out[i] = textureLoad(ids_drawn, vec2(i % params.width, i / params.width), 0).x;
}
