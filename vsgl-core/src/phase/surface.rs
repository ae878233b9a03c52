//! The surface at a hit: where it is, which way it faces, how it reflects.

use super::texture;
use crate::data::{NO_TEXTURE, SceneData};
use crate::geom::Hit;
use crate::math::vec::normalize;
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
    /// GGX roughness `alpha`, at least [`ALPHA_MIN`].
    pub alpha: f32,
}

/// The surface at a hit of a ray that runs along `direction` (any length).
///
/// Position and normal are interpolated; the material follows glTF 2.0 appendix B. Where `textured` is false no
/// texture is read.
pub fn at_hit(scene: &SceneData, hit: &Hit, direction: Vec3, textured: bool) -> Surface {
    let triangle = hit.triangle as usize;
    let (u, v) = (hit.u.clamp(0.0, 1.0), hit.v.clamp(0.0, 1.0));
    let position = interpolate(&scene.corner[triangle], u, v);
    let normal = normalize(interpolate(&scene.corner_normal[triangle], u, v));
    let normal = if normal.dot(direction) > 0.0 {
        -normal
    } else {
        normal
    };

    let material = &scene.material[scene.triangle_material[triangle] as usize];
    let mut base = material.base_color;
    let mut metallic = material.metallic;
    let mut roughness = material.roughness;
    // A plan made by hand may ask for textures that the scene has not.
    if textured && !scene.texture.is_empty() {
        let sample =
            |texture: u32, srgb: bool| texture::sample(scene, texture, triangle, u, v, srgb);
        if material.base_color_texture != NO_TEXTURE {
            let color = sample(material.base_color_texture, true);
            base = [base[0] * color[0], base[1] * color[1], base[2] * color[2]];
        }
        if material.metallic_roughness_texture != NO_TEXTURE {
            let factors = sample(material.metallic_roughness_texture, false);
            roughness *= factors[1];
            metallic *= factors[2];
        }
    }
    let dielectric = material.reflectance.map(|c| c.min(1.0) * material.specular);
    Surface {
        position,
        normal,
        diffuse: base.map(|c| (1.0 - metallic) * c),
        dielectric_f0: dielectric[0].max(dielectric[1]).max(dielectric[2]),
        dielectric_f90: material.specular,
        f0: std::array::from_fn(|i| mix(dielectric[i], base[i], metallic)),
        f90: mix(material.specular, 1.0, metallic),
        alpha: (roughness * roughness).max(ALPHA_MIN),
    }
}

/// `a` where `t` is 0, `b` where it is 1.
pub(super) fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

fn interpolate(corner: &[f32; 9], u: f32, v: f32) -> Vec3 {
    let a = Vec3::new(corner[0], corner[1], corner[2]);
    let ab = Vec3::new(corner[3], corner[4], corner[5]) - a;
    let ac = Vec3::new(corner[6], corner[7], corner[8]) - a;
    (a + ab * u) + ac * v
}
