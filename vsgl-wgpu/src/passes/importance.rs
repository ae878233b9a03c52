//! What texels reflect of the lights that the camera makes.

use super::{camera_map, cluster, shade};
use crate::backend::WgpuBackend;
use crate::kernel::KernelId;
use crate::pool::Pooled;
use crate::recorder::{Binding, Groups, Recorder};
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::backend::PdfInputs;
use vsgl_core::phase::importance::INTERLEAVE;
use vsgl_core::plan::ImportancePlan;

/// Pairs of texel and light in one dispatch, about: no watchdog minds so many.
const PAIRS: u64 = 1 << 30;

/// Twin of `Params` in `entry/importance.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    size: u32,
    texels: u32,
    capacity: u32,
    first: u32,
    end: u32,
}

/// The pipelines that a plan needs.
pub(super) fn kernels(plan: &ImportancePlan) -> Vec<KernelId> {
    let mut kernels = cluster::kernels(&plan.cluster);
    kernels.push(camera_map::kernel(&plan.cluster));
    let constants = shade::form_constants(&plan.shade);
    kernels.push(KernelId::new("entry/importance", "importance", &constants));
    kernels
}

/// Records all from what the camera sees to a number a texel.
pub(super) fn record(
    recorder: &mut Recorder<'_>,
    inputs: &PdfInputs<'_, WgpuBackend>,
    plan: &ImportancePlan,
) -> Result<Pooled> {
    let context = recorder.context();
    let rsm = inputs.rsm;
    let camera = camera_map::record(recorder, inputs.gbuffer, inputs.view, &plan.cluster)?;
    let lights = cluster::record(recorder, inputs.scene, &camera, None, &plan.cluster)?;
    let texels = rsm.len("position") as u32;
    let reflected = context.buffer("what texels matter", 4 * u64::from(texels))?;
    let bound = [
        ("texel", rsm.bind("position")),
        ("map", rsm.bind("map")),
        ("lights", lights.bind("diffuse")),
        ("clusters", Binding::Buffer(lights.count_buffer())),
        ("reflected_out", Binding::Buffer(&reflected)),
    ];
    let capacity = lights.len("diffuse") as u32;
    let constants = shade::form_constants(&plan.shade);
    let kernel = context.kernel("entry/importance", "importance", &constants)?;
    let each = u64::from(capacity.div_ceil(INTERLEAVE * INTERLEAVE).max(1));
    let band = (PAIRS / each).clamp(1, u64::from(texels.max(1))) as u32;
    for first in (0..texels).step_by(band as usize) {
        let end = first.saturating_add(band).min(texels);
        let params = Params {
            size: rsm.head[0],
            texels,
            capacity,
            first,
            end,
        };
        let items = Groups::Items(u64::from(end - first));
        recorder.dispatch(&kernel, &params, &bound, items)?;
    }
    Ok(reflected)
}

#[cfg(test)]
mod tests {
    use super::Params;
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/importance",
            "Params",
            Params {
                size,
                texels,
                capacity,
                first,
                end
            }
        );
    }
}
