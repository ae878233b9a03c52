//! needs: data/index, data/lights, data/scene, math/vec, phase/facing, sg/anisotropic
// The texels of reflective shadow maps as point lights. Twin of `PointSender::of` in `vsgl-core/src/phase/shade.rs` and of
// `target` in `phase/cluster.rs`.

override GLOSSY_SENDERS: bool = true;
override ANISOTROPIC_SENDERS: bool = false;

struct Params {
    // Texels of a map, and of all maps.
    map_texels: u32,
    count: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> corner: array<array<f32, 9>>;
@group(0) @binding(2) var<storage, read> map: array<MapRecord>;
@group(0) @binding(3) var<storage, read> triangle: array<u32>;
@group(0) @binding(4) var<storage, read> texel: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> sender_out: array<vec4<f32>>;

@compute @workgroup_size(INVOCATIONS)
fn senders(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    let count = params.count;
    if i >= count {
        return;
    }
    let position = texel[i];
    let normal = texel[count + i];
    let diffuse = texel[2u * count + i];
    var specular = vec4(0.0, 0.0, 0.0, 1.0);
    var grazing = vec4(0.0);
    if GLOSSY_SENDERS {
        specular = texel[3u * count + i];
        grazing = texel[4u * count + i];
    }
    var across = 0.0;
    var turn = 0.0;
    if ANISOTROPIC_SENDERS {
        let tangent = texel[5u * count + i];
        across = tangent.w;
        turn = anisotropic_turn_of(normal.xyz, tangent.xyz);
    }
    let record = map[i / params.map_texels];
    let apart = map_record_to_light(record, position.xyz);
    var facing = vec3(0.0, 0.0, 1.0);
    if triangle[i] != NO_TRIANGLE {
        facing = surface_geometric_normal(triangle[i], map_record_lit_side(record, position.xyz, normal.xyz));
    }
    let weight = vec_luminance(diffuse.xyz) + grazing.w;
    let at = 7u * i;
    sender_out[at] = vec4(position.xyz, position.w * (1.0 / 12.0));
    sender_out[at + 1u] = vec4(normal.xyz, specular.w);
    sender_out[at + 2u] = vec4(vec_normalize(apart), diffuse.w);
    sender_out[at + 3u] = vec4(diffuse.xyz, normal.w);
    sender_out[at + 4u] = vec4(specular.xyz, across);
    sender_out[at + 5u] = vec4(grazing.xyz, turn);
    sender_out[at + 6u] = vec4(facing, select(0.0, 1.0, weight > 0.0));
}
