//! What the camera sees as a reflective shadow map of its own.

use super::flag;
use crate::kernel::{Constant, KernelId};
use crate::recorder::{Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{GBuffer, MapRecord, Rsm};
use vsgl_core::phase::camera_map::{map, side};
use vsgl_core::plan::ClusterPlan;
use vsgl_core::render::View;

/// Twin of `Params` in `entry/camera_map.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    map: MapRecord,
    side: u32,
    width: u32,
    height: u32,
    padding: u32,
}

fn constants(plan: &ClusterPlan) -> [Constant; 2] {
    [
        ("GLOSSY", flag(plan.glossy)),
        ("ANISOTROPY", flag(plan.anisotropic)),
    ]
}

/// The pipeline that a plan needs.
pub(super) fn kernel(plan: &ClusterPlan) -> KernelId {
    KernelId::new("entry/camera_map", "camera_map", &constants(plan))
}

/// Records the map.
pub(super) fn record(
    recorder: &mut Recorder<'_>,
    gbuffer: &WgpuRes<GBuffer>,
    view: &View,
    plan: &ClusterPlan,
) -> Result<WgpuRes<Rsm>> {
    let context = recorder.context();
    let [width, height] = gbuffer.head[..] else {
        return Err(context.error("a G-buffer without its size", "report it"));
    };
    let side = side(width, height);
    let count = u64::from(side) * u64::from(side);
    let if_so = |yes: bool| if yes { count } else { 0 };
    let made = WgpuRes::<Rsm>::new(
        context,
        vec![side, 1],
        &[
            ("map", size_of::<MapRecord>() as u64, 1),
            ("triangle", 4, count),
            ("position", 16, count),
            ("normal", 16, count),
            ("diffuse", 16, count),
            ("specular", 16, if_so(plan.glossy)),
            ("grazing", 16, if_so(plan.glossy)),
            ("tangent", 16, if_so(plan.anisotropic)),
        ],
    )?;
    let params = Params {
        map: map(view, side),
        side,
        width,
        height,
        padding: 0,
    };
    let bound = [
        ("triangle", gbuffer.bind("triangle")),
        ("receiver", gbuffer.bind("position")),
        ("grazing", gbuffer.bind("grazing")),
        ("triangle_out", made.bind("triangle")),
        ("texel_out", made.bind("position")),
        ("map_out", made.bind("map")),
    ];
    let kernel = context.kernel("entry/camera_map", "camera_map", &constants(plan))?;
    recorder.dispatch(&kernel, &params, &bound, Groups::Items(count))?;
    Ok(made)
}

#[cfg(test)]
mod tests {
    use super::Params;
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/camera_map",
            "Params",
            Params {
                map,
                side,
                width,
                height,
                padding
            }
        );
    }
}
