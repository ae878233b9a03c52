//! needs: data/index, data/partition, data/scan_counts, math/vec
// Before the rounds of the partition: weights, the list of lit texels, and a node for each map. Twin of `Tree::new` in
// `vsgl-cpu/src/phase/partition.rs`.

// The RSM has the columns of the specular part.
override GLOSSY: bool = true;

struct Params {
    // Texels of all maps, of a map, and maps.
    texels: u32,
    map_texels: u32,
    maps: u32,
    // Clusters wanted, and nodes that there is room for.
    clusters: u32,
    most: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> texel: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> place: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read_write> list: array<u32>;
@group(0) @binding(4) var<storage, read_write> label: array<u32>;
@group(0) @binding(5) var<storage, read_write> mark: array<u32>;
@group(0) @binding(6) var<storage, read_write> count: array<u32>;
@group(0) @binding(7) var<storage, read_write> node: array<Node>;
@group(0) @binding(8) var<storage, read_write> split: array<Split>;
@group(0) @binding(9) var<storage, read_write> state: State;
@group(0) @binding(10) var<storage, read_write> slot_groups: Groups;
@group(0) @binding(11) var<storage, read_write> child_groups: Groups;

// A texel an invocation.
@compute @workgroup_size(SCAN)
fn places(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let block = group_index(group, groups);
    let i = block * SCAN + local;
    var is_lit = false;
    if i < params.texels {
        var weight = vec_luminance(texel[2u * params.texels + i].xyz);
        if GLOSSY {
            weight += texel[4u * params.texels + i].w;
        }
        place[i] = vec4(texel[i].xyz, weight);
        label[i] = 0xffffffffu;
        mark[i] = 0u;
        is_lit = weight > 0.0;
    }
    let scanned = scan_flags(local, is_lit);
    if local == 0u && block * SCAN < params.texels {
        count[block] = scanned.total;
    }
}

// One workgroup: the blocks' running sum in place of their counts.
@compute @workgroup_size(SCAN)
fn lit(@builtin(local_invocation_index) local: u32) {
    let total = scan_counts(local, blocks_of(params.texels, SCAN));
    if local == 0u {
        state.lit = total;
    }
}

@compute @workgroup_size(SCAN)
fn compact(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let block = group_index(group, groups);
    let i = block * SCAN + local;
    var is_lit = false;
    if i < params.texels {
        is_lit = place[i].w > 0.0;
    }
    let scanned = scan_flags(local, is_lit);
    if i < params.texels {
        let at = count[block] + scanned.before;
        if is_lit {
            list[at] = i;
        }
        if i % params.map_texels == 0u {
            node[i / params.map_texels].start = at;
        }
    }
}

// One workgroup: the maps' nodes, as if they were the first of two children each.
@compute @workgroup_size(SCAN)
fn roots(@builtin(local_invocation_index) local: u32) {
    let maps = params.maps;
    let chunk = blocks_of(maps, SCAN);
    let first = min(local * chunk, maps);
    let end = min(first + chunk, maps);
    let total = state.lit;
    var slots = 0u;
    var lit = 0u;
    for (var m = first; m < end; m += 1u) {
        let length = root_end(m, total) - node[m].start;
        slots += blocks_of(length, PARTITION_BLOCK) + 1u;
        lit += select(0u, 1u, length > 0u);
    }
    let scanned = scan_group(local, slots);
    let lit_maps = scan_group(local, lit).total;
    var slot = scanned.before;
    for (var m = first; m < end; m += 1u) {
        let length = root_end(m, total) - node[m].start;
        node[m].length = length;
        split[m] = Split(m, m, slot);
        slot += blocks_of(length, PARTITION_BLOCK) + 1u;
    }
    if local == 0u {
        state.maps = maps;
        state.texels = params.texels;
        state.splits = params.clusters - min(params.clusters, lit_maps);
        state.most = params.most;
        state.nodes = maps;
        state.open = maps;
        state.slots = scanned.total;
        state.roots = 1u;
        slot_groups = groups_of(scanned.total);
        child_groups = groups_of(maps);
    }
}

fn root_end(m: u32, total: u32) -> u32 {
    if m + 1u < params.maps {
        return node[m + 1u].start;
    }
    return total;
}
