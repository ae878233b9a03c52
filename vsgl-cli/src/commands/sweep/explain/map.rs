//! Pictures of where a cause makes a picture too bright or too dark.

use crate::output::color;
use crate::output::font::{self, Canvas};
use crate::output::legend::{HEIGHT, WIDTH_MIN};

const WHITE: [u8; 3] = [0xff; 3];
/// Colour of pixels without light.
const DARK: [u8; 3] = [0x60, 0x70, 0x60];
/// Relative errors at the middle and at the ends of the scale.
const ENDS: (f64, f64) = (0.01, 1.0);
const LABELS: [&str; 5] = ["-100%", "-10%", "1%", "10%", "100%"];
/// Pixels that a picture is made as wide as, about.
const WIDTH: usize = 640;

/// Draws what each pixel is wrong by, as shares of its truth. Pixels of a grid become squares.
pub(super) fn draw(step: &[f64], truth: &[f64], (width, height): (u32, u32)) -> Canvas {
    let mean = truth.iter().sum::<f64>() / truth.len().max(1) as f64;
    let floor = (ENDS.0 * mean.abs()).max(f64::MIN_POSITIVE);
    let color = |at: usize| {
        if truth[at] == 0.0 {
            DARK
        } else {
            color::signed(share(step[at] / truth[at].max(floor)))
        }
    };
    let mut canvas = squares(width, height, color);
    let top = canvas.height;
    let mut below = Canvas::new(canvas.width.max(WIDTH_MIN), top + HEIGHT, [0; 3]);
    for (at, &pixel) in canvas.pixels.iter().enumerate() {
        below.set(at % canvas.width, at / canvas.width, pixel);
    }
    std::mem::swap(&mut canvas, &mut below);
    legend(&mut canvas, top);
    canvas
}

/// Draws pixels of a grid as squares, about as wide as a picture.
pub(super) fn squares(width: u32, height: u32, color: impl Fn(usize) -> [u8; 3]) -> Canvas {
    let (width, height) = (width as usize, height as usize);
    let side = (WIDTH / width.max(1)).clamp(1, 32);
    let mut canvas = Canvas::new(width * side, height * side, [0; 3]);
    for y in 0..height * side {
        for x in 0..width * side {
            canvas.set(x, y, color(y / side * width + x / side));
        }
    }
    canvas
}

/// Place of a relative error on the scale, -1..=1.
fn share(error: f64) -> f32 {
    let size = error.abs().clamp(ENDS.0, ENDS.1);
    let share = (size / ENDS.0).ln() / (ENDS.1 / ENDS.0).ln();
    (share * error.signum()) as f32
}

fn legend(canvas: &mut Canvas, top: usize) {
    let width = canvas.width;
    for x in 0..width {
        let color = color::signed(2.0 * x as f32 / (width - 1) as f32 - 1.0);
        (top + 2..top + 12).for_each(|y| canvas.set(x, y, color));
    }
    for (index, label) in LABELS.iter().enumerate() {
        let place = (width - 1) * index / (LABELS.len() - 1);
        (top + 10..top + 14).for_each(|y| canvas.set(place, y, WHITE));
        let length = label.len() * font::WIDTH;
        let left = place.saturating_sub(length / 2).min(width - length);
        font::draw(canvas, label, left, top + 15, WHITE);
    }
    for (x, y) in (0..7).flat_map(|x| (0..7).map(move |y| (x, y))) {
        canvas.set(x, top + 26 + y, DARK);
    }
    font::draw(canvas, "dark", 10, top + 26, WHITE);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_much_and_too_little_have_their_colours() {
        let truth = [1.0, 1.0, 0.0, 1.0];
        let canvas = draw(&[0.1, -0.1, 5.0, 0.001], &truth, (4, 1));
        let at = |column: usize| canvas.pixels[column * 32];
        assert_eq!(at(0), color::signed(0.5));
        assert_eq!(at(1), color::signed(-0.5));
        assert_eq!(at(2), DARK);
        assert_eq!(at(3), color::signed(0.0));
        assert_eq!(canvas.width, WIDTH_MIN);
    }
}
