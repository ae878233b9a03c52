//! Picture of where a picture is wrong.

use crate::output::color;
use crate::output::font::{self, Canvas};
use vsgl_core::metrics::{Plane, relative_error};

/// Errors at the two ends of the scale, which is logarithmic.
const ENDS: (f64, f64) = (1e-3, 1.0);
/// Colour of pixels without reference light.
const DARK: [u8; 3] = [0x60, 0x70, 0x60];
/// Colour of pixels that are not finite.
const BROKEN: [u8; 3] = [0, 0xff, 0];
const WHITE: [u8; 3] = [0xff; 3];
/// Least width, so that the legend fits.
const WIDTH_MIN: usize = 170;

/// Draws the relative error of each pixel, and a legend below it.
pub(super) fn draw(test: &Plane, reference: &Plane, eps: f64) -> Canvas {
    let (width, height) = (test.width() as usize, test.height() as usize);
    let mut canvas = Canvas::new(width.max(WIDTH_MIN), height + 36, [0; 3]);
    let pairs = test.values().iter().zip(reference.values());
    for (index, (&x, &r)) in pairs.enumerate() {
        let color = if !(x.is_finite() && r.is_finite()) {
            BROKEN
        } else if r == 0.0 {
            DARK
        } else {
            color::scale(share(relative_error(x, r, eps)))
        };
        canvas.set(index % width, index / width, color);
    }
    legend(&mut canvas, height);
    canvas
}

/// Place of an error on the scale.
fn share(error: f64) -> f32 {
    let (low, high) = ENDS;
    ((error.max(low) / low).ln() / (high / low).ln()) as f32
}

fn legend(canvas: &mut Canvas, top: usize) {
    let width = canvas.width;
    for x in 0..width {
        let color = color::scale(x as f32 / (width - 1) as f32);
        (top + 2..top + 12).for_each(|y| canvas.set(x, y, color));
    }
    for (index, label) in ["0.1%", "1%", "10%", "100%"].into_iter().enumerate() {
        let place = (width - 1) * index / 3;
        (top + 10..top + 14).for_each(|y| canvas.set(place, y, WHITE));
        let length = label.len() * font::WIDTH;
        let left = place.saturating_sub(length / 2).min(width - length);
        font::draw(canvas, label, left, top + 15, WHITE);
    }
    let mut left = 0;
    for (label, color) in [("dark", DARK), ("not finite", BROKEN)] {
        for (x, y) in (0..7).flat_map(|x| (0..7).map(move |y| (x, y))) {
            canvas.set(left + x, top + 26 + y, color);
        }
        font::draw(canvas, label, left + 10, top + 26, WHITE);
        left += 16 + label.len() * font::WIDTH;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_placed_by_decade_and_faults_have_their_own_colours() {
        assert_eq!(share(0.0), 0.0);
        assert!((share(0.01) - 1.0 / 3.0).abs() < 1e-6);
        assert!((share(1.0) - 1.0).abs() < 1e-6);
        let plane = |values: Vec<f64>| Plane::new(3, 1, values).expect("test data fits");
        let test = plane(vec![1.1, 1.0, f64::NAN]);
        let canvas = draw(&test, &plane(vec![1.0, 0.0, 1.0]), 0.01);
        let error = color::scale(share(0.1));
        assert_eq!(canvas.pixels[..3], [error, DARK, BROKEN]);
    }
}
