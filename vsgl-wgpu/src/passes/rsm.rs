//! What the lights see.

use super::{flag, masks, scene_columns, surface_constants};
use crate::kernel::{Constant, KernelId};
use crate::recorder::{Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{MapRecord, Rsm, SceneData};
use vsgl_core::phase::rsm::maps;
use vsgl_core::plan::RsmPlan;
use vsgl_core::scene::Light;

/// Twin of `Params` in `entry/rsm.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    map: MapRecord,
    nodes: u32,
    size: u32,
    first: u32,
    count: u32,
}

fn constants(plan: &RsmPlan, textures: bool) -> Vec<Constant> {
    let mut constants = surface_constants(&plan.surface, textures).to_vec();
    constants.push(("GLOSSY", flag(plan.glossy)));
    constants
}

/// The pipelines that a plan needs.
pub(crate) fn kernels(plan: &RsmPlan) -> Vec<KernelId> {
    vec![
        KernelId::new("entry/rsm", "visibility", &masks(&plan.surface)),
        KernelId::new("entry/rsm", "surface", &constants(plan, true)),
    ]
}

/// Records both kernels for each light's map.
pub(crate) fn record(
    recorder: &mut Recorder<'_>,
    scene: &WgpuRes<SceneData>,
    lights: &[Light],
    plan: &RsmPlan,
) -> Result<WgpuRes<Rsm>> {
    let context = recorder.context();
    let maps = maps(lights, plan.size, SceneData::bounds_of(&scene.head));
    let side = u64::from(plan.size) * u64::from(plan.size);
    let count = side * maps.len() as u64;
    let glossy = if plan.glossy { count } else { 0 };
    let stretched = if plan.surface.anisotropy { count } else { 0 };
    let made = WgpuRes::<Rsm>::new(
        context,
        vec![plan.size, maps.len() as u32],
        &[
            ("map", size_of::<MapRecord>() as u64, maps.len() as u64),
            ("triangle", 4, count),
            ("position", 16, count),
            ("normal", 16, count),
            ("diffuse", 16, count),
            ("specular", 16, glossy),
            ("grazing", 16, glossy),
            ("tangent", 16, stretched),
        ],
    )?;
    let visibility = context.kernel("entry/rsm", "visibility", &masks(&plan.surface))?;
    let constants = constants(plan, scene.len("texture") > 0);
    let surface = context.kernel("entry/rsm", "surface", &constants)?;
    let mut bound = scene_columns(scene);
    bound.extend([
        ("triangle", made.bind("triangle")),
        ("triangle_out", made.bind("triangle")),
        ("texel_out", made.bind("position")),
        // Not from the host: what it writes comes before all that is recorded, and a host may have recorded something
        // that used this buffer before.
        ("map_out", made.bind("map")),
    ]);
    for (index, map) in maps.iter().enumerate() {
        let params = Params {
            map: *map,
            nodes: scene.len("node") as u32,
            size: plan.size,
            first: (index as u64 * side) as u32,
            count: count as u32,
        };
        recorder.dispatch(&visibility, &params, &bound, Groups::Items(side))?;
        recorder.dispatch(&surface, &params, &bound, Groups::Items(side))?;
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
            "entry/rsm",
            "Params",
            Params {
                map,
                nodes,
                size,
                first,
                count
            }
        );
    }
}
