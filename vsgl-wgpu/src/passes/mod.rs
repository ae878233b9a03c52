//! One file a phase: what its kernels bind, and in which order they run. Everything is recorded into the caller's encoder.

mod camera_map;
pub(crate) mod cluster;
pub(crate) mod export;
mod filtered;
pub(crate) mod gbuffer;
pub(crate) mod import;
mod importance;
mod nearest;
pub(crate) mod occlusion;
mod partition;
pub(crate) mod path;
pub(crate) mod pdf;
pub(crate) mod reconstruct;
pub(crate) mod resolve;
pub(crate) mod rsm;
mod sampled;
pub(crate) mod shade;
mod sort;
mod whole;

pub(crate) use sort::SORT_BLOCK;

use crate::kernel::{Constant, KernelId};
use crate::recorder::Binding;
use crate::res::WgpuRes;
use vsgl_core::data::SceneData;
use vsgl_core::plan::{Plan, SurfacePlan};

/// Every pipeline that a plan needs.
pub fn kernels(plan: &Plan) -> Vec<KernelId> {
    let mut kernels = gbuffer::kernels(&plan.gbuffer);
    kernels.extend(plan.path.iter().flat_map(path::kernels));
    let mut clusters = false;
    if let Some(bounce) = &plan.bounce {
        kernels.extend(rsm::kernels(&bounce.rsm));
        kernels.extend(bounce.pdf.iter().flat_map(pdf::kernels));
        kernels.extend(bounce.cluster.iter().flat_map(cluster::kernels));
        kernels.extend(bounce.occlusion.iter().flat_map(occlusion::kernels));
        clusters = bounce.cluster.is_some();
    }
    kernels.extend(shade::kernels(&plan.shade, clusters));
    kernels.extend(plan.reconstruct.iter().flat_map(reconstruct::kernels));
    kernels.extend(resolve::kernels(plan));
    kernels
}

/// A `bool` as an `override` constant.
fn flag(value: bool) -> f64 {
    f64::from(u8::from(value))
}

/// Whether rays pass where alpha masks leave surfaces out, as a constant of `phase/mask.wgsl`.
fn masks(plan: &SurfacePlan) -> [Constant; 1] {
    [("MASKS", flag(plan.masks))]
}

/// What is read of surfaces, as constants of `phase/surface.wgsl`; without what reads textures where a plan made by hand asks for
/// some that the scene has not.
fn surface_constants(plan: &SurfacePlan, textures: bool) -> [Constant; 5] {
    [
        ("TEXTURES", flag(plan.textures && textures)),
        ("NORMAL_MAPS", flag(plan.normal_maps && textures)),
        ("COLORS", flag(plan.colors)),
        ("UNLIT_ONES", flag(plan.unlit)),
        ("ANISOTROPY", flag(plan.anisotropy)),
    ]
}

/// The columns of a scene that are words, under the names that shaders bind them by.
fn words(scene: &WgpuRes<SceneData>) -> [(&'static str, Binding<'_>); 2] {
    [("texels", scene.bind("texel")), ("columns", scene.layout())]
}

/// The columns of a scene, under the names that shaders bind them by.
fn scene_columns(scene: &WgpuRes<SceneData>) -> Vec<(&'static str, Binding<'_>)> {
    let mut bound = ["node", "corner", "corner_normal"]
        .map(|name| (name, scene.bind(name)))
        .to_vec();
    bound.extend(words(scene));
    bound
}
