//! needs: phase/shade
// From shares of the virtual lights to all of them: neighbours of a sample. Twin of `vsgl-core/src/phase/reconstruct.rs`; the
// loops over neighbours, which read what the entry binds, are there.

struct Patch {
    position: vec3<f32>,
    normal: vec3<f32>,
    alpha: f32,
}

// For the Lambert part and for the specular part.
fn patch_likeness(own: Patch, other: Patch) -> vec2<f32> {
    let apart = other.position - own.position;
    let distance2 = dot(apart, apart);
    let here = dot(apart, own.normal);
    let there = dot(apart, other.normal);
    let off2 = min(here * here, there * there);
    let slope2 = off2 / max(distance2, F32_MIN_POSITIVE);
    let plane = max(1.0 - slope2 * (1.0 / SLOPE_MAX), 0.0);
    let turned = own.normal - other.normal;
    let turn = 0.5 * dot(turned, turned);
    let facing = max(1.0 - turn * (1.0 / TURN_MAX), 0.0);
    let diffuse = plane * (facing * facing);
    let product = max(own.alpha * other.alpha, F32_MIN_POSITIVE);
    let difference = own.alpha - other.alpha;
    let rough = 1.0 + ROUGHNESS_FALL * (difference * difference / product);
    return vec2(diffuse, diffuse / rough);
}

fn reconstruct_tent(side: u32, away: i32) -> f32 {
    return f32(side) - abs(f32(away));
}

fn reconstruct_ahead(side: u32, own: u32, share: u32) -> u32 {
    return (share + side - own % side) % side;
}

// Sums over lights, and weighted sums of them.
struct Gathered {
    diffuse: vec3<f32>,
    near: vec3<f32>,
    grazing: vec3<f32>,
    // Contributions, and those that arrive.
    total: f32,
    open: f32,
}

fn gathered_visibility(own: Gathered) -> f32 {
    if own.total > 0.0 {
        return own.open / own.total;
    }
    return 1.0;
}
