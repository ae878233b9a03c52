//! From shares of the virtual lights to all of them.

use super::flag;
use crate::kernel::{Constant, KernelId};
use crate::recorder::{Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{GBuffer, Radiance};
use vsgl_core::plan::ReconstructPlan;

/// Twin of `Params` in `entry/reconstruct.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    width: u32,
    height: u32,
    side: u32,
    filter_side: u32,
}

fn constants(plan: &ReconstructPlan) -> [Constant; 3] {
    [
        ("GLOSSY", flag(plan.glossy)),
        ("EMITTERS", flag(plan.emitters)),
        ("SAMPLED", flag(plan.sampled)),
    ]
}

/// The pipelines that a plan needs.
pub(crate) fn kernels(plan: &ReconstructPlan) -> Vec<KernelId> {
    let constants = constants(plan);
    vec![KernelId::new(
        "entry/reconstruct",
        "reconstruct",
        &constants,
    )]
}

/// Records the way from the sums that shading left to light.
pub(crate) fn record(
    recorder: &mut Recorder<'_>,
    gbuffer: &WgpuRes<GBuffer>,
    radiance: &WgpuRes<Radiance>,
    plan: &ReconstructPlan,
) -> Result<WgpuRes<Radiance>> {
    let context = recorder.context();
    let count = gbuffer.len("triangle");
    let made = WgpuRes::<Radiance>::new(
        context,
        radiance.head.clone(),
        &[
            ("direct", 12, count),
            ("indirect_diffuse", 12, count),
            ("indirect_glossy", 12, if plan.glossy { count } else { 0 }),
            ("sums", 48, 0),
            ("emitted", 48, 0),
        ],
    )?;
    let params = Params {
        width: gbuffer.head[0],
        height: gbuffer.head[1],
        side: plan.interleave,
        filter_side: plan.filter(),
    };
    let kernel = context.kernel("entry/reconstruct", "reconstruct", &constants(plan))?;
    recorder.dispatch(
        &kernel,
        &params,
        &[
            ("triangle", gbuffer.bind("triangle")),
            ("receiver", gbuffer.bind("position")),
            ("grazing", gbuffer.bind("grazing")),
            ("sums", radiance.bind("sums")),
            ("direct", radiance.bind("direct")),
            ("radiance_out", made.bind("direct")),
        ],
        Groups::Items(count),
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
            "entry/reconstruct",
            "Params",
            Params {
                width,
                height,
                side,
                filter_side
            }
        );
    }
}
