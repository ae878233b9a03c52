//! Where the error of a picture comes from: light summed up texel by texel, beside that of the clusters they are in.
//!
//! All here is luminance of indirect light to the eye \[W/(m² sr)\], one number a sample: luminances of parts of the light add up,
//! and so do differences of these pictures. No part of the pipeline: this backend alone has it.

mod drawn;
mod sets;
mod sums;
mod truth;

pub use drawn::drawn_texels;
pub use sets::Sets;
pub use sums::{Asked, RAYS, RAYS_MAX, Sums, sums};
pub use truth::{Places, truth};

use vsgl_core::data::{Element, GBuffer};

/// Some samples of a G-buffer, in one row.
///
/// # Panics
/// If there is no such sample.
pub fn gathered(gbuffer: &GBuffer, samples: &[usize]) -> GBuffer {
    fn column<T: Element>(column: &[T], samples: &[usize]) -> Vec<T> {
        if column.is_empty() {
            return Vec::new();
        }
        samples.iter().map(|&sample| column[sample]).collect()
    }
    GBuffer {
        width: samples.len() as u32,
        height: 1,
        triangle: column(&gbuffer.triangle, samples),
        position: column(&gbuffer.position, samples),
        normal: column(&gbuffer.normal, samples),
        diffuse: column(&gbuffer.diffuse, samples),
        specular: column(&gbuffer.specular, samples),
        grazing: column(&gbuffer.grazing, samples),
        tangent: column(&gbuffer.tangent, samples),
        emission: column(&gbuffer.emission, samples),
    }
}
