//! The shadow maps of the clusters, side by side.

use crate::output::font::Canvas;
use vsgl_core::data::Occlusion;

/// Most pixels along a side of the picture: maps that do not fit are left out.
const SIDE_MAX: usize = 4096;

/// All maps in rows, as many as a square picture holds: the nearer a surface, the brighter, on a scale of logarithms from the
/// nearest to the farthest; black where there is none.
pub(super) fn draw(maps: &Occlusion) -> Canvas {
    let side = (maps.side as usize).max(1);
    let texels = side * side;
    let count = maps.depth.len() / texels;
    let row = (1..=SIDE_MAX / side)
        .find(|r| r * r >= count)
        .unwrap_or(SIDE_MAX / side);
    let rows = count.div_ceil(row.max(1)).clamp(1, row.max(1));
    let hit = |depth: &&f32| **depth < f32::MAX;
    let (mut low, mut high) = (f32::MAX, f32::MIN_POSITIVE);
    for &depth in maps.depth.iter().filter(hit) {
        (low, high) = (low.min(depth), high.max(depth));
    }
    let (far, span) = (
        high.ln(),
        (high / low.max(f32::MIN_POSITIVE)).ln().max(1e-3),
    );
    let grey = |depth: f32| {
        if depth < f32::MAX {
            (40.0 + 215.0 * ((far - depth.ln()) / span).clamp(0.0, 1.0)) as u8
        } else {
            0
        }
    };
    let mut canvas = Canvas::new(row * side, rows * side, [0; 3]);
    for (index, map) in maps.depth.chunks(texels).take(row * rows).enumerate() {
        let (left, top) = (index % row * side, index / row * side);
        for (i, &depth) in map.iter().enumerate() {
            canvas.set(left + i % side, top + i / side, [grey(depth); 3]);
        }
    }
    canvas
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearer_is_brighter_and_nothing_is_black() {
        let maps = Occlusion {
            maps: 3,
            side: 1,
            depth: vec![1.0, 8.0, f32::MAX],
        };
        let canvas = draw(&maps);
        let red: Vec<u8> = canvas.pixels.iter().map(|p| p[0]).collect();
        assert_eq!((canvas.width, canvas.height), (2, 2));
        assert!(red[0] > red[1] && red[1] > 0);
        assert_eq!(red[2..], [0, 0]);
        let none = draw(&Occlusion::default());
        assert_eq!((none.width, none.height), (1, 1));
    }
}
