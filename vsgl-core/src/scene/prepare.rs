//! From the scene as it was read to the scene as the phases read it.

use super::emitters;
use super::pyramid::{self, srgb_to_linear};
use super::shares;
use super::{Filter, Material, Mesh, Scene, Slot, TextureRef, Wrap};
use crate::data::{
    DOUBLE_SIDED, MIPS, MaterialRecord, NEAREST, NO_TEXTURE, SECOND_SET, SceneData, TextureRecord,
    UNLIT,
};
use crate::geom;
use glam::{Affine2, Vec2, Vec4};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::mem::take;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

impl SceneData {
    /// Orders the triangles along a bounding volume hierarchy and gathers what shading them needs.
    pub fn new(scene: &Scene) -> Self {
        let (mut data, smaller) = Self::all_but_texels(scene);
        let texels = scene.textures.iter().map(|t| Cow::Borrowed(&t.texels[..]));
        data.texel = join(texels, smaller, texel_count(scene));
        (data.emitter, data.lamp) = emitters::of(&data);
        data
    }

    /// As [`SceneData::new`], but frees on the way what the scene need not hold any more, so that not all is there twice:
    /// texels, and of the mesh all but positions and triangles.
    pub fn take(scene: &mut Scene) -> Self {
        let (mut data, smaller) = Self::all_but_texels(scene);
        scene.mesh = Mesh {
            positions: take(&mut scene.mesh.positions),
            triangles: take(&mut scene.mesh.triangles),
            ..Mesh::default()
        };
        let count = texel_count(scene);
        let texels = scene.textures.iter_mut();
        let texels = texels.map(|t| Cow::Owned(take(&mut t.texels)));
        data.texel = join(texels, smaller, count);
        (data.emitter, data.lamp) = emitters::of(&data);
        data
    }

    /// Everything but the texels, and the smaller images of textures, if any texture is read.
    fn all_but_texels(scene: &Scene) -> (Self, Option<Vec<Vec<u32>>>) {
        let mesh = &scene.mesh;
        let place = |triangle: &[u32; 3]| spread(triangle, |v| mesh.positions[v].to_array());
        let corners: Vec<[f32; 9]> = mesh.triangles.iter().map(place).collect();
        let bvh = geom::build(&corners);
        let order = || bvh.order.iter().map(|&i| i as usize);

        let (textures, smaller) = gather_textures(scene);
        let reads = |set: u32| {
            let mut used = scene.materials.iter().flat_map(uses).flatten();
            used.any(|texture| texture.set == set)
        };
        let (low, high) = scene.bounds();
        let corner_texcoord = |set: u32, texcoords: &[Vec2]| {
            let value = |v: usize| {
                texcoords
                    .get(v)
                    .map_or([0.0; 2], |t| t.to_array().map(sound))
            };
            let corners = |i: usize| spread::<2, 6>(&mesh.triangles[i], value);
            if reads(set) {
                order().map(corners).collect()
            } else {
                Vec::new()
            }
        };
        let corner_four = |values: &[Vec4]| {
            let value = |v: usize| values.get(v).copied().unwrap_or_default().to_array();
            let corners = |i: usize| spread::<4, 12>(&mesh.triangles[i], value);
            if values.is_empty() {
                Vec::new()
            } else {
                order().map(corners).collect()
            }
        };
        let corner: Vec<[f32; 9]> = order().map(|i| corners[i]).collect();
        let data = Self {
            lift_bits: (LIFT_LEAST * (high - low).length()).to_bits(),
            low_x_bits: low.x.to_bits(),
            low_y_bits: low.y.to_bits(),
            low_z_bits: low.z.to_bits(),
            high_x_bits: high.x.to_bits(),
            high_y_bits: high.y.to_bits(),
            high_z_bits: high.z.to_bits(),
            share: shares::of(&corner),
            corner,
            corner_normal: order()
                .map(|i| spread(&mesh.triangles[i], |v| mesh.normals[v].to_array()))
                .collect(),
            corner_texcoord: corner_texcoord(0, &mesh.texcoords),
            corner_texcoord_second: corner_texcoord(1, &mesh.texcoords_second),
            corner_tangent: corner_four(&mesh.tangents),
            corner_color: corner_four(&mesh.colors),
            triangle_material: order().map(|i| mesh.material[i]).collect(),
            material: gather_materials(scene),
            node: bvh.nodes,
            srgb: if textures.is_empty() {
                Vec::new()
            } else {
                (0..=255).map(srgb_to_linear).collect()
            },
            texture: textures,
            texel: Vec::new(),
            emitter: Vec::new(),
            lamp: Vec::new(),
        };
        (data, smaller)
    }
}

