//! Clusters by exact partition.

use super::cluster::{Drawn, constants};
use super::flag;
use crate::context::Context;
use crate::kernel::{Constant, KernelId};
use crate::pool::Pooled;
use crate::recorder::{Binding, Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{Rsm, Vsgls};
use vsgl_core::phase::{cluster, partition};
use vsgl_core::plan::ClusterPlan;

/// Twin of `Params` in `entry/partition.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Params {
    texels: u32,
    map_texels: u32,
    maps: u32,
    clusters: u32,
    most: u32,
}

/// Bytes of the records that only the device writes, as `data/partition.wgsl`, `phase/partition.wgsl` and
/// `phase/cluster.wgsl` declare them.
pub(super) const NODE: u64 = 32;
const SPLIT: u64 = 12;
pub(super) const STATE: u64 = 40;
pub(super) const CLUSTER: u64 = 12;
pub(super) const GROUPS: u64 = 12;
const FEATURES: u64 = 64;
pub(super) const SUM: u64 = 288;

/// What the kernels hand on to each other.
struct Work {
    place: Pooled,
    list: Pooled,
    spare: Pooled,
    mark: Pooled,
    count: Pooled,
    node: Pooled,
    split: Pooled,
    state: Pooled,
    slot_groups: Pooled,
    child_groups: Pooled,
    features: Pooled,
    cluster: Pooled,
    block: Pooled,
}

impl Work {
    fn new(context: &Context, texels: u64, capacity: u64, nodes: u64) -> Result<Self> {
        let buffer = |what, bytes| context.buffer(&format!("the partition's {what}"), bytes);
        // A set has a block that is not full, and a slot more than blocks.
        let slots = texels / partition::BLOCK as u64 + 2 * capacity;
        let blocks = texels / cluster::BLOCK as u64 + capacity;
        Ok(Self {
            place: buffer("positions and weights", 16 * texels)?,
            list: buffer("list", 4 * texels)?,
            spare: buffer("spare list", 4 * texels)?,
            mark: buffer("marks", 4 * texels)?,
            count: buffer("counts", 4 * slots)?,
            node: buffer("nodes", NODE * nodes)?,
            split: buffer("splits", SPLIT * capacity)?,
            state: buffer("state", STATE)?,
            slot_groups: buffer("workgroups", GROUPS)?,
            child_groups: buffer("workgroups", GROUPS)?,
            features: buffer("features of blocks", FEATURES * slots)?,
            cluster: buffer("clusters", CLUSTER * capacity)?,
            block: buffer("sums of blocks", SUM * blocks)?,
        })
    }

    fn bound(&self) -> Vec<(&'static str, Binding<'_>)> {
        [
            ("place", &self.place),
            ("list", &self.list),
            ("spare", &self.spare),
            ("mark", &self.mark),
            ("count", &self.count),
            ("node", &self.node),
            ("split", &self.split),
            ("state", &self.state),
            ("slot_groups", &self.slot_groups),
            ("child_groups", &self.child_groups),
            ("cluster", &self.cluster),
        ]
        .map(|(name, buffer)| (name, Binding::Buffer(buffer)))
        .to_vec()
    }
}

const LISTS: [&str; 3] = ["places", "lit", "compact"];
const OF_ROOTS: [&str; 2] = ["features", "nodes"];
const ROUND: [(&str, &str); 5] = [
    ("entry/best", "best"),
    ("entry/round", "halves"),
    ("entry/round", "scatter"),
    ("entry/round", "features"),
    ("entry/round", "nodes"),
];
const AFTER: [&str; 4] = ["begins", "numbers", "labels", "blocks"];
const SUMS: [&str; 2] = ["block_sums", "cluster_sums"];
const LAST: [Constant; 1] = [("LAST", 1.0)];

