//! needs: data/index, data/partition, data/scan_counts
// One pass of a stable sort of numbers by eight bits of what a table says of each: how often each digit occurs in a block, where
// the numbers of a digit and a block begin, and the numbers brought there.
//
// Source: the radix sort by counting; as Satish, Harris and Garland 2009, "Designing Efficient Sorting Algorithms for Manycore
// GPUs", section 4, with ranks from bits.

struct Params {
    shift: u32,
    // Blocks that there is room for.
    blocks: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// How many are sorted.
@group(0) @binding(1) var<storage, read> length: array<u32>;
@group(0) @binding(2) var<storage, read> value: array<u32>;
@group(0) @binding(3) var<storage, read> table: array<u32>;
@group(0) @binding(4) var<storage, read_write> count: array<u32>;
@group(0) @binding(5) var<storage, read_write> value_out: array<u32>;

// Workgroups of SCAN go over a block in so many steps.
const STEPS: u32 = SORT_BLOCK / SCAN;

fn digit_of(number: u32) -> u32 {
    return (table[number] >> params.shift) & 255u;
}

var<workgroup> histogram: array<atomic<u32>, SCAN>;

// A workgroup a block, as below.
@compute @workgroup_size(SCAN)
fn digits(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let block = group_index(group, groups);
    atomicStore(&histogram[local], 0u);
    workgroupBarrier();
    for (var step = 0u; step < STEPS; step += 1u) {
        let i = block * SORT_BLOCK + step * SCAN + local;
        if i < length[0] {
            atomicAdd(&histogram[digit_of(value[i])], 1u);
        }
    }
    workgroupBarrier();
    if block < params.blocks {
        count[local * params.blocks + block] = atomicLoad(&histogram[local]);
    }
}

// One workgroup.
@compute @workgroup_size(SCAN)
fn starts(@builtin(local_invocation_index) local: u32) {
    scan_counts(local, SCAN * params.blocks);
}

const WORDS: u32 = SCAN / 32u;
const BITS: u32 = SCAN * WORDS;

// Who of a step has a digit, a bit for each; and where the next number with a digit goes.
var<workgroup> who: array<atomic<u32>, BITS>;
var<workgroup> next: array<u32, SCAN>;

@compute @workgroup_size(SCAN)
fn move_values(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let block = group_index(group, groups);
    next[local] = count[local * params.blocks + min(block, params.blocks - 1u)];
    let word = local / 32u;
    let bit = local % 32u;
    for (var step = 0u; step < STEPS; step += 1u) {
        for (var w = 0u; w < WORDS; w += 1u) {
            atomicStore(&who[w * SCAN + local], 0u);
        }
        workgroupBarrier();
        let i = block * SORT_BLOCK + step * SCAN + local;
        let inside = i < length[0];
        var number = 0u;
        var digit = 0u;
        if inside {
            number = value[i];
            digit = digit_of(number);
            atomicOr(&who[digit * WORDS + word], 1u << bit);
        }
        workgroupBarrier();
        if inside {
            var at = next[digit];
            for (var w = 0u; w < word; w += 1u) {
                at += countOneBits(atomicLoad(&who[digit * WORDS + w]));
            }
            at += countOneBits(atomicLoad(&who[digit * WORDS + word]) & ((1u << bit) - 1u));
            value_out[at] = number;
        }
        workgroupBarrier();
        for (var w = 0u; w < WORDS; w += 1u) {
            next[local] += countOneBits(atomicLoad(&who[local * WORDS + w]));
        }
        workgroupBarrier();
    }
}
