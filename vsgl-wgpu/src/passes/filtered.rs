//! Clusters by filtered importance sampling: trilinear kernels, of modified and of original size, and square ones.

use super::cluster::{Drawn, constants};
use super::flag;
use super::partition::SUM;
use crate::kernel::{Constant, KernelId};
use crate::recorder::{Binding, Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{Pdf, Rsm, Vsgls};
use vsgl_core::phase::pdf::{level_count, level_start, top_level};
use vsgl_core::plan::ClusterPlan;
use vsgl_core::settings::Clustering;

/// Twin of `Params` in `entry/filtered.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    size: u32,
    maps: u32,
    rsm_size: u32,
    map_texels: u32,
    texels: u32,
    level: u32,
    overlap: f32,
    bisections: u32,
}

/// Bytes of a `Kernel` as `phase/filtered.wgsl` declares it, and of a `Square` in `phase/filtered_box.wgsl`.
pub(super) const KERNEL: u64 = 20;

/// What finds the kernels, and what sums up the texels under them.
fn entries(plan: &ClusterPlan) -> [&'static str; 2] {
    if plan.method == Clustering::FilteredBox {
        ["squares", "gather_squares"]
    } else {
        ["kernels", "gather"]
    }
}

/// The constants of an entry.
fn constants_of(plan: &ClusterPlan) -> Vec<Constant> {
    let mut all = constants(plan).to_vec();
    let original = plan.method == Clustering::FilteredOriginal;
    all.push(("ORIGINAL", flag(original)));
    all
}

/// The pipelines that a plan needs.
pub(super) fn kernels(plan: &ClusterPlan) -> Vec<KernelId> {
    let constants = constants_of(plan);
    ["numbers", "above"]
        .into_iter()
        .chain(entries(plan))
        .map(|entry| KernelId::new("entry/filtered", entry, &constants))
        .collect()
}

/// Records kernels and the sums under them, with the texels drawn into the lights' resource.
pub(super) fn record(
    recorder: &mut Recorder<'_>,
    rsm: &WgpuRes<Rsm>,
    pdf: &WgpuRes<Pdf>,
    made: &WgpuRes<Vsgls>,
    plan: &ClusterPlan,
) -> Result<Drawn> {
    let context = recorder.context();
    let ([size, maps], [rsm_size, _]) = (&pdf.head[..], &rsm.head[..]) else {
        return Err(context.error("a density without its size", "report it"));
    };
    let (size, maps, rsm_size) = (*size, *maps, *rsm_size);
    let capacity = made.len("texel");
    let top = top_level(size);
    let above = level_start(size, maps, top + 1) - level_count(size, maps, 0);
    let before = context.buffer("lights of the maps before", 4 * u64::from(maps))?;
    let kernel = context.buffer("kernels", KERNEL * capacity)?;
    let pyramid = context.buffer("the pyramid of sums", SUM * above as u64)?;
    let sum = context.buffer("sums of clusters", SUM * capacity)?;
    let bound = [
        ("texel", rsm.bind("position")),
        ("map", rsm.bind("map")),
        ("weight", pdf.bind("weight")),
        ("share", pdf.bind("share")),
        ("before", Binding::Buffer(&before)),
        ("clusters", Binding::Buffer(made.count_buffer())),
        ("kernel", Binding::Buffer(&kernel)),
        ("square", Binding::Buffer(&kernel)),
        ("kernel_out", made.bind("kernel")),
        ("drawn_out", made.bind("texel")),
        ("pyramid", Binding::Buffer(&pyramid)),
        ("sum_out", Binding::Buffer(&sum)),
    ];
    let mut params = Params {
        size,
        maps,
        rsm_size,
        map_texels: rsm_size * rsm_size,
        texels: rsm.len("position") as u32,
        level: 0,
        overlap: plan.kernel,
        bisections: plan.bisections,
    };
    let constants = constants_of(plan);
    let mut run = |entry, params: &Params, groups| {
        let kernel = context.kernel("entry/filtered", entry, &constants)?;
        recorder.dispatch(&kernel, params, &bound, groups)
    };
    for level in 1..=top {
        params.level = level;
        let texels = level_count(size, maps, level) as u64;
        run("above", &params, Groups::Items(texels))?;
    }
    run("numbers", &params, Groups::Count(1))?;
    let groups = if plan.method == Clustering::FilteredBox {
        Groups::Count(capacity)
    } else {
        Groups::Items(capacity)
    };
    for entry in entries(plan) {
        run(entry, &params, groups)?;
    }
    Ok(Drawn { sum })
}

#[cfg(test)]
mod tests {
    use super::Params;
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/filtered",
            "Params",
            Params {
                size,
                maps,
                rsm_size,
                map_texels,
                texels,
                level,
                overlap,
                bisections
            }
        );
    }
}
