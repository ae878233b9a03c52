//! The clusters of a map drawn over its flux, as in figure 1 of Tokuyoshi 2016.

use super::map::Map;
use crate::output::color;
use crate::output::font::Canvas;
use vsgl_core::data::Vsgls;

const DARK: [u8; 3] = [0; 3];
const WHITE: [u8; 3] = [0xff; 3];

/// A partition as areas of one colour with borders and their representative texels, filtered kernels as squares, whole maps by
/// their representative texels alone.
pub(super) fn draw(map: &Map<'_>, vsgls: &Vsgls) -> Canvas {
    if map.labels.is_empty() {
        kernels(map, vsgls)
    } else {
        partition(map, vsgls)
    }
}

fn partition(map: &Map<'_>, vsgls: &Vsgls) -> Canvas {
    let brightness = map.brightness();
    let labels = map.labels;
    let mut canvas = map.canvas(|i| match labels[i] {
        u32::MAX => DARK,
        label => shade(color::category(label), 0.35 + 0.65 * brightness[i]),
    });
    for y in 0..map.size {
        for x in 0..map.size {
            let here = labels[y * map.size + x];
            let differs = |x: usize, y: usize| {
                x < map.size && y < map.size && labels[y * map.size + x] != here
            };
            let (left, top, zoom) = (x * map.zoom, y * map.zoom, map.zoom);
            if differs(x + 1, y) {
                (0..zoom).for_each(|i| canvas.set(left + zoom - 1, top + i, DARK));
            }
            if differs(x, y + 1) {
                (0..zoom).for_each(|i| canvas.set(left + i, top + zoom - 1, DARK));
            }
        }
    }
    dots(&mut canvas, map, vsgls);
    canvas
}

/// The texels that stand for the clusters of a map.
fn dots(canvas: &mut Canvas, map: &Map<'_>, vsgls: &Vsgls) {
    let texels = map.size * map.size;
    for &texel in &vsgls.texel {
        if let Some(i) = (texel as usize)
            .checked_sub(map.first())
            .filter(|i| *i < texels)
        {
            let place = |v: usize| v * map.zoom + map.zoom / 2;
            dot(canvas, place(i % map.size), place(i / map.size), WHITE);
        }
    }
}

fn kernels(map: &Map<'_>, vsgls: &Vsgls) -> Canvas {
    let brightness = map.brightness();
    let mut canvas = map.canvas(|i| [(200.0 * brightness[i]) as u8; 3]);
    for (index, &[of, x, y, side]) in vsgls.kernel.iter().enumerate() {
        if of as u32 != map.index {
            continue;
        }
        let color = color::category(index as u32);
        let zoom = map.zoom as f32;
        square(&mut canvas, [x * zoom, y * zoom], 0.5 * side * zoom, color);
        dot(&mut canvas, (x * zoom) as usize, (y * zoom) as usize, color);
    }
    if vsgls.kernel.is_empty() {
        dots(&mut canvas, map, vsgls);
    }
    canvas
}

/// The outline of a square; what lies outside the canvas is cut off.
fn square(canvas: &mut Canvas, [x, y]: [f32; 2], half: f32, color: [u8; 3]) {
    let ends = |centre: f32| {
        let low = (centre - half).round().max(-1.0) as i64;
        let high = (centre + half).round().min(canvas.width as f32) as i64;
        (low, high)
    };
    let ((left, right), (top, bottom)) = (ends(x), ends(y));
    let mut set = |x: i64, y: i64| {
        if let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) {
            canvas.set(x, y, color);
        }
    };
    for x in left..=right {
        set(x, top);
        set(x, bottom);
    }
    for y in top..=bottom {
        set(left, y);
        set(right, y);
    }
}

/// Two by two pixels.
fn dot(canvas: &mut Canvas, x: usize, y: usize, color: [u8; 3]) {
    for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        canvas.set(x + dx, y + dy, color);
    }
}

fn shade(color: [u8; 3], factor: f32) -> [u8; 3] {
    color.map(|c| (f32::from(c) * factor) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_are_cut_at_the_edge() {
        let mut canvas = Canvas::new(8, 8, DARK);
        square(&mut canvas, [0.0, 4.0], 2.0, WHITE);
        let lit = |x: usize, y: usize| canvas.pixels[y * 8 + x] == WHITE;
        assert!(lit(0, 2) && lit(2, 2) && lit(2, 6) && lit(2, 4));
        assert!(!lit(0, 4) && !lit(1, 4));
        square(&mut canvas, [1e9, -1e9], 1e20, WHITE);
    }
}
