//! A ring that gathers light.

use super::builder::{Builder, Pipe, Spot, Walls};
use crate::scene::Material;
use glam::Vec3;

/// A ring stands on a matte floor, painted outside, steel inside. The light comes in so low that the floor within the
/// ring is in its shadow, and lit only by the steel, in the heart-shaped curve of a concave mirror.
pub(super) fn scene() -> Builder {
    let mut b = Builder::default();
    let wall = b.material(Material::lambert("wall", [0.45, 0.47, 0.50]));
    let floor = b.material(Material::lambert("floor", [0.62, 0.60, 0.56]));
    let steel = b.material(Material::metal("steel", [0.90, 0.86, 0.78], 0.3));
    let paint = b.material(Material::lambert("blue paint", [0.10, 0.22, 0.45]));
    b.room(
        Vec3::new(-3.2, 0.0, -2.4),
        Vec3::new(2.4, 2.4, 2.4),
        &Walls {
            floor,
            ceiling: wall,
            back: wall,
            front: wall,
            left: wall,
            right: wall,
        },
    );
    let ring = Pipe {
        inner: 0.62,
        outer: 0.66,
        height: 0.5,
        lining: steel,
        material: paint,
    };
    // A hair above the floor: its bottom does not lie in the floor's plane.
    b.pipe(Vec3::new(0.0, 0.001, 0.0), 128, &ring);
    b.spot(Spot {
        position: Vec3::new(-2.6, 1.75, -1.4),
        target: Vec3::new(0.0, 0.25, 0.0),
        intensity: [36.0, 35.0, 33.0],
        inner: 13.0,
        outer: 20.0,
    });
    b.camera(Vec3::new(0.2, 2.1, 1.75), Vec3::new(0.0, 0.1, 0.0), 38.0);
    b
}
