//! Materials in the metallic-roughness model of glTF 2.0 with its extensions for specular reflection, index of refraction,
//! anisotropy, strength of emission and surfaces without light.

use glam::Affine2;

/// A surface. Both sides reflect alike; a single-sided one shines from its front only.
///
/// The model is glTF 2.0 appendix B: GGX with height-correlated Smith masking, Schlick's Fresnel term, and a Lambert
/// part for what a dielectric does not reflect.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// A name for messages.
    pub name: String,
    /// Linear base colour, multiplied by the texture's where there is one, and by the vertices'. 0..=1.
    pub base_color: [f32; 3],
    /// Opacity 0..=1, multiplied by that of the base colour's texture and of the vertices. Matters where there is an
    /// [`alpha_cutoff`](Self::alpha_cutoff).
    pub alpha: f32,
    /// Where the opacity is less, there is no surface. None: the surface is opaque.
    pub alpha_cutoff: Option<f32>,
    /// 0 dielectric .. 1 metal, multiplied by the texture's blue channel.
    pub metallic: f32,
    /// Perceptual roughness 0..=1, multiplied by the texture's green channel; GGX `alpha` is its square.
    pub roughness: f32,
    /// Strength of the dielectric specular reflection (`KHR_materials_specular`), 0..=1. 0 is pure Lambert.
    pub specular: f32,
    /// Colour of the dielectric reflection at normal incidence, linear, each at least 0.
    pub specular_color: [f32; 3],
    /// Index of refraction, at least 1 (`KHR_materials_ior`); 1.5 gives the usual 0.04 at normal incidence.
    pub ior: f32,
    /// Radiance that the surface sends in all directions, red, green, blue, each at least 0 \[W/(m² sr)\]. Multiplied by the
    /// texture's where there is one.
    pub emission: [f32; 3],
    /// Whether the surface shines from both sides; from its front only, if not. Its front is where its corners run
    /// counterclockwise.
    pub double_sided: bool,
    /// Shows its base colour as radiance \[W/(m² sr)\] and reflects nothing (`KHR_materials_unlit`).
    pub unlit: bool,
    /// By how much x and y of the normal map are multiplied.
    pub normal_scale: f32,
    /// Stretch of the specular lobe along the direction of anisotropy, 0..=1 (`KHR_materials_anisotropy`).
    pub anisotropy: f32,
    /// Angle of that direction against the tangent, counterclockwise \[rad\].
    pub anisotropy_rotation: f32,
    /// sRGB texture of the base colour; alpha is the opacity.
    pub base_color_texture: Option<TextureRef>,
    /// Linear texture: green roughness, blue metallic.
    pub metallic_roughness_texture: Option<TextureRef>,
    /// Linear texture of normals in tangent space, -1..=1 as 0..=1.
    pub normal_texture: Option<TextureRef>,
    /// sRGB texture of the emission.
    pub emissive_texture: Option<TextureRef>,
    /// Linear texture: alpha multiplies [`specular`](Self::specular).
    pub specular_texture: Option<TextureRef>,
    /// sRGB texture of [`specular_color`](Self::specular_color).
    pub specular_color_texture: Option<TextureRef>,
    /// Linear texture: red and green the direction of anisotropy, -1..=1 as 0..=1, blue its strength.
    pub anisotropy_texture: Option<TextureRef>,
}

impl Default for Material {
    /// The default material of glTF: white, metallic 1, roughness 1.
    fn default() -> Self {
        Self {
            name: "default".into(),
            base_color: [1.0; 3],
            alpha: 1.0,
            alpha_cutoff: None,
            metallic: 1.0,
            roughness: 1.0,
            specular: 1.0,
            specular_color: [1.0; 3],
            ior: 1.5,
            emission: [0.0; 3],
            double_sided: false,
            unlit: false,
            normal_scale: 1.0,
            anisotropy: 0.0,
            anisotropy_rotation: 0.0,
            base_color_texture: None,
            metallic_roughness_texture: None,
            normal_texture: None,
            emissive_texture: None,
            specular_texture: None,
            specular_color_texture: None,
            anisotropy_texture: None,
        }
    }
}

/// What a material reads a texture for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Slot {
    /// [`Material::base_color_texture`].
    BaseColor,
    /// [`Material::metallic_roughness_texture`].
    MetallicRoughness,
    /// [`Material::normal_texture`].
    Normal,
    /// [`Material::emissive_texture`].
    Emissive,
    /// [`Material::specular_texture`].
    Specular,
    /// [`Material::specular_color_texture`].
    SpecularColor,
    /// [`Material::anisotropy_texture`].
    Anisotropy,
}

