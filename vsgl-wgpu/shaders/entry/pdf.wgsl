//! needs: data/index, math/vec, phase/importance, phase/pdf
// The density, its pyramid, and the lights of each map. Twin of `vsgl-cpu/src/phase/pdf.rs`, of `shares` in
// `vsgl-core/src/phase/pdf.rs` and of `smoothed` in `importance.rs` there.

struct Params {
    // Of the density: texels along a side, and maps.
    size: u32,
    maps: u32,
    // Texels along a side of the RSM, and of all maps.
    rsm_size: u32,
    texels: u32,
    // The level to make.
    level: u32,
    // Lights to share out.
    lights: u32,
    // 1 if the RSM has the columns of the specular part.
    specular: u32,
    // 1 to count texels with light instead of adding flux.
    count: u32,
    // Where totals of maps are kept: 0 those of texels with light, 1 those of what texels matter.
    kept: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> texel: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> weight: array<f32>;
@group(0) @binding(3) var<storage, read_write> share: array<u32>;
@group(0) @binding(4) var<storage, read_write> totals: array<f32>;
// What texels reflect of the camera's lights.
@group(0) @binding(5) var<storage, read> reflected: array<f32>;

fn density() -> Pdf {
    return Pdf(params.size, params.maps);
}

@compute @workgroup_size(INVOCATIONS)
fn texels(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    let size = params.size;
    if i >= pdf_level_count(size, params.maps, 0u) {
        return;
    }
    let at = place_of(i);
    var own = 0.0;
    if at.inside {
        own = flux_at(at.texel);
        if params.count > 0u {
            own = select(0.0, 1.0, own > 0.0);
        }
    }
    weight[i] = own;
}

struct Place {
    texel: u32,
    x: u32,
    y: u32,
    // Others are padding to a power of two.
    inside: bool,
}

// The texel of the maps at an entry of level 0.
fn place_of(i: u32) -> Place {
    let size = params.size;
    let x = i % size;
    let y = i / size % size;
    let at = (i / (size * size) * params.rsm_size + y) * params.rsm_size + x;
    return Place(at, x, y, x < params.rsm_size && y < params.rsm_size);
}

// Luminance of the flux that a texel reflects.
fn flux_at(at: u32) -> f32 {
    var own = vec_luminance(texel[2u * params.texels + at].xyz);
    if params.specular > 0u {
        own += texel[4u * params.texels + at].w;
    }
    return own;
}

// Level 0 from what texels reflect of the camera's lights.
@compute @workgroup_size(INVOCATIONS)
fn smoothed(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    if i >= pdf_level_count(params.size, params.maps, 0u) {
        return;
    }
    let at = place_of(i);
    var own = 0.0;
    if at.inside {
        own = importance_smoothed(at);
    }
    weight[i] = own;
}

fn importance_smoothed(at: Place) -> f32 {
    let size = params.rsm_size;
    let first = at.texel - (at.y * size + at.x);
    var sum = 0.0;
    var flux = 0.0;
    for (var row = max(at.y + 2u, INTERLEAVE) - INTERLEAVE; row < min(at.y + 2u, size); row += 1u) {
        for (var column = max(at.x + 2u, INTERLEAVE) - INTERLEAVE; column < min(at.x + 2u, size); column += 1u) {
            let near = first + row * size + column;
            sum += reflected[near];
            flux += flux_at(near);
        }
    }
    if flux > 0.0 {
        return sum * (flux_at(at.texel) / flux);
    }
    return 0.0;
}

// Keeps the totals of all maps. One invocation.
@compute @workgroup_size(1)
fn keep() {
    for (var m = 0u; m < params.maps; m += 1u) {
        totals[params.kept * params.maps + m] = pdf_total(density(), m);
    }
}

// Level 0 from what texels matter, in place.
@compute @workgroup_size(INVOCATIONS)
fn mix_floor(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    if i >= pdf_level_count(params.size, params.maps, 0u) {
        return;
    }
    let at = place_of(i);
    if at.inside && flux_at(at.texel) > 0.0 {
        let m = i / (params.size * params.size);
        weight[i] = importance_density(weight[i], totals[params.maps + m], totals[m]);
    }
}

@compute @workgroup_size(INVOCATIONS)
fn above(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    let size = params.size;
    if i >= pdf_level_count(size, params.maps, params.level) {
        return;
    }
    let side = size >> params.level;
    let map_number = i / (side * side);
    let x = 2u * (i % side);
    let y = 2u * (i / side % side);
    let a = pdf_at(density(), map_number, params.level - 1u, x, y);
    let b = pdf_at(density(), map_number, params.level - 1u, x + 1u, y);
    let c = pdf_at(density(), map_number, params.level - 1u, x, y + 1u);
    let d = pdf_at(density(), map_number, params.level - 1u, x + 1u, y + 1u);
    weight[pdf_level_start(size, params.maps, params.level) + i] = (a + b) + (c + d);
}

// One invocation.
@compute @workgroup_size(1)
fn shares() {
    let maps = params.maps;
    let count = params.lights;
    var heaviest = 0.0;
    var lit = 0u;
    for (var m = 0u; m < maps; m += 1u) {
        let total = pdf_total(density(), m);
        heaviest = max(heaviest, total);
        lit += select(0u, 1u, total > 0.0);
    }
    let few = count < lit;
    var step = 0u;
    var beyond = bitcast<u32>(select(f32(count), heaviest, few)) + 1u;
    while beyond - step > 1u {
        let middle = step + (beyond - step) / 2u;
        var given = 0u;
        for (var m = 0u; m < maps; m += 1u) {
            given += pdf_lights(pdf_total(density(), m), heaviest, middle, few);
        }
        if given <= count {
            step = middle;
        } else {
            beyond = middle;
        }
    }
    var left = select(0u, count, lit > 0u);
    for (var m = 0u; m < maps; m += 1u) {
        left -= pdf_lights(pdf_total(density(), m), heaviest, step, few);
    }
    for (var m = 0u; m < maps; m += 1u) {
        let total = pdf_total(density(), m);
        let sure = pdf_lights(total, heaviest, step, few);
        let more = min(pdf_lights(total, heaviest, step + 1u, few) - sure, left);
        left -= more;
        share[m] = sure + more;
    }
}

fn pdf_lights(total: f32, heaviest: f32, step: u32, few: bool) -> u32 {
    if few {
        return pdf_one_or_none(total, heaviest, step);
    }
    return pdf_share(total, heaviest, step, params.lights);
}

fn pdf_one_or_none(total: f32, heaviest: f32, step: u32) -> u32 {
    return select(0u, 1u, bitcast<u32>(total) + step > bitcast<u32>(heaviest));
}

fn pdf_share(total: f32, heaviest: f32, step: u32, count: u32) -> u32 {
    if total > 0.0 {
        let ideal = total / heaviest * bitcast<f32>(step);
        return max(u32(min(ideal + 0.5, f32(count))), 1u);
    }
    return 0u;
}
