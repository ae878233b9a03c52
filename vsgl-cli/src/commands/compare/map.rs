//! Picture of where a picture is wrong.

use crate::output::font::Canvas;
use crate::output::legend::Scale;
use vsgl_core::metrics::{Plane, relative_error};

/// Colour of pixels without reference light.
const DARK: [u8; 3] = [0x60, 0x70, 0x60];
/// Colour of pixels that are not finite.
const BROKEN: [u8; 3] = [0, 0xff, 0];
const SCALE: Scale = Scale {
    ends: (1e-3, 1.0),
    labels: &["0.1%", "1%", "10%", "100%"],
    marks: &[("dark", DARK), ("not finite", BROKEN)],
};

/// Draws the relative error of each pixel, and a legend below it.
pub(super) fn draw(test: &Plane, reference: &Plane, eps: f64) -> Canvas {
    let (width, height) = (test.width() as usize, test.height() as usize);
    let mut canvas = SCALE.canvas(width, height);
    let pairs = test.values().iter().zip(reference.values());
    for (index, (&x, &r)) in pairs.enumerate() {
        let color = if !(x.is_finite() && r.is_finite()) {
            BROKEN
        } else if r == 0.0 {
            DARK
        } else {
            SCALE.color(relative_error(x, r, eps))
        };
        canvas.set(index % width, index / width, color);
    }
    canvas
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_have_the_colours_of_the_scale_and_faults_their_own() {
        let plane = |values: Vec<f64>| Plane::new(3, 1, values).expect("test data fits");
        let test = plane(vec![1.1, 1.0, f64::NAN]);
        let canvas = draw(&test, &plane(vec![1.0, 0.0, 1.0]), 0.01);
        let error = SCALE.color(0.1);
        assert_eq!(canvas.pixels[..3], [error, DARK, BROKEN]);
    }
}
