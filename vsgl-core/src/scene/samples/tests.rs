use super::*;
use crate::scene::{Light, SceneFacts, SpotLight};

fn all() -> Vec<Scene> {
    NAMES
        .iter()
        .map(|name| by_name(&name.replace(":N", ":4")).unwrap())
        .collect()
}

#[test]
fn every_sample_has_a_light_a_camera_and_glossy_surfaces_on_both_ends() {
    for scene in all() {
        assert_eq!(scene.cameras.len(), 1, "{}", scene.name);
        assert_eq!(scene.cameras[0].0, "main");
        let facts = SceneFacts::new(&scene, &scene.lights, &scene.cameras[0].1);
        assert!(facts.lights > 0 && facts.glossy_senders && facts.glossy_receivers);
        assert_eq!((facts.seen, facts.sent), Default::default());
        for light in &scene.lights {
            let Light::Spot(spot) = light else {
                panic!("{light:?}")
            };
            assert!(spot.axis.is_normalized());
            assert!(spot.inner < spot.outer && spot.outer <= SpotLight::ONE_MAP_MAX);
        }
    }
}

#[test]
fn columns_of_the_mesh_fit_and_no_triangle_is_flat() {
    for Scene {
        name,
        mesh,
        materials,
        ..
    } in all()
    {
        assert_eq!(mesh.positions.len(), mesh.normals.len(), "{name}");
        assert_eq!(mesh.triangles.len(), mesh.material.len(), "{name}");
        assert!(
            mesh.material
                .iter()
                .all(|&m| (m as usize) < materials.len())
        );
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
            let face = (b - a).cross(c - a);
            assert!(face.length() > 1e-8, "{name}: {a} {b} {c}");
            for v in *triangle {
                let normal = mesh.normals[v as usize];
                assert!(normal.is_normalized(), "{name}: {normal}");
                assert!(face.normalize().dot(normal) > 0.9, "{name}: inside out");
            }
        }
    }
}

/// Every edge has two triangles with opposite directions, once vertices at one place are taken for one.
#[test]
fn geometry_is_closed() {
    for Scene { name, mesh, .. } in all() {
        let key = |v: u32| {
            mesh.positions[v as usize]
                .to_array()
                .map(|x| (x * 1e5).round() as i64)
        };
        let mut edges = std::collections::HashMap::new();
        for t in &mesh.triangles {
            for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                *edges.entry((key(a), key(b))).or_insert(0) += 1;
                *edges.entry((key(b), key(a))).or_insert(0) -= 1;
            }
        }
        assert!(edges.values().all(|&n| n == 0), "{name}");
    }
}

#[test]
fn the_origin_is_the_centre_and_camera_and_lights_are_inside() {
    for scene in all() {
        let (low, high) = scene.bounds();
        assert!((low + high).length() < 1e-5, "{}", scene.name);
        let inside = |p: glam::Vec3| p.cmpgt(low).all() && p.cmplt(high).all();
        assert!(inside(scene.cameras[0].1.eye), "{}", scene.name);
        for light in &scene.lights {
            let Light::Spot(spot) = light else {
                panic!("{light:?}")
            };
            assert!(inside(spot.position), "{}", scene.name);
        }
    }
}

#[test]
fn many_lights_has_as_many_as_asked() {
    for n in [1, 2, 7, LIGHTS_MAX] {
        let scene = by_name(&format!("many-lights:{n}")).unwrap();
        assert_eq!(scene.lights.len(), n as usize);
    }
}

#[test]
fn wrong_names_say_what_is_right() {
    for name in ["cornel", "", "cornell:3", "cornell:"] {
        let message = by_name(name).unwrap_err().to_string();
        assert!(message.contains("cornell, glossy-floor"), "{message}");
    }
    for name in [
        "many-lights",
        "many-lights:0",
        "many-lights:17",
        "many-lights:N",
    ] {
        let message = by_name(name).unwrap_err().to_string();
        assert!(message.contains("from 1 to 16"), "{message}");
    }
}

#[test]
fn every_name_is_described() {
    for name in NAMES {
        assert!(describe(name).is_some_and(|about| !about.is_empty()));
    }
    assert_eq!(describe("no such scene"), None);
}
