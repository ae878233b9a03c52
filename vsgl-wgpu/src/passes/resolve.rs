//! From samples to pixels.

use super::flag;
use crate::recorder::{Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{GBuffer, Image, Radiance};
use vsgl_core::render::View;

/// Twin of `Params` in `entry/resolve.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    width: u32,
    height: u32,
    aa: u32,
    samples_x: u32,
    samples: u32,
}

/// Records the mean over the samples of each pixel.
pub(crate) fn record(
    recorder: &mut Recorder<'_>,
    gbuffer: &WgpuRes<GBuffer>,
    radiance: &WgpuRes<Radiance>,
    view: &View,
) -> Result<WgpuRes<Image>> {
    let context = recorder.context();
    let (width, height) = view.pixels();
    let pixels = u64::from(width) * u64::from(height);
    let made = WgpuRes::<Image>::new(
        context,
        vec![width, height],
        &[
            ("direct", 12, pixels),
            ("indirect_diffuse", 12, pixels),
            ("indirect_glossy", 12, pixels),
            ("albedo", 12, pixels),
            ("normal", 12, pixels),
            ("depth", 4, pixels),
        ],
    )?;
    let params = Params {
        width,
        height,
        aa: view.aa,
        samples_x: view.samples().0,
        samples: gbuffer.len("triangle") as u32,
    };
    let constants = [
        ("GLOSSY", flag(gbuffer.len("specular") > 0)),
        ("BOUNCE", flag(radiance.len("indirect_diffuse") > 0)),
        ("BOUNCE_GLOSSY", flag(radiance.len("indirect_glossy") > 0)),
    ];
    let kernel = context.kernel("entry/resolve", "resolve", &constants)?;
    recorder.dispatch(
        &kernel,
        &params,
        &[
            ("triangle", gbuffer.bind("triangle")),
            ("receiver", gbuffer.bind("position")),
            ("radiance", radiance.bind("direct")),
            ("image_out", made.bind("direct")),
        ],
        Groups::Items(pixels),
    )?;
    Ok(made)
}
