//! The density on the texels.

use crate::kernel::KernelId;
use crate::recorder::{Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{Pdf, Rsm};
use vsgl_core::phase::pdf::{level_count, level_start, top_level};
use vsgl_core::plan::PdfPlan;
use vsgl_core::settings::PdfMethod;

/// Twin of `Params` in `entry/pdf.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    size: u32,
    maps: u32,
    rsm_size: u32,
    texels: u32,
    level: u32,
    lights: u32,
    specular: u32,
}

/// The pipelines that a plan needs.
pub(crate) fn kernels(plan: &PdfPlan) -> Vec<KernelId> {
    // The only one.
    let PdfMethod::Flux = plan.method;
    ["texels", "above", "shares"]
        .map(|entry| KernelId::new("entry/pdf", entry, &[]))
        .to_vec()
}

/// Records the density and its pyramid.
pub(crate) fn record(
    recorder: &mut Recorder<'_>,
    rsm: &WgpuRes<Rsm>,
    plan: &PdfPlan,
) -> Result<WgpuRes<Pdf>> {
    let context = recorder.context();
    let [rsm_size, maps] = rsm.head[..] else {
        return Err(context.error("an RSM without its size", "report it"));
    };
    let size = rsm_size.next_power_of_two();
    let top = top_level(size);
    let made = WgpuRes::<Pdf>::new(
        context,
        vec![size, maps],
        &[
            ("weight", 4, level_start(size, maps, top + 1) as u64),
            ("share", 4, u64::from(maps)),
        ],
    )?;
    let bound = [
        ("texel", rsm.bind("position")),
        ("weight", made.bind("weight")),
        ("share", made.bind("share")),
    ];
    let mut params = Params {
        size,
        maps,
        rsm_size,
        texels: rsm.len("position") as u32,
        level: 0,
        lights: plan.count,
        specular: u32::from(rsm.len("grazing") > 0),
    };
    for level in 0..=top {
        params.level = level;
        let entry = if level == 0 { "texels" } else { "above" };
        let kernel = context.kernel("entry/pdf", entry, &[])?;
        let items = Groups::Items(level_count(size, maps, level) as u64);
        recorder.dispatch(&kernel, &params, &bound, items)?;
    }
    let kernel = context.kernel("entry/pdf", "shares", &[])?;
    recorder.dispatch(&kernel, &params, &bound, Groups::Count(1))?;
    Ok(made)
}

#[cfg(test)]
mod tests {
    use super::Params;
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/pdf",
            "Params",
            Params {
                size,
                maps,
                rsm_size,
                texels,
                level,
                lights,
                specular
            }
        );
    }
}
