//! A Cornell-like room.

use super::builder::{Builder, Spot, Walls};
use crate::scene::Material;
use glam::Vec3;

/// A red and a green wall, a copper block that throws the light of the spot on, a white block in its shadow, and a
/// varnished floor that shows both.
pub(super) fn scene() -> Builder {
    let mut b = Builder::default();
    let white = b.material(Material::lambert("white", [0.73, 0.73, 0.73]));
    let red = b.material(Material::lambert("red", [0.63, 0.06, 0.05]));
    let green = b.material(Material::lambert("green", [0.13, 0.45, 0.09]));
    let floor = b.material(Material::dielectric("varnish", [0.52, 0.50, 0.46], 0.3));
    let copper = b.material(Material::metal("copper", [0.95, 0.64, 0.54], 0.25));
    b.room(
        Vec3::new(-1.6, 0.0, -1.5),
        Vec3::new(1.6, 2.0, 2.6),
        &Walls {
            floor,
            ceiling: white,
            back: white,
            front: white,
            left: red,
            right: green,
        },
    );
    b.block(
        Vec3::new(-0.55, 0.62, -0.55),
        Vec3::new(0.33, 0.62, 0.33),
        20.0,
        copper,
    );
    b.block(
        Vec3::new(0.55, 0.3, -0.1),
        Vec3::new(0.3, 0.3, 0.3),
        -18.0,
        white,
    );
    b.spot(Spot {
        position: Vec3::new(1.1, 1.9, 0.9),
        target: Vec3::new(-0.75, 0.75, -0.8),
        intensity: [40.0, 38.0, 34.0],
        inner: 16.0,
        outer: 26.0,
    });
    b.camera(Vec3::new(0.0, 1.0, 2.5), Vec3::new(0.0, 0.9, 0.0), 44.0);
    b
}
