//! Samples to pixels, all pixels.

use super::band;
use rayon::prelude::*;
use vsgl_core::data::{GBuffer, Image, Radiance};
use vsgl_core::phase::resolve::{Pixel, pixel};
use vsgl_core::render::View;

pub(crate) fn run(gbuffer: &GBuffer, radiance: &Radiance, view: &View) -> Image {
    let (width, height) = view.pixels();
    let row = |y: u32| (0..width).map(move |x| pixel(gbuffer, radiance, view.aa, x, y));
    let mut image = Image {
        width,
        height,
        ..Image::default()
    };
    let count = width as usize * height as usize;
    for rows in band::rows(width, height) {
        let pixels: Vec<Pixel> = rows.into_par_iter().flat_map_iter(row).collect();
        let part = Image {
            direct: pixels.iter().map(|p| p.direct).collect(),
            indirect_diffuse: pixels.iter().map(|p| p.indirect_diffuse).collect(),
            indirect_glossy: pixels.iter().map(|p| p.indirect_glossy).collect(),
            albedo: pixels.iter().map(|p| p.albedo).collect(),
            normal: pixels.iter().map(|p| p.normal).collect(),
            depth: pixels.iter().map(|p| p.depth).collect(),
            ..Image::default()
        };
        image.append(&part, count);
    }
    image
}
