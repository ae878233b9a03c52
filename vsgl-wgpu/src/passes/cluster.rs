//! Clusters of virtual point lights.

use crate::kernel::KernelId;
use crate::recorder::Recorder;
use crate::res::WgpuRes;
use vsgl_core::Result;
use vsgl_core::data::{Pdf, Rsm, SceneData, Vsgls};
use vsgl_core::plan::ClusterPlan;

/// The pipelines that a plan needs.
pub(crate) fn kernels(_plan: &ClusterPlan) -> Vec<KernelId> {
    Vec::new()
}

/// Records the clusters.
pub(crate) fn record(
    recorder: &mut Recorder<'_>,
    _scene: &WgpuRes<SceneData>,
    _rsm: &WgpuRes<Rsm>,
    _pdf: Option<&WgpuRes<Pdf>>,
    _plan: &ClusterPlan,
) -> Result<WgpuRes<Vsgls>> {
    Err(recorder
        .context()
        .error("clustering is not written yet", "use `--backend cpu`"))
}
