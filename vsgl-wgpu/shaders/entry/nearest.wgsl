//! needs: data/index, data/nearest, data/partition, data/scan, phase/nearest, phase/pdf
// Clusters of the texels nearest to centres: centres drawn and put into boxes, the nearest one of each texel, and where the
// clusters begin in the list that is sorted by it. Twin of `vsgl-cpu/src/phase/nearest.rs`.

struct Params {
    // Of the density: texels along a side, and maps.
    size: u32,
    maps: u32,
    // Texels along a side of the RSM, of a map, and of all maps.
    rsm_size: u32,
    map_texels: u32,
    texels: u32,
    // Boxes that there is room for, after which the wider ones begin.
    boxes: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> weight: array<f32>;
@group(0) @binding(2) var<storage, read> share: array<u32>;
// Centres of the maps before each, and of all; then lit texels.
@group(0) @binding(3) var<storage, read_write> before: array<u32>;
@group(0) @binding(4) var<storage, read_write> state: State;
@group(0) @binding(5) var<storage, read> place: array<vec4<f32>>;
// Centres in the order in which they are drawn, their keys, and their numbers sorted by these.
@group(0) @binding(6) var<storage, read_write> draw: array<Centre>;
@group(0) @binding(7) var<storage, read_write> key: array<u32>;
@group(0) @binding(8) var<storage, read_write> order: array<u32>;
@group(0) @binding(9) var<storage, read_write> centre: array<Centre>;
@group(0) @binding(10) var<storage, read_write> bounds: array<Bounds>;
@group(0) @binding(11) var<storage, read> list: array<u32>;
@group(0) @binding(12) var<storage, read_write> label: array<u32>;
@group(0) @binding(13) var<storage, read_write> mark: array<u32>;
// Centres, and lit texels: what is sorted.
@group(0) @binding(14) var<storage, read_write> centres: array<u32>;
@group(0) @binding(15) var<storage, read_write> lit: array<u32>;

fn density() -> Pdf {
    return Pdf(params.size, params.maps);
}

fn nearest_centres(own: Pdf, map_number: u32) -> u32 {
    let wanted = share[map_number];
    if pdf_total(own, map_number) > 0.0 {
        return max(wanted, 1u);
    }
    return wanted;
}

fn nearest_drawn(own: Pdf, map_number: u32, size: u32, index: u32, count: u32) -> vec2<u32> {
    let point = pdf_fibonacci(index, count);
    let at = pdf_warp(own, map_number, point.x, point.y);
    return vec2(min(u32(at.x), size - 1u), min(u32(at.y), size - 1u));
}

// One workgroup.
@compute @workgroup_size(SCAN)
fn numbers(@builtin(local_invocation_index) local: u32) {
    let maps = params.maps;
    let chunk = blocks_of(maps, SCAN);
    let first = min(local * chunk, maps);
    let end = min(first + chunk, maps);
    var own = 0u;
    for (var m = first; m < end; m += 1u) {
        own += nearest_centres(density(), m);
    }
    let scanned = scan_group(local, own);
    var passed = scanned.before;
    for (var m = first; m < end; m += 1u) {
        before[m] = passed;
        passed += nearest_centres(density(), m);
    }
    if local == 0u {
        before[maps] = scanned.total;
        before[maps + 1u] = state.lit;
        centres[0] = scanned.total;
        lit[0] = state.lit;
        state.texels = params.texels;
    }
}

@compute @workgroup_size(INVOCATIONS)
fn draws(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let j = item_index(invocation, groups);
    if j >= before[params.maps] {
        return;
    }
    // The last map that begins at or before this centre has it.
    var low = 0u;
    var high = params.maps;
    while high - low > 1u {
        let middle = low + (high - low) / 2u;
        if before[middle] <= j {
            low = middle;
        } else {
            high = middle;
        }
    }
    let count = before[low + 1u] - before[low];
    let at = nearest_drawn(density(), low, params.rsm_size, j - before[low], count);
    let own = place[(low * params.rsm_size + at.y) * params.rsm_size + at.x];
    draw[j] = Centre(select(vec3(NEAREST_FAR), own.xyz, own.w > 0.0), j);
    key[j] = nearest_key(low, params.size, at.x, at.y);
    order[j] = j;
}

// A box an invocation: brings its centres into order.
@compute @workgroup_size(INVOCATIONS)
fn boxes(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let all = before[params.maps];
    let b = item_index(invocation, groups);
    let begin = b * NEAREST_WIDTH;
    if begin >= all {
        return;
    }
    var joined = Bounds();
    for (var i = begin; i < min(begin + NEAREST_WIDTH, all); i += 1u) {
        let own = draw[order[i]];
        centre[i] = own;
        let point = Bounds(own.position, own.position);
        if i == begin {
            joined = point;
        } else {
            joined = bounds_join(joined, point);
        }
    }
    bounds[b] = joined;
}

@compute @workgroup_size(INVOCATIONS)
fn wider_boxes(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let all = blocks_of(before[params.maps], NEAREST_WIDTH);
    let w = item_index(invocation, groups);
    let begin = w * NEAREST_WIDTH;
    if begin >= all {
        return;
    }
    var joined = bounds[begin];
    for (var b = begin + 1u; b < min(begin + NEAREST_WIDTH, all); b += 1u) {
        joined = bounds_join(joined, bounds[b]);
    }
    bounds[params.boxes + w] = joined;
}

// Twin of `Centres::nearest`; the range of the list is `begin` to `end`.
fn centres_nearest(begin: u32, end: u32, near: u32, x: vec3<f32>) -> u32 {
    let first = near / NEAREST_WIDTH;
    let all = NEAREST_WIDTH * NEAREST_WIDTH;
    let boxes = blocks_of(end, NEAREST_WIDTH);
    var best = centres_scan(Nearest(begin, F32_MAX), first, begin, end, x);
    for (var w = begin / all; w < blocks_of(end, all); w += 1u) {
        if bounds_distance2(bounds[params.boxes + w], x) <= best.distance2 {
            let low = max(w * NEAREST_WIDTH, begin / NEAREST_WIDTH);
            let high = min((w + 1u) * NEAREST_WIDTH, boxes);
            for (var b = low; b < high; b += 1u) {
                if b != first && bounds_distance2(bounds[b], x) <= best.distance2 {
                    best = centres_scan(best, b, begin, end, x);
                }
            }
        }
    }
    return best.number;
}

fn centres_scan(from_best: Nearest, b: u32, begin: u32, end: u32, x: vec3<f32>) -> Nearest {
    var best = from_best;
    let low = max(b * NEAREST_WIDTH, begin);
    let high = min((b + 1u) * NEAREST_WIDTH, end);
    for (var i = low; i < high; i += 1u) {
        best = nearest_or(best, centre[i], x);
    }
    return best;
}

// A lit texel an invocation.
@compute @workgroup_size(INVOCATIONS)
fn labels(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    if i >= before[params.maps + 1u] {
        return;
    }
    let index = list[i];
    let map_number = index / params.map_texels;
    let begin = before[map_number];
    let end = before[map_number + 1u];
    if begin < end {
        let x = index % params.rsm_size;
        let y = index / params.rsm_size % params.rsm_size;
        let own = nearest_key(map_number, params.size, x, y);
        // The first centre of the map that is not before the texel.
        var low = begin;
        var high = end;
        while low < high {
            let middle = low + (high - low) / 2u;
            if key[order[middle]] < own {
                low = middle + 1u;
            } else {
                high = middle;
            }
        }
        label[index] = centres_nearest(begin, end, min(low, end - 1u), place[index].xyz);
    }
}

// A place of the sorted list an invocation. Texels of a map that got no centre are of no cluster, and come last.
@compute @workgroup_size(INVOCATIONS)
fn marks(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    let all = lit[0];
    if i >= all {
        return;
    }
    let own = label[list[i]];
    var before_own = NO_LABEL;
    if i > 0u {
        before_own = label[list[i - 1u]];
    }
    if own != NO_LABEL {
        mark[i] = select(0u, 1u, i == 0u || own != before_own);
    } else if i == 0u || before_own != NO_LABEL {
        state.lit = i;
    }
}

const NO_LABEL: u32 = 0xffffffffu;
