//! needs: math/vec, phase/interleave, phase/shade
// Rays to lights chosen by what they bring. Twin of `vsgl-core/src/phase/sampled.rs`.

fn sampled_contribution(colors: Colors, diffuse: vec3<f32>, near: vec3<f32>, grazing: vec3<f32>) -> f32 {
    return vec_luminance(colors_diffuse(colors, diffuse)) + vec_luminance(colors_glossy(colors, near, grazing));
}

fn sampled_offset(shares: Shares, place: vec2<u32>) -> f32 {
    let bits = (place.x / shares.side) * STEP_X + (place.y / shares.side) * STEP_Y
        + shares_share(shares, place) * GOLDEN_TURN;
    return f32(bits >> 8u) * (1.0 / 16777216.0);
}

fn sampled_threshold(k: u32, offset: f32, step: f32) -> f32 {
    return (f32(k) + offset) * step;
}

fn sampled_step(total: f32, rays: u32) -> f32 {
    return total / f32(rays);
}
