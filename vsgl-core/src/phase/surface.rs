//! The surface at a hit: where it is, which way it faces, how it reflects.

use super::anisotropy::{self, Stretch};
use super::footprint::Place;
use super::{color, normal_map, texture};
use crate::data::{DOUBLE_SIDED, MaterialRecord, NO_TEXTURE, SceneData, UNLIT};
use crate::math::vec::normalize;
use crate::plan::SurfacePlan;
use glam::Vec3;

/// Smallest GGX `alpha` of a surface: below, the lobe is a mirror that no light of finite extent can hit in f32.
pub const ALPHA_MIN: f32 = 1e-3;

/// A point of a surface with its reflectance, seen from one side.
#[derive(Clone, Copy, Debug, Default)]
pub struct Surface {
    /// Position \[m\].
    pub position: Vec3,
    /// Unit shading normal, turned to the viewer.
    pub normal: Vec3,
    /// Albedo of the Lambert part, `(1 - metallic) base`.
    pub diffuse: [f32; 3],
    /// Largest channel of the dielectric reflectance at normal incidence.
    pub dielectric_f0: f32,
    /// Dielectric reflectance at grazing incidence.
    pub dielectric_f90: f32,
    /// Specular reflectance at normal incidence.
    pub f0: [f32; 3],
    /// Specular reflectance at grazing incidence.
    pub f90: f32,
    /// GGX roughness `alpha`, at least [`ALPHA_MIN`]; along the tangent where anisotropy is read.
    pub alpha: f32,
    /// Unit direction in the surface that `alpha` belongs to. Zero where anisotropy is not read; likewise `across`.
    pub tangent: Vec3,
    /// GGX roughness across the tangent.
    pub across: f32,
    /// Radiance that it sends to the viewer by itself \[W/(m² sr)\].
    pub emission: [f32; 3],
}

/// The surface at a place that a ray along `direction` (any length) has hit.
///
/// Position and normal are interpolated; the material follows glTF 2.0 appendix B. What `reads` leaves out is not looked at.
pub fn at_hit(scene: &SceneData, place: &Place, direction: Vec3, reads: &SurfacePlan) -> Surface {
    let triangle = place.triangle as usize;
    let (u, v) = (place.u, place.v);
    let position = interpolate(&scene.corner[triangle], u, v);
    let smooth = normalize(interpolate(&scene.corner_normal[triangle], u, v));
    let from_behind = smooth.dot(direction) > 0.0;

    let material = &scene.material[scene.triangle_material[triangle] as usize];
    let mut base = material.base_color;
    let mut metallic = material.metallic;
    let mut roughness = material.roughness;
    let mut reflectance = material.reflectance;
    let mut specular = material.specular;
    // A plan made by hand may ask for what the scene has not.
    let textures = !scene.texture.is_empty();
    if reads.textures && textures {
        let sample = |texture: u32, srgb: bool| texture::sample(scene, texture, place, srgb);
        if material.base_color_texture != NO_TEXTURE {
            base = product(base, sample(material.base_color_texture, true));
        }
        if material.metallic_roughness_texture != NO_TEXTURE {
            let factors = sample(material.metallic_roughness_texture, false);
            roughness *= factors[1];
            metallic *= factors[2];
        }
        if material.specular_texture != NO_TEXTURE {
            specular *= sample(material.specular_texture, false)[3];
        }
        if material.specular_color_texture != NO_TEXTURE {
            reflectance = product(reflectance, sample(material.specular_color_texture, true));
        }
    }
    if reads.colors && !scene.corner_color.is_empty() {
        base = product(base, color::of_vertices(scene, place));
    }
    let mut normal = smooth;
    let mapped = reads.normal_maps && textures && material.normal_texture != NO_TEXTURE;
    if mapped {
        normal = normal_map::mapped(scene, material, place, smooth);
    }
    if from_behind {
        normal = -normal;
    }
    if mapped {
        normal = normal_map::facing(normal, direction);
    }
    let unlit = reads.unlit && material.flags & UNLIT != 0;
    let mut emission = [0.0; 3];
    if unlit {
        emission = base;
    } else if reads.emission {
        emission = emitted(
            scene,
            material,
            place,
            direction,
            reads.textures && textures,
        );
    }
    if unlit {
        (base, metallic, specular) = ([0.0; 3], 0.0, 0.0);
    }
    let alpha = (roughness * roughness).max(ALPHA_MIN);
    let stretch = if reads.anisotropy {
        let normals = (smooth, normal);
        let textures = reads.textures && textures;
        anisotropy::stretch(scene, material, place, normals, alpha, textures)
    } else {
        Stretch {
            along: alpha,
            ..Stretch::default()
        }
    };
    let dielectric = reflectance.map(|c| c.min(1.0) * specular);
    Surface {
        position,
        normal,
        diffuse: base.map(|c| (1.0 - metallic) * c),
        dielectric_f0: dielectric[0].max(dielectric[1]).max(dielectric[2]),
        dielectric_f90: specular,
        f0: std::array::from_fn(|i| mix(dielectric[i], base[i], metallic)),
        f90: mix(specular, 1.0, metallic),
        alpha: stretch.along,
        tangent: stretch.tangent,
        across: stretch.across,
        emission,
    }
}