impl Slot {
    /// All of them, in the order of the fields.
    pub const ALL: [Self; 7] = [
        Self::BaseColor,
        Self::MetallicRoughness,
        Self::Normal,
        Self::Emissive,
        Self::Specular,
        Self::SpecularColor,
        Self::Anisotropy,
    ];
}

impl Material {
    /// A pure Lambert surface.
    pub fn lambert(name: &str, base_color: [f32; 3]) -> Self {
        Self {
            name: name.into(),
            base_color,
            metallic: 0.0,
            specular: 0.0,
            ..Self::default()
        }
    }

    /// A metal of the given perceptual roughness.
    pub fn metal(name: &str, base_color: [f32; 3], roughness: f32) -> Self {
        Self {
            name: name.into(),
            base_color,
            metallic: 1.0,
            roughness,
            ..Self::default()
        }
    }

    /// A dielectric with a specular reflection on a Lambert base.
    pub fn dielectric(name: &str, base_color: [f32; 3], roughness: f32) -> Self {
        Self {
            name: name.into(),
            base_color,
            metallic: 0.0,
            roughness,
            ..Self::default()
        }
    }

    /// The texture that is read for something.
    pub fn texture(&self, slot: Slot) -> Option<TextureRef> {
        match slot {
            Slot::BaseColor => self.base_color_texture,
            Slot::MetallicRoughness => self.metallic_roughness_texture,
            Slot::Normal => self.normal_texture,
            Slot::Emissive => self.emissive_texture,
            Slot::Specular => self.specular_texture,
            Slot::SpecularColor => self.specular_color_texture,
            Slot::Anisotropy => self.anisotropy_texture,
        }
    }

    /// Reflectance at normal incidence of a dielectric of full [`specular`](Self::specular) strength, not yet limited to 1.
    pub fn reflectance(&self) -> [f32; 3] {
        let ratio = (self.ior - 1.0) / (self.ior + 1.0);
        self.specular_color.map(|c| ratio * ratio * c)
    }

    /// Reflectance of the dielectric at normal incidence, and at grazing incidence, without textures.
    pub fn dielectric_fresnel(&self) -> ([f32; 3], f32) {
        let f0 = self.reflectance().map(|c| c.min(1.0) * self.specular);
        (f0, self.specular)
    }

    /// Whether the surface may be left out anywhere: `colors` says whether vertices have an opacity too.
    pub fn is_masked(&self, colors: bool) -> bool {
        let varies = colors || self.base_color_texture.is_some();
        self.alpha_cutoff
            .is_some_and(|cutoff| cutoff > 0.0 && (varies || self.alpha < cutoff))
    }

    /// Whether anything but a Lambert reflection can come from this surface.
    pub fn is_glossy(&self) -> bool {
        self.metallic > 0.0 || self.specular > 0.0
    }
}

/// Which image a material reads, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureRef {
    /// Index into [`super::Scene::textures`].
    pub texture: u32,
    /// What happens outside 0..1, along u and v.
    pub wrap: [Wrap; 2],
    /// How values between texels are made.
    pub filter: Filter,
    /// Whether smaller images of the texture stand in where many texels fall into one pixel.
    pub mips: bool,
    /// 0: [`super::Mesh::texcoords`], 1: [`super::Mesh::texcoords_second`].
    pub set: u32,
    /// From texture coordinates of the mesh to those of the image (`KHR_texture_transform`).
    pub transform: Affine2,
}

impl TextureRef {
    /// The first set of coordinates as it is, tiled, interpolated, with smaller images.
    pub fn new(texture: u32) -> Self {
        Self {
            texture,
            wrap: [Wrap::Repeat; 2],
            filter: Filter::Linear,
            mips: true,
            set: 0,
            transform: Affine2::IDENTITY,
        }
    }
}

/// Continuation of a texture outside its square.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// Tiles.
    #[default]
    Repeat,
    /// Tiles, every second one mirrored.
    Mirror,
    /// The edge texel goes on.
    Clamp,
}

/// Reconstruction between texel centres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// Bilinear.
    #[default]
    Linear,
    /// The nearest texel.
    Nearest,
}

/// An 8-bit image, row-major from the top left, as it was stored (sRGB or linear is the reader's matter).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Texture {
    /// Width in texels, at least 1.
    pub width: u32,
    /// Height in texels, at least 1.
    pub height: u32,
    /// Red, green, blue, alpha.
    pub texels: Vec<[u8; 4]>,
}
