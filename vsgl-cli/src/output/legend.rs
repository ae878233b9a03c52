//! Maps of errors: a colour for each decade, and a legend below.

use super::color;
use super::font::{self, Canvas};

const WHITE: [u8; 3] = [0xff; 3];
/// Rows that a legend takes.
pub const HEIGHT: usize = 36;
/// Least width of a canvas that a legend fits below.
pub const WIDTH_MIN: usize = 170;

/// A logarithmic scale of errors, with labels at equal distances, and colours of what is not on it.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    /// Errors at the two ends.
    pub ends: (f64, f64),
    /// Labels from one end to the other.
    pub labels: &'static [&'static str],
    /// Colours with their meaning.
    pub marks: &'static [(&'static str, [u8; 3])],
}

impl Scale {
    /// Place of an error on the scale, 0..=1.
    pub fn share(&self, error: f64) -> f32 {
        let (low, high) = self.ends;
        ((error.clamp(low, high) / low).ln() / (high / low).ln()) as f32
    }

    /// Colour of an error.
    pub fn color(&self, error: f64) -> [u8; 3] {
        color::scale(self.share(error))
    }

    /// A black canvas for a map of this size with its legend.
    pub fn canvas(&self, width: usize, height: usize) -> Canvas {
        let mut canvas = Canvas::new(width.max(WIDTH_MIN), height + HEIGHT, [0; 3]);
        self.legend(&mut canvas, height);
        canvas
    }

    fn legend(&self, canvas: &mut Canvas, top: usize) {
        let width = canvas.width;
        for x in 0..width {
            let color = color::scale(x as f32 / (width - 1) as f32);
            (top + 2..top + 12).for_each(|y| canvas.set(x, y, color));
        }
        for (index, label) in self.labels.iter().enumerate() {
            let place = (width - 1) * index / (self.labels.len() - 1).max(1);
            (top + 10..top + 14).for_each(|y| canvas.set(place, y, WHITE));
            let length = label.len() * font::WIDTH;
            let left = place.saturating_sub(length / 2).min(width - length);
            font::draw(canvas, label, left, top + 15, WHITE);
        }
        let mut left = 0;
        for (label, color) in self.marks {
            for (x, y) in (0..7).flat_map(|x| (0..7).map(move |y| (x, y))) {
                canvas.set(left + x, top + 26 + y, *color);
            }
            font::draw(canvas, label, left + 10, top + 26, WHITE);
            left += 16 + label.len() * font::WIDTH;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_placed_by_decade() {
        let scale = Scale {
            ends: (1e-3, 1.0),
            labels: &["0.1%", "1%", "10%", "100%"],
            marks: &[("dark", [9; 3])],
        };
        assert_eq!(scale.share(0.0), 0.0);
        assert!((scale.share(0.01) - 1.0 / 3.0).abs() < 1e-6);
        assert!((scale.share(1.0) - 1.0).abs() < 1e-6);
        assert_eq!(scale.share(7.0), 1.0);
        let canvas = scale.canvas(3, 2);
        assert_eq!((canvas.width, canvas.height), (WIDTH_MIN, 2 + HEIGHT));
        assert!(canvas.pixels.contains(&[9; 3]) && canvas.pixels.contains(&WHITE));
    }
}
