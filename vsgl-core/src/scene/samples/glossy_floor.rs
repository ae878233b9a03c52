//! A floor that mirrors.

use super::builder::{Builder, Spot, Walls};
use crate::scene::Material;
use glam::Vec3;

/// Three coloured boards on a brushed metal floor. The floor shows the boards, which are lit, and throws the light
/// that it gets itself against the wall behind them.
pub(super) fn scene() -> Builder {
    let mut b = Builder::default();
    let wall = b.material(Material::lambert("wall", [0.7, 0.7, 0.7]));
    let floor = b.material(Material::metal("brushed metal", [0.82, 0.80, 0.76], 0.3));
    let boards = [
        ("red", [0.70, 0.08, 0.06]),
        ("yellow", [0.75, 0.55, 0.08]),
        ("blue", [0.08, 0.18, 0.65]),
    ];
    b.room(
        Vec3::new(-2.2, 0.0, -1.8),
        Vec3::new(2.2, 2.2, 3.0),
        &Walls {
            floor,
            ceiling: wall,
            back: wall,
            front: wall,
            left: wall,
            right: wall,
        },
    );
    for (i, (name, color)) in boards.into_iter().enumerate() {
        let material = b.material(Material::lambert(name, color));
        let i = i as f32 - 1.0;
        b.block(
            Vec3::new(1.05 * i, 0.55, -0.7 - 0.15 * i * i),
            Vec3::new(0.36, 0.55, 0.04),
            -18.0 * i,
            material,
        );
    }
    b.spot(Spot {
        position: Vec3::new(0.0, 2.1, 1.6),
        target: Vec3::new(0.0, 0.35, -0.6),
        intensity: [40.0, 39.0, 37.0],
        inner: 30.0,
        outer: 55.0,
    });
    b.camera(Vec3::new(0.3, 1.05, 2.7), Vec3::new(0.0, 0.55, -0.5), 42.0);
    b
}
