//! One corner of a room, written in many ways: all must come to the same.

use crate::assets;
use vsgl_core::glam::{DVec3, Vec3};
use vsgl_core::scene::{Light, Scene, gltf};

/// Files and their scale and offset against `base_corner.gltf`.
const VARIANTS: &[(&str, f64, DVec3)] = &[
    ("indices_u8", 1.0, DVec3::ZERO),
    ("indices_u32", 1.0, DVec3::ZERO),
    ("no_indices", 1.0, DVec3::ZERO),
    ("no_normals", 1.0, DVec3::ZERO),
    ("strip_and_fan", 1.0, DVec3::ZERO),
    ("zero_area_mixed", 1.0, DVec3::ZERO),
    ("no_materials", 1.0, DVec3::ZERO),
    ("points_and_lines", 1.0, DVec3::ZERO),
    ("scale_1e-4", 1e-4, DVec3::ZERO),
    ("scale_1e5", 1e5, DVec3::ZERO),
    ("offset_1e6", 1.0, DVec3::new(1e6, 0.0, -1e6)),
];

#[test]
fn the_same_corner_in_every_writing() {
    let Some(root) = assets("scenes-conformance/generated", "11 corners") else {
        return;
    };
    let read = |name: &str| gltf::load(&root.join(format!("{name}.gltf"))).expect(name);
    let base = read("base_corner");
    for &(name, scale, offset) in VARIANTS {
        let scene = read(name);
        let moved = scene.origin - (base.origin * scale + offset);
        assert!(moved.length() <= 1e-9 * scale, "{name}: {moved}");
        let expected = corners(&base, scale);
        assert_eq!(corners(&scene, 1.0).len(), expected.len(), "{name}");
        for (corner, normal) in corners(&scene, 1.0) {
            let found = expected.iter().any(|(c, n)| {
                c.distance(corner) <= 1e-6 * scale as f32 && n.distance(normal) <= 1e-6
            });
            assert!(found, "{name}: {corner} {normal}");
        }
        let (eye, expected) = (scene.cameras[0].1.eye, base.cameras[0].1.eye);
        assert!(
            eye.distance(expected * scale as f32) <= 1e-6 * scale as f32,
            "{name}"
        );
        let (Light::Spot(light), Light::Spot(expected)) = (scene.lights[0], base.lights[0]) else {
            panic!("{name}: a spot is expected");
        };
        let place = expected.position * scale as f32;
        assert!(
            light.position.distance(place) <= 1e-6 * scale as f32,
            "{name}"
        );
        assert_eq!(light.axis, expected.axis, "{name}");
    }
}

/// Corners of all triangles with their normals.
fn corners(scene: &Scene, scale: f64) -> Vec<(Vec3, Vec3)> {
    let mesh = &scene.mesh;
    let corners = mesh.triangles.as_flattened().iter();
    corners
        .map(|&v| {
            (
                mesh.positions[v as usize] * scale as f32,
                mesh.normals[v as usize],
            )
        })
        .collect()
}