/// Radiance that a place sends against `direction` by itself \[W/(m² sr)\]: nothing from the back of a single-sided material.
pub fn emitted(
    scene: &SceneData,
    material: &MaterialRecord,
    place: &Place,
    direction: Vec3,
    textures: bool,
) -> [f32; 3] {
    let (_, ab, ac) = corners(&scene.corner[place.triangle as usize]);
    if material.flags & DOUBLE_SIDED == 0 && ab.cross(ac).dot(direction) > 0.0 {
        return [0.0; 3];
    }
    if textures && material.emissive_texture != NO_TEXTURE {
        let texel = texture::sample(scene, material.emissive_texture, place, true);
        return product(material.emission, texel);
    }
    material.emission
}

fn product(factor: [f32; 3], by: [f32; 4]) -> [f32; 3] {
    [factor[0] * by[0], factor[1] * by[1], factor[2] * by[2]]
}

/// `a` where `t` is 0, `b` where it is 1.
pub(super) fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// First corner, and the way from it to the second and third.
pub(super) fn corners(corner: &[f32; 9]) -> (Vec3, Vec3, Vec3) {
    let a = Vec3::new(corner[0], corner[1], corner[2]);
    let ab = Vec3::new(corner[3], corner[4], corner[5]) - a;
    let ac = Vec3::new(corner[6], corner[7], corner[8]) - a;
    (a, ab, ac)
}

