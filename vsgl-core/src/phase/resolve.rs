//! From the samples of a pixel to the pixel.

use crate::data::{GBuffer, NO_TRIANGLE, Radiance};

/// All layers of one pixel; see [`crate::data::Image`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    /// Direct light, and what surfaces send by themselves.
    pub direct: [f32; 3],
    /// One bounce by the Lambert part.
    pub indirect_diffuse: [f32; 3],
    /// One bounce by the specular part.
    pub indirect_glossy: [f32; 3],
    /// Albedo.
    pub albedo: [f32; 3],
    /// Normal.
    pub normal: [f32; 3],
    /// Depth.
    pub depth: f32,
}

/// Mean over the `aa × aa` samples of the pixel in column `x` and row `y`, row by row.
pub fn pixel(gbuffer: &GBuffer, radiance: &Radiance, aa: u32, x: u32, y: u32) -> Pixel {
    let mut pixel = Pixel::default();
    let mut hits = 0.0f32;
    let share = 1.0 / (aa as f32 * aa as f32);
    for j in 0..aa {
        for i in 0..aa {
            let index = (y * aa + j) as usize * gbuffer.width as usize + (x * aa + i) as usize;
            if gbuffer.triangle[index] == NO_TRIANGLE {
                continue;
            }
            hits += 1.0;
            add(&mut pixel.direct, layer(&radiance.direct, index));
            add(&mut pixel.direct, layer(&gbuffer.emission, index));
            add(
                &mut pixel.indirect_diffuse,
                layer(&radiance.indirect_diffuse, index),
            );
            add(
                &mut pixel.indirect_glossy,
                layer(&radiance.indirect_glossy, index),
            );
            add(&mut pixel.albedo, xyz(gbuffer.diffuse[index]));
            add(
                &mut pixel.albedo,
                gbuffer.specular.get(index).map_or([0.0; 3], |&f0| xyz(f0)),
            );
            add(&mut pixel.normal, xyz(gbuffer.normal[index]));
            pixel.depth += gbuffer.position[index][3];
        }
    }
    for rgb in [
        &mut pixel.direct,
        &mut pixel.indirect_diffuse,
        &mut pixel.indirect_glossy,
        &mut pixel.albedo,
        &mut pixel.normal,
    ] {
        *rgb = rgb.map(|c| c * share);
    }
    pixel.depth /= hits.max(1.0);
    pixel
}

fn layer(column: &[[f32; 3]], index: usize) -> [f32; 3] {
    column.get(index).copied().unwrap_or_default()
}

fn xyz(v: [f32; 4]) -> [f32; 3] {
    [v[0], v[1], v[2]]
}

fn add(sum: &mut [f32; 3], value: [f32; 3]) {
    for i in 0..3 {
        sum[i] += value[i];
    }
}
