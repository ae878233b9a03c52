//! Which way a surface is stretched, and by how much.

use super::footprint::Place;
use super::surface::mix;
use super::{normal_map, texture};
use crate::data::{MaterialRecord, NO_TEXTURE, SceneData};
use crate::math::vec::{normalize, orthonormal_basis};
use glam::Vec3;

/// Two roughnesses of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stretch {
    /// Unit direction in the surface that `along` belongs to.
    pub tangent: Vec3,
    /// GGX roughness along it.
    pub along: f32,
    /// GGX roughness across it.
    pub across: f32,
}

/// The roughnesses of a material of GGX roughness `alpha`, whose interpolated normal is `smooth` and whose shading normal is
/// `normal`. Where the surface has no direction, or no anisotropy, both are `alpha`.
///
/// Source: Khronos Group, `KHR_materials_anisotropy`, "Anisotropy": the roughness along the direction is mixed with 1 by the
/// square of the strength.
pub fn stretch(
    scene: &SceneData,
    material: &MaterialRecord,
    place: &Place,
    (smooth, normal): (Vec3, Vec3),
    alpha: f32,
    textures: bool,
) -> Stretch {
    let mut strength = material.anisotropy;
    let (cos, sin) = (material.anisotropy_cos, material.anisotropy_sin);
    let (mut x, mut y) = (cos, sin);
    if textures && material.anisotropy_texture != NO_TEXTURE {
        let texel = texture::sample(scene, material.anisotropy_texture, place, false);
        let (s, t) = (2.0 * texel[0] - 1.0, 2.0 * texel[1] - 1.0);
        (x, y) = (cos * s - sin * t, sin * s + cos * t);
        strength *= texel[2];
    }
    let (tangent, handed) = direction(scene, material, place, smooth, textures);
    let bitangent = smooth.cross(tangent) * handed;
    let along = tangent * x + bitangent * y;
    let flat = along - normal * normal.dot(along);
    let none = flat.dot(flat) <= normal_map::TANGENT_MIN;
    let strength = if none { 0.0 } else { strength };
    Stretch {
        tangent: if none {
            orthonormal_basis(normal).0
        } else {
            normalize(flat)
        },
        along: mix(alpha, 1.0, strength * strength),
        across: alpha,
    }
}

/// The tangent that the direction is told against, by the texture whose coordinates it follows, and the bitangent's sign.
fn direction(
    scene: &SceneData,
    material: &MaterialRecord,
    place: &Place,
    smooth: Vec3,
    textures: bool,
) -> (Vec3, f32) {
    let uses = [material.normal_texture, material.anisotropy_texture];
    match uses.iter().find(|&&texture| texture != NO_TEXTURE) {
        Some(&texture) if textures => {
            let record = scene.texture[texture as usize];
            normal_map::tangent(scene, &record, place, smooth)
        }
        _ => normal_map::tangent_of_mesh(scene, place, smooth),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phase::footprint::Footprint;

    /// A triangle in the plane z = 0 whose mesh has a tangent along x, or none, and a place on it.
    fn triangle(tangent: bool) -> (SceneData, Place) {
        let t = [1.0, 0.0, 0.0, 1.0];
        let scene = SceneData {
            corner: vec![[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]],
            corner_tangent: if tangent {
                vec![std::array::from_fn(|i| t[i % 4])]
            } else {
                Vec::new()
            },
            ..SceneData::default()
        };
        let place = Place {
            triangle: 0,
            u: 0.3,
            v: 0.3,
            footprint: Footprint::default(),
        };
        (scene, place)
    }

    fn brushed(strength: f32, rotation: f32) -> MaterialRecord {
        MaterialRecord {
            anisotropy: strength,
            anisotropy_cos: rotation.cos(),
            anisotropy_sin: rotation.sin(),
            normal_texture: NO_TEXTURE,
            anisotropy_texture: NO_TEXTURE,
            ..MaterialRecord::default()
        }
    }

    #[test]
    fn the_direction_turns_counterclockwise_from_the_tangent() {
        let (scene, place) = triangle(true);
        for rotation in [0.0f32, 0.5, 1.6, -2.0] {
            let normals = (Vec3::Z, Vec3::Z);
            let made = stretch(&scene, &brushed(0.5, rotation), &place, normals, 0.2, false);
            let expected = Vec3::new(rotation.cos(), rotation.sin(), 0.0);
            assert!((made.tangent - expected).length() < 1e-6);
            assert_eq!((made.along, made.across), (0.2 + 0.8 * 0.25, 0.2));
        }
    }

    #[test]
    fn it_lies_in_the_shading_surface_seen_from_either_side() {
        let (scene, place) = triangle(true);
        for normal in [Vec3::Z, Vec3::NEG_Z, Vec3::new(0.6, 0.0, 0.8)] {
            let made = stretch(
                &scene,
                &brushed(1.0, 0.7),
                &place,
                (Vec3::Z, normal),
                0.1,
                false,
            );
            assert!(made.tangent.is_normalized() && made.tangent.dot(normal).abs() < 1e-6);
            assert!(made.tangent.dot(Vec3::new(0.7f32.cos(), 0.7f32.sin(), 0.0)) > 0.7);
        }
    }

    #[test]
    fn without_a_direction_the_surface_is_isotropic() {
        let (scene, place) = triangle(false);
        let normals = (Vec3::Z, Vec3::Z);
        let made = stretch(&scene, &brushed(0.8, 0.3), &place, normals, 0.2, false);
        assert_eq!((made.along, made.across), (0.2, 0.2));
        assert!(made.tangent.is_normalized() && made.tangent.dot(Vec3::Z) == 0.0);
    }
}
