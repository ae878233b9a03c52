//! Surfaces.

use super::document::{Document, lookup};
use super::fault::{Fault, Result};
use super::warnings::Warnings;
use crate::scene::{Filter, Material, TextureRef, Wrap};
use glam::Vec2;
use gltf::json;
use gltf::json::extensions::texture::TextureTransform;
use gltf::json::material::AlphaMode;
use gltf::json::texture::{Info, MagFilter, Sampler, WrappingMode};
use gltf::json::validation::Checked;
use std::collections::HashMap;

/// Materials that primitives use, in the order of their first use.
pub(super) struct Materials<'a> {
    document: &'a Document,
    materials: Vec<Material>,
    mappings: Vec<Option<Mapping>>,
    /// Index of a material of the file (none: the default material) to its place here.
    places: HashMap<Option<usize>, u32>,
    images: Vec<usize>,
    image_places: HashMap<usize, u32>,
}

/// Which texture coordinates a material reads, and how they are transformed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mapping {
    /// Number of the set: `TEXCOORD_n`.
    pub(super) set: u32,
    scale: Vec2,
    /// Sine and cosine of the rotation.
    turn: Vec2,
    offset: Vec2,
}

impl Mapping {
    fn of(info: &Info) -> Self {
        let transform = info
            .extensions
            .as_ref()
            .and_then(|e| e.texture_transform.clone());
        let TextureTransform {
            offset,
            rotation,
            scale,
            tex_coord,
            ..
        } = transform.unwrap_or_default();
        Self {
            set: tex_coord.unwrap_or(info.tex_coord),
            scale: scale.0.into(),
            turn: Vec2::from(rotation.0.sin_cos()),
            offset: offset.0.into(),
        }
    }

    /// Scaled, turned counterclockwise as seen with v downwards, moved.
    ///
    /// Source: Khronos Group, `KHR_texture_transform`, properties `scale`, `rotation`, `offset`.
    pub(super) fn apply(&self, texcoord: Vec2) -> Vec2 {
        let Vec2 { x: u, y: v } = texcoord * self.scale;
        let Vec2 { x: sin, y: cos } = self.turn;
        Vec2::new(cos * u + sin * v, cos * v - sin * u) + self.offset
    }
}

impl<'a> Materials<'a> {
    pub(super) fn new(document: &'a Document) -> Self {
        Self {
            document,
            materials: Vec::new(),
            mappings: Vec::new(),
            places: HashMap::new(),
            images: Vec::new(),
            image_places: HashMap::new(),
        }
    }

    /// The place of a material, read if it is new, and the texture coordinates that it needs. `place` is the JSON
    /// path of the primitive.
    pub(super) fn intern(
        &mut self,
        index: Option<json::Index<json::Material>>,
        place: &str,
        warnings: &mut Warnings,
    ) -> Result<(u32, Option<Mapping>)> {
        let key = index.map(|i| i.value());
        if let Some(&known) = self.places.get(&key) {
            return Ok((known, self.mappings[known as usize].clone()));
        }
        let (material, mapping) = match key {
            Some(index) => {
                let at = || format!("{place}.material");
                let material = lookup(&self.document.root.materials, "materials", index, at)?;
                self.read(material, index, warnings)?
            }
            None => (Material::default(), None),
        };
        let new = self.materials.len() as u32;
        self.materials.push(material);
        self.mappings.push(mapping.clone());
        self.places.insert(key, new);
        Ok((new, mapping))
    }

    /// The materials, and the images of the file that their textures are.
    pub(super) fn finish(self) -> (Vec<Material>, Vec<usize>) {
        (self.materials, self.images)
    }

    fn read(
        &mut self,
        source: &json::Material,
        index: usize,
        warnings: &mut Warnings,
    ) -> Result<(Material, Option<Mapping>)> {
        let place = format!("materials[{index}]");
        note_ignored(source, warnings);
        let mut material = factors(source, index, &place)?;
        let pbr = &source.pbr_metallic_roughness;
        let at = |slot| format!("{place}.pbrMetallicRoughness.{slot}");
        let mut mapping = None;
        if let Some(info) = &pbr.base_color_texture {
            material.base_color_texture = self.texture(info, &at("baseColorTexture"), warnings)?;
            mapping = material.base_color_texture.map(|_| Mapping::of(info));
        }
        if let Some(info) = &pbr.metallic_roughness_texture {
            material.metallic_roughness_texture =
                self.texture(info, &at("metallicRoughnessTexture"), warnings)?;
            let own = material
                .metallic_roughness_texture
                .map(|_| Mapping::of(info));
            if mapping.is_some() && own.is_some() && mapping != own {
                warnings.add(
                    "metallic-roughness textures with coordinates of their own take those of the base colour",
                );
            }
            mapping = mapping.or(own);
        }
        Ok((material, mapping))
    }