/// The pipelines that a plan needs.
pub(super) fn kernels(plan: &ClusterPlan) -> Vec<KernelId> {
    let has_specular = [("GLOSSY", flag(plan.glossy))];
    let mut kernels = kernels_of_lists(plan);
    kernels.push(KernelId::new("entry/partition", "roots", &has_specular));
    kernels.extend(ROUND.map(|(file, e)| KernelId::new(file, e, &[])));
    kernels.push(KernelId::new("entry/best", "best", &LAST));
    kernels.extend(kernels_of_clusters(plan));
    kernels
}

/// Those of [`record_lists`].
pub(super) fn kernels_of_lists(plan: &ClusterPlan) -> Vec<KernelId> {
    let has_specular = [("GLOSSY", flag(plan.glossy))];
    LISTS
        .map(|e| KernelId::new("entry/partition", e, &has_specular))
        .to_vec()
}

/// Those of [`record_clusters`].
pub(super) fn kernels_of_clusters(plan: &ClusterPlan) -> Vec<KernelId> {
    let sums = constants(plan);
    let mut kernels: Vec<_> = AFTER
        .map(|e| KernelId::new("entry/leaves", e, &[]))
        .to_vec();
    kernels.extend(SUMS.map(|e| KernelId::new("entry/cluster", e, &sums)));
    kernels
}

/// Records the partition, with labels and texels drawn into the lights' resource; returns what lights are made from.
pub(super) fn record(
    recorder: &mut Recorder<'_>,
    rsm: &WgpuRes<Rsm>,
    made: &WgpuRes<Vsgls>,
    plan: &ClusterPlan,
) -> Result<Drawn> {
    let context = recorder.context();
    let [_, maps] = rsm.head[..] else {
        return Err(context.error("an RSM without its size", "report it"));
    };
    let texels = rsm.len("position");
    let capacity = u64::from(plan.count.max(maps).max(1));
    let most = partition::nodes(plan.count, maps);
    let work = Work::new(context, texels, capacity, u64::from(most))?;
    let sum = context.buffer("sums of clusters", SUM * capacity)?;
    let mut bound = work.bound();
    bound.extend([
        ("texel", rsm.bind("position")),
        ("label", made.bind("label")),
        ("clusters", Binding::Buffer(made.count_buffer())),
        // An indirect dispatch may not bind what it reads its size from for writing: the table of blocks has its own.
        ("block_groups", Binding::Buffer(&work.slot_groups)),
    ]);
    let one = Groups::Count(1);
    let params = record_lists(recorder, rsm, plan, &bound)?;
    let has_specular = [("GLOSSY", flag(rsm.len("grazing") > 0))];
    let roots = context.kernel("entry/partition", "roots", &has_specular)?;
    recorder.dispatch(&roots, &params, &bound, one)?;

    let slots = Groups::Indirect(&work.slot_groups, 0);
    let children = Groups::Indirect(&work.child_groups, 0);
    let mut rounds = bound.clone();
    rounds.push(("block", Binding::Buffer(&work.features)));
    for (entry, groups) in OF_ROOTS.into_iter().zip([slots, children]) {
        let kernel = context.kernel("entry/round", entry, &[])?;
        recorder.dispatch(&kernel, &(), &rounds, groups)?;
    }
    for _ in 0..partition::rounds(plan.count) {
        let groups = [one, slots, slots, slots, children];
        for ((file, entry), groups) in ROUND.into_iter().zip(groups) {
            let kernel = context.kernel(file, entry, &[])?;
            recorder.dispatch(&kernel, &(), &rounds, groups)?;
        }
    }

    let last = context.kernel("entry/best", "best", &LAST)?;
    recorder.dispatch(&last, &(), &bound, one)?;
    let mut sums = bound;
    sums.extend([
        ("map", rsm.bind("map")),
        ("block", Binding::Buffer(&work.block)),
        ("block_out", Binding::Buffer(&work.block)),
        ("sum_out", Binding::Buffer(&sum)),
        ("drawn_out", made.bind("texel")),
    ]);
    record_clusters(recorder, rsm, made, plan, &sums, &work.slot_groups)?;
    Ok(Drawn { sum })
}

