//! Clusters of the texels nearest to centres.

use super::cluster::Drawn;
use super::partition::{self, CLUSTER, GROUPS, NODE, STATE, SUM};
use super::sort;
use crate::kernel::KernelId;
use crate::recorder::{Binding, Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{Pdf, Rsm, Vsgls};
use vsgl_core::phase::cluster;
use vsgl_core::phase::nearest::WIDTH;
use vsgl_core::plan::ClusterPlan;

/// Twin of `Params` in `entry/nearest.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    size: u32,
    maps: u32,
    rsm_size: u32,
    map_texels: u32,
    texels: u32,
    boxes: u32,
}

/// Bytes of the records that only the device writes, as `data/nearest.wgsl` declares them.
pub(super) const CENTRE: u64 = 16;
pub(super) const BOUNDS: u64 = 32;

const ENTRIES: [&str; 6] = [
    "numbers",
    "draws",
    "boxes",
    "wider_boxes",
    "labels",
    "marks",
];

/// The pipelines that a plan needs.
pub(super) fn kernels(plan: &ClusterPlan) -> Vec<KernelId> {
    let mut kernels = partition::kernels_of_lists(plan);
    kernels.extend(ENTRIES.map(|entry| KernelId::new("entry/nearest", entry, &[])));
    kernels.extend(sort::kernels());
    kernels.extend(partition::kernels_of_clusters(plan));
    kernels
}

/// Records clusters and their sums, with labels and texels drawn into the lights' resource.
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
    let texels = rsm.len("position");
    let capacity = made.len("texel");
    let boxes = capacity.div_ceil(WIDTH as u64);
    let wider = boxes.div_ceil(WIDTH as u64);
    let buffer = |what, bytes| context.buffer(&format!("the nearest centres' {what}"), bytes);
    let place = buffer("positions and weights", 16 * texels)?;
    let lists = [
        buffer("list", 4 * texels)?,
        buffer("spare list", 4 * texels)?,
    ];
    let mark = buffer("marks", 4 * texels)?;
    let count = buffer("counts", sort::count_bytes(texels.max(capacity)))?;
    let node = buffer("nodes", NODE * u64::from(maps))?;
    let state = buffer("state", STATE)?;
    let before = buffer("centres of the maps before", 4 * (u64::from(maps) + 2))?;
    let draw = buffer("centres", CENTRE * capacity)?;
    let key = buffer("keys", 4 * capacity)?;
    let orders = [
        buffer("order", 4 * capacity)?,
        buffer("spare order", 4 * capacity)?,
    ];
    let centre = buffer("centres in order", CENTRE * capacity)?;
    let bounds = buffer("boxes", BOUNDS * (boxes + wider))?;
    let [centres, lit] = [buffer("number", 4)?, buffer("number of texels", 4)?];
    let block_groups = buffer("workgroups", GROUPS)?;
    let clusters = buffer("clusters", CLUSTER * capacity)?;
    let block = buffer(
        "sums of blocks",
        SUM * (texels / cluster::BLOCK as u64 + capacity),
    )?;
    let sum = context.buffer("sums of clusters", SUM * capacity)?;

    let mut bound = vec![
        ("texel", rsm.bind("position")),
        ("map", rsm.bind("map")),
        ("weight", pdf.bind("weight")),
        ("share", pdf.bind("share")),
        ("label", made.bind("label")),
        ("clusters", Binding::Buffer(made.count_buffer())),
        ("sum_out", Binding::Buffer(&sum)),
        ("drawn_out", made.bind("texel")),
    ];
    let own = [
        ("place", &place),
        ("mark", &mark),
        ("count", &count),
        ("node", &node),
        ("state", &state),
        ("before", &before),
        ("draw", &draw),
        ("key", &key),
        ("centre", &centre),
        ("bounds", &bounds),
        ("centres", &centres),
        ("lit", &lit),
        ("block_groups", &block_groups),
        ("cluster", &clusters),
        ("block", &block),
        ("block_out", &block),
    ];
    bound.extend(own.map(|(name, buffer)| (name, Binding::Buffer(buffer))));
    // What is sorted changes its place.
    let with = |name, buffer| {
        let mut all = bound.clone();
        all.push((name, Binding::Buffer(buffer)));
        all
    };
    let params = Params {
        size,
        maps,
        rsm_size,
        map_texels: rsm_size * rsm_size,
        texels: texels as u32,
        boxes: boxes as u32,
    };
    let run = |recorder: &mut Recorder<'_>, entry, bound: &[_], groups| {
        let kernel = context.kernel("entry/nearest", entry, &[])?;
        recorder.dispatch(&kernel, &params, bound, groups)
    };

    let [list, spare] = &lists;
    partition::record_lists(recorder, rsm, plan, &with("list", list))?;
    run(recorder, "numbers", &bound, Groups::Count(1))?;
    let [order, spare_order] = &orders;
    let drawn = with("order", order);
    run(recorder, "draws", &drawn, Groups::Items(capacity))?;
    let keys = u64::from(maps) * u64::from(size) * u64::from(size);
    let by_key = [&centres, &key].map(|b| Binding::Buffer(b));
    let [order, _] = sort::record(
        recorder,
        by_key,
        [order, spare_order],
        &count,
        capacity,
        keys,
    )?;
    let mut ordered = with("order", order);
    ordered.push(("list", Binding::Buffer(list)));
    run(recorder, "boxes", &ordered, Groups::Items(boxes))?;
    run(recorder, "wider_boxes", &ordered, Groups::Items(wider))?;
    run(recorder, "labels", &ordered, Groups::Items(texels))?;
    // Beyond all labels are those of texels without one.
    let by_label = [Binding::Buffer(&lit), made.bind("label")];
    let [list, _] = sort::record(
        recorder,
        by_label,
        [list, spare],
        &count,
        texels,
        capacity + 1,
    )?;
    let listed = with("list", list);
    run(recorder, "marks", &listed, Groups::Items(texels))?;
    partition::record_clusters(recorder, rsm, made, plan, &listed, &block_groups)?;
    Ok(Drawn { sum })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/nearest",
            "Params",
            Params {
                size,
                maps,
                rsm_size,
                map_texels,
                texels,
                boxes
            }
        );
    }
}
