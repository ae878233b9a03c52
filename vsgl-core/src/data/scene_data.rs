//! The scene as the phases read it.

use super::columns::{Element, Scalar, columns};
use crate::geom::BvhNode;

/// Texture index of a material without texture.
pub const NO_TEXTURE: u32 = u32::MAX;

columns! {
    /// Triangles in the order of the bounding volume hierarchy, with everything that shading them needs.
    ///
    /// A triangle's id is its index here.
    pub struct SceneData = "scene" {
        head {
            /// Bits of the f32 by which ray origins are lifted off surfaces \[m\].
            lift_bits,
        }
        /// Bounding volume hierarchy, root first; empty without triangles.
        node: BvhNode,
        /// Corners of each triangle, three after three \[m\].
        corner: [f32; 9],
        /// Shading normals at the corners.
        corner_normal: [f32; 9],
        /// Texture coordinates at the corners. Empty without textures.
        corner_texcoord: [f32; 6],
        /// Material of each triangle.
        triangle_material: u32,
        /// Materials.
        material: MaterialRecord,
        /// Textures: records of four integers. Empty without textures.
        texture: TextureRecord,
        /// Texels of all textures, red in the lowest byte. Empty without textures.
        texel: u32,
        /// Linear value of each of the 256 sRGB codes. Empty without textures.
        srgb: f32,
    }
}

impl SceneData {
    /// Distance by which ray origins are lifted off surfaces \[m\].
    pub fn lift(&self) -> f32 {
        f32::from_bits(self.lift_bits)
    }
}

/// A material, ready to be evaluated.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct MaterialRecord {
    /// Linear base colour.
    pub base_color: [f32; 3],
    /// Metallic factor.
    pub metallic: f32,
    /// Dielectric reflectance at normal incidence.
    pub dielectric_f0: [f32; 3],
    /// Dielectric reflectance at grazing incidence.
    pub dielectric_f90: f32,
    /// Perceptual roughness factor.
    pub roughness: f32,
    /// Bits of the index of the base colour texture, or [`NO_TEXTURE`].
    pub base_color_texture: u32,
    /// Bits of the index of the metallic-roughness texture, or [`NO_TEXTURE`].
    pub metallic_roughness_texture: u32,
    /// Zero.
    pub padding: u32,
}

/// Where a texture's texels lie, and how it is read.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct TextureRecord {
    /// Index of the first texel.
    pub first: u32,
    /// Width in texels.
    pub width: u32,
    /// Height in texels.
    pub height: u32,
    /// Bits 0-1 wrap along u, 2-3 along v (0 repeat, 1 mirror, 2 clamp); bit 4: nearest texel.
    pub mode: u32,
}

impl Element for MaterialRecord {
    const SCALAR: Scalar = Scalar::U32;
}
impl Element for TextureRecord {
    const SCALAR: Scalar = Scalar::U32;
}
