//! Shadow maps of the clusters.

use super::{flag, words};
use crate::context::is_software;
use crate::kernel::{Constant, KernelId};
use crate::recorder::{Binding, Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{Occlusion, SceneData, SpecularVsgl, Vsgls};
use vsgl_core::phase::{fill, run, splat};
use vsgl_core::plan::OcclusionPlan;

/// Points in one dispatch, about: as `passes/shade.rs` has it for pairs.
const POINTS_GPU: u64 = 1 << 26;
const POINTS_SOFTWARE: u64 = 1 << 22;

/// Triangles of a run that one invocation draws, about: with all texels that each may cover, fewer rounds of a shader's loops
/// than lavapipe runs.
const TRIANGLES: u32 = 8;
/// Bytes of a `Run` in a buffer.
const RUN_BYTES: u64 = 32;

/// Twin of `Params` in `entry/occlusion.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    maps: u32,
    side: u32,
    points: u32,
    stride: u32,
    lift: f32,
    specular_stride: u32,
    triangles: u32,
    level: u32,
    first: u32,
    draws: u32,
    parts: u32,
}

/// Invocations for the triangles of a run. Half of the shares go to all triangles alike, so that few runs are longer than twice
/// the mean; each invocation goes on until its run ends.
fn parts(triangles: u64, points: u32) -> u32 {
    let long = 2 * triangles / u64::from(points.max(1)) + 1;
    (long.min(u64::from(run::RUN_MAX)) as u32).div_ceil(TRIANGLES)
}

fn constants(plan: &OcclusionPlan) -> [Constant; 1] {
    [("MASKS", flag(plan.masks))]
}

/// The kernel that draws.
fn drawing(plan: &OcclusionPlan) -> &'static str {
    if plan.tessellated { "pieces" } else { "points" }
}

/// The pipelines that a plan needs.
pub(crate) fn kernels(plan: &OcclusionPlan) -> Vec<KernelId> {
    let kernel = |entry, constants: &[Constant]| KernelId::new("entry/occlusion", entry, constants);
    vec![
        kernel("empty", &[]),
        kernel("bundle", &[]),
        kernel("triangles", &constants(plan)),
        kernel(drawing(plan), &constants(plan)),
        kernel("pull", &[]),
        kernel("push", &[]),
    ]
}

/// Columns that have room for more maps than there may be.
const COUNTED: &[&str] = &["depth"];

/// Records the maps.
pub(crate) fn record(
    recorder: &mut Recorder<'_>,
    scene: &WgpuRes<SceneData>,
    vsgls: &WgpuRes<Vsgls>,
    plan: &OcclusionPlan,
) -> Result<WgpuRes<Occlusion>> {
    let context = recorder.context();
    let (maps, side) = (vsgls.len("target"), u64::from(plan.side));
    let specular_stride = if vsgls.len("specular") > 0 {
        size_of::<SpecularVsgl>() as u32 / 16
    } else {
        0
    };
    // An entry a map here, so that as many are brought to the host as there are clusters.
    let shapes = [("depth", 4 * side * side, maps)];
    let count = context.buffer("the number of shadow maps", 4)?;
    let smaller_texels = maps * u64::from(fill::before(plan.side, fill::LEVELS + 1));
    let smaller = context.buffer("smaller images of the shadow maps", 4 * smaller_texels)?;
    let made = WgpuRes::<Occlusion>::new(context, vec![maps as u32, plan.side], &shapes)?;
    let params = Params {
        maps: maps as u32,
        side: plan.side,
        points: plan.points,
        stride: splat::stride(plan.points),
        lift: f32::from_bits(scene.head[0]),
        specular_stride,
        triangles: scene.len("share") as u32,
        level: 0,
        first: 0,
        draws: 0,
        parts: parts(scene.len("share"), plan.points),
    };
    let runs = context.buffer(
        "runs of triangles",
        RUN_BYTES * u64::from(plan.points.max(1)),
    )?;
    let mut bound = vec![
        ("corner", scene.bind("corner")),
        ("share", scene.bind("share")),
        ("lights", vsgls.bind("diffuse")),
        ("clusters", Binding::Buffer(vsgls.count_buffer())),
        ("bits", made.bind("depth")),
        ("depth", made.bind("depth")),
        ("smaller", Binding::Buffer(&smaller)),
        ("count_out", Binding::Buffer(&count)),
        ("runs_out", Binding::Buffer(&runs)),
        ("runs", Binding::Buffer(&runs)),
    ];
    bound.extend(words(scene));
    let kernel =
        |entry, constants: &[Constant]| context.kernel("entry/occlusion", entry, constants);
    let texels = |level: u32| {
        let own = u64::from(fill::side(plan.side, level));
        Groups::Items(maps * own * own)
    };
    recorder.dispatch(&*kernel("empty", &[])?, &params, &bound, texels(0))?;
    let bundle = kernel("bundle", &[])?;
    recorder.dispatch(&bundle, &params, &bound, Groups::Items(plan.points.into()))?;
    let software = is_software(context.info());
    let most = if software {
        POINTS_SOFTWARE
    } else {
        POINTS_GPU
    };
    let ways = [("triangles", params.parts), (drawing(plan), 1)];
    for (entry, parts) in ways {
        let draw = kernel(entry, &constants(plan))?;
        let together = maps.max(1) * u64::from(parts);
        let draws = (most / together).clamp(1, u64::from(plan.points).max(1)) as u32;
        for first in (0..plan.points).step_by(draws as usize) {
            let params = Params {
                first,
                draws,
                ..params
            };
            let items = together * u64::from(draws);
            recorder.dispatch(&draw, &params, &bound, Groups::Items(items))?;
        }
    }
    let (pull, push) = (kernel("pull", &[])?, kernel("push", &[])?);
    for level in 1..=fill::LEVELS {
        let params = Params { level, ..params };
        recorder.dispatch(&pull, &params, &bound, texels(level))?;
    }
    for level in (0..fill::LEVELS).rev() {
        let params = Params { level, ..params };
        recorder.dispatch(&push, &params, &bound, texels(level))?;
    }
    drop(bound);
    Ok(made.counted(count, COUNTED))
}

#[cfg(test)]
mod tests {
    use super::Params;
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/occlusion",
            "Params",
            Params {
                maps,
                side,
                points,
                stride,
                lift,
                specular_stride,
                triangles,
                level,
                first,
                draws,
                parts
            }
        );
    }
}
