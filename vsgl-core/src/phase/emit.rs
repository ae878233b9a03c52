//! The map of the surfaces that shine: points of them instead of what a light sees.

use super::rsm::Texel;
use crate::data::{EmitterRecord, MapRecord, map_kind};

/// The frame of the map of emitters: it has none, since its texels lie wherever surfaces shine.
pub fn map() -> MapRecord {
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    MapRecord {
        tan_half_fov: 1.0,
        axis: z,
        right: x,
        up: y,
        kind: map_kind::EMITTERS,
        cone: z,
        ..MapRecord::default()
    }
}

/// Which point a texel of the map holds: of more points than texels every so-manieth. None beyond the last point.
pub fn point(index: u32, texels: u32, points: u32) -> Option<u32> {
    if points <= texels {
        (index < points).then_some(index)
    } else {
        // Fits into 32 bits: there are 2¹⁶ points at most, and fewer texels.
        Some((index * points + points / 2) / texels)
    }
}

/// A texel of the map, `texels` in all and `points` to fill them with: the point's flux leaves its surface as from a Lambert
/// surface without a dielectric layer.
pub fn texel(emitter: &EmitterRecord, texels: u32, points: u32) -> Texel {
    let times = (points as f32 / texels as f32).max(1.0);
    let [x, y, z] = emitter.position;
    let [nx, ny, nz] = emitter.normal;
    let [r, g, b] = emitter.flux;
    Texel {
        triangle: emitter.triangle,
        position: [x, y, z, emitter.area * times],
        normal: [nx, ny, nz, 0.0],
        diffuse: [r * times, g * times, b * times, 0.0],
        // Of a specular part that is black, but has roughnesses.
        tangent: [1.0, 0.0, 0.0, 1.0],
        ..Texel::EMPTY
    }
}
