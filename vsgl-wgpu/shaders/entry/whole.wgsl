//! needs: data/index, data/partition, data/scan, phase/cluster, phase/unit
// One cluster for each map: sums of chunks, of maps, and the numbers of those with light. Twin of
// `vsgl-core/src/phase/whole.rs`, and of `vsgl-cpu/src/phase/whole.rs`.

override GLOSSY: bool = true;
override ANISOTROPIC: bool = false;
override SG: bool = false;
override APART: bool = false;
override TOKSVIG: bool = false;
override TRACE: bool = false;

struct Params {
    // Texels of all maps, and of a map.
    texels: u32,
    map_texels: u32,
    maps: u32,
    // Chunks of a map.
    chunks: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> texel: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> map: array<MapRecord>;
@group(0) @binding(3) var<storage, read> triangle: array<u32>;
@group(0) @binding(4) var<storage, read> corner: array<array<f32, 9>>;
// Sums of chunks; of maps, and the texel that stands for each.
@group(0) @binding(5) var<storage, read_write> chunk: array<Sum>;
@group(0) @binding(6) var<storage, read_write> whole: array<Sum>;
@group(0) @binding(7) var<storage, read_write> whole_drawn: array<u32>;
// Of those with light alone.
@group(0) @binding(8) var<storage, read_write> clusters: array<u32>;
@group(0) @binding(9) var<storage, read_write> sum_out: array<Sum>;
@group(0) @binding(10) var<storage, read_write> drawn_out: array<u32>;

var<workgroup> lanes: array<Sum, WHOLE_LANES>;

fn sum_join(own: Sum, other: Sum) -> Sum {
    if sum_weight(other) <= 0.0 {
        return own;
    }
    if sum_weight(own) <= 0.0 {
        return other;
    }
    return sum_merge(own, other);
}

fn weight_of(index: u32) -> f32 {
    let diffuse = vec_luminance(texel[2u * params.texels + index].xyz);
    if GLOSSY {
        return diffuse + texel[4u * params.texels + index].w;
    }
    return diffuse;
}

// Every invocation calls it; the sum is that of the first lane.
fn halve(local: u32) {
    workgroupBarrier();
    for (var half = WHOLE_LANES / 2u; half > 0u; half /= 2u) {
        if local < half {
            lanes[local] = sum_join(lanes[local], lanes[local + half]);
        }
        workgroupBarrier();
    }
}

// A workgroup a chunk.
@compute @workgroup_size(WHOLE_LANES)
fn chunks(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let number = group_index(group, groups);
    let m = number / params.chunks;
    let start = number % params.chunks * WHOLE_CHUNK;
    var own = Sum();
    // The grid may hold more than there are.
    if m < params.maps {
        let end = min(start + WHOLE_CHUNK, params.map_texels);
        for (var t = start + local; t < end; t += WHOLE_LANES) {
            let index = m * params.map_texels + t;
            if weight_of(index) > 0.0 {
                own = sum_join(own, sum_texel(index, params.texels, params.map_texels));
            }
        }
    }
    lanes[local] = own;
    halve(local);
    if local == 0u && m < params.maps {
        chunk[number] = lanes[0];
    }
}

// A workgroup a map. Its first invocation draws the texel that stands for it meanwhile.
@compute @workgroup_size(WHOLE_LANES)
fn maps(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let m = group_index(group, groups);
    var own = Sum();
    if m < params.maps {
        for (var c = local; c < params.chunks; c += WHOLE_LANES) {
            own = sum_join(own, chunk[m * params.chunks + c]);
        }
    }
    lanes[local] = own;
    if local == 0u && m < params.maps {
        whole_drawn[m] = whole_draw(m, pdf_unit(m * GOLDEN_TURN + 0x80000000u));
    }
    halve(local);
    if local == 0u && m < params.maps {
        whole[m] = lanes[0];
    }
}

// Twin of `draw` in `vsgl-core/src/phase/whole.rs`.
fn whole_draw(m: u32, u: f32) -> u32 {
    let own = m * params.chunks;
    var total = 0.0;
    for (var c = 0u; c < params.chunks; c += 1u) {
        total += sum_weight(chunk[own + c]);
    }
    var wanted = u * total;
    var passed = 0.0;
    var picked = 0u;
    var rest = 0.0;
    for (var c = 0u; c < params.chunks; c += 1u) {
        let weight = sum_weight(chunk[own + c]);
        if weight > 0.0 && passed <= wanted {
            picked = c;
            rest = wanted - passed;
        }
        passed += weight;
    }
    wanted = rest;
    passed = 0.0;
    let start = picked * WHOLE_CHUNK;
    let end = min(start + WHOLE_CHUNK, params.map_texels);
    picked = start;
    for (var t = start; t < end; t += 1u) {
        let weight = weight_of(m * params.map_texels + t);
        if weight > 0.0 && passed <= wanted {
            picked = t;
        }
        passed += weight;
    }
    return m * params.map_texels + picked;
}

// One workgroup: maps without light become no cluster.
@compute @workgroup_size(SCAN)
fn numbers(@builtin(local_invocation_index) local: u32) {
    let count = params.maps;
    let share = blocks_of(count, SCAN);
    let first = min(local * share, count);
    let end = min(first + share, count);
    var lit = 0u;
    for (var m = first; m < end; m += 1u) {
        lit += select(0u, 1u, sum_weight(whole[m]) > 0.0);
    }
    let scanned = scan_group(local, lit);
    var number = scanned.before;
    for (var m = first; m < end; m += 1u) {
        if sum_weight(whole[m]) > 0.0 {
            sum_out[number] = whole[m];
            drawn_out[number] = whole_drawn[m];
            number += 1u;
        }
    }
    if local == 0u {
        clusters[0] = scanned.total;
    }
}
