// What the kernels of the partition hand on to each other.

// A set of texels: a range of the list.
struct Node {
    start: u32,
    length: u32,
    // Index of the first of two children; 0 for none.
    children: u32,
    axis: u32,
    threshold: f32,
    rank: f32,
    // See `features_scale`.
    scale: f32,
    // Split in the tree that is taken in the end.
    taken: u32,
}

// A set that a round tries to split. As many slots as it has blocks, and one more, are kept for the blocks of its children.
struct Split {
    node: u32,
    // First of the two children.
    child: u32,
    // First slot.
    slot: u32,
}

struct State {
    // Maps, texels of all of them, and those with weight.
    maps: u32,
    texels: u32,
    lit: u32,
    // Sets that may be split, and nodes that there is room for.
    splits: u32,
    most: u32,
    nodes: u32,
    // Of this round: sets to split, and slots.
    open: u32,
    slots: u32,
    // Blocks that the clusters are summed up by.
    blocks: u32,
    // 1 while the nodes are those of the maps, each as if it were the first of two children.
    roots: u32,
}

// A range of the list in the end, and the first of the blocks that it is summed up by.
struct Cluster {
    start: u32,
    length: u32,
    block: u32,
}

// So many workgroups, in rows that the limits allow.
struct Groups {
    x: u32,
    y: u32,
    z: u32,
}

fn groups_of(count: u32) -> Groups {
    let rows = max((count + 65534u) / 65535u, 1u);
    return Groups((count + rows - 1u) / rows, rows, 1u);
}

fn blocks_of(length: u32, block: u32) -> u32 {
    return (length + block - 1u) / block;
}
