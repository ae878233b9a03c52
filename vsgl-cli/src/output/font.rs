//! A few letters of five by seven dots, for the legends of maps.

/// Width of a letter with its gap.
pub const WIDTH: usize = 6;
/// Height of a letter.
pub const HEIGHT: usize = 7;

/// Draws a text with its top left corner at `(left, top)`; dots outside the canvas are dropped, letters that the font
/// lacks are blank.
pub fn draw(canvas: &mut Canvas, text: &str, left: usize, top: usize, color: [u8; 3]) {
    for (index, letter) in text.chars().enumerate() {
        for (row, bits) in glyph(letter).into_iter().enumerate() {
            for column in (0..5).filter(|column| bits >> (4 - column) & 1 == 1) {
                canvas.set(left + index * WIDTH + column, top + row, color);
            }
        }
    }
}

/// An 8-bit picture to draw on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Canvas {
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// The pixels, row-major from the top left.
    pub pixels: Vec<[u8; 3]>,
}

impl Canvas {
    /// A canvas of one colour.
    pub fn new(width: usize, height: usize, color: [u8; 3]) -> Self {
        Self {
            width,
            height,
            pixels: vec![color; width * height],
        }
    }

    /// Sets a pixel; outside nothing happens.
    pub fn set(&mut self, x: usize, y: usize, color: [u8; 3]) {
        if x < self.width && y < self.height {
            self.pixels[y * self.width + x] = color;
        }
    }
}

fn glyph(letter: char) -> [u8; HEIGHT] {
    match letter {
        '0' => [0x0e, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0e],
        '1' => [0x04, 0x0c, 0x04, 0x04, 0x04, 0x04, 0x0e],
        '3' => [0x0e, 0x11, 0x01, 0x06, 0x01, 0x11, 0x0e],
        '5' => [0x1f, 0x10, 0x1e, 0x01, 0x01, 0x11, 0x0e],
        '7' => [0x1f, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08],
        '-' => [0, 0, 0, 0x0e, 0, 0, 0],
        '.' => [0, 0, 0, 0, 0, 0x0c, 0x0c],
        '%' => [0x18, 0x19, 0x02, 0x04, 0x08, 0x13, 0x03],
        'a' => [0, 0, 0x0e, 0x01, 0x0f, 0x11, 0x0f],
        'd' => [0x01, 0x01, 0x0d, 0x13, 0x11, 0x11, 0x0f],
        'e' => [0, 0, 0x0e, 0x11, 0x1f, 0x10, 0x0e],
        'f' => [0x06, 0x09, 0x08, 0x1c, 0x08, 0x08, 0x08],
        'i' => [0x04, 0, 0x0c, 0x04, 0x04, 0x04, 0x0e],
        'k' => [0x10, 0x10, 0x12, 0x14, 0x18, 0x14, 0x12],
        'n' => [0, 0, 0x16, 0x19, 0x11, 0x11, 0x11],
        'o' => [0, 0, 0x0e, 0x11, 0x11, 0x11, 0x0e],
        'r' => [0, 0, 0x16, 0x19, 0x10, 0x10, 0x10],
        't' => [0x08, 0x08, 0x1c, 0x08, 0x08, 0x09, 0x06],
        _ => [0; HEIGHT],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_clipped_at_the_edges() {
        let mut canvas = Canvas::new(7, 7, [0; 3]);
        draw(&mut canvas, "11", 0, 0, [255; 3]);
        let lit = canvas.pixels.iter().filter(|p| p[0] == 255).count();
        assert!(lit > 9, "the first letter is there");
        draw(&mut canvas, "1", 100, 100, [255; 3]);
    }
}
