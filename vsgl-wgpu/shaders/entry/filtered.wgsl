//! needs: data/index, data/partition, data/scan, phase/cluster, phase/filtered, phase/filtered_box
// Clusters by filtered importance sampling: the pyramid of sums, the kernels, and the sums under them. Twin of
// `vsgl-cpu/src/phase/filtered.rs`.

// Kernels of original size.
override ORIGINAL: bool = false;

override GLOSSY: bool = true;
override ANISOTROPIC: bool = false;
override SG: bool = false;
override APART: bool = false;
override TOKSVIG: bool = false;
override TRACE: bool = false;

struct Params {
    // Of the density: texels along a side, and maps.
    size: u32,
    maps: u32,
    // Texels along a side of the RSM, of a map, and of all maps.
    rsm_size: u32,
    map_texels: u32,
    texels: u32,
    // The level to make.
    level: u32,
    overlap: f32,
    bisections: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> texel: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> map: array<MapRecord>;
@group(0) @binding(3) var<storage, read> triangle: array<u32>;
@group(0) @binding(4) var<storage, read> corner: array<array<f32, 9>>;
@group(0) @binding(5) var<storage, read> weight: array<f32>;
@group(0) @binding(6) var<storage, read> share: array<u32>;
// Lights of the maps before each.
@group(0) @binding(7) var<storage, read_write> before: array<u32>;
@group(0) @binding(8) var<storage, read_write> clusters: array<u32>;
@group(0) @binding(9) var<storage, read_write> kernel: array<Kernel>;
@group(0) @binding(10) var<storage, read_write> kernel_out: array<vec4<f32>>;
@group(0) @binding(11) var<storage, read_write> drawn_out: array<u32>;
// Levels above the texels.
@group(0) @binding(12) var<storage, read_write> pyramid: array<Sum>;
@group(0) @binding(13) var<storage, read_write> sum_out: array<Sum>;
@group(0) @binding(14) var<storage, read_write> square: array<Square>;

fn density() -> Pdf {
    return Pdf(params.size, params.maps);
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
        own += share[m];
    }
    let scanned = scan_group(local, own);
    var passed = scanned.before;
    for (var m = first; m < end; m += 1u) {
        before[m] = passed;
        passed += share[m];
    }
    if local == 0u {
        clusters[0] = scanned.total;
    }
}

// Where a kernel is drawn.
struct Drawn {
    map: u32,
    // Kernels of its map.
    count: u32,
    x: f32,
    y: f32,
}

fn drawn(j: u32) -> Drawn {
    // The last map that begins at or before this light has it.
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
    let count = share[low];
    let point = pdf_fibonacci(j - before[low], count);
    let centre = pdf_warp(density(), low, point.x, point.y);
    return Drawn(low, count, centre.x, centre.y);
}

// The texel that a kernel is drawn from.
fn texel_of(at: Drawn) -> u32 {
    let last = params.rsm_size - 1u;
    let x = min(u32(at.x), last);
    let y = min(u32(at.y), last);
    return (at.map * params.rsm_size + y) * params.rsm_size + x;
}

@compute @workgroup_size(INVOCATIONS)
fn kernels(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let j = item_index(invocation, groups);
    if j >= clusters[0] {
        return;
    }
    let at = drawn(j);
    var made: Kernel;
    if ORIGINAL {
        made = filtered_original(density(), at.map, at.x, at.y, at.count, params.overlap);
    } else {
        made = filtered_kernel(density(), at.map, at.x, at.y, at.count, params.overlap, params.bisections);
    }
    kernel[j] = made;
    kernel_out[j] = kernel_record(made);
    drawn_out[j] = texel_of(at);
}

var<workgroup> own_drawn: Drawn;
var<workgroup> masses: array<f32, BOX_LANES>;

// What one lane of `mass` adds up.
fn mass_of_lane(map_number: u32, cells: Cells, lane: u32) -> f32 {
    var mass = 0.0;
    for (var index = lane; index < cells.count; index += BOX_LANES) {
        let cell = cells_at(cells, index);
        mass += cell.share * pdf_at(density(), map_number, cells.level, cell.column, cell.row);
    }
    return mass;
}

// Weight of the texels in a square. Every invocation calls it and has the result.
fn mass(local: u32, map_number: u32, cells: Cells) -> f32 {
    workgroupBarrier();
    masses[local] = mass_of_lane(map_number, cells, local);
    workgroupBarrier();
    for (var half = BOX_LANES / 2u; half > 0u; half /= 2u) {
        if local < half {
            masses[local] += masses[local + half];
        }
        workgroupBarrier();
    }
    return masses[0];
}

