//! Surfaces.

use super::document::{Document, lookup};
use super::fault::{Fault, Result, printable};
use super::textures::{Sets, Textures, Use};
use super::warnings::Warnings;
use crate::scene::Material;
use gltf::json;
use gltf::json::material::AlphaMode;
use gltf::json::texture::Info;
use gltf::json::validation::Checked;
use std::collections::HashMap;

/// Materials that primitives use, in the order of their first use.
pub(super) struct Materials<'a> {
    document: &'a Document,
    materials: Vec<Material>,
    needs: Vec<Needs>,
    /// Index of a material of the file (none: the default material) to its place here.
    places: HashMap<Option<usize>, u32>,
    textures: Textures<'a>,
}

/// What a material reads of a vertex besides position, normal and colour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Needs {
    /// Numbers `n` of the sets `TEXCOORD_n` that [`Mesh::texcoords`](crate::scene::Mesh::texcoords) and
    /// [`Mesh::texcoords_second`](crate::scene::Mesh::texcoords_second) are.
    pub(super) sets: [Option<u32>; 2],
    /// Tangents, along the set with this place in [`sets`](Self::sets).
    pub(super) tangents: Option<u32>,
}

impl<'a> Materials<'a> {
    pub(super) fn new(document: &'a Document) -> Self {
        Self {
            document,
            materials: Vec::new(),
            needs: Vec::new(),
            places: HashMap::new(),
            textures: Textures::new(document),
        }
    }

    /// The place of a material, read if it is new, and what it needs. `place` is the JSON path of the primitive.
    pub(super) fn intern(
        &mut self,
        index: Option<json::Index<json::Material>>,
        place: &str,
        warnings: &mut Warnings,
    ) -> Result<(u32, Needs)> {
        let key = index.map(|i| i.value());
        if let Some(&known) = self.places.get(&key) {
            return Ok((known, self.needs[known as usize]));
        }
        let (material, needs) = match key {
            Some(index) => {
                let at = || format!("{place}.material");
                let material = lookup(&self.document.root.materials, "materials", index, at)?;
                self.read(material, index, warnings)?
            }
            None => (Material::default(), Needs::default()),
        };
        let new = self.materials.len() as u32;
        self.materials.push(material);
        self.needs.push(needs);
        self.places.insert(key, new);
        Ok((new, needs))
    }

    /// The materials, and the images of the file that their textures are.
    pub(super) fn finish(self) -> (Vec<Material>, Vec<usize>) {
        (self.materials, self.textures.into_images())
    }

    fn read(
        &mut self,
        source: &json::Material,
        index: usize,
        warnings: &mut Warnings,
    ) -> Result<(Material, Needs)> {
        let place = format!("materials[{index}]");
        note_ignored(source, warnings);
        let anisotropy = Anisotropy::of(source, &place)?;
        let mut material = factors(source, &anisotropy, index, &place)?;
        let mut sets = Sets::default();
        let mut texture = |info: Option<&Info>, slot: &str| match info {
            Some(info) => {
                let place = format!("{place}.{slot}");
                self.textures
                    .read(&info.into(), &mut sets, &place, warnings)
            }
            None => Ok(None),
        };
        let pbr = &source.pbr_metallic_roughness;
        let specular = source.extensions.as_ref().and_then(|e| e.specular.as_ref());
        material.base_color_texture = texture(
            pbr.base_color_texture.as_ref(),
            "pbrMetallicRoughness.baseColorTexture",
        )?;
        material.metallic_roughness_texture = texture(
            pbr.metallic_roughness_texture.as_ref(),
            "pbrMetallicRoughness.metallicRoughnessTexture",
        )?;
        material.emissive_texture = texture(source.emissive_texture.as_ref(), "emissiveTexture")?;
        material.specular_texture = texture(
            specular.and_then(|s| s.specular_texture.as_ref()),
            "extensions.KHR_materials_specular.specularTexture",
        )?;
        material.specular_color_texture = texture(
            specular.and_then(|s| s.specular_color_texture.as_ref()),
            "extensions.KHR_materials_specular.specularColorTexture",
        )?;
        material.anisotropy_texture = texture(
            anisotropy.texture.as_ref(),
            "extensions.KHR_materials_anisotropy.anisotropyTexture",
        )?;
        if let Some(info) = &source.normal_texture {
            let place = format!("{place}.normalTexture");
            let used = Use::of_normal(info, &place)?;
            material.normal_texture = self.textures.read(&used, &mut sets, &place, warnings)?;
        }
        let along = material.normal_texture.or(material.anisotropy_texture);
        let tangents = match along {
            Some(texture) => Some(texture.set),
            None => (material.anisotropy > 0.0).then_some(0),
        };
        if tangents.is_some() {
            // Tangents alone need coordinates too, even if no texture does.
            sets.0[0].get_or_insert(0);
        }
        let needs = Needs {
            sets: sets.0,
            tangents,
        };
        Ok((material, needs))
    }
}

