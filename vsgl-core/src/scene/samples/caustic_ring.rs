//! A ring that gathers light.

use super::builder::{Builder, Spot, Walls};
use crate::scene::Material;
use glam::Vec3;

/// A steel ring lies on a matte floor. Its inner wall throws the light of the spot onto the floor inside it, in the
/// heart-shaped curve of a concave mirror; its outer wall throws a fan onto the floor beside it.
pub(super) fn scene() -> Builder {
    let mut b = Builder::default();
    let wall = b.material(Material::lambert("wall", [0.45, 0.47, 0.50]));
    let floor = b.material(Material::lambert("floor", [0.62, 0.60, 0.56]));
    let steel = b.material(Material::metal("steel", [0.90, 0.86, 0.78], 0.15));
    b.room(
        Vec3::new(-2.0, 0.0, -2.0),
        Vec3::new(2.0, 2.4, 2.4),
        &Walls {
            floor,
            ceiling: wall,
            back: wall,
            front: wall,
            left: wall,
            right: wall,
        },
    );
    // A hair above the floor: its bottom does not lie in the floor's plane.
    b.pipe(Vec3::new(0.0, 0.001, 0.0), 0.62, 0.66, 0.3, 128, steel);
    b.spot(Spot {
        position: Vec3::new(-1.6, 1.7, -1.2),
        target: Vec3::new(0.1, 0.1, 0.1),
        intensity: [36.0, 35.0, 33.0],
        inner: 22.0,
        outer: 26.0,
    });
    b.camera(Vec3::new(0.0, 1.75, 1.9), Vec3::new(0.0, 0.05, 0.05), 45.0);
    b
}