/// What is given at the corners of a triangle, between them.
pub(super) fn interpolate(corner: &[f32; 9], u: f32, v: f32) -> Vec3 {
    let (a, ab, ac) = corners(corner);
    (a + ab * u) + ac * v
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phase::footprint::Footprint;
    use crate::scene::{Material, Mesh, Scene, Texture, TextureRef};
    use glam::{Vec2, Vec4};

    const ALL: SurfacePlan = SurfacePlan {
        textures: true,
        normal_maps: true,
        colors: true,
        unlit: true,
        anisotropy: true,
        emission: true,
        masks: true,
    };

    /// A triangle in the xy plane that faces +z, with u to the right and v downwards, and textures of one texel each.
    fn scene(material: Material, texels: &[[u8; 4]]) -> Scene {
        Scene {
            mesh: Mesh {
                positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
                normals: vec![Vec3::Z; 3],
                texcoords: vec![Vec2::new(0.0, 1.0), Vec2::ONE, Vec2::ZERO],
                triangles: vec![[0, 1, 2]],
                material: vec![0],
                ..Mesh::default()
            },
            materials: vec![material],
            textures: texels
                .iter()
                .map(|&texel| Texture {
                    width: 1,
                    height: 1,
                    texels: vec![texel],
                })
                .collect(),
            ..Scene::default()
        }
    }

    fn seen(scene: &Scene, direction: Vec3) -> Surface {
        let place = Place {
            triangle: 0,
            u: 0.25,
            v: 0.5,
            footprint: Footprint::default(),
        };
        at_hit(&SceneData::new(scene), &place, direction, &ALL)
    }

    fn near(a: impl AsRef<[f32]>, b: impl AsRef<[f32]>) -> bool {
        let mut pairs = a.as_ref().iter().zip(b.as_ref());
        a.as_ref().len() == b.as_ref().len() && pairs.all(|(a, b)| (a - b).abs() < 2e-3)
    }

    #[test]
    fn factors_textures_and_vertices_are_multiplied() {
        let material = Material {
            base_color: [0.5, 1.0, 1.0],
            metallic: 0.5,
            roughness: 0.5,
            base_color_texture: Some(TextureRef::new(0)),
            metallic_roughness_texture: Some(TextureRef::new(1)),
            ..Material::default()
        };
        // sRGB code 188 is 0.5029 of the light of white.
        let mut scene = scene(material, &[[188, 255, 188, 255], [0, 102, 51, 0]]);
        scene.mesh.colors = vec![
            Vec4::new(1.0, 0.0, 1.0, 1.0),
            Vec4::ONE,
            Vec4::new(1.0, 0.5, 1.0, 1.0),
        ];
        let found = seen(&scene, Vec3::NEG_Z);
        let (base, metallic) = ([0.5 * 0.5029, 0.5, 0.5029], 0.1);
        assert!(near(found.diffuse, base.map(|c| (1.0 - metallic) * c)));
        assert!(near(found.f0, base.map(|c| 0.04 + (c - 0.04) * metallic)));
        assert!((found.alpha - 0.04).abs() < 1e-5, "{}", found.alpha);
        assert!(near(found.position.to_array(), [0.25, 0.5, 0.0]));
    }

    #[test]
    fn specular_textures_multiply_strength_and_colour() {
        let material = Material {
            metallic: 0.0,
            specular: 0.5,
            specular_color: [1.0, 40.0, 1.0],
            specular_texture: Some(TextureRef::new(0)),
            specular_color_texture: Some(TextureRef::new(1)),
            ..Material::default()
        };
        let scene = scene(material, &[[0, 0, 0, 102], [188, 255, 0, 0]]);
        let found = seen(&scene, Vec3::NEG_Z);
        // 0.04 · 40 is more than all: limited before the strength of 0.5 · 0.4.
        assert!(near(found.f0, [0.02 * 0.2, 0.2, 0.0]), "{:?}", found.f0);
        assert!((found.f90 - 0.2).abs() < 1e-5 && (found.dielectric_f90 - 0.2).abs() < 1e-5);
        assert!((found.dielectric_f0 - 0.2).abs() < 1e-5);
    }

    /// A map that leans by 45 degrees along +x of the texture, or along +y.
    #[test]
    fn normal_maps_lean_right_and_up_on_both_sides() {
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let code = |n: f32| ((n * 0.5 + 0.5) * 255.0).round() as u8;
        let (lean, flat) = (code(half), code(0.0));
        for tangents in [false, true] {
            for (texel, expected) in [
                ([lean, flat, lean, 255], [half, 0.0, half]),
                ([flat, lean, lean, 255], [0.0, half, half]),
            ] {
                let material = Material {
                    normal_texture: Some(TextureRef::new(0)),
                    ..Material::default()
                };
                let mut scene = scene(material, &[texel]);
                if tangents {
                    scene.mesh.tangents = vec![Vec4::new(1.0, 0.0, 0.0, 1.0); 3];
                }
                let front = seen(&scene, Vec3::NEG_Z).normal.to_array();
                let back = seen(&scene, Vec3::Z).normal.to_array();
                assert!(
                    (0..3).all(|i| (front[i] - expected[i]).abs() < 6e-3),
                    "{front:?}"
                );
                assert!(
                    (0..3).all(|i| (back[i] + expected[i]).abs() < 6e-3),
                    "{back:?}"
                );
            }
        }
        // u to the left: x of the map points there, and y still upwards.
        let material = Material {
            normal_texture: Some(TextureRef::new(0)),
            normal_scale: 0.5,
            ..Material::default()
        };
        let mut mirrored = scene(material, &[[lean, lean, lean, 255]]);
        for texcoord in &mut mirrored.mesh.texcoords {
            texcoord.x = 1.0 - texcoord.x;
        }
        let normal = seen(&mirrored, Vec3::NEG_Z).normal;
        let expected = Vec3::new(-0.5, 0.5, 1.0).normalize();
        assert!(normal.distance(expected) < 6e-3, "{normal}");
    }

    #[test]
    fn mapped_normals_face_the_viewer() {
        let material = Material {
            normal_texture: Some(TextureRef::new(0)),
            ..Material::default()
        };
        // Leans by almost 90 degrees.
        let scene = scene(material, &[[255, 128, 128, 255]]);
        for direction in [
            Vec3::new(1.0, 0.0, -0.1),
            Vec3::new(5.0, 3.0, -7.0),
            Vec3::NEG_Z,
            Vec3::new(-1.0, 0.2, 0.3),
        ] {
            let normal = seen(&scene, direction).normal;
            let cosine = -normal.dot(direction.normalize());
            assert!(normal.is_normalized() && cosine > 0.5 * normal_map::HORIZON);
        }
    }

    #[test]
    fn coordinates_without_direction_leave_the_normal() {
        let material = Material {
            normal_texture: Some(TextureRef::new(0)),
            ..Material::default()
        };
        let mut scene = scene(material, &[[255, 128, 128, 255]]);
        scene.mesh.texcoords = vec![Vec2::ONE; 3];
        assert_eq!(seen(&scene, Vec3::NEG_Z).normal, Vec3::Z);
    }

    #[test]
    fn single_sided_materials_shine_from_their_front() {
        let mut material = Material {
            emission: [4.0, 2.0, 1.0],
            emissive_texture: Some(TextureRef::new(0)),
            ..Material::default()
        };
        let lit = |material: &Material, direction| {
            seen(&scene(material.clone(), &[[188, 255, 0, 0]]), direction).emission
        };
        // Code 188 is a little more than half.
        assert!(near(lit(&material, Vec3::NEG_Z), [2.011, 2.0, 0.0]));
        assert_eq!(lit(&material, Vec3::Z), [0.0; 3]);
        material.double_sided = true;
        assert_eq!(lit(&material, Vec3::Z), lit(&material, Vec3::NEG_Z));
    }

    #[test]
    fn unlit_surfaces_show_their_colour_and_reflect_nothing() {
        let material = Material {
            base_color: [0.5, 0.25, 1.0],
            emission: [9.0; 3],
            unlit: true,
            ..Material::default()
        };
        for direction in [Vec3::Z, Vec3::NEG_Z] {
            let found = seen(&scene(material.clone(), &[]), direction);
            assert_eq!(found.emission, [0.5, 0.25, 1.0]);
            assert_eq!((found.diffuse, found.f0), ([0.0; 3], [0.0; 3]));
            assert_eq!((found.f90, found.dielectric_f90), (0.0, 0.0));
        }
    }
}
