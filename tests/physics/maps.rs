//! What shadow maps must not do: let light through a wall, or hold it back where nothing is in its way.

use super::furnace::sphere;
use vsgl_core::glam::Vec3;
use vsgl_core::metrics::luminance;
use vsgl_core::scene::{Camera, Light, Material, Mesh, Scene, SpotLight};
use vsgl_tests::render::Shot;

const KINDS: [&str; 2] = ["ism", "ism-tessellated"];

/// Indirect light of all pixels.
fn light(shot: &Shot) -> f64 {
    shot.image().indirect().into_iter().map(luminance).sum()
}

/// A square across the x axis, in `cuts` by `cuts` pieces.
fn wall(mesh: &mut Mesh, x: f32, half: f32, cuts: u32, normal: Vec3) {
    let first = mesh.positions.len() as u32;
    let at = |i: u32| (2.0 * i as f32 / cuts as f32 - 1.0) * half;
    for row in 0..=cuts {
        for column in 0..=cuts {
            mesh.positions.push(Vec3::new(x, at(row), at(column)));
            mesh.normals.push(normal);
        }
    }
    for row in 0..cuts {
        for column in 0..cuts {
            let a = first + row * (cuts + 1) + column;
            let (b, c, d) = (a + 1, a + cuts + 1, a + cuts + 2);
            mesh.triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
    mesh.material = vec![0; mesh.triangles.len()];
}

/// Two walls, one of them lit and the other seen, and a third between them that is so finely cut; without it for 0 cuts.
fn walls(cuts: u32) -> Shot {
    let mut mesh = Mesh::default();
    wall(&mut mesh, -2.0, 2.0, 1, Vec3::X);
    wall(&mut mesh, 2.0, 2.0, 1, Vec3::NEG_X);
    if cuts > 0 {
        wall(&mut mesh, 0.0, 6.0, cuts, Vec3::X);
    }
    let light = SpotLight {
        position: Vec3::new(-0.5, 0.1, 0.2),
        axis: Vec3::NEG_X,
        intensity: [10.0; 3],
        inner: 0.5,
        outer: 0.7,
        range: f32::INFINITY,
    };
    Shot::of(Scene {
        mesh,
        materials: vec![Material::lambert("matte", [0.8; 3])],
        lights: vec![Light::Spot(light)],
        cameras: vec![(
            "main".into(),
            Camera::look_at(Vec3::new(0.5, 0.0, 0.0), Vec3::X, 1.2),
        )],
        ..Scene::default()
    })
}

/// A wall of two triangles and one of many small ones, of which a draw stands for several.
#[test]
fn no_light_comes_through_a_wall() {
    let free = light(&walls(0).with("occlusion=none"));
    assert!(free > 0.0);
    for kind in KINDS {
        for (cuts, points) in [(1, 8192), (48, 8192), (48, 512), (48, 16)] {
            let settings = format!("occlusion={kind} map_points={points}");
            let leak = light(&walls(cuts).with(&settings)) / free;
            println!("{cuts} cuts, {settings}: {:.3} % leaks", 100.0 * leak);
            assert!(leak <= LEAK, "{cuts} cuts, {settings}: {leak} of the light");
        }
    }
}

/// Share of the light that a wall may let through: where discs leave a gap, a map sees the wall behind.
const LEAK: f64 = 0.02;

#[test]
fn nothing_is_held_back_where_nothing_is_in_the_way() {
    let free = light(&walls(0).with("occlusion=none"));
    let round = light(&Shot::of(sphere()).with("occlusion=none"));
    for kind in KINDS {
        let settings = format!("occlusion={kind}");
        let lost = 1.0 - light(&walls(0).with(&settings)) / free;
        println!("two walls, {kind}: {:.3} % is lost", 100.0 * lost);
        assert!(lost.abs() <= 1e-6, "two walls, {kind}: {lost} of the light");
        let lost = 1.0 - light(&Shot::of(sphere()).with(&settings)) / round;
        println!("a sphere, {kind}: {:.3} % is lost", 100.0 * lost);
        assert!(lost.abs() <= LOST, "a sphere, {kind}: {lost} of the light");
    }
}

/// Share of the light that facets of a sphere may hold back where they are nearer than a texel.
const LOST: f64 = 0.02;
