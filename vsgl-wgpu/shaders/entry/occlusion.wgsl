//! needs: data/index, data/vsgls_read, phase/facet, phase/fill, phase/mask, phase/run, phase/splat
// Shadow maps of the clusters: emptied, triangles and points drawn into them, holes filled.

override MASKS: bool = true;

struct Params {
    // Room for maps, texels along a side, draws of a map and their distance.
    maps: u32,
    side: u32,
    points: u32,
    stride: u32,
    // By how much ray origins are lifted at least.
    lift: f32,
    // As `target_at` takes it.
    specular_stride: u32,
    triangles: u32,
    // The level that is filled or made; the first draw of each map in this dispatch, and how many.
    level: u32,
    first: u32,
    draws: u32,
    // Invocations that share out the triangles of a run.
    parts: u32,
}

struct Count {
    value: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> corner: array<array<f32, 9>>;
@group(0) @binding(2) var<storage, read> share: array<u32>;
@group(0) @binding(3) var<storage, read> lights: array<vec4<f32>>;
@group(0) @binding(4) var<uniform> clusters: Count;
@group(0) @binding(5) var texels: texture_2d_array<u32>;
@group(0) @binding(6) var<uniform> columns: TexelLayout;
// The maps: bits while points are drawn, of which the least is the nearest.
@group(0) @binding(7) var<storage, read_write> bits: array<atomic<u32>>;
@group(0) @binding(8) var<storage, read_write> depth: array<f32>;
// Smaller images of all maps, level by level.
@group(0) @binding(9) var<storage, read_write> smaller: array<f32>;
@group(0) @binding(10) var<storage, read_write> count_out: array<u32>;
@group(0) @binding(11) var<storage, read_write> runs_out: array<Run>;
@group(0) @binding(12) var<storage, read> runs: array<Run>;

@compute @workgroup_size(INVOCATIONS)
fn empty(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    if i == 0u {
        count_out[0] = clusters.value;
    }
    if i < params.maps * params.side * params.side {
        depth[i] = F32_MAX;
    }
}

fn frame_of(map: u32) -> MapFrame {
    let point = target_at(map, params.maps, params.specular_stride);
    return map_frame_new(point.position, point.normal, params.lift);
}

@compute @workgroup_size(INVOCATIONS)
fn bundle(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    if i < params.points {
        runs_out[i] = run_new(params.triangles, i, params.points, params.stride);
    }
}

fn write(map: u32, triangle: u32, corners: Corners, point: Point) {
    let splat = splat_new(corners, point, params.side);
    if !splat.above || !mask_covers(triangle, point.u, point.v) {
        return;
    }
    let step = 2.0 / f32(params.side);
    let first = splat_first(splat);
    let end = splat_end(splat, params.side);
    for (var row = first.y; row < end.y; row++) {
        for (var column = first.x; column < end.x; column++) {
            let found = splat_depth(splat, column, row, step);
            if found < F32_MAX {
                atomicMin(&bits[(map * params.side + row) * params.side + column], bitcast<u32>(found));
            }
        }
    }
}

fn write_facet(map: u32, triangle: u32, corners: Corners) {
    let bounds = facet_bounds(corners, params.side);
    let facet = facet_new(corners);
    let step = 2.0 / f32(params.side);
    for (var row = bounds.top; row < bounds.bottom; row++) {
        for (var column = bounds.left; column < bounds.right; column++) {
            let met = facet_meet(facet, occlusion_direction(column, row, step));
            if met.depth < F32_MAX && mask_covers(triangle, met.u, met.v) {
                atomicMin(&bits[(map * params.side + row) * params.side + column], bitcast<u32>(met.depth));
            }
        }
    }
}

@compute @workgroup_size(INVOCATIONS)
fn triangles(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    let of_map = i / params.parts;
    let map = of_map / params.draws;
    let index = params.first + of_map % params.draws;
    if map >= min(params.maps, clusters.value) || index >= params.points {
        return;
    }
    let run = runs[index];
    let frame = frame_of(map);
    if !run_is_apart(run, frame, params.side) {
        return;
    }
    for (var k = i % params.parts; k < run.count; k += params.parts) {
        let triangle = run.first + k * run.every;
        let corners = splat_corners(frame, triangle);
        if run.every > 1u {
            write(map, triangle, corners, splat_middle(run.every));
        } else {
            write_facet(map, triangle, corners);
        }
    }
}

struct Drawn {
    map: u32,
    index: u32,
    draw: u32,
    triangle: u32,
    low: u32,
    high: u32,
    found: bool,
}

// What an invocation draws.
fn drawn_by(i: u32) -> Drawn {
    let map = i / params.draws;
    let index = params.first + i % params.draws;
    var made = Drawn(map, index, 0u, 0u, 0u, 0u, false);
    if map >= min(params.maps, clusters.value) || index >= params.points {
        return made;
    }
    made.draw = splat_draw(map, index, params.stride);
    made.triangle = splat_find(params.triangles, made.draw);
    if made.triangle < params.triangles {
        made.found = true;
        made.high = share[made.triangle];
        if made.triangle > 0u {
            made.low = share[made.triangle - 1u];
        }
    }
    return made;
}

// Whether the triangle of a draw is not drawn itself.
fn stands(d: Drawn, frame: MapFrame) -> bool {
    if run_wide(d.low, d.high, params.stride) {
        return true;
    }
    let run = runs[run_of(d.low, params.stride, params.points)];
    return !run_is_apart(run, frame, params.side);
}

@compute @workgroup_size(INVOCATIONS)
fn points(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let d = drawn_by(item_index(invocation, groups));
    if !d.found {
        return;
    }
    let frame = frame_of(d.map);
    if !stands(d, frame) {
        return;
    }
    let corners = splat_corners(frame, d.triangle);
    let point = splat_random_point(d.map, d.index, d.draw, d.low, d.high, params.stride);
    write(d.map, d.triangle, corners, point);
}

@compute @workgroup_size(INVOCATIONS)
fn pieces(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let d = drawn_by(item_index(invocation, groups));
    if !d.found {
        return;
    }
    let frame = frame_of(d.map);
    if !stands(d, frame) {
        return;
    }
    let corners = splat_corners(frame, d.triangle);
    let slot = splat_slot(d.map, d.index, d.low, d.high, params.stride, corners, params.side);
    for (var piece = slot.first; piece < slot.cuts * slot.cuts; piece += slot.slots) {
        write(d.map, d.triangle, corners, splat_piece(slot, piece));
    }
}

// A texel of a level of a map.
fn texel_of(map: u32, level: u32, at: vec2<u32>) -> f32 {
    let own = fill_side(params.side, level);
    if at.x >= own || at.y >= own {
        return F32_MAX;
    }
    let place = (map * own + at.y) * own + at.x;
    if level == 0u {
        return depth[place];
    }
    return smaller[params.maps * fill_before(params.side, level) + place];
}

@compute @workgroup_size(INVOCATIONS)
fn pull(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    let own = fill_side(params.side, params.level);
    if i >= params.maps * own * own {
        return;
    }
    let map = i / (own * own);
    let below = params.level - 1u;
    let at = 2u * vec2(i % own, i / own % own);
    let four = vec4(
        texel_of(map, below, at),
        texel_of(map, below, at + vec2(1u, 0u)),
        texel_of(map, below, at + vec2(0u, 1u)),
        texel_of(map, below, at + vec2(1u, 1u)),
    );
    smaller[params.maps * fill_before(params.side, params.level) + i] = fill_pull(four);
}

@compute @workgroup_size(INVOCATIONS)
fn push(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    let own = fill_side(params.side, params.level);
    if i >= params.maps * own * own {
        return;
    }
    let map = i / (own * own);
    let at = vec2(i % own, i / own % own);
    let above = texel_of(map, params.level + 1u, at / 2u);
    let filled = fill_push(texel_of(map, params.level, at), above);
    if params.level == 0u {
        depth[i] = filled;
    } else {
        smaller[params.maps * fill_before(params.side, params.level) + i] = filled;
    }
}
