//! Roughness, step by step.

use super::builder::{Builder, Spot, Walls};
use crate::scene::Material;
use glam::Vec3;

/// Perceptual roughness of the spheres, from left to right.
const ROUGHNESS: [f32; 6] = [0.2, 0.3, 0.4, 0.5, 0.65, 0.8];

/// Six golden spheres before coloured walls: what they mirror, and the light that they throw around them.
pub(super) fn scene() -> Builder {
    let mut b = Builder::default();
    let white = b.material(Material::lambert("white", [0.72, 0.72, 0.72]));
    let left = b.material(Material::lambert("violet", [0.40, 0.10, 0.55]));
    let right = b.material(Material::lambert("green", [0.15, 0.50, 0.20]));
    b.room(
        Vec3::new(-2.6, 0.0, -1.2),
        Vec3::new(2.6, 2.4, 3.4),
        &Walls {
            floor: white,
            ceiling: white,
            back: white,
            front: white,
            left,
            right,
        },
    );
    for (i, roughness) in ROUGHNESS.into_iter().enumerate() {
        let gold = Material::metal(
            &format!("gold, roughness {roughness}"),
            [0.94, 0.75, 0.42],
            roughness,
        );
        let material = b.material(gold);
        let x = 0.68 * (i as f32 - 2.5);
        b.sphere(Vec3::new(x, 0.31, -0.1), 0.305, 64, material);
    }
    b.spot(Spot {
        position: Vec3::new(0.0, 2.35, 2.4),
        target: Vec3::new(0.0, 0.2, -0.2),
        intensity: [60.0, 58.0, 54.0],
        inner: 34.0,
        outer: 42.0,
    });
    b.camera(Vec3::new(0.0, 1.1, 3.2), Vec3::new(0.0, 0.42, 0.0), 39.0);
    b
}