fn texel_count(scene: &Scene) -> usize {
    scene.textures.iter().map(|t| t.texels.len()).sum()
}

/// All texels: the textures', `count` in all, then those of their smaller images; none if no texture is read.
fn join<'a>(
    textures: impl Iterator<Item = Cow<'a, [[u8; 4]]>>,
    smaller: Option<Vec<Vec<u32>>>,
    count: usize,
) -> Vec<u32> {
    let mut texels = Vec::new();
    let Some(smaller) = smaller else {
        return texels;
    };
    // At once: growing would hold everything twice.
    texels.reserve_exact(count + smaller.iter().map(Vec::len).sum::<usize>());
    for texture in textures {
        texels.extend(texture.iter().map(|&t| u32::from_le_bytes(t)));
    }
    for words in smaller {
        texels.extend(words);
    }
    texels
}

/// Least lift of ray origins, as a share of the scene's diagonal: a few roundings of a coordinate at its edge.
const LIFT_LEAST: f32 = 2.5e-7;

/// Largest texture coordinate that is read: what is computed from it stays a number.
const TEXCOORD_MAX: f32 = 1e12;

/// A texture coordinate, or zero where it is none.
fn sound(texcoord: f32) -> f32 {
    if texcoord.abs() <= TEXCOORD_MAX {
        texcoord
    } else {
        0.0
    }
}

/// The values at the corners of a triangle, one after the other; `M` is three times `N`.
fn spread<const N: usize, const M: usize>(
    triangle: &[u32; 3],
    value: impl Fn(usize) -> [f32; N],
) -> [f32; M] {
    let corners = triangle.map(|v| value(v as usize));
    std::array::from_fn(|i| corners[i / N][i % N])
}

/// One record for each use of a texture: those of material 0, those of material 1 …
fn uses(material: &Material) -> [Option<TextureRef>; Slot::ALL.len()] {
    Slot::ALL.map(|slot| material.texture(slot))
}

fn gather_materials(scene: &Scene) -> Vec<MaterialRecord> {
    let mut next = 0;
    let mut index = |texture: Option<TextureRef>| {
        texture.map_or(NO_TEXTURE, |_| {
            next += 1;
            next - 1
        })
    };
    let record = |material: &Material| {
        let [
            base_color_texture,
            metallic_roughness_texture,
            normal_texture,
            emissive_texture,
            specular_texture,
            specular_color_texture,
            anisotropy_texture,
        ] = uses(material).map(&mut index);
        MaterialRecord {
            base_color: material.base_color,
            metallic: material.metallic,
            reflectance: material.reflectance(),
            specular: material.specular,
            roughness: material.roughness,
            alpha: material.alpha,
            alpha_cutoff: match material.alpha_cutoff {
                Some(cutoff) if material.is_masked(!scene.mesh.colors.is_empty()) => cutoff,
                _ => -1.0,
            },
            flags: u32::from(material.double_sided) * DOUBLE_SIDED
                + u32::from(material.unlit) * UNLIT,
            emission: material.emission,
            normal_scale: material.normal_scale,
            anisotropy: material.anisotropy,
            anisotropy_cos: material.anisotropy_rotation.cos(),
            anisotropy_sin: material.anisotropy_rotation.sin(),
            base_color_texture,
            metallic_roughness_texture,
            normal_texture,
            emissive_texture,
            specular_texture,
            specular_color_texture,
            anisotropy_texture,
            padding: [0; 2],
        }
    };
    scene.materials.iter().map(record).collect()
}

