// Visible normals of any distribution: twin of `vsgl-core/src/brdf/visible.rs`.

fn visible_normal_density(d: f32, view_half: f32, view_cosine: f32, view_area: f32) -> f32 {
    return d * max(view_half, 0.0) * (2.0 / max(view_cosine + view_area, 1e-18));
}

fn visible_reflected_density(d: f32, view_cosine: f32, view_area: f32) -> f32 {
    return d * (0.5 / max(view_cosine + view_area, 1e-18));
}

fn visible_sample_weight(view_cosine: f32, light_cosine: f32, view_area: f32, light_area: f32) -> f32 {
    let v = max(view_cosine, 0.0);
    let o = max(light_cosine, 0.0);
    let both = max(o * view_area + light_area * v, 1e-30);
    return min(o * (v + view_area) / both, 1.0);
}
