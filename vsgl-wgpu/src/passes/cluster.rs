//! Clusters of virtual point lights, and the lights that stand for them.

use super::{filtered, flag, nearest, partition, whole};
use crate::kernel::{Constant, KernelId};
use crate::pool::Pooled;
use crate::recorder::{Binding, Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{DiffuseVsgl, Pdf, Rsm, SceneData, SpecularVsgl, Target, Vsgls};
use vsgl_core::plan::ClusterPlan;
use vsgl_core::settings::{Clustering, Emission, SharpnessFit, Variance};

/// Twin of `Params` in `entry/cluster.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Params {
    texels: u32,
    map_texels: u32,
    capacity: u32,
    specular_stride: u32,
}

impl Params {
    pub(super) fn new(rsm: &WgpuRes<Rsm>, made: &WgpuRes<Vsgls>, plan: &ClusterPlan) -> Self {
        Self {
            texels: rsm.len("position") as u32,
            map_texels: rsm.head[0] * rsm.head[0],
            capacity: made.len("texel") as u32,
            specular_stride: if plan.glossy {
                size_of::<SpecularVsgl>() as u32 / 16
            } else {
                0
            },
        }
    }
}

/// Constants of all kernels that make sums of texels, or lights of sums.
pub(super) fn constants(plan: &ClusterPlan) -> [Constant; 6] {
    [
        ("GLOSSY", flag(plan.glossy)),
        ("ANISOTROPIC", flag(plan.anisotropic)),
        ("SG", flag(plan.emission == Emission::Sg)),
        ("APART", flag(plan.apart)),
        ("TOKSVIG", flag(plan.sharpness == SharpnessFit::Toksvig)),
        ("TRACE", flag(plan.variance == Variance::Trace)),
    ]
}

/// Columns that have room for more lights than there may be.
const COUNTED: &[&str] = &["diffuse", "specular", "target", "texel", "kernel"];

/// Sums of the clusters, whose texels are drawn already.
pub(super) struct Drawn {
    pub(super) sum: Pooled,
}

/// The pipelines that a plan needs.
pub(crate) fn kernels(plan: &ClusterPlan) -> Vec<KernelId> {
    let mut kernels = match plan.method {
        Clustering::Partition => partition::kernels(plan),
        Clustering::Filtered | Clustering::FilteredBox | Clustering::FilteredOriginal => {
            filtered::kernels(plan)
        }
        Clustering::NearestWorld => nearest::kernels(plan),
        Clustering::Whole => whole::kernels(plan),
    };
    let constants = constants(plan);
    kernels.push(KernelId::new("entry/cluster", "make_lights", &constants));
    kernels
}

/// Records the clusters.
pub(crate) fn record(
    recorder: &mut Recorder<'_>,
    scene: &WgpuRes<SceneData>,
    rsm: &WgpuRes<Rsm>,
    pdf: Option<&WgpuRes<Pdf>>,
    plan: &ClusterPlan,
) -> Result<WgpuRes<Vsgls>> {
    let context = recorder.context();
    let pdf = pdf.filter(|_| plan.method.draws());
    let has_kernels = pdf.is_some() && plan.method.has_kernels();
    let has_labels = !has_kernels && plan.method != Clustering::Whole;
    // A cluster a map at least, if it is lit.
    let most = plan.count.max(rsm.head[1]).max(1);
    let capacity = u64::from(most);
    let if_so = |yes: bool, count: u64| if yes { count } else { 0 };
    let made = WgpuRes::<Vsgls>::new(
        context,
        vec![most],
        &[
            ("diffuse", size_of::<DiffuseVsgl>() as u64, capacity),
            (
                "specular",
                size_of::<SpecularVsgl>() as u64,
                if_so(plan.glossy, capacity),
            ),
            ("target", size_of::<Target>() as u64, capacity),
            ("texel", 4, capacity),
            ("label", 4, if_so(has_labels, rsm.len("position"))),
            ("kernel", 16, if_so(has_kernels, capacity)),
        ],
    )?
    .counted(context.buffer("the number of clusters", 4)?, COUNTED);
    let drawn = match pdf {
        Some(pdf) if has_kernels => filtered::record(recorder, rsm, pdf, &made, plan)?,
        Some(pdf) => nearest::record(recorder, rsm, pdf, &made, plan)?,
        None if plan.method == Clustering::Whole => whole::record(recorder, rsm, &made, plan)?,
        None => partition::record(recorder, rsm, &made, plan)?,
    };
    let kernel = context.kernel("entry/cluster", "make_lights", &constants(plan))?;
    recorder.dispatch(
        &kernel,
        &Params::new(rsm, &made, plan),
        &[
            ("texel", rsm.bind("position")),
            ("map", rsm.bind("map")),
            ("triangle", rsm.bind("triangle")),
            ("corner", scene.bind("corner")),
            ("clusters", Binding::Buffer(made.count_buffer())),
            ("sum", Binding::Buffer(&drawn.sum)),
            ("drawn", made.bind("texel")),
            ("lights", made.bind("diffuse")),
        ],
        Groups::Items(capacity),
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
            "entry/cluster",
            "Params",
            Params {
                texels,
                map_texels,
                capacity,
                specular_stride
            }
        );
    }
}