// A workgroup a kernel. Twin of `square` in `vsgl-core/src/phase/filtered_box.rs`.
@compute @workgroup_size(BOX_LANES)
fn squares(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let j = group_index(group, groups);
    let is_one = j < clusters[0];
    if local == 0u && is_one {
        own_drawn = drawn(j);
    }
    workgroupBarrier();
    let at = own_drawn;
    let total = pdf_total(density(), at.map);
    let wanted = min(params.overlap / f32(at.count), 1.0) * total;
    let all = f32(pdf_top_level(params.size)) + 1.0;
    var low = BOX_LEAST;
    var high = all;
    for (var i = 0u; i < params.bisections; i += 1u) {
        let middle = 0.5 * (low + high);
        let side = filtered_box_side_of(middle);
        let held = mass(local, at.map, cells_new(params.size, at.x, at.y, side));
        let below = held < wanted;
        low = select(low, middle, below);
        high = select(middle, high, below);
    }
    let level = select(0.5 * (low + high), all, wanted >= total);
    let side = filtered_box_side_of(level);
    let held = mass(local, at.map, cells_new(params.size, at.x, at.y, side));
    if local == 0u && is_one {
        var scale = 0.0;
        if held > 0.0 {
            scale = total / (f32(at.count) * held);
        }
        let made = Square(at.map, at.x, at.y, side, scale);
        square[j] = made;
        kernel_out[j] = square_record(made);
        drawn_out[j] = texel_of(at);
    }
}

// The sum of one texel of a level.
fn pyramid_at(map_number: u32, level: u32, x: u32, y: u32) -> Sum {
    if level > 0u {
        let side = params.size >> level;
        let start = pdf_level_start(params.size, params.maps, level)
            - pdf_level_count(params.size, params.maps, 0u);
        return pyramid[start + (map_number * side + y) * side + x];
    }
    if x < params.rsm_size && y < params.rsm_size {
        let at = (map_number * params.rsm_size + y) * params.rsm_size + x;
        return sum_texel(at, params.texels, params.map_texels);
    }
    return Sum();
}

@compute @workgroup_size(INVOCATIONS)
fn above(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    let size = params.size;
    let maps = params.maps;
    if i >= pdf_level_count(size, maps, params.level) {
        return;
    }
    let side = size >> params.level;
    let x = 2u * (i % side);
    let y = 2u * (i / side % side);
    var quad: array<Sum, 4>;
    for (var k = 0u; k < 4u; k += 1u) {
        quad[k] = pyramid_at(i / (side * side), params.level - 1u, x + (k & 1u), y + (k >> 1u));
    }
    let start = pdf_level_start(size, maps, params.level) - pdf_level_count(size, maps, 0u);
    pyramid[start + i] = sum_merge(sum_merge(quad[0], quad[1]), sum_merge(quad[2], quad[3]));
}

@compute @workgroup_size(INVOCATIONS)
fn gather(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let j = item_index(invocation, groups);
    if j >= clusters[0] {
        return;
    }
    let own = kernel[j];
    let taps = filtered_taps(params.size, own.x, own.y, own.level);
    var tap: array<Sum, 8>;
    for (var k = 0u; k < 8u; k += 1u) {
        var foot = taps.low;
        var part = 1.0 - taps.fraction;
        if k >= 4u {
            foot = taps.high;
            part = taps.fraction;
        }
        let w = foot.weights[k & 3u] * part;
        let at = pyramid_at(own.map, foot.level, foot.columns[k & 1u], foot.rows[(k >> 1u) & 1u]);
        tap[k] = sum_scaled(at, w / filtered_per_texel(foot.level) * own.scale);
    }
    let low = sum_merge(sum_merge(tap[0], tap[1]), sum_merge(tap[2], tap[3]));
    let high = sum_merge(sum_merge(tap[4], tap[5]), sum_merge(tap[6], tap[7]));
    sum_out[j] = sum_merge(low, high);
}

var<workgroup> lanes: array<Sum, BOX_LANES>;

// A workgroup a kernel.
@compute @workgroup_size(BOX_LANES)
fn gather_squares(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let j = group_index(group, groups);
    var used = 0u;
    if j < clusters[0] {
        let own = square[j];
        let cells = cells_new(params.size, own.x, own.y, own.side);
        used = cells.count;
        if local < used {
            var merged = cell_sum(own, cells, local);
            for (var index = local + BOX_LANES; index < used; index += BOX_LANES) {
                merged = sum_merge(merged, cell_sum(own, cells, index));
            }
            lanes[local] = merged;
        }
    }
    workgroupBarrier();
    for (var half = BOX_LANES / 2u; half > 0u; half /= 2u) {
        if local < half && local + half < used {
            lanes[local] = sum_merge(lanes[local], lanes[local + half]);
        }
        workgroupBarrier();
    }
    if local == 0u && used > 0u {
        sum_out[j] = lanes[0];
    }
}

fn cell_sum(own: Square, cells: Cells, index: u32) -> Sum {
    let cell = cells_at(cells, index);
    return sum_scaled(pyramid_at(own.map, cells.level, cell.column, cell.row), cell.share * own.scale);
}
