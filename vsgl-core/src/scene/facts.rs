//! What a scene contains, as far as the plan asks.

use super::{Camera, Light, Scene, SpotLight};
use glam::Vec3;

/// Findings about a scene under its lights, seen by a camera. Each is conservative: "no" is certain.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFacts {
    /// Number of triangles.
    pub triangles: usize,
    /// Number of lights.
    pub lights: usize,
    /// Some triangle that the lights may reach is glossy.
    pub glossy_senders: bool,
    /// Some triangle that the lights may reach reflects anything at all.
    pub reflecting_senders: bool,
    /// Some triangle that the camera may see is glossy.
    pub glossy_receivers: bool,
    /// Some material has a texture.
    pub textures: bool,
    /// Smallest box around all vertices [m], relative to the scene's origin.
    pub bounds: (Vec3, Vec3),
}

impl SceneFacts {
    /// Looks at every triangle once.
    pub fn new(scene: &Scene, lights: &[Light], camera: &Camera) -> Self {
        let mut facts = Self {
            triangles: scene.mesh.triangles.len(),
            lights: lights.len(),
            glossy_senders: false,
            reflecting_senders: false,
            glossy_receivers: false,
            textures: scene
                .materials
                .iter()
                .any(|m| m.base_color_texture.is_some() || m.metallic_roughness_texture.is_some()),
            bounds: scene.bounds(),
        };
        for (triangle, &material) in scene.mesh.triangles.iter().zip(&scene.mesh.material) {
            let material = &scene.materials[material as usize];
            let glossy = material.is_glossy();
            let reflecting = glossy || material.base_color != [0.0; 3];
            let sender_known = facts.reflecting_senders && (facts.glossy_senders || !glossy);
            let receiver_known = facts.glossy_receivers || !glossy;
            if sender_known && receiver_known {
                continue;
            }
            let corners = triangle.map(|v| scene.mesh.positions[v as usize]);
            let lit = lights.iter().any(|light| may_reach(light, corners));
            facts.reflecting_senders |= lit && reflecting;
            facts.glossy_senders |= lit && glossy;
            facts.glossy_receivers |= glossy && may_see(camera, corners);
        }
        facts
    }
}

/// Centre and radius of a sphere around a triangle.
fn sphere(corners: [Vec3; 3]) -> (Vec3, f32) {
    let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    let radius = corners
        .iter()
        .fold(0.0f32, |r, c| r.max(c.distance(centre)));
    (centre, radius * 1.001)
}

/// False only if no point of the triangle lies inside the light's cone.
fn may_reach(light: &Light, corners: [Vec3; 3]) -> bool {
    let Light::Spot(SpotLight {
        position,
        axis,
        outer,
        ..
    }) = *light;
    let (centre, radius) = sphere(corners);
    let to_centre = centre - position;
    let along = to_centre.dot(axis);
    let across = (to_centre - axis * along).length();
    // Signed distance from the cone's mantle.
    across * outer.cos() - along * outer.sin() <= radius
}

/// False only if the whole triangle lies behind the camera.
fn may_see(camera: &Camera, corners: [Vec3; 3]) -> bool {
    corners
        .iter()
        .any(|&c| (c - camera.eye).dot(camera.forward) > 0.0)
}
