//! Parameters of dispatches, as shaders read them from uniform buffers. Twins of the structs in `shaders/data`.

use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::data::Columns;

/// Twin of `View` in `data/view.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct View {
    pub(crate) eye: [f32; 3],
    pub(crate) tan_half_fov: f32,
    pub(crate) forward: [f32; 3],
    pub(crate) width: u32,
    pub(crate) right: [f32; 3],
    pub(crate) height: u32,
    pub(crate) up: [f32; 3],
    pub(crate) aa: u32,
    pub(crate) stride: u32,
    pub(crate) samples_x: u32,
    pub(crate) samples_y: u32,
    pub(crate) padding: u32,
}

impl From<&vsgl_core::render::View> for View {
    fn from(view: &vsgl_core::render::View) -> Self {
        let camera = &view.camera;
        let (samples_x, samples_y) = view.samples();
        Self {
            eye: camera.eye.to_array(),
            tan_half_fov: camera.tan_half_fov,
            forward: camera.forward.to_array(),
            width: view.width,
            right: camera.right.to_array(),
            height: view.height,
            up: camera.up.to_array(),
            aa: view.aa,
            stride: view.stride,
            samples_x,
            samples_y,
            padding: 0,
        }
    }
}

/// Place of a column that a scene may lack, if it does.
pub(crate) const NO_WORDS: u32 = u32::MAX;

/// Twin of `TexelLayout` in `data/scene.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct TexelLayout {
    pub(crate) corner_texcoord: u32,
    pub(crate) corner_texcoord_second: u32,
    pub(crate) corner_tangent: u32,
    pub(crate) corner_color: u32,
    pub(crate) triangle_material: u32,
    pub(crate) material: u32,
    pub(crate) texture: u32,
    pub(crate) texel: u32,
    pub(crate) srgb: u32,
    pub(crate) rows: u32,
    pub(crate) padding: [u32; 2],
}

impl TexelLayout {
    /// Of a resource that has texels.
    pub(crate) fn of<T: Columns>(scene: &WgpuRes<T>) -> Self {
        let first = |column: &str| {
            if scene.len(column) > 0 {
                scene.first_word(column)
            } else {
                NO_WORDS
            }
        };
        Self {
            corner_texcoord: first("corner_texcoord"),
            corner_texcoord_second: first("corner_texcoord_second"),
            corner_tangent: first("corner_tangent"),
            corner_color: first("corner_color"),
            triangle_material: first("triangle_material"),
            material: first("material"),
            texture: first("texture"),
            texel: first("texel"),
            srgb: first("srgb"),
            rows: scene.texels().rows(),
            padding: [0; 2],
        }
    }
}
