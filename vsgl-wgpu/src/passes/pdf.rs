//! The density on the texels.

use super::importance;
use crate::backend::WgpuBackend;
use crate::kernel::KernelId;
use crate::recorder::{Binding, Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::backend::PdfInputs;
use vsgl_core::data::Pdf;
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
    count: u32,
    kept: u32,
}

/// Level 0 of each pyramid that a density takes, and the kernels that make it and what follows.
const FLUX: &str = "texels";
const MATTERS: &str = "smoothed";
const MIXED: &str = "mix_floor";

/// The pipelines that a plan needs.
pub(crate) fn kernels(plan: &PdfPlan) -> Vec<KernelId> {
    let mut entries = vec![FLUX, "above", "shares"];
    let mut kernels = Vec::new();
    if let Some(plan) = &plan.importance {
        entries.extend(["keep", MATTERS, MIXED]);
        kernels = importance::kernels(plan);
    }
    let of_file = |entry| KernelId::new("entry/pdf", entry, &[]);
    kernels.extend(entries.into_iter().map(of_file));
    kernels
}

/// Records the density and its pyramid.
pub(crate) fn record(
    recorder: &mut Recorder<'_>,
    inputs: &PdfInputs<'_, WgpuBackend>,
    plan: &PdfPlan,
) -> Result<WgpuRes<Pdf>> {
    let context = recorder.context();
    let rsm = inputs.rsm;
    let [rsm_size, maps] = rsm.head[..] else {
        return Err(context.error("an RSM without its size", "report it"));
    };
    let reflected = match &plan.importance {
        Some(plan) => importance::record(recorder, inputs, plan)?,
        None => context.buffer("no importance", 4)?,
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
    let totals = context.buffer("totals of maps", 8 * u64::from(maps))?;
    let bound = [
        ("texel", rsm.bind("position")),
        ("weight", made.bind("weight")),
        ("share", made.bind("share")),
        ("totals", Binding::Buffer(&totals)),
        ("reflected", Binding::Buffer(&reflected)),
    ];
    let flux = Params {
        size,
        maps,
        rsm_size,
        texels: rsm.len("position") as u32,
        level: 0,
        lights: plan.count,
        specular: u32::from(rsm.len("grazing") > 0),
        count: 0,
        kept: 0,
    };
    let mut run = |entry, params: &Params, groups| {
        let kernel = context.kernel("entry/pdf", entry, &[])?;
        recorder.dispatch(&kernel, params, &bound, groups)
    };
    let mut pyramid = |first, mut params: Params, last: Option<&'static str>| {
        for level in 0..=top {
            params.level = level;
            let entry = if level == 0 { first } else { "above" };
            let items = Groups::Items(level_count(size, maps, level) as u64);
            run(entry, &params, items)?;
        }
        last.map_or(Ok(()), |last| run(last, &params, Groups::Count(1)))
    };
    let lit = Params { count: 1, ..flux };
    // By flux whatever the density: it says where lights of a map go, not how many.
    pyramid(FLUX, flux, Some("shares"))?;
    match (plan.method, &plan.importance) {
        (PdfMethod::Flux, _) => {}
        (PdfMethod::Uniform, _) | (PdfMethod::Brsm, None) => pyramid(FLUX, lit, None)?,
        (PdfMethod::Brsm, Some(_)) => {
            pyramid(FLUX, lit, Some("keep"))?;
            pyramid(MATTERS, Params { kept: 1, ..flux }, Some("keep"))?;
            pyramid(MIXED, flux, None)?;
        }
    }
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
                specular,
                count,
                kept
            }
        );
    }
}
