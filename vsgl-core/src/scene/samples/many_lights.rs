//! A gallery under many lights.

use super::builder::{Builder, Spot, Walls};
use crate::scene::Material;
use glam::Vec3;

/// Most lights of `many-lights:N`. Each has a map of its own: 16 of the usual size take a few hundred megabytes.
pub const LIGHTS_MAX: u32 = 16;

/// Colours of the lights, in turn.
const COLORS: [[f32; 3]; 4] = [
    [1.0, 0.85, 0.65],
    [0.65, 0.8, 1.0],
    [1.0, 0.6, 0.5],
    [0.7, 1.0, 0.7],
];

/// A hall with blocks on a varnished floor under `count` spots in a grid: how time and error grow with the number of
/// lights, and how clusters are shared out between their maps. The sum of all intensities does not depend on `count`.
pub(super) fn scene(count: u32) -> Builder {
    let mut b = Builder::default();
    let wall = b.material(Material::lambert("wall", [0.7, 0.7, 0.7]));
    let floor = b.material(Material::dielectric("varnish", [0.45, 0.40, 0.34], 0.25));
    let steel = b.material(Material::metal("steel", [0.80, 0.80, 0.82], 0.3));
    let clay = b.material(Material::lambert("clay", [0.60, 0.28, 0.16]));
    let (low, high) = (Vec3::new(-4.0, 0.0, -5.0), Vec3::new(4.0, 3.0, 4.0));
    b.room(
        low,
        high,
        &Walls {
            floor,
            ceiling: wall,
            back: wall,
            front: wall,
            left: wall,
            right: wall,
        },
    );
    for i in 0..9 {
        let (column, row) = (i % 3, i / 3);
        let half = Vec3::new(0.35, 0.35 + 0.15 * ((i * 5) % 4) as f32, 0.35);
        let centre = Vec3::new(
            2.2 * (column as f32 - 1.0),
            half.y,
            2.2 * (row as f32 - 1.0) - 1.6,
        );
        let material = if i % 2 == 0 { steel } else { clay };
        b.block(centre, half, 17.0 * i as f32, material);
    }
    let columns = f64::from(count).sqrt().ceil() as u32;
    let rows = count.div_ceil(columns);
    for i in 0..count {
        let place = |n: u32, of: u32| (n as f32 + 0.5) / of as f32;
        let x = low.x + (high.x - low.x) * place(i % columns, columns);
        let z = low.z + (2.0 - low.z) * place(i / columns, rows);
        let share = 240.0 / count as f32;
        b.spot(Spot {
            position: Vec3::new(x, 2.9, z),
            target: Vec3::new(0.7 * x, 0.0, z - 0.4),
            intensity: COLORS[(i % 4) as usize].map(|c| c * share),
            inner: 18.0,
            outer: 32.0,
        });
    }
    b.camera(Vec3::new(0.4, 1.7, 3.8), Vec3::new(0.0, 0.8, -1.0), 50.0);
    b
}
