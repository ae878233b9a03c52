//! The surface at a hit: where it is, which way it faces, how it reflects.

use super::anisotropy::{self, Stretch};
use super::footprint::Place;
use super::{normal_map, texture};
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
        base = product(base, color(scene, place));
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

/// Colour and opacity of the vertices at a place.
pub fn color(scene: &SceneData, place: &Place) -> [f32; 4] {
    let c = &scene.corner_color[place.triangle as usize];
    std::array::from_fn(|i| (c[i] + (c[i + 4] - c[i]) * place.u) + (c[i + 8] - c[i]) * place.v)
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
