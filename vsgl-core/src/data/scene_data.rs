//! The scene as the phases read it.

use super::columns::{Columns, Element, Scalar, columns};
use super::emitter::{EmitterRecord, LampRecord};
use crate::error::{Error, Result};
use crate::geom::{self, BvhNode};
use glam::Vec3;

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
            /// Bits of the least x of all vertices \[m\].
            low_x_bits,
            /// Bits of the least y.
            low_y_bits,
            /// Bits of the least z.
            low_z_bits,
            /// Bits of the greatest x.
            high_x_bits,
            /// Bits of the greatest y.
            high_y_bits,
            /// Bits of the greatest z.
            high_z_bits,
        }
        /// Bounding volume hierarchy, root first; empty without triangles.
        node: BvhNode,
        /// Corners of each triangle, three after three \[m\].
        corner: [f32; 9],
        /// For points drawn on surfaces: share of each triangle and all before it, in 2⁻³²; see `scene/shares.rs`.
        share: u32,
        /// Shading normals at the corners.
        corner_normal: [f32; 9],
        /// Texture coordinates at the corners. Empty where no texture reads them.
        corner_texcoord: [f32; 6],
        /// A second set of texture coordinates. Empty where no texture reads them.
        corner_texcoord_second: [f32; 6],
        /// Unit tangents with the sign of the bitangent, at the corners. Empty where no material reads them, or the scene has
        /// none.
        corner_tangent: [f32; 12],
        /// Linear colours with opacity, at the corners. Empty where the scene has none.
        corner_color: [f32; 12],
        /// Material of each triangle.
        triangle_material: u32,
        /// Materials.
        material: MaterialRecord,
        /// Uses of textures. Empty without textures.
        texture: TextureRecord,
        /// Texels of all textures, red in the lowest byte. Empty without textures.
        texel: u32,
        /// Linear value of each of the 256 sRGB codes. Empty without textures.
        srgb: f32,
        /// Points of the surfaces that shine. Empty where none does.
        emitter: EmitterRecord,
        /// The triangles that shine, in the order of their ids, without those that are dark. Empty where none does.
        lamp: LampRecord,
    }
}

impl SceneData {
    /// Refuses a scene with more than `most` triangles in one place: each ray there would test them all, and the picture
    /// would take thousands of times as long as it should.
    ///
    /// # Errors
    /// [`Error::Scene`] about `name`.
    pub fn check_overlap(&self, name: &str, most: u64) -> Result<()> {
        if geom::overlap(&self.node, most) <= most {
            return Ok(());
        }
        Err(Error::Scene {
            file: name.to_owned(),
            place: "scene".into(),
            problem: format!("more than {most} triangles lie in one place"),
            remedy: "remove the copies, or raise the limit `overlap`".into(),
        })
    }

    /// Distance by which ray origins are lifted off surfaces \[m\].
    pub fn lift(&self) -> f32 {
        f32::from_bits(self.lift_bits)
    }

    /// Smallest box around all vertices, as (least, greatest) corner \[m\].
    pub fn bounds(&self) -> (Vec3, Vec3) {
        Self::bounds_of(&self.head())
    }

    /// The same from the head alone; zero if it has too few numbers.
    pub fn bounds_of(head: &[u32]) -> (Vec3, Vec3) {
        let number = |i: usize| f32::from_bits(head.get(i).copied().unwrap_or_default());
        let corner = |first| Vec3::new(number(first), number(first + 1), number(first + 2));
        (corner(1), corner(4))
    }
}

/// [`MaterialRecord::flags`]: the surface shines from both sides.
pub const DOUBLE_SIDED: u32 = 1;
/// [`MaterialRecord::flags`]: the surface shows its base colour and reflects nothing.
pub const UNLIT: u32 = 2;

/// A material, ready to be evaluated. Textures are indices into [`SceneData::texture`], or [`NO_TEXTURE`].
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct MaterialRecord {
    /// Linear base colour.
    pub base_color: [f32; 3],
    /// Metallic factor.
    pub metallic: f32,
    /// Reflectance of the dielectric at normal incidence before its strength, not yet limited to 1.
    pub reflectance: [f32; 3],
    /// Strength of the dielectric reflection: its reflectance at grazing incidence.
    pub specular: f32,
    /// Perceptual roughness factor.
    pub roughness: f32,
    /// Opacity.
    pub alpha: f32,
    /// Where opacity is less, there is no surface; -1 where it is nowhere.
    pub alpha_cutoff: f32,
    /// [`DOUBLE_SIDED`] and [`UNLIT`].
    pub flags: u32,
    /// Radiance \[W/(m² sr)\].
    pub emission: [f32; 3],
    /// Factor of x and y of the normal map.
    pub normal_scale: f32,
    /// Strength of anisotropy.
    pub anisotropy: f32,
    /// Cosine of its angle against the tangent.
    pub anisotropy_cos: f32,
    /// Sine of it.
    pub anisotropy_sin: f32,
    /// Texture of the base colour.
    pub base_color_texture: u32,
    /// Texture of roughness and metallic.
    pub metallic_roughness_texture: u32,
    /// Normal map.
    pub normal_texture: u32,
    /// Texture of the emission.
    pub emissive_texture: u32,
    /// Texture of the strength of the dielectric reflection.
    pub specular_texture: u32,
    /// Texture of its colour.
    pub specular_color_texture: u32,
    /// Texture of anisotropy.
    pub anisotropy_texture: u32,
    /// Zero.
    pub padding: [u32; 2],
}

/// [`TextureRecord::mode`]: the nearest texel instead of a mean of four.
pub const NEAREST: u32 = 16;
/// [`TextureRecord::mode`]: there are smaller images.
pub const MIPS: u32 = 32;
/// [`TextureRecord::mode`]: the second set of texture coordinates.
pub const SECOND_SET: u32 = 64;

/// Where a texture's texels lie, and how it is read.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct TextureRecord {
    /// Index of the first texel.
    pub first: u32,
    /// Width in texels.
    pub width: u32,
    /// Height in texels.
    pub height: u32,
    /// Bits 0-1 wrap along u, 2-3 along v (0 repeat, 1 mirror, 2 clamp); [`NEAREST`], [`MIPS`], [`SECOND_SET`].
    pub mode: u32,
    /// From texture coordinates of the mesh to u of the image: factor of u, factor of v, what is added.
    pub to_u: [f32; 3],
    /// Index of the first texel of the first smaller image; the others follow it.
    pub smaller: u32,
    /// The same to v.
    pub to_v: [f32; 3],
    /// How many images there are, the full one included.
    pub levels: u32,
}

impl Element for MaterialRecord {
    const SCALAR: Scalar = Scalar::U32;
}
impl Element for TextureRecord {
    const SCALAR: Scalar = Scalar::U32;
}
