//! Which image a material reads, and how.

use super::document::{Document, lookup};
use super::fault::{Fault, Result};
use super::warnings::Warnings;
use crate::scene::{Filter, TextureRef, Wrap};
use glam::{Affine2, Mat2, Vec2};
use gltf::json;
use gltf::json::extensions::texture::TextureTransform;
use gltf::json::material::NormalTexture;
use gltf::json::texture::{Info, MagFilter, MinFilter, Sampler, WrappingMode};
use gltf::json::validation::Checked;
use std::collections::HashMap;

/// Largest number of a texture's transform that is accepted: products with it stay numbers.
const TRANSFORM_MAX: f32 = 1e12;

/// Images that materials use, in the order of their first use.
pub(super) struct Textures<'a> {
    document: &'a Document,
    images: Vec<usize>,
    places: HashMap<usize, u32>,
}

/// What a material says of a texture.
pub(super) struct Use {
    texture: usize,
    /// Number of the set of coordinates: `TEXCOORD_n`.
    number: u32,
    transform: TextureTransform,
}

impl Use {
    fn new(texture: usize, number: u32, transform: Option<TextureTransform>) -> Self {
        let transform = transform.unwrap_or_default();
        Self {
            texture,
            number: transform.tex_coord.unwrap_or(number),
            transform,
        }
    }
}

impl From<&Info> for Use {
    fn from(info: &Info) -> Self {
        let extensions = info.extensions.as_ref();
        let transform = extensions.and_then(|e| e.texture_transform.clone());
        Self::new(info.index.value(), info.tex_coord, transform)
    }
}

impl Use {
    /// Of a normal map, whose extensions the parser leaves as they are. `place` is its JSON path.
    pub(super) fn of_normal(info: &NormalTexture, place: &str) -> Result<Self> {
        let others = info.extensions.as_ref().map(|e| &e.others);
        let transform = others.and_then(|others| others.get("KHR_texture_transform"));
        let transform = transform
            .map(|value| json::deserialize::from_value(value.clone()))
            .transpose()
            .map_err(|_| {
                let place = format!("{place}.extensions.KHR_texture_transform");
                Fault::new(place, "is not what the extension says", BROKEN)
            })?;
        Ok(Self::new(info.index.value(), info.tex_coord, transform))
    }
}

/// The sets of texture coordinates that a material reads: their numbers in the file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sets(pub(super) [Option<u32>; 2]);

impl Sets {
    /// The place of a set, given by its number.
    fn place(&mut self, number: u32, warnings: &mut Warnings) -> u32 {
        for (place, known) in self.0.iter_mut().enumerate() {
            if *known.get_or_insert(number) == number {
                return place as u32;
            }
        }
        warnings.add("materials read two sets of texture coordinates at most: a third is taken for the first");
        0
    }
}

impl<'a> Textures<'a> {
    pub(super) fn new(document: &'a Document) -> Self {
        Self {
            document,
            images: Vec::new(),
            places: HashMap::new(),
        }
    }

    /// The images of the file that textures are.
    pub(super) fn into_images(self) -> Vec<usize> {
        self.images
    }

    /// A texture; none if its image is of no format that is read. `place` is its JSON path.
    pub(super) fn read(
        &mut self,
        used: &Use,
        sets: &mut Sets,
        place: &str,
        warnings: &mut Warnings,
    ) -> Result<Option<TextureRef>> {
        let root = &self.document.root;
        let index = used.texture;
        let texture = lookup(&root.textures, "textures", index, || {
            format!("{place}.index")
        })?;
        let Some(source) = image(texture) else {
            warnings.add("textures without a PNG, JPEG or WebP image are left out");
            return Ok(None);
        };
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
        let image = *self.places.entry(source).or_insert_with(|| {
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
            mips: !matches!(
                sampler.min_filter,
                Some(Checked::Valid(MinFilter::Nearest | MinFilter::Linear))
            ),
            set: sets.place(used.number, warnings),
            transform: transform(&used.transform, place)?,
        }))
    }
}

/// Index of the image of a texture: its own, else that of `EXT_texture_webp`.
fn image(texture: &json::Texture) -> Option<usize> {
    let own = texture.source.value();
    // The parser's sign for "no source".
    if own != u32::MAX as usize {
        return Some(own);
    }
    let extension = texture
        .extensions
        .as_ref()?
        .others
        .get("EXT_texture_webp")?;
    Some(extension["source"].as_u64()? as usize)
}

fn wrap(mode: Checked<WrappingMode>) -> Wrap {
    match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    }
}

/// Scaled, turned counterclockwise as seen with v downwards, moved.
///
/// Source: Khronos Group, `KHR_texture_transform`, properties `scale`, `rotation`, `offset`.
fn transform(source: &TextureTransform, place: &str) -> Result<Affine2> {
    let (scale, offset) = (Vec2::from(source.scale.0), Vec2::from(source.offset.0));
    let rotation = source.rotation.0;
    let sound = |x: f32| x.abs() <= TRANSFORM_MAX;
    if ![scale.x, scale.y, offset.x, offset.y, rotation]
        .into_iter()
        .all(sound)
    {
        let place = format!("{place}.extensions.KHR_texture_transform");
        return Err(Fault::new(
            place,
            format!("has a number beyond {TRANSFORM_MAX:e}"),
            BROKEN,
        ));
    }
    let (sin, cos) = rotation.sin_cos();
    let matrix = Mat2::from_cols(
        Vec2::new(cos * scale.x, -sin * scale.x),
        Vec2::new(sin * scale.y, cos * scale.y),
    );
    Ok(Affine2::from_mat2_translation(matrix, offset))
}

const BROKEN: &str = "the file is broken; export it again";
