//! What a scene contains, as far as the plan asks.

use super::{Camera, DirectionalLight, Light, PointLight, Scene, Slot, SpotLight};
use glam::Vec3;

/// Findings about a scene under its lights, seen by a camera. Each is conservative: "no" is certain.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFacts {
    /// Number of triangles.
    pub triangles: usize,
    /// Number of lights.
    pub lights: usize,
    /// Number of their maps: see [`Light::maps`].
    pub maps: u32,
    /// Some triangle that the lights may reach is glossy.
    pub glossy_senders: bool,
    /// Some triangle that the lights may reach reflects anything at all.
    pub reflecting_senders: bool,
    /// Some triangle that the camera may see is glossy.
    pub glossy_receivers: bool,
    /// A surface that the lights may reach has two roughnesses.
    pub anisotropic_senders: bool,
    /// A surface that the camera may see has two roughnesses.
    pub anisotropic_receivers: bool,
    /// Some material has a texture.
    pub textures: bool,
    /// Smallest box around all vertices \[m\], relative to the scene's origin.
    pub bounds: (Vec3, Vec3),
}

impl SceneFacts {
    /// Looks at every triangle once.
    pub fn new(scene: &Scene, lights: &[Light], camera: &Camera) -> Self {
        let mut facts = Self {
            triangles: scene.mesh.triangles.len(),
            lights: lights.len(),
            maps: lights
                .iter()
                .fold(0, |sum, light| light.maps().saturating_add(sum)),
            glossy_senders: false,
            reflecting_senders: false,
            glossy_receivers: false,
            anisotropic_senders: false,
            anisotropic_receivers: false,
            textures: scene
                .materials
                .iter()
                .any(|m| Slot::ALL.iter().any(|&slot| m.texture(slot).is_some())),
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

/// False only if no point of the triangle lies inside the light's cone and range.
fn may_reach(light: &Light, corners: [Vec3; 3]) -> bool {
    let (centre, radius) = sphere(corners);
    let in_range = |position: Vec3, range: f32| centre.distance(position) - radius <= range;
    match *light {
        Light::Spot(SpotLight {
            position,
            axis,
            outer,
            range,
            ..
        }) => {
            let to_centre = centre - position;
            let along = to_centre.dot(axis);
            let across = (to_centre - axis * along).length();
            // Signed distance from the cone's mantle.
            across * outer.cos() - along * outer.sin() <= radius && in_range(position, range)
        }
        Light::Point(PointLight {
            position, range, ..
        }) => in_range(position, range),
        Light::Directional(DirectionalLight { .. }) => true,
    }
}

/// False only if the whole triangle lies behind the camera.
fn may_see(camera: &Camera, corners: [Vec3; 3]) -> bool {
    corners
        .iter()
        .any(|&c| (c - camera.eye).dot(camera.forward) > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Material, Mesh};
    use proptest::prelude::*;

    /// One triangle at `corners`, of this material.
    fn scene(corners: [Vec3; 3], material: Material) -> Scene {
        Scene {
            mesh: Mesh {
                positions: corners.to_vec(),
                normals: vec![Vec3::Z; 3],
                triangles: vec![[0, 1, 2]],
                material: vec![0],
                ..Mesh::default()
            },
            materials: vec![material],
            ..Scene::default()
        }
    }

    /// A spot at the origin that shines along -z, 30 degrees wide.
    fn spot() -> Light {
        Light::Spot(SpotLight {
            position: Vec3::ZERO,
            axis: Vec3::NEG_Z,
            intensity: [1.0; 3],
            inner: 0.2,
            outer: 30f32.to_radians(),
            range: f32::INFINITY,
        })
    }

    /// Looks along -z from the origin.
    fn camera() -> Camera {
        Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, 1.0)
    }

    fn around(centre: Vec3) -> [Vec3; 3] {
        [centre, centre + Vec3::X * 0.1, centre + Vec3::Y * 0.1]
    }

    fn facts(centre: Vec3, material: Material) -> SceneFacts {
        SceneFacts::new(&scene(around(centre), material), &[spot()], &camera())
    }

    #[test]
    fn a_metal_in_the_cone_sends_and_receives() {
        let facts = facts(Vec3::NEG_Z * 5.0, Material::metal("", [1.0; 3], 0.3));
        assert!(facts.glossy_senders && facts.reflecting_senders && facts.glossy_receivers);
        assert_eq!(
            (facts.triangles, facts.lights, facts.textures),
            (1, 1, false)
        );
    }

    #[test]
    fn outside_the_cone_and_behind_the_camera_nothing_is_sent_or_received() {
        let beside = facts(
            Vec3::new(4.0, 0.0, -5.0),
            Material::metal("", [1.0; 3], 0.3),
        );
        assert!(!beside.glossy_senders && !beside.reflecting_senders && beside.glossy_receivers);
        let behind = facts(Vec3::Z * 5.0, Material::metal("", [1.0; 3], 0.3));
        assert!(!behind.glossy_senders && !behind.reflecting_senders && !behind.glossy_receivers);
    }

    #[test]
    fn a_triangle_that_holds_the_light_or_the_whole_cone_is_reached() {
        let large = [
            Vec3::new(-50.0, -50.0, -1.0),
            Vec3::new(50.0, -50.0, -1.0),
            Vec3::new(0.0, 90.0, -1.0),
        ];
        assert!(may_reach(&spot(), large));
        assert!(may_reach(&spot(), large.map(|c| c + Vec3::Z)));
    }

    #[test]
    fn ranges_end_and_the_sun_is_everywhere() {
        let light = |range| {
            let (position, intensity) = (Vec3::ZERO, [1.0; 3]);
            Light::Point(PointLight {
                position,
                intensity,
                range,
            })
        };
        let five_off = around(Vec3::Y * 5.0);
        assert!(may_reach(&light(f32::INFINITY), five_off) && may_reach(&light(5.1), five_off));
        assert!(!may_reach(&light(4.7), five_off));
        let (axis, irradiance) = (Vec3::Y, [1.0; 3]);
        assert!(may_reach(
            &Light::Directional(DirectionalLight { axis, irradiance }),
            five_off
        ));
    }

    #[test]
    fn matte_surfaces_reflect_without_gloss_and_black_ones_not_at_all() {
        let ahead = Vec3::NEG_Z * 5.0;
        let matte = facts(ahead, Material::lambert("", [0.5; 3]));
        assert!(matte.reflecting_senders && !matte.glossy_senders && !matte.glossy_receivers);
        let black = facts(ahead, Material::lambert("", [0.0; 3]));
        assert!(!black.reflecting_senders && !black.glossy_senders);
        // Black, but with a varnish.
        let varnished = facts(ahead, Material::dielectric("", [0.0; 3], 0.3));
        assert!(varnished.reflecting_senders && varnished.glossy_senders);
    }

    #[test]
    fn without_lights_nothing_is_sent() {
        let metal = Material::metal("", [1.0; 3], 0.3);
        let facts = SceneFacts::new(&scene(around(Vec3::NEG_Z), metal), &[], &camera());
        assert!(!facts.reflecting_senders && !facts.glossy_senders && facts.glossy_receivers);
    }

    #[test]
    fn one_surface_of_many_is_enough() {
        let mut both = scene(around(Vec3::NEG_Z * 5.0), Material::lambert("", [0.5; 3]));
        both.mesh.triangles.push([0, 2, 1]);
        both.mesh.material.push(1);
        both.materials.push(Material::metal("", [1.0; 3], 0.3));
        let facts = SceneFacts::new(&both, &[spot()], &camera());
        assert!(facts.glossy_senders && facts.glossy_receivers);
    }

    fn coordinate() -> impl Strategy<Value = Vec3> {
        (-3.0f32..3.0, -3.0f32..3.0, -3.0f32..3.0).prop_map(Vec3::from)
    }

    proptest! {
        /// A point of the triangle in the cone: the triangle must not be ruled out.
        #[test]
        fn no_lit_triangle_is_missed(
            corners in [coordinate(), coordinate(), coordinate()],
            position in coordinate(),
            target in coordinate(),
            outer in 0.01f32..SpotLight::OUTER_MAX,
            range in prop_oneof![Just(f32::INFINITY), 0.1f32..10.0],
            (u, v) in (0.0f32..1.0, 0.0f32..1.0),
        ) {
            let axis = (target - position).normalize_or(Vec3::X);
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let point = corners[0] + (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v;
            let direction = (point - position).normalize_or(axis);
            let intensity = [1.0; 3];
            let spot = Light::Spot(SpotLight { position, axis, intensity, inner: 0.0, outer, range });
            let near = point.distance(position) < range;
            if near && direction.dot(axis) > outer.cos() {
                prop_assert!(may_reach(&spot, corners));
            }
            if near {
                let point = Light::Point(PointLight { position, intensity, range });
                prop_assert!(may_reach(&point, corners));
            }
        }
    }
}
