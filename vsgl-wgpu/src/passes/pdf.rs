//! The density on the texels.

use crate::kernel::KernelId;
use crate::recorder::Recorder;
use crate::res::WgpuRes;
use vsgl_core::Result;
use vsgl_core::data::{Pdf, Rsm};
use vsgl_core::plan::PdfPlan;

/// The pipelines that a plan needs.
pub(crate) fn kernels(_plan: &PdfPlan) -> Vec<KernelId> {
    Vec::new()
}

/// Records the density and its pyramid.
pub(crate) fn record(
    recorder: &mut Recorder<'_>,
    _rsm: &WgpuRes<Rsm>,
    _plan: &PdfPlan,
) -> Result<WgpuRes<Pdf>> {
    Err(recorder
        .context()
        .error("the density is not written yet", "use `--backend cpu`"))
}
