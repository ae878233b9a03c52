//! What a scene contains, as far as the plan asks.

use super::{Camera, DirectionalLight, Light, Material, PointLight, Scene, Slot, SpotLight};
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
    /// Number of triangles that shine, with or without a texture that may leave some of them dark.
    pub emitters: usize,
    /// Some triangle that the lights may reach is glossy.
    pub glossy_senders: bool,
    /// Some triangle that the lights may reach reflects anything at all.
    pub reflecting_senders: bool,
    /// Some triangle that the camera may see is glossy.
    pub glossy_receivers: bool,
    /// What is to be read of triangles that the camera may see.
    pub seen: SurfaceFacts,
    /// What is to be read of triangles that the lights may reach, and that reflect anything.
    pub sent: SurfaceFacts,
    /// What is to be read of any triangle, for paths that may reach all of them.
    pub any: SurfaceFacts,
    /// Some triangle is glossy.
    pub glossy: bool,
    /// Some triangle has an alpha mask: it may stand in the way of any ray.
    pub masks: bool,
    /// Smallest box around all vertices \[m\], relative to the scene's origin.
    pub bounds: (Vec3, Vec3),
}

/// What some surface has besides position, normal and factors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SurfaceFacts {
    /// Textures of colours and factors.
    pub textures: bool,
    /// A normal map.
    pub normal_maps: bool,
    /// Colours of vertices.
    pub colors: bool,
    /// Is unlit.
    pub unlit: bool,
    /// Has two roughnesses.
    pub anisotropy: bool,
    /// Sends light by itself.
    pub emission: bool,
}

impl SurfaceFacts {
    /// Everything.
    pub const ALL: Self = Self {
        textures: true,
        normal_maps: true,
        colors: true,
        unlit: true,
        anisotropy: true,
        emission: true,
    };

    fn of(material: &Material, colors: bool) -> Self {
        let Material { unlit, .. } = *material;
        let emission = !unlit && material.emission != [0.0; 3];
        let anisotropy = !unlit && material.anisotropy > 0.0 && material.is_glossy();
        let read = |&slot: &Slot| match slot {
            Slot::BaseColor => true,
            Slot::Emissive => emission,
            Slot::Normal => false,
            Slot::Anisotropy => anisotropy,
            Slot::MetallicRoughness | Slot::Specular | Slot::SpecularColor => !unlit,
        };
        let mut read = Slot::ALL.iter().filter(|slot| read(slot));
        Self {
            textures: read.any(|&slot| material.texture(slot).is_some()),
            normal_maps: !unlit && material.normal_texture.is_some(),
            colors,
            unlit,
            anisotropy,
            emission,
        }
    }

    /// What either has.
    fn or(self, other: Self) -> Self {
        Self {
            textures: self.textures || other.textures,
            normal_maps: self.normal_maps || other.normal_maps,
            colors: self.colors || other.colors,
            unlit: self.unlit || other.unlit,
            anisotropy: self.anisotropy || other.anisotropy,
            emission: self.emission || other.emission,
        }
    }
}

/// What a material may add to the facts.
#[derive(Clone, Copy, Debug)]
struct Findings {
    glossy: bool,
    reflecting: bool,
    masked: bool,
    surface: SurfaceFacts,
}

impl Findings {
    fn of(material: &Material, colors: bool) -> Self {
        let glossy = material.is_glossy() && !material.unlit;
        Self {
            glossy,
            reflecting: glossy || (material.base_color != [0.0; 3] && !material.unlit),
            masked: material.is_masked(colors),
            surface: SurfaceFacts::of(material, colors),
        }
    }
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
            emitters: 0,
            glossy_senders: false,
            reflecting_senders: false,
            glossy_receivers: false,
            seen: SurfaceFacts::default(),
            sent: SurfaceFacts::default(),
            any: SurfaceFacts::default(),
            glossy: false,
            masks: false,
            bounds: scene.bounds(),
        };
        let colors = !scene.mesh.colors.is_empty();
        let findings = |material: &Material| Findings::of(material, colors);
        let findings: Vec<Findings> = scene.materials.iter().map(findings).collect();
        for &material in &scene.mesh.material {
            let material = &scene.materials[material as usize];
            facts.emitters += usize::from(material.emission != [0.0; 3] && !material.unlit);
        }
        for (triangle, &material) in scene.mesh.triangles.iter().zip(&scene.mesh.material) {
            let found = findings[material as usize];
            facts.masks |= found.masked;
            facts.glossy |= found.glossy;
            facts.any = facts.any.or(found.surface);
            // Geometry is looked at only where the material has something new to say.
            let mut sent = facts.clone();
            sent.add_sent(found);
            let mut seen = facts.clone();
            seen.add_seen(found);
            if sent == facts && seen == facts {
                continue;
            }
            let corners = triangle.map(|v| scene.mesh.positions[v as usize]);
            if sent != facts && lights.iter().any(|light| may_reach(light, corners)) {
                facts.add_sent(found);
            }
            if seen != facts && may_see(camera, corners) {
                facts.add_seen(found);
            }
        }
        facts
    }

    /// The lights may reach such a surface. One that reflects nothing may still stand before others: it is told whether it is
    /// unlit.
    fn add_sent(&mut self, found: Findings) {
        self.reflecting_senders |= found.reflecting;
        self.glossy_senders |= found.glossy;
        if found.reflecting || found.surface.unlit {
            self.sent = self.sent.or(found.surface);
        }
    }

    /// The camera may see such a surface.
    fn add_seen(&mut self, found: Findings) {
        self.glossy_receivers |= found.glossy;
        self.seen = self.seen.or(found.surface);
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
    use crate::scene::{Mesh, TextureRef};
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
        assert_eq!((facts.triangles, facts.lights), (1, 1));
        assert_eq!((facts.seen, facts.sent), Default::default());
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
    fn surfaces_are_read_where_they_are_seen_or_lit() {
        let whole = Material {
            base_color_texture: Some(TextureRef::new(0)),
            normal_texture: Some(TextureRef::new(0)),
            emission: [1.0; 3],
            ..Material::default()
        };
        let (ahead, beside) = (Vec3::NEG_Z * 5.0, Vec3::new(4.0, 0.0, -5.0));
        let both = facts(ahead, whole.clone());
        assert!(both.seen.textures && both.seen.normal_maps && both.seen.emission);
        assert!(both.sent.textures && both.sent.normal_maps && !both.seen.colors);
        let seen = facts(beside, whole.clone());
        assert!(seen.seen.textures && seen.sent == SurfaceFacts::default());
        let behind = facts(Vec3::Z * 5.0, whole.clone());
        assert_eq!((behind.seen, behind.sent), Default::default());
        // An unlit surface has neither gloss nor emission, and sends nothing.
        let unlit = Material {
            unlit: true,
            ..whole
        };
        let unlit = facts(ahead, unlit);
        assert!(!unlit.glossy_receivers && !unlit.reflecting_senders);
        assert!(unlit.seen.unlit && unlit.sent.unlit && unlit.seen.textures);
        assert!(!unlit.seen.normal_maps && !unlit.seen.emission);
        // An emissive texture alone is read by the camera where there is emission to multiply.
        let dark = Material {
            emissive_texture: Some(TextureRef::new(0)),
            ..Material::default()
        };
        assert!(!facts(ahead, dark).seen.textures);
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
