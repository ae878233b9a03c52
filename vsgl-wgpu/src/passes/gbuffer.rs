//! What the camera sees.

use super::{flag, masks, scene_columns, surface_constants};
use crate::kernel::{Constant, KernelId};
use crate::params::View;
use crate::raster;
use crate::recorder::{Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{GBuffer, SceneData};
use vsgl_core::plan::GBufferPlan;
use vsgl_core::settings::Primary;

/// Twin of `Params` in `entry/gbuffer.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    view: View,
    nodes: u32,
    padding: [u32; 3],
}

fn constants(plan: &GBufferPlan, textures: bool) -> Vec<Constant> {
    let mut constants = surface_constants(&plan.surface, textures).to_vec();
    constants.push(("GLOSSY", flag(plan.glossy)));
    constants.push(("EMISSION", flag(plan.surface.emission)));
    constants
}

/// The pipelines that a plan needs.
pub(crate) fn kernels(plan: &GBufferPlan) -> Vec<KernelId> {
    let mut kernels = vec![
        KernelId::new("entry/gbuffer", "visibility", &masks(&plan.surface)),
        KernelId::new("entry/gbuffer", "surface", &constants(plan, true)),
    ];
    if plan.primary == Primary::Raster {
        kernels.extend(raster::kernels());
    }
    kernels
}

/// Records both kernels: which triangle each sample sees, and the surface there.
pub(crate) fn record(
    recorder: &mut Recorder<'_>,
    scene: &WgpuRes<SceneData>,
    view: &vsgl_core::render::View,
    plan: &GBufferPlan,
) -> Result<WgpuRes<GBuffer>> {
    let context = recorder.context();
    let (width, height) = view.samples();
    let count = u64::from(width) * u64::from(height);
    let glossy = if plan.glossy { count } else { 0 };
    let stretched = if plan.surface.anisotropy { count } else { 0 };
    let emission = if plan.surface.emission { count } else { 0 };
    let made = WgpuRes::<GBuffer>::new(
        context,
        vec![width, height],
        &[
            ("triangle", 4, count),
            ("position", 16, count),
            ("normal", 16, count),
            ("diffuse", 16, count),
            ("specular", 16, glossy),
            ("grazing", 4, glossy),
            ("tangent", 16, stretched),
            ("emission", 12, emission),
        ],
    )?;
    let params = Params {
        view: View::from(view),
        nodes: scene.len("node") as u32,
        padding: [0; 3],
    };
    let mut bound = scene_columns(scene);
    bound.extend([
        ("triangle", made.bind("triangle")),
        ("triangle_out", made.bind("triangle")),
        ("surface_out", made.bind("position")),
        ("grazing_out", made.bind("grazing")),
        ("emission_out", made.bind("emission")),
    ]);
    if plan.primary == Primary::Raster && raster::fits(view) {
        raster::record(recorder, scene, view, &made)?;
    } else {
        let visibility = context.kernel("entry/gbuffer", "visibility", &masks(&plan.surface))?;
        recorder.dispatch(&visibility, &params, &bound, Groups::Items(count))?;
    }
    let constants = constants(plan, scene.len("texture") > 0);
    let surface = context.kernel("entry/gbuffer", "surface", &constants)?;
    recorder.dispatch(&surface, &params, &bound, Groups::Items(count))?;
    Ok(made)
}

#[cfg(test)]
mod tests {
    use super::Params;
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!("entry/gbuffer", "Params", Params { view, nodes });
    }
}
