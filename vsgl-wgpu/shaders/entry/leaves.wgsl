//! needs: data/index, data/partition, data/scan_counts
// After the rounds of the partition, or the sort by the nearest centre: clusters are numbered by where their ranges of the list
// begin. Twin of `Tree::sets` in `vsgl-cpu/src/phase/partition.rs`.

@group(0) @binding(0) var<storage, read> list: array<u32>;
// Not 0 where a range begins.
@group(0) @binding(1) var<storage, read> mark: array<u32>;
@group(0) @binding(2) var<storage, read_write> state: State;
@group(0) @binding(3) var<storage, read_write> count: array<u32>;
@group(0) @binding(4) var<storage, read_write> label: array<u32>;
@group(0) @binding(5) var<storage, read_write> cluster: array<Cluster>;
@group(0) @binding(6) var<storage, read_write> clusters: array<u32>;
@group(0) @binding(7) var<storage, read_write> block_groups: Groups;

// A place of the list an invocation.
@compute @workgroup_size(SCAN)
fn begins(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let block = group_index(group, groups);
    let i = block * SCAN + local;
    let scanned = scan_flags(local, begins_at(i));
    if local == 0u && block * SCAN < state.texels {
        count[block] = scanned.total;
    }
}

fn begins_at(i: u32) -> bool {
    if i < state.texels {
        return mark[i] > 0u;
    }
    return false;
}

// One workgroup: the blocks' running sum in place of their counts, and the number of clusters.
@compute @workgroup_size(SCAN)
fn numbers(@builtin(local_invocation_index) local: u32) {
    let total = scan_counts(local, blocks_of(state.texels, SCAN));
    if local == 0u {
        clusters[0] = total;
    }
}

@compute @workgroup_size(SCAN)
fn labels(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let block = group_index(group, groups);
    let i = block * SCAN + local;
    let begins = begins_at(i);
    let scanned = scan_flags(local, begins);
    if i < state.lit {
        // Of the range that began last, here or before.
        let number = count[block] + scanned.before + select(0u, 1u, begins) - 1u;
        label[list[i]] = number;
        if begins {
            cluster[number] = Cluster(i, 0u, 0u);
        }
    }
}

// A range ends where the next begins.
fn length_of(c: u32, all: u32) -> u32 {
    var end = state.lit;
    if c + 1u < all {
        end = cluster[c + 1u].start;
    }
    return end - cluster[c].start;
}

// One workgroup: the clusters' lengths and blocks.
@compute @workgroup_size(SCAN)
fn blocks(@builtin(local_invocation_index) local: u32) {
    let all = clusters[0];
    let chunk = blocks_of(all, SCAN);
    let first = min(local * chunk, all);
    let end = min(first + chunk, all);
    var own = 0u;
    for (var c = first; c < end; c += 1u) {
        own += blocks_of(length_of(c, all), CLUSTER_BLOCK);
    }
    let scanned = scan_group(local, own);
    var passed = scanned.before;
    for (var c = first; c < end; c += 1u) {
        let length = length_of(c, all);
        cluster[c].length = length;
        cluster[c].block = passed;
        passed += blocks_of(length, CLUSTER_BLOCK);
    }
    if local == 0u {
        state.blocks = scanned.total;
        block_groups = groups_of(scanned.total);
    }
}