/// `KHR_materials_anisotropy`, which the parser leaves as it is.
#[derive(Default)]
struct Anisotropy {
    strength: f32,
    rotation: f32,
    texture: Option<Info>,
}

impl Anisotropy {
    fn of(source: &json::Material, place: &str) -> Result<Self> {
        const NAME: &str = "KHR_materials_anisotropy";
        let others = source.extensions.as_ref().map(|e| &e.others);
        let Some(value) = others.and_then(|others| others.get(NAME)) else {
            return Ok(Self::default());
        };
        let broken = || {
            let place = format!("{place}.extensions.{NAME}");
            Fault::new(place, "is not what the extension says", BROKEN)
        };
        let number = |name: &str| match value.get(name) {
            None => Ok(0.0),
            Some(number) => number.as_f64().map(|n| n as f32).ok_or_else(broken),
        };
        let texture = value.get("anisotropyTexture").cloned();
        Ok(Self {
            strength: number("anisotropyStrength")?,
            rotation: number("anisotropyRotation")?,
            texture: texture
                .map(json::deserialize::from_value)
                .transpose()
                .map_err(|_| broken())?,
        })
    }
}

/// Everything but textures.
fn factors(
    source: &json::Material,
    anisotropy: &Anisotropy,
    index: usize,
    place: &str,
) -> Result<Material> {
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
    let strength = extensions
        .and_then(|e| e.emissive_strength.clone())
        .unwrap_or_default()
        .emissive_strength
        .0;
    let [r, g, b, alpha] = pbr.base_color_factor.0;
    let range = |name: &str, value: f32, least: f32, most: f32| {
        if value.is_finite() {
            return Ok(value.clamp(least, most));
        }
        Err(Fault::new(
            format!("{place}.{name}"),
            format!("{value} is no number"),
            BROKEN,
        ))
    };
    let number = |name: &str, value: f32, most: f32| range(name, value, 0.0, most);
    let color = |name: &str, [r, g, b]: [f32; 3], most: f32| -> Result<[f32; 3]> {
        Ok([
            number(name, r, most)?,
            number(name, g, most)?,
            number(name, b, most)?,
        ])
    };
    let strength = number("emissiveStrength", strength, EMISSION_MAX)?;
    let emission = color("emissiveFactor", source.emissive_factor.0, 1.0)?;
    let normal_scale = source.normal_texture.as_ref().map_or(1.0, |n| n.scale);
    Ok(Material {
        name: match &source.name {
            Some(name) => printable(name),
            None => format!("material {index}"),
        },
        base_color: color("baseColorFactor", [r, g, b], 1.0)?,
        alpha: number("baseColorFactor", alpha, 1.0)?,
        alpha_cutoff: match source.alpha_mode {
            Checked::Valid(AlphaMode::Mask) => {
                let cutoff = source.alpha_cutoff.map_or(0.5, |c| c.0);
                Some(number("alphaCutoff", cutoff, f32::MAX)?)
            }
            Checked::Valid(AlphaMode::Blend) => Some(BLEND_CUTOFF),
            Checked::Valid(AlphaMode::Opaque) | Checked::Invalid => None,
        },
        metallic: number("metallicFactor", pbr.metallic_factor.0, 1.0)?,
        roughness: number("roughnessFactor", pbr.roughness_factor.0, 1.0)?,
        specular: number("specularFactor", specular.specular_factor.0, 1.0)?,
        specular_color: color(
            "specularColorFactor",
            specular.specular_color_factor.0,
            f32::MAX,
        )?,
        ior: refraction(number("ior", ior, f32::MAX)?),
        emission: emission.map(|c| c * strength),
        double_sided: source.double_sided,
        unlit: extensions.is_some_and(|e| e.unlit.is_some()),
        normal_scale: range("normalTexture.scale", normal_scale, -SCALE_MAX, SCALE_MAX)?,
        anisotropy: number("anisotropyStrength", anisotropy.strength, 1.0)?,
        anisotropy_rotation: range("anisotropyRotation", anisotropy.rotation, -1e6, 1e6)?,
        ..Material::default()
    })
}

/// Where the opacity of a blended surface is less, it is left out.
const BLEND_CUTOFF: f32 = 0.5;
/// Largest strength of emission: sums of it stay numbers.
const EMISSION_MAX: f32 = 1e30;
/// Largest factor of a normal map.
const SCALE_MAX: f32 = 1e6;
const BROKEN: &str = "the file is broken; export it again";

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
        Checked::Valid(AlphaMode::Opaque | AlphaMode::Mask) => {}
        Checked::Valid(AlphaMode::Blend) => warnings.add(
            "alpha blending is shown as a mask: surfaces are there where they are at least half opaque",
        ),
        Checked::Invalid => warnings.add("unknown alpha modes are ignored"),
    }
}
