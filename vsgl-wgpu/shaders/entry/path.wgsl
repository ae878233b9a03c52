//! needs: data/index, phase/path
// Light along paths through each pixel: a dispatch for each band of pixels and some samples, added up in the order of samples.

override GLOSSY: bool = true;
override TEXTURES: bool = true;
override NORMAL_MAPS: bool = true;
override COLORS: bool = true;
override UNLIT_ONES: bool = true;
override ANISOTROPY: bool = true;
override MASKS: bool = true;
override EMISSION: bool = true;
// Points of surfaces that shine are drawn.
override EMITTERS: bool = true;
// They are drawn by their power, not evenly.
override BY_POWER: bool = true;
// Light of lights is reflected by `bsdf` here, not by `direct_radiance`.
const ANISOTROPIC_RECEIVERS: bool = false;

struct Params {
    view: View,
    lift: f32,
    nodes: u32,
    lights: u32,
    // Triangles that shine.
    lamps: u32,
    max_depth: u32,
    seed: u32,
    // Samples of this dispatch, of which the first of a piece begins the sum.
    first_sample: u32,
    end_sample: u32,
    begins: u32,
    // Pixels of this dispatch.
    first: u32,
    end: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> node: array<BvhNode>;
@group(0) @binding(2) var<storage, read> corner: array<array<f32, 9>>;
@group(0) @binding(3) var<storage, read> corner_normal: array<array<f32, 9>>;
@group(0) @binding(4) var texels: texture_2d_array<u32>;
@group(0) @binding(5) var<storage, read> direct_light: array<LightRecord>;
@group(0) @binding(6) var<storage, read> lamp: array<LampRecord>;
// Columns direct, indirect_diffuse, indirect_glossy.
@group(0) @binding(7) var<storage, read_write> radiance_out: array<f32>;
@group(0) @binding(8) var<uniform> columns: TexelLayout;

fn before(column: u32, i: u32) -> vec3<f32> {
    let at = 3u * (column * (params.view.samples_x * params.view.samples_y) + i);
    return vec3(radiance_out[at], radiance_out[at + 1u], radiance_out[at + 2u]);
}

fn write(column: u32, i: u32, value: vec3<f32>) {
    let at = 3u * (column * (params.view.samples_x * params.view.samples_y) + i);
    radiance_out[at] = value.x;
    radiance_out[at + 1u] = value.y;
    radiance_out[at + 2u] = value.z;
}

@compute @workgroup_size(INVOCATIONS)
fn trace(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = params.first + item_index(invocation, groups);
    if i >= params.end {
        return;
    }
    var sum: Light;
    if params.begins == 0u {
        sum = Light(before(0u, i), before(1u, i), before(2u, i));
    }
    let across = params.view.samples_x;
    for (var index = params.first_sample; index < params.end_sample; index++) {
        let more = path_sample(i % across, i / across, index);
        sum.direct += more.direct;
        sum.indirect_diffuse += more.indirect_diffuse;
        sum.indirect_glossy += more.indirect_glossy;
    }
    write(0u, i, sum.direct);
    write(1u, i, sum.indirect_diffuse);
    write(2u, i, sum.indirect_glossy);
}
