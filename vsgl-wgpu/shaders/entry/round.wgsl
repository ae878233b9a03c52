//! needs: data/index, data/partition, data/scan, phase/partition
// A round of the partition: which sets are split, where their texels go, and what decides about the halves. Twin of
// `Tree::round` in `vsgl-cpu/src/phase/partition.rs`.

@group(0) @binding(0) var<storage, read> texel: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> place: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> list: array<u32>;
@group(0) @binding(3) var<storage, read_write> spare: array<u32>;
@group(0) @binding(4) var<storage, read_write> count: array<u32>;
@group(0) @binding(5) var<storage, read_write> node: array<Node>;
@group(0) @binding(6) var<storage, read> split: array<Split>;
@group(0) @binding(7) var<storage, read> state: State;
@group(0) @binding(8) var<storage, read_write> block: array<Features>;

// The split that a slot belongs to.
fn split_of(slot: u32) -> Split {
    var low = 0u;
    var high = state.open;
    while high - low > 1u {
        let middle = low + (high - low) / 2u;
        if split[middle].slot <= slot {
            low = middle;
        } else {
            high = middle;
        }
    }
    return split[low];
}

// What a workgroup works on, looked up by its first invocation.
var<workgroup> own: Split;
var<workgroup> parent: Node;

fn look_up(slot: u32, local: u32) {
    if local == 0u && slot < state.slots {
        own = split_of(slot);
        let from_node = node[own.node];
        parent.start = from_node.start;
        parent.length = from_node.length;
        parent.axis = from_node.axis;
        parent.threshold = from_node.threshold;
    }
    workgroupBarrier();
}

fn feature(index: u32, axis: u32) -> f32 {
    if axis < 4u {
        return place[index][axis];
    }
    return texel[state.texels + index][axis - 4u];
}

// Texels of a block that go to the first half. A workgroup a slot, as below.
@compute @workgroup_size(PARTITION_BLOCK)
fn halves(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let slot = group_index(group, groups);
    look_up(slot, local);
    var first = false;
    let i = (slot - own.slot) * PARTITION_BLOCK + local;
    if slot < state.slots && i < parent.length {
        first = feature(list[parent.start + i], parent.axis) <= parent.threshold;
    }
    let scanned = scan_flags(local, first);
    if local == 0u && slot < state.slots {
        count[slot] = scanned.total;
    }
}

@compute @workgroup_size(PARTITION_BLOCK)
fn scatter(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let slot = group_index(group, groups);
    let inside = slot < state.slots;
    look_up(slot, local);
    let start = parent.start;
    let length = parent.length;
    var before = 0u;
    var all = 0u;
    if inside {
        let blocks = blocks_of(length, PARTITION_BLOCK);
        for (var b = local; b < blocks; b += PARTITION_BLOCK) {
            let here = count[own.slot + b];
            all += here;
            before += select(0u, here, own.slot + b < slot);
        }
    }
    // Place in the range.
    let i = (slot - own.slot) * PARTITION_BLOCK + local;
    var index = 0u;
    var first = false;
    if inside && i < length {
        index = list[start + i];
        first = feature(index, parent.axis) <= parent.threshold;
    }
    let totals = scan_totals(local, vec2(all, before));
    let firsts = totals.x;
    let front = totals.y + scan_flags(local, first).before;
    if inside && i < length {
        spare[start + select(firsts + (i - front), front, first)] = index;
    }
    if inside && slot == own.slot && local == 0u {
        // All on one side: never to be tried again.
        let is_whole = firsts == 0u || firsts == length;
        node[own.child].start = start;
        node[own.child].length = select(firsts, 0u, is_whole);
        node[own.child + 1u].start = start + firsts;
        node[own.child + 1u].length = select(length - firsts, 0u, is_whole);
        if is_whole {
            node[own.node].rank = 0.0;
        }
    }
}

