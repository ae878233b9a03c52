//! What the lights see.

use super::{flag, masks, scene_columns, surface_constants};
use crate::kernel::{Constant, KernelId};
use crate::recorder::{Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::map_kind;
use vsgl_core::data::{MapRecord, Rsm, SceneData};
use vsgl_core::phase::rsm::planned;
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

/// Twin of `Params` in `entry/emitters.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct EmitterParams {
    map: MapRecord,
    size: u32,
    first: u32,
    count: u32,
    points: u32,
}

fn constants(plan: &RsmPlan, textures: bool) -> Vec<Constant> {
    let mut constants = surface_constants(&plan.surface, textures).to_vec();
    constants.push(("GLOSSY", flag(plan.glossy)));
    constants
}

fn emitter_constants(plan: &RsmPlan) -> [Constant; 2] {
    [
        ("GLOSSY", flag(plan.glossy)),
        ("ANISOTROPY", flag(plan.surface.anisotropy)),
    ]
}

/// The pipelines that a plan needs.
pub(crate) fn kernels(plan: &RsmPlan) -> Vec<KernelId> {
    let mut kernels = Vec::new();
    if plan.lights {
        kernels.push(KernelId::new(
            "entry/rsm",
            "visibility",
            &masks(&plan.surface),
        ));
        kernels.push(KernelId::new(
            "entry/rsm",
            "surface",
            &constants(plan, true),
        ));
    }
    if plan.emitters {
        kernels.push(KernelId::new(
            "entry/emitters",
            "emitters",
            &emitter_constants(plan),
        ));
    }
    kernels
}

/// Records both kernels for each light's map, and that for the map of emitters.
pub(crate) fn record(
    recorder: &mut Recorder<'_>,
    scene: &WgpuRes<SceneData>,
    lights: &[Light],
    plan: &RsmPlan,
) -> Result<WgpuRes<Rsm>> {
    let context = recorder.context();
    let maps = planned(lights, plan, SceneData::bounds_of(&scene.head));
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
        let first = (index as u64 * side) as u32;
        if map.kind == map_kind::EMITTERS {
            let constants = emitter_constants(plan);
            let emitters = context.kernel("entry/emitters", "emitters", &constants)?;
            let params = EmitterParams {
                map: *map,
                size: plan.size,
                first,
                count: count as u32,
                points: scene.len("emitter") as u32,
            };
            bound.push(("emitter", scene.bind("emitter")));
            recorder.dispatch(&emitters, &params, &bound, Groups::Items(side))?;
            continue;
        }
        let params = Params {
            map: *map,
            nodes: scene.len("node") as u32,
            size: plan.size,
            first,
            count: count as u32,
        };
        recorder.dispatch(&visibility, &params, &bound, Groups::Items(side))?;
        recorder.dispatch(&surface, &params, &bound, Groups::Items(side))?;
    }
    Ok(made)
}

#[cfg(test)]
mod tests {
    use super::{EmitterParams, Params};
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
        twins!(
            "entry/emitters",
            "Params",
            EmitterParams {
                map,
                size,
                first,
                count,
                points
            }
        );
    }
}
