//! needs: data/index, data/partition, data/vsgls_write, phase/cluster, phase/unit
// From the ranges of the partition to lights: sums of blocks, of clusters, and what is made of them. Twin of `clusters` in
// `vsgl-cpu/src/phase/partition.rs`, and of `gather` in `cluster.rs` there.

override GLOSSY: bool = true;
override ANISOTROPIC: bool = false;
// Published forms instead of ours.
override SG: bool = false;
override APART: bool = false;
override TOKSVIG: bool = false;
override TRACE: bool = false;

struct Params {
    // Texels of all maps, and of a map.
    texels: u32,
    map_texels: u32,
    // Lights that there is room for, and what a specular one takes.
    capacity: u32,
    specular_stride: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> texel: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> map: array<MapRecord>;
@group(0) @binding(3) var<storage, read> triangle: array<u32>;
@group(0) @binding(4) var<storage, read> corner: array<array<f32, 9>>;
@group(0) @binding(5) var<storage, read> list: array<u32>;
@group(0) @binding(6) var<storage, read> place: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read> cluster: array<Cluster>;
@group(0) @binding(8) var<storage, read> clusters: array<u32>;
@group(0) @binding(9) var<storage, read> block: array<Sum>;
@group(0) @binding(10) var<storage, read> sum: array<Sum>;
@group(0) @binding(11) var<storage, read> drawn: array<u32>;
@group(0) @binding(12) var<storage, read_write> block_out: array<Sum>;
@group(0) @binding(13) var<storage, read_write> sum_out: array<Sum>;
@group(0) @binding(14) var<storage, read_write> drawn_out: array<u32>;
@group(0) @binding(15) var<storage, read_write> lights: array<vec4<f32>>;

var<workgroup> halved: array<Sum, CLUSTER_BLOCK>;

// What a workgroup works on, looked up by its first invocation.
var<workgroup> own: Cluster;

// The cluster that a block belongs to.
fn cluster_of(block_number: u32) -> u32 {
    var low = 0u;
    var high = clusters[0];
    while high - low > 1u {
        let middle = low + (high - low) / 2u;
        if cluster[middle].block <= block_number {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

// A workgroup a block.
@compute @workgroup_size(CLUSTER_BLOCK)
fn block_sums(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let number = group_index(group, groups);
    if local == 0u {
        own = cluster[cluster_of(number)];
    }
    workgroupBarrier();
    let first = (number - own.block) * CLUSTER_BLOCK;
    // The grid may hold more than there are.
    let length = own.length - min(own.length, first);
    if local < length {
        halved[local] = sum_texel(list[own.start + first + local], params.texels, params.map_texels);
    }
    workgroupBarrier();
    for (var half = CLUSTER_BLOCK / 2u; half > 0u; half /= 2u) {
        if local < half && local + half < length {
            halved[local] = sum_merge(halved[local], halved[local + half]);
        }
        workgroupBarrier();
    }
    if local == 0u && length > 0u {
        block_out[number] = halved[0];
    }
}

var<workgroup> lanes: array<Sum, CLUSTER_LANES>;

// A workgroup a cluster. Its first invocation draws the texel that stands for it meanwhile.
@compute @workgroup_size(CLUSTER_LANES)
fn cluster_sums(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let number = group_index(group, groups);
    var blocks = 0u;
    if local == 0u {
        own = cluster[number];
    }
    workgroupBarrier();
    if number < clusters[0] {
        blocks = blocks_of(own.length, CLUSTER_BLOCK);
        if local < blocks {
            var merged = block[own.block + local];
            for (var b = local + CLUSTER_LANES; b < blocks; b += CLUSTER_LANES) {
                merged = sum_merge(merged, block[own.block + b]);
            }
            lanes[local] = merged;
        }
        if local == 0u {
            drawn_out[number] = draw(blocks, pdf_unit(number * GOLDEN_TURN));
        }
    }
    workgroupBarrier();
    for (var half = CLUSTER_LANES / 2u; half > 0u; half /= 2u) {
        if local < half && local + half < blocks {
            lanes[local] = sum_merge(lanes[local], lanes[local + half]);
        }
        workgroupBarrier();
    }
    if local == 0u && blocks > 0u {
        sum_out[number] = lanes[0];
    }
}

// Twin of `draw` and `pick` in `vsgl-core/src/phase/cluster.rs`.
fn draw(blocks: u32, u: f32) -> u32 {
    var total = 0.0;
    for (var b = 0u; b < blocks; b += 1u) {
        total += block_weight(own.block + b);
    }
    var wanted = u * total;
    var passed = 0.0;
    var picked = 0u;
    var rest = 0.0;
    for (var b = 0u; b < blocks; b += 1u) {
        let weight = block_weight(own.block + b);
        if weight > 0.0 && passed <= wanted {
            picked = b;
            rest = wanted - passed;
        }
        passed += weight;
    }
    wanted = rest;
    passed = 0.0;
    let first = picked * CLUSTER_BLOCK;
    let length = min(own.length - first, CLUSTER_BLOCK);
    picked = list[own.start + first];
    for (var i = 0u; i < length; i += 1u) {
        let index = list[own.start + first + i];
        let weight = place[index].w;
        if weight > 0.0 && passed <= wanted {
            picked = index;
        }
        passed += weight;
    }
    return picked;
}

fn block_weight(b: u32) -> f32 {
    return block[b].diffuse.weight + block[b].specular.weight;
}

// A cluster an invocation.
@compute @workgroup_size(INVOCATIONS)
fn make_lights(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let j = item_index(invocation, groups);
    if j >= min(params.capacity, clusters[0]) {
        return;
    }
    let index = drawn[j];
    var made = cluster_lights(sum[j], map[index / params.map_texels]);
    if ANISOTROPIC {
        let along = texel[3u * params.texels + index].w;
        made.specular = cluster_stretched(made.specular, along, texel[5u * params.texels + index]);
    }
    diffuse_vsgl_write(j, made.diffuse);
    if GLOSSY {
        specular_vsgl_write(j, params.capacity, made.specular);
    }
    target_write(j, params.capacity, params.specular_stride, cluster_target(index, params.texels, params.map_texels));
}
