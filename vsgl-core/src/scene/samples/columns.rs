//! A hall of columns.

use super::builder::{Builder, Spot, Walls};
use crate::scene::Material;
use glam::Vec3;

/// Two rows of stone columns. The spot shines from the right aisle across the hall, so that half of what the camera
/// sees is in the columns' shadows, and lit indirectly.
pub(super) fn scene() -> Builder {
    let mut b = Builder::default();
    let plaster = b.material(Material::lambert("plaster", [0.70, 0.67, 0.62]));
    let orange = b.material(Material::lambert("orange", [0.75, 0.35, 0.08]));
    let teal = b.material(Material::lambert("teal", [0.07, 0.40, 0.45]));
    let stone = b.material(Material::dielectric("stone", [0.60, 0.57, 0.52], 0.35));
    let marble = b.material(Material::dielectric("marble", [0.55, 0.53, 0.50], 0.2));
    let brass = b.material(Material::metal("brass", [0.89, 0.76, 0.42], 0.3));
    b.room(
        Vec3::new(-3.0, 0.0, -5.0),
        Vec3::new(3.0, 3.0, 4.5),
        &Walls {
            floor: marble,
            ceiling: plaster,
            back: plaster,
            front: plaster,
            left: teal,
            right: orange,
        },
    );
    for row in [-1.0, 1.0] {
        for i in 0..4 {
            let foot = Vec3::new(1.25 * row, 0.0, -3.6 + 1.8 * i as f32);
            b.cylinder(foot, 0.30, 0.16, brass);
            // Into the foot and the ceiling, so that no two faces lie in one plane.
            b.cylinder(foot + Vec3::Y * 0.1, 0.22, 2.95, stone);
        }
    }
    b.spot(Spot {
        position: Vec3::new(2.6, 2.7, 2.6),
        target: Vec3::new(-1.2, 0.3, -1.6),
        intensity: [110.0, 104.0, 92.0],
        inner: 26.0,
        outer: 34.0,
    });
    b.camera(Vec3::new(-0.5, 1.5, 4.2), Vec3::new(0.15, 1.25, -1.0), 50.0);
    b
}
