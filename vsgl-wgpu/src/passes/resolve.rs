//! From samples to pixels.

use super::flag;
use crate::kernel::{Constant, KernelId};
use crate::recorder::{Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{GBuffer, Image, Radiance};
use vsgl_core::plan::Plan;
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

fn constants(glossy: bool, emission: bool, bounce: bool, bounce_glossy: bool) -> [Constant; 4] {
    [
        ("GLOSSY", flag(glossy)),
        ("EMISSION", flag(emission)),
        ("BOUNCE", flag(bounce)),
        ("BOUNCE_GLOSSY", flag(bounce_glossy)),
    ]
}

/// The pipelines that a plan needs.
pub(crate) fn kernels(plan: &Plan) -> Vec<KernelId> {
    let (glossy, bounce) = (plan.gbuffer.glossy, plan.shade.bounce);
    let emission = plan.gbuffer.surface.emission;
    let bounce_glossy = bounce && plan.shade.glossy_receivers;
    let constants = constants(glossy, emission, bounce, bounce_glossy);
    vec![KernelId::new("entry/resolve", "resolve", &constants)]
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
    let has = |layer| radiance.len(layer) > 0;
    let constants = constants(
        gbuffer.len("specular") > 0,
        gbuffer.len("emission") > 0,
        has("indirect_diffuse"),
        has("indirect_glossy"),
    );
    let kernel = context.kernel("entry/resolve", "resolve", &constants)?;
    recorder.dispatch(
        &kernel,
        &params,
        &[
            ("triangle", gbuffer.bind("triangle")),
            ("receiver", gbuffer.bind("position")),
            ("radiance", radiance.bind("direct")),
            ("image_out", made.bind("direct")),
            ("emission", gbuffer.bind("emission")),
        ],
        Groups::Items(pixels),
    )?;
    Ok(made)
}

#[cfg(test)]
mod tests {
    use super::Params;
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/resolve",
            "Params",
            Params {
                width,
                height,
                aa,
                samples_x,
                samples
            }
        );
    }
}
