//! From the scene as it was read to the scene as the phases read it.

use super::{Filter, Material, Scene, TextureRef, Wrap};
use crate::data::{MaterialRecord, NO_TEXTURE, SceneData, TextureRecord};
use crate::geom;

impl SceneData {
    /// Orders the triangles along a bounding volume hierarchy and gathers what shading them needs.
    pub fn new(scene: &Scene) -> Self {
        let mesh = &scene.mesh;
        let place = |triangle: &[u32; 3]| spread(triangle, |v| mesh.positions[v].to_array());
        let corners: Vec<[f32; 9]> = mesh.triangles.iter().map(place).collect();
        let bvh = geom::build(&corners);
        let order = || bvh.order.iter().map(|&i| i as usize);

        let (textures, texels) = gather_textures(scene);
        let textured = !textures.is_empty();
        let (low, high) = scene.bounds();
        let texcoord = |i: usize| {
            let corner = mesh.triangles[i]
                .map(|v| mesh.texcoords.get(v as usize).copied().unwrap_or_default());
            [
                corner[0].x,
                corner[0].y,
                corner[1].x,
                corner[1].y,
                corner[2].x,
                corner[2].y,
            ]
        };
        Self {
            lift_bits: (LIFT_LEAST * (high - low).length()).to_bits(),
            corner: order().map(|i| corners[i]).collect(),
            corner_normal: order()
                .map(|i| spread(&mesh.triangles[i], |v| mesh.normals[v].to_array()))
                .collect(),
            corner_texcoord: if textured {
                order().map(texcoord).collect()
            } else {
                Vec::new()
            },
            triangle_material: order().map(|i| mesh.material[i]).collect(),
            material: gather_materials(scene),
            node: bvh.nodes,
            srgb: if textured {
                (0..=255).map(srgb_to_linear).collect()
            } else {
                Vec::new()
            },
            texture: textures,
            texel: texels,
        }
    }
}

/// Least lift of ray origins, as a share of the scene's diagonal: a few roundings of a coordinate at its edge.
const LIFT_LEAST: f32 = 2.5e-7;

fn spread(triangle: &[u32; 3], value: impl Fn(usize) -> [f32; 3]) -> [f32; 9] {
    let [a, b, c] = triangle.map(|v| value(v as usize));
    [a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]]
}

/// One record for each use of a texture: base colour of material 0, its metallic-roughness, material 1 …
fn uses(material: &Material) -> [Option<TextureRef>; 2] {
    [
        material.base_color_texture,
        material.metallic_roughness_texture,
    ]
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
        let (f0, f90) = material.dielectric_fresnel();
        let [base_color_texture, metallic_roughness_texture] = uses(material).map(&mut index);
        MaterialRecord {
            base_color: material.base_color,
            metallic: material.metallic,
            dielectric_f0: f0,
            dielectric_f90: f90,
            roughness: material.roughness,
            base_color_texture,
            metallic_roughness_texture,
            padding: 0,
        }
    };
    scene.materials.iter().map(record).collect()
}

fn gather_textures(scene: &Scene) -> (Vec<TextureRecord>, Vec<u32>) {
    let mut first_of = Vec::with_capacity(scene.textures.len());
    let mut texels = Vec::new();
    let used = scene.materials.iter().flat_map(uses).flatten();
    if used.clone().next().is_some() {
        for texture in &scene.textures {
            first_of.push(texels.len() as u32);
            texels.extend(texture.texels.iter().map(|&t| u32::from_le_bytes(t)));
        }
    }
    let records = used.map(|use_| {
        let texture = &scene.textures[use_.texture as usize];
        let wrap = |w: Wrap| match w {
            Wrap::Repeat => 0,
            Wrap::Mirror => 1,
            Wrap::Clamp => 2,
        };
        let nearest = u32::from(use_.filter == Filter::Nearest) << 4;
        TextureRecord {
            first: first_of[use_.texture as usize],
            width: texture.width,
            height: texture.height,
            mode: wrap(use_.wrap[0]) | wrap(use_.wrap[1]) << 2 | nearest,
        }
    });
    let records = records.collect();
    (records, texels)
}

/// Linear value 0..=1 of an 8-bit sRGB code (IEC 61966-2-1).
fn srgb_to_linear(code: u32) -> f32 {
    let c = f64::from(code) / 255.0;
    let linear = if c <= 0.04045 {
        c / 12.92
    } else {
        ((c + 0.055) / 1.055).powf(2.4)
    };
    linear as f32
}