const HALF: u32 = PARTITION_BLOCK / 2u;
var<workgroup> halved: array<Features, HALF>;

// Texels of the block of a slot: the blocks of the first child, then those of the second.
struct Range {
    start: u32,
    length: u32,
}
var<workgroup> part: Range;

fn range_of(slot: u32) -> Range {
    if slot >= state.slots {
        return Range(0u, 0u);
    }
    let from_split = split_of(slot);
    var child = from_split.child;
    var b = slot - from_split.slot;
    let blocks = blocks_of(node[child].length, PARTITION_BLOCK);
    if b >= blocks {
        if state.roots > 0u {
            return Range(0u, 0u);
        }
        b -= blocks;
        child += 1u;
    }
    let passed = min(b * PARTITION_BLOCK, node[child].length);
    return Range(node[child].start + passed, min(node[child].length - passed, PARTITION_BLOCK));
}

fn features_at(index: u32) -> Features {
    return features_texel(place[index], texel[state.texels + index].xyz);
}

// Features of a block of a child; the texels come back into the list. Two texels an invocation.
@compute @workgroup_size(HALF)
fn features(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let slot = group_index(group, groups);
    if local == 0u {
        part = range_of(slot);
    }
    workgroupBarrier();
    let start = part.start;
    let length = part.length;
    if local < length {
        let index = moved(start + local);
        var sum = features_at(index);
        if local + HALF < length {
            let other = moved(start + local + HALF);
            sum = features_merge(sum, features_at(other));
        }
        halved[local] = sum;
    }
    workgroupBarrier();
    for (var half = HALF / 2u; half > 0u; half /= 2u) {
        if local < half && local + half < length {
            halved[local] = features_merge(halved[local], halved[local + half]);
        }
        workgroupBarrier();
    }
    if local == 0u && length > 0u {
        block[slot] = halved[0];
    }
}

fn moved(at: u32) -> u32 {
    if state.roots > 0u {
        return list[at];
    }
    let index = spare[at];
    list[at] = index;
    return index;
}

var<workgroup> lanes: array<Features, PARTITION_LANES>;

// The node of a child. A workgroup a child.
@compute @workgroup_size(PARTITION_LANES)
fn nodes(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let item = group_index(group, groups);
    let k = select(item / 2u, item, state.roots > 0u);
    let side = select(item % 2u, 0u, state.roots > 0u);
    var blocks = 0u;
    if k < state.open {
        let from_split = split[k];
        var slot = from_split.slot;
        if side > 0u {
            slot += blocks_of(node[from_split.child].length, PARTITION_BLOCK);
        }
        blocks = blocks_of(node[from_split.child + side].length, PARTITION_BLOCK);
        if local < blocks {
            var sum = block[slot + local];
            for (var b = local + PARTITION_LANES; b < blocks; b += PARTITION_LANES) {
                sum = features_merge(sum, block[slot + b]);
            }
            lanes[local] = sum;
        }
    }
    workgroupBarrier();
    for (var half = PARTITION_LANES / 2u; half > 0u; half /= 2u) {
        if local < half && local + half < blocks {
            lanes[local] = features_merge(lanes[local], lanes[local + half]);
        }
        workgroupBarrier();
    }
    if local == 0u && k < state.open {
        let from_split = split[k];
        var above = F32_MAX;
        var scale = 1.0;
        if state.roots > 0u {
            if blocks > 0u {
                scale = features_scale(lanes[0]);
            }
        } else {
            above = node[from_split.node].rank;
            scale = node[from_split.node].scale;
        }
        var at = Statistics();
        if blocks > 0u {
            at = statistics_new(lanes[0], scale);
        }
        let child = from_split.child + side;
        node[child].children = 0u;
        node[child].axis = at.axis;
        node[child].threshold = at.threshold;
        node[child].rank = min(at.priority, above);
        node[child].scale = scale;
        node[child].taken = 0u;
    }
}
