//! One cluster for each map.

use super::cluster::{Drawn, constants};
use super::partition::SUM;
use crate::kernel::KernelId;
use crate::recorder::{Binding, Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{Rsm, Vsgls};
use vsgl_core::phase::whole::CHUNK;
use vsgl_core::plan::ClusterPlan;

/// Twin of `Params` in `entry/whole.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    texels: u32,
    map_texels: u32,
    maps: u32,
    chunks: u32,
}

/// The pipelines that a plan needs.
pub(super) fn kernels(plan: &ClusterPlan) -> Vec<KernelId> {
    let constants = constants(plan);
    ["chunks", "maps", "numbers"]
        .map(|entry| KernelId::new("entry/whole", entry, &constants))
        .to_vec()
}

/// Records the sums of all maps, with the texels drawn into the lights' resource.
pub(super) fn record(
    recorder: &mut Recorder<'_>,
    rsm: &WgpuRes<Rsm>,
    made: &WgpuRes<Vsgls>,
    plan: &ClusterPlan,
) -> Result<Drawn> {
    let context = recorder.context();
    let [size, maps] = rsm.head[..] else {
        return Err(context.error("an RSM without its size", "report it"));
    };
    let map_texels = size * size;
    let params = Params {
        texels: rsm.len("position") as u32,
        map_texels,
        maps,
        chunks: map_texels.div_ceil(CHUNK as u32).max(1),
    };
    let (all, chunks) = (u64::from(maps), u64::from(params.chunks));
    let chunk = context.buffer("sums of chunks", SUM * all * chunks)?;
    let whole = context.buffer("sums of maps", SUM * all)?;
    let whole_drawn = context.buffer("texels of maps", 4 * all)?;
    let sum = context.buffer("sums of clusters", SUM * made.len("texel"))?;
    let bound = [
        ("texel", rsm.bind("position")),
        ("map", rsm.bind("map")),
        ("chunk", Binding::Buffer(&chunk)),
        ("whole", Binding::Buffer(&whole)),
        ("whole_drawn", Binding::Buffer(&whole_drawn)),
        ("clusters", Binding::Buffer(made.count_buffer())),
        ("sum_out", Binding::Buffer(&sum)),
        ("drawn_out", made.bind("texel")),
    ];
    let constants = constants(plan);
    for (entry, groups) in [("chunks", all * chunks), ("maps", all), ("numbers", 1)] {
        let kernel = context.kernel("entry/whole", entry, &constants)?;
        recorder.dispatch(&kernel, &params, &bound, Groups::Count(groups))?;
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
            "entry/whole",
            "Params",
            Params {
                texels,
                map_texels,
                maps,
                chunks
            }
        );
    }
}
