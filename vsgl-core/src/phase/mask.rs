//! Where a surface with an alpha mask is, and rays that pass where it is not.

use super::footprint::Place;
use super::{color, texture};
use crate::data::{MaterialRecord, NO_TEXTURE, SceneData};
use crate::geom::{self, Covers, Hit, Opaque, Ray};

/// Triangles that are there where their opacity is not below the cutoff of their material.
#[derive(Clone, Copy, Debug)]
pub struct Masked<'a>(pub &'a SceneData);

impl Covers for Masked<'_> {
    const ALWAYS: bool = false;

    fn is_whole(&self, triangle: u32) -> bool {
        material(self.0, triangle).alpha_cutoff < 0.0
    }

    fn covers(&self, triangle: u32, u: f32, v: f32) -> bool {
        covers(self.0, triangle, u, v)
    }
}

fn material(scene: &SceneData, triangle: u32) -> &MaterialRecord {
    &scene.material[scene.triangle_material[triangle as usize] as usize]
}

/// Whether a triangle is there at a point, given by the weights of its second and third corner: of a texture its full image is
/// read, filtered as the sampler says.
pub fn covers(scene: &SceneData, triangle: u32, u: f32, v: f32) -> bool {
    let material = material(scene, triangle);
    if material.alpha_cutoff < 0.0 {
        return true;
    }
    let t = 0.0;
    let place = Place::point(&Hit { triangle, t, u, v });
    let mut alpha = material.alpha;
    if material.base_color_texture != NO_TEXTURE {
        alpha *= texture::sample(scene, material.base_color_texture, &place, false)[3];
    }
    if !scene.corner_color.is_empty() {
        alpha *= color::of_vertices(scene, &place)[3];
    }
    alpha >= material.alpha_cutoff
}

/// Nearest crossing with `0 < t < t_max`; without `masks` every triangle is whole.
pub fn closest_hit(scene: &SceneData, ray: &Ray, t_max: f32, masks: bool) -> Hit {
    let (nodes, corners) = (&scene.node, &scene.corner);
    if masks {
        geom::closest_hit(nodes, corners, ray, t_max, &Masked(scene))
    } else {
        geom::closest_hit(nodes, corners, ray, t_max, &Opaque)
    }
}

/// Whether anything is crossed with `0 < t < t_max`; without `masks` every triangle is whole.
pub fn any_hit(scene: &SceneData, ray: &Ray, t_max: f32, masks: bool) -> bool {
    let (nodes, corners) = (&scene.node, &scene.corner);
    if masks {
        geom::any_hit(nodes, corners, ray, t_max, &Masked(scene))
    } else {
        geom::any_hit(nodes, corners, ray, t_max, &Opaque)
    }
}