/// Records positions and weights, and the list of lit texels.
pub(super) fn record_lists(
    recorder: &mut Recorder<'_>,
    rsm: &WgpuRes<Rsm>,
    plan: &ClusterPlan,
    bound: &[(&str, Binding<'_>)],
) -> Result<Params> {
    let context = recorder.context();
    let [size, maps] = rsm.head[..] else {
        return Err(context.error("an RSM without its size", "report it"));
    };
    let texels = rsm.len("position");
    let params = Params {
        texels: texels as u32,
        map_texels: size * size,
        maps,
        clusters: plan.count,
        most: partition::nodes(plan.count, maps),
    };
    let has_specular = [("GLOSSY", flag(rsm.len("grazing") > 0))];
    let blocks = Groups::Count(texels.div_ceil(256));
    for (entry, groups) in LISTS.into_iter().zip([blocks, Groups::Count(1), blocks]) {
        let kernel = context.kernel("entry/partition", entry, &has_specular)?;
        recorder.dispatch(&kernel, &params, bound, groups)?;
    }
    Ok(params)
}

/// Records clusters from marks in the list, and their sums; `block_groups` is where their number of blocks is written.
pub(super) fn record_clusters(
    recorder: &mut Recorder<'_>,
    rsm: &WgpuRes<Rsm>,
    made: &WgpuRes<Vsgls>,
    plan: &ClusterPlan,
    bound: &[(&str, Binding<'_>)],
    block_groups: &Pooled,
) -> Result<()> {
    let context = recorder.context();
    let (one, blocks) = (
        Groups::Count(1),
        Groups::Count(rsm.len("position").div_ceil(256)),
    );
    for (entry, groups) in AFTER.into_iter().zip([blocks, one, blocks, one]) {
        let kernel = context.kernel("entry/leaves", entry, &[])?;
        recorder.dispatch(&kernel, &(), bound, groups)?;
    }
    let params = super::cluster::Params::new(rsm, made, plan);
    let constants = constants(plan);
    let clusters = Groups::Count(made.len("texel"));
    let groups = [Groups::Indirect(block_groups, 0), clusters];
    for (entry, groups) in SUMS.into_iter().zip(groups) {
        let kernel = context.kernel("entry/cluster", entry, &constants)?;
        recorder.dispatch(&kernel, &params, bound, groups)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::twins;
    use crate::shaders::link;
    use wgpu::naga::front::wgsl::parse_str;
    use wgpu::naga::proc::Layouter;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/partition",
            "Params",
            Params {
                texels,
                map_texels,
                maps,
                clusters,
                most
            }
        );
    }

    /// Too small a buffer would not fail: accesses beyond its end are moved inside it.
    #[test]
    fn records_have_the_sizes_that_shaders_give_them() {
        let mut found = 0;
        for file in [
            "entry/round",
            "entry/cluster",
            "entry/filtered",
            "entry/whole",
            "entry/nearest",
        ] {
            let module = parse_str(&link(&[file])).expect(file);
            let mut layouter = Layouter::default();
            layouter.update(module.to_ctx()).expect(file);
            for (handle, kind) in module.types.iter() {
                let bytes = match kind.name.as_deref() {
                    Some("Node") => NODE,
                    Some("Split") => SPLIT,
                    Some("State") => STATE,
                    Some("Cluster") => CLUSTER,
                    Some("Groups") => GROUPS,
                    Some("Features") => FEATURES,
                    Some("Sum") => SUM,
                    Some("Kernel" | "Square") => super::super::filtered::KERNEL,
                    Some("Centre") => super::super::nearest::CENTRE,
                    Some("Bounds") => super::super::nearest::BOUNDS,
                    _ => continue,
                };
                assert_eq!(
                    u64::from(layouter[handle].to_stride()),
                    bytes,
                    "{:?}",
                    kind.name
                );
                found += 1;
            }
        }
        assert!(found >= 11, "{found} records");
    }
}
