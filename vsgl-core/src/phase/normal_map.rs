//! Normals from a normal map.

use super::footprint::Place;
use super::surface::{corners, interpolate};
use super::texture;
use crate::data::{MaterialRecord, SceneData, TextureRecord};
use crate::math::vec::normalize;
use glam::Vec3;

/// Least cosine between a mapped normal and the direction to the viewer.
pub const HORIZON: f32 = 0.01;
/// Square of the length below which a tangent counts as none.
pub const TANGENT_MIN: f32 = 1e-6;

/// The normal that a material's map puts in the place of the unit normal `smooth`, on the same side of the surface. `smooth`
/// itself where texture coordinates give no direction.
///
/// Source: Khronos Group, glTF 2.0 specification, section 3.9.3, "Additional Textures".
pub fn mapped(scene: &SceneData, material: &MaterialRecord, place: &Place, smooth: Vec3) -> Vec3 {
    let record = scene.texture[material.normal_texture as usize];
    let (tangent, handed) = tangent(scene, &record, place, smooth);
    if tangent == Vec3::ZERO {
        return smooth;
    }
    let texel = texture::sample(scene, material.normal_texture, place, false);
    let x = (2.0 * texel[0] - 1.0) * material.normal_scale;
    let y = (2.0 * texel[1] - 1.0) * material.normal_scale;
    let z = 2.0 * texel[2] - 1.0;
    let bitangent = smooth.cross(tangent) * handed;
    normalize((tangent * x + bitangent * y) + smooth * z)
}

/// Unit tangent at right angles to `normal` along increasing u of a texture, and the sign of the bitangent; zero where there
/// is none. That of the mesh, or else that of the texture coordinates on the triangle.
pub fn tangent(
    scene: &SceneData,
    record: &TextureRecord,
    place: &Place,
    normal: Vec3,
) -> (Vec3, f32) {
    let of_mesh = tangent_of_mesh(scene, place, normal);
    if of_mesh.0 != Vec3::ZERO {
        return of_mesh;
    }
    let (_, ab, ac) = corners(&scene.corner[place.triangle as usize]);
    let [_, b, c] = texture::corners(scene, record, place.triangle);
    let turned = b[0] * c[1] - b[1] * c[0] < 0.0;
    let along = normalize(ab * c[1] - ac * b[1]);
    let along = if turned { -along } else { along };
    let tangent = along - normal * normal.dot(along);
    let flipped = ab.cross(ac).dot(normal) < 0.0;
    // Green points against increasing v, which points down.
    let handed = if turned == flipped { -1.0 } else { 1.0 };
    let none = (b[0] * c[1] == b[1] * c[0]) | (tangent.dot(tangent) <= TANGENT_MIN);
    (if none { Vec3::ZERO } else { normalize(tangent) }, handed)
}

/// Unit tangent of the mesh at right angles to `normal`, and the sign of the bitangent; zero where there is none.
pub fn tangent_of_mesh(scene: &SceneData, place: &Place, normal: Vec3) -> (Vec3, f32) {
    if let Some(t) = scene.corner_tangent.get(place.triangle as usize) {
        let corners = [t[0], t[1], t[2], t[4], t[5], t[6], t[8], t[9], t[10]];
        let along = interpolate(&corners, place.u, place.v);
        let tangent = along - normal * normal.dot(along);
        if tangent.dot(tangent) > TANGENT_MIN {
            return (normalize(tangent), if t[3] < 0.0 { -1.0 } else { 1.0 });
        }
    }
    (Vec3::ZERO, 1.0)
}

/// A mapped normal that faces the viewer of a ray along `direction`: one that would face away, or stand at less than
/// [`HORIZON`], is bent towards the viewer to stand at that cosine about.
pub fn facing(normal: Vec3, direction: Vec3) -> Vec3 {
    let away = normalize(direction);
    let beyond = normal.dot(away) + HORIZON;
    if beyond > 0.0 {
        normalize(normal - away * beyond)
    } else {
        normal
    }
}