    fn texture(
        &mut self,
        info: &Info,
        place: &str,
        warnings: &mut Warnings,
    ) -> Result<Option<TextureRef>> {
        let root = &self.document.root;
        let index = info.index.value();
        let texture = lookup(&root.textures, "textures", index, || {
            format!("{place}.index")
        })?;
        let source = texture.source.value();
        // The parser's sign for "no source".
        if source == u32::MAX as usize {
            warnings.add("textures without a PNG or JPEG image are left out");
            return Ok(None);
        }
        lookup(&root.images, "images", source, || {
            format!("textures[{index}].source")
        })?;
        let sampler = match texture.sampler {
            Some(sampler) => {
                let at = || format!("textures[{index}].sampler");
                lookup(&root.samplers, "samplers", sampler.value(), at)?.clone()
            }
            None => Sampler::default(),
        };
        let images = &mut self.images;
        let image = *self.image_places.entry(source).or_insert_with(|| {
            images.push(source);
            (images.len() - 1) as u32
        });
        Ok(Some(TextureRef {
            texture: image,
            wrap: [wrap(sampler.wrap_s), wrap(sampler.wrap_t)],
            filter: match sampler.mag_filter {
                Some(Checked::Valid(MagFilter::Nearest)) => Filter::Nearest,
                _ => Filter::Linear,
            },
        }))
    }
}

fn wrap(mode: Checked<WrappingMode>) -> Wrap {
    match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    }
}

/// Everything but textures.
fn factors(source: &json::Material, index: usize, place: &str) -> Result<Material> {
    let pbr = &source.pbr_metallic_roughness;
    let extensions = source.extensions.as_ref();
    let specular = extensions
        .and_then(|e| e.specular.clone())
        .unwrap_or_default();
    let ior = extensions
        .and_then(|e| e.ior.clone())
        .unwrap_or_default()
        .ior
        .0;
    let [r, g, b, _] = pbr.base_color_factor.0;
    let number = |name: &str, value: f32, most: f32| {
        if value.is_finite() {
            return Ok(value.clamp(0.0, most));
        }
        Err(Fault::new(
            format!("{place}.{name}"),
            format!("{value} is no number"),
            "the file is broken; export it again",
        ))
    };
    let color = |name: &str, [r, g, b]: [f32; 3], most: f32| -> Result<[f32; 3]> {
        Ok([
            number(name, r, most)?,
            number(name, g, most)?,
            number(name, b, most)?,
        ])
    };
    Ok(Material {
        name: source
            .name
            .clone()
            .unwrap_or_else(|| format!("material {index}")),
        base_color: color("baseColorFactor", [r, g, b], 1.0)?,
        metallic: number("metallicFactor", pbr.metallic_factor.0, 1.0)?,
        roughness: number("roughnessFactor", pbr.roughness_factor.0, 1.0)?,
        specular: number("specularFactor", specular.specular_factor.0, 1.0)?,
        specular_color: color(
            "specularColorFactor",
            specular.specular_color_factor.0,
            f32::MAX,
        )?,
        ior: refraction(number("ior", ior, f32::MAX)?),
        base_color_texture: None,
        metallic_roughness_texture: None,
    })
}

/// Index of refraction. 0 stands for infinity, where everything is reflected: so large that f32 shows no difference.
///
/// Source: Khronos Group, `KHR_materials_ior`.
fn refraction(ior: f32) -> f32 {
    const LARGE: f32 = 1e9;
    if ior == 0.0 {
        LARGE
    } else {
        ior.clamp(1.0, LARGE)
    }
}

fn note_ignored(source: &json::Material, warnings: &mut Warnings) {
    match source.alpha_mode {
        Checked::Valid(AlphaMode::Opaque) => {}
        Checked::Valid(AlphaMode::Mask) => warnings.add("alpha masks are ignored: drawn opaque"),
        Checked::Valid(AlphaMode::Blend) => warnings.add("alpha blending is ignored: drawn opaque"),
        Checked::Invalid => warnings.add("unknown alpha modes are ignored"),
    }
    if source.normal_texture.is_some() {
        warnings.add("normal maps are ignored");
    }
    if source.emissive_factor.0 != [0.0; 3] {
        warnings.add("emission is ignored: surfaces do not shine");
    }
    let specular = source.extensions.as_ref().and_then(|e| e.specular.as_ref());
    if specular.is_some_and(|s| s.specular_texture.is_some() || s.specular_color_texture.is_some())
    {
        warnings.add("textures of KHR_materials_specular are ignored");
    }
}