/// Records of the textures that are read, and the smaller images of these textures in the order in which they follow
/// the textures; none if no texture is read.
fn gather_textures(scene: &Scene) -> (Vec<TextureRecord>, Option<Vec<Vec<u32>>>) {
    let slots = |material| Slot::ALL.into_iter().zip(uses(material));
    let used = scene.materials.iter().flat_map(slots);
    let used: Vec<(Slot, TextureRef)> = used
        .filter_map(|(slot, texture)| Some((slot, texture?)))
        .collect();
    if used.is_empty() {
        return (Vec::new(), None);
    }
    let mut next = 0u32;
    let mut place = |words: usize| {
        let first = next;
        next += words as u32;
        first
    };
    let textures = scene.textures.iter();
    let first_of: Vec<u32> = textures.map(|t| place(t.texels.len())).collect();
    let wanted = used.iter().filter(|(_, texture)| texture.mips);
    let wanted: BTreeSet<Pyramid> = wanted
        .map(|&(slot, t)| (t.texture, is_srgb(slot)))
        .collect();
    let mut smaller_of = BTreeMap::new();
    let mut all_smaller = Vec::new();
    for (pyramid, words) in pyramids(scene, &Vec::from_iter(wanted)) {
        smaller_of.insert(pyramid, place(words.len()));
        all_smaller.push(words);
    }
    let records = used.into_iter().map(|(slot, use_)| {
        let texture = &scene.textures[use_.texture as usize];
        let smaller = smaller_of.get(&(use_.texture, is_srgb(slot)));
        let smaller = smaller.filter(|_| use_.mips);
        let Affine2 {
            matrix2,
            translation,
        } = use_.transform;
        TextureRecord {
            first: first_of[use_.texture as usize],
            width: texture.width,
            height: texture.height,
            mode: mode(&use_),
            to_u: [matrix2.x_axis.x, matrix2.y_axis.x, translation.x],
            smaller: smaller.copied().unwrap_or_default(),
            to_v: [matrix2.x_axis.y, matrix2.y_axis.y, translation.y],
            levels: smaller.map_or(1, |_| pyramid::levels(texture)),
        }
    });
    (records.collect(), Some(all_smaller))
}

/// A texture, and whether it holds sRGB colours.
type Pyramid = (u32, bool);

/// The smaller images of textures, on as many threads as there are cores.
fn pyramids(scene: &Scene, wanted: &[Pyramid]) -> Vec<(Pyramid, Vec<u32>)> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        while let Some(&(texture, srgb)) = wanted.get(next.fetch_add(1, Ordering::Relaxed)) {
            let words = pyramid::smaller(&scene.textures[texture as usize], srgb);
            done.push(((texture, srgb), words));
        }
        done
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let mut all = thread::scope(|scope| {
        let others: Vec<_> = (1..threads.min(wanted.len()))
            .map(|_| scope.spawn(work))
            .collect();
        let mut all = work();
        for other in others {
            match other.join() {
                Ok(done) => all.extend(done),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        all
    });
    all.sort_by_key(|&(pyramid, _)| pyramid);
    all
}

fn is_srgb(slot: Slot) -> bool {
    matches!(slot, Slot::BaseColor | Slot::Emissive | Slot::SpecularColor)
}

/// [`TextureRecord::mode`] of a use.
fn mode(use_: &TextureRef) -> u32 {
    let wrap = |w: Wrap| match w {
        Wrap::Repeat => 0,
        Wrap::Mirror => 1,
        Wrap::Clamp => 2,
    };
    let flag = |set: bool, flag: u32| u32::from(set) * flag;
    wrap(use_.wrap[0])
        | wrap(use_.wrap[1]) << 2
        | flag(use_.filter == Filter::Nearest, NEAREST)
        | flag(use_.mips, MIPS)
        | flag(use_.set == 1, SECOND_SET)
}
