//! needs: data/partition, data/scan
// Which sets best-first splitting would split first. Twin of `Tree::best` in `vsgl-cpu/src/phase/partition.rs`; it finds the
// least rank among them digit by digit. One workgroup.

// After the last round: marks where the sets that are left begin, instead of opening any.
override LAST: bool = false;

@group(0) @binding(0) var<storage, read_write> state: State;
@group(0) @binding(1) var<storage, read_write> node: array<Node>;
@group(0) @binding(2) var<storage, read_write> split: array<Split>;
@group(0) @binding(3) var<storage, read_write> slot_groups: Groups;
@group(0) @binding(4) var<storage, read_write> child_groups: Groups;
@group(0) @binding(5) var<storage, read_write> mark: array<u32>;

var<workgroup> histogram: array<atomic<u32>, SCAN>;
var<workgroup> digit: u32;
var<workgroup> above_digit: u32;
var<workgroup> is_over: u32;

// Ranks as numbers of the same order; never negative.
fn key(i: u32) -> u32 {
    return bitcast<u32>(node[i].rank);
}

@compute @workgroup_size(SCAN)
fn best(@builtin(local_invocation_index) local: u32) {
    if local == 0u {
        // The round before had none.
        is_over = select(0u, 1u, state.open == 0u);
    }
    workgroupBarrier();
    if !LAST && is_over > 0u {
        return;
    }
    let nodes = state.nodes;
    var own = 0u;
    for (var i = local; i < nodes; i += SCAN) {
        own += select(0u, 1u, key(i) > 0u);
    }
    var wanted = min(scan_group(local, own).total, state.splits);
    let none = wanted == 0u;
    var least = 0u;
    for (var pass_number = 0u; pass_number < 4u; pass_number += 1u) {
        let shift = 24u - 8u * pass_number;
        atomicStore(&histogram[local], 0u);
        workgroupBarrier();
        for (var i = local; i < nodes; i += SCAN) {
            let k = key(i);
            // In two steps: no shift by all bits.
            if k > 0u && ((k >> shift) >> 8u) == least {
                atomicAdd(&histogram[(k >> shift) & 255u], 1u);
            }
        }
        workgroupBarrier();
        let here = atomicLoad(&histogram[SCAN - 1u - local]);
        let above = scan_group(local, here).before;
        if above < wanted && wanted <= above + here {
            digit = SCAN - 1u - local;
            above_digit = above;
        }
        workgroupBarrier();
        least = (least << 8u) | digit;
        wanted -= above_digit;
        workgroupBarrier();
    }
    // Taken: ranks above the least, and of that one as many as are still wanted, by index.
    if none {
        least = 0xffffffffu;
        wanted = 0u;
    }
    let chunk = blocks_of(nodes, SCAN);
    let first = min(local * chunk, nodes);
    let end = min(first + chunk, nodes);
    own = 0u;
    for (var i = first; i < end; i += 1u) {
        own += select(0u, 1u, key(i) == least);
    }
    let ties = scan_group(local, own).before;
    own = 0u;
    var tie = ties;
    for (var i = first; i < end; i += 1u) {
        let k = key(i);
        let taken = k > least || (k == least && tie < wanted);
        tie += select(0u, 1u, k == least);
        if LAST {
            node[i].taken = select(0u, 1u, taken && node[i].children > 0u);
        } else if taken && node[i].children == 0u {
            own += 1u;
        }
    }
    if LAST {
        storageBarrier();
        for (var i = first; i < end; i += 1u) {
            if i < state.maps {
                mark_leaf(i);
            }
            if node[i].taken > 0u {
                mark_leaf(node[i].children);
                mark_leaf(node[i].children + 1u);
            }
        }
        return;
    }
    let opened = scan_group(local, own);
    let open = min(opened.total, (state.most - nodes) / 2u);
    var k = opened.before;
    own = 0u;
    tie = ties;
    for (var i = first; i < end; i += 1u) {
        if opens(i, least, wanted, tie) {
            own += select(0u, blocks_of(node[i].length, PARTITION_BLOCK) + 1u, k < open);
            k += 1u;
        }
        tie += select(0u, 1u, key(i) == least);
    }
    let slots = scan_group(local, own);
    var slot = slots.before;
    k = opened.before;
    tie = ties;
    for (var i = first; i < end; i += 1u) {
        if opens(i, least, wanted, tie) && k < open {
            split[k] = Split(i, nodes + 2u * k, slot);
            slot += blocks_of(node[i].length, PARTITION_BLOCK) + 1u;
            node[i].children = nodes + 2u * k;
            k += 1u;
        }
        tie += select(0u, 1u, key(i) == least);
    }
    workgroupBarrier();
    if local == 0u {
        state.nodes = nodes + 2u * open;
        state.open = open;
        state.slots = slots.total;
        state.roots = 0u;
        slot_groups = groups_of(slots.total);
        child_groups = groups_of(2u * open);
    }
}

fn opens(i: u32, least: u32, wanted: u32, tie: u32) -> bool {
    let k = key(i);
    return (k > least || (k == least && tie < wanted)) && node[i].children == 0u;
}

fn mark_leaf(i: u32) {
    if node[i].taken == 0u && node[i].length > 0u {
        mark[node[i].start] = i + 1u;
    }
}
