//! Materials in the metallic-roughness model of glTF 2.0, with `KHR_materials_specular` and `KHR_materials_ior`.

/// A surface. Both sides reflect alike.
///
/// The model is glTF 2.0 appendix B: GGX with height-correlated Smith masking, Schlick's Fresnel term, and a Lambert
/// part for what a dielectric does not reflect.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// A name for messages.
    pub name: String,
    /// Linear base colour, multiplied by the texture's where there is one. 0..=1.
    pub base_color: [f32; 3],
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
    /// sRGB texture of the base colour.
    pub base_color_texture: Option<TextureRef>,
    /// Linear texture: green roughness, blue metallic.
    pub metallic_roughness_texture: Option<TextureRef>,
}

impl Default for Material {
    /// The default material of glTF: white, metallic 1, roughness 1.
    fn default() -> Self {
        Self {
            name: "default".into(),
            base_color: [1.0; 3],
            metallic: 1.0,
            roughness: 1.0,
            specular: 1.0,
            specular_color: [1.0; 3],
            ior: 1.5,
            base_color_texture: None,
            metallic_roughness_texture: None,
        }
    }
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

    /// Reflectance of the dielectric at normal incidence, and at grazing incidence.
    pub fn dielectric_fresnel(&self) -> ([f32; 3], f32) {
        let ratio = (self.ior - 1.0) / (self.ior + 1.0);
        let f0 = self
            .specular_color
            .map(|c| (ratio * ratio * c).min(1.0) * self.specular);
        (f0, self.specular)
    }

    /// Whether anything but a Lambert reflection can come from this surface.
    pub fn is_glossy(&self) -> bool {
        self.metallic > 0.0 || self.specular > 0.0
    }
}

/// Which image a material reads, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextureRef {
    /// Index into [`super::Scene::textures`].
    pub texture: u32,
    /// What happens outside 0..1, along u and v.
    pub wrap: [Wrap; 2],
    /// How values between texels are made.
    pub filter: Filter,
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
