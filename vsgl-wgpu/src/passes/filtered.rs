//! Clusters by modified filtered importance sampling.

use super::cluster::Drawn;
use crate::kernel::KernelId;
use crate::recorder::Recorder;
use crate::res::WgpuRes;
use vsgl_core::Result;
use vsgl_core::data::{Pdf, Rsm, Vsgls};
use vsgl_core::plan::ClusterPlan;

/// The pipelines that a plan needs.
pub(super) fn kernels(_plan: &ClusterPlan) -> Vec<KernelId> {
    Vec::new()
}

pub(super) fn record(
    recorder: &mut Recorder<'_>,
    _rsm: &WgpuRes<Rsm>,
    _pdf: &WgpuRes<Pdf>,
    _made: &WgpuRes<Vsgls>,
    _plan: &ClusterPlan,
) -> Result<Drawn> {
    Err(recorder.context().error(
        "filtered clustering is not written yet",
        "use `--backend cpu`",
    ))
}
