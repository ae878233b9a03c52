//! Smaller images of textures, each half the size of the one before.

use super::Texture;
use crate::phase::texture::half;

/// Linear value 0..=1 of an 8-bit sRGB code (IEC 61966-2-1).
pub(super) fn srgb_to_linear(code: u32) -> f32 {
    curve(f64::from(code)) as f32
}

fn curve(code: f64) -> f64 {
    let c = code / 255.0;
    if c <= 0.04045 {
        c / 12.92
    } else {
        ((c + 0.055) / 1.055).powf(2.4)
    }
}

/// How many images a texture has, the full one included.
pub(super) fn levels(texture: &Texture) -> u32 {
    texture.width.max(texture.height).max(1).ilog2() + 1
}

/// All smaller images, one after the other, as words with red in the lowest byte.
///
/// A texel is the mean over the part of the next larger image that it covers: of four texels, or of parts of nine where a side
/// is odd. `srgb` means red, green and blue as linear light; without, codes are averaged, which for normal maps is the mean of
/// the vectors. Rounded to 8 bits once, from means that are not.
pub(super) fn smaller(texture: &Texture, srgb: bool) -> Vec<u32> {
    let code = Codes::new(srgb);
    let (mut width, mut height) = (texture.width as usize, texture.height as usize);
    let mut words = Vec::new();
    let mut image: Vec<[f32; 4]> = Vec::new();
    for level in 1..levels(texture) {
        let (w, h) = (half(width as u32) as usize, half(height as u32) as usize);
        let texel = |x: usize, y: usize| match level {
            1 => code.decode(texture.texels[y * width + x]),
            _ => image[y * width + x],
        };
        let columns = Halving::new(width, w);
        let rows = Halving::new(height, h);
        let mut next = Vec::with_capacity(w * h);
        for y in 0..h {
            for x in 0..w {
                let mut sum = [0.0; 4];
                for (from_y, weight_y) in rows.parts(y) {
                    for (from_x, weight_x) in columns.parts(x) {
                        let weight = weight_x * weight_y;
                        let from = texel(from_x, from_y);
                        sum = std::array::from_fn(|i| sum[i] + weight * from[i]);
                    }
                }
                next.push(sum);
            }
        }
        words.extend(next.iter().map(|&texel| code.encode(texel)));
        (image, width, height) = (next, w, h);
    }
    words
}

/// Which texels of one side of an image make one of the next smaller.
struct Halving {
    size: usize,
    /// Size of the smaller side.
    half: usize,
}

impl Halving {
    fn new(size: usize, half: usize) -> Self {
        Self { size, half }
    }

    /// Indices with their weights, whose sum is one.
    fn parts(&self, i: usize) -> impl Iterator<Item = (usize, f32)> + Clone {
        let (count, weights) = if self.size == 1 {
            (1, [1.0, 0.0, 0.0])
        } else if self.size == 2 * self.half {
            (2, [0.5, 0.5, 0.0])
        } else {
            // size = 2 half + 1: texel i covers size/half of them.
            let (n, m, i) = (self.size as f32, self.half as f32, i as f32);
            (3, [(m - i) / n, m / n, (i + 1.0) / n])
        };
        (0..count).map(move |k| (2 * i + k, weights[k]))
    }
}

/// From codes to numbers that can be averaged, and back.
struct Codes {
    /// Linear value of each code of red, green and blue.
    linear: Vec<f32>,
    /// Where one code ends and the next begins.
    ends: Vec<f32>,
}

impl Codes {
    fn new(srgb: bool) -> Self {
        let value = |code: f64| {
            if srgb {
                curve(code) as f32
            } else {
                (code / 255.0) as f32
            }
        };
        Self {
            linear: (0..=255).map(|code| value(f64::from(code))).collect(),
            ends: (0..255).map(|code| value(f64::from(code) + 0.5)).collect(),
        }
    }

    fn decode(&self, [r, g, b, a]: [u8; 4]) -> [f32; 4] {
        let linear = |code: u8| self.linear[usize::from(code)];
        [linear(r), linear(g), linear(b), f32::from(a)]
    }

    fn encode(&self, [r, g, b, a]: [f32; 4]) -> u32 {
        let code = |value: f32| self.ends.partition_point(|&end| end <= value) as u8;
        let alpha = (a + 0.5).floor().clamp(0.0, 255.0) as u8;
        u32::from_le_bytes([code(r), code(g), code(b), alpha])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texture(width: u32, height: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Texture {
        let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Texture {
            width,
            height,
            texels: all.map(|(x, y)| texel(x, y)).collect(),
        }
    }

    fn bytes(words: &[u32]) -> Vec<[u8; 4]> {
        words.iter().map(|w| w.to_le_bytes()).collect()
    }

    #[test]
    fn colours_are_averaged_as_light_and_the_rest_as_codes() {
        let check = texture(
            2,
            2,
            |x, y| if (x + y) % 2 == 0 { [255; 4] } else { [0; 4] },
        );
        // Half the light of white is the code 188.
        assert_eq!(bytes(&smaller(&check, true)), [[188, 188, 188, 128]]);
        assert_eq!(bytes(&smaller(&check, false)), [[128; 4]]);
    }

    #[test]
    fn one_colour_stays_at_any_size() {
        for (width, height, count) in [(1, 1, 0), (7, 1, 2), (5, 3, 2), (12, 20, 4), (1, 64, 6)] {
            let plain = texture(width, height, |_, _| [10, 100, 200, 55]);
            assert_eq!(levels(&plain), count + 1);
            for srgb in [false, true] {
                let words = smaller(&plain, srgb);
                let sizes = (1..=count).map(|l| (width >> l).max(1) * (height >> l).max(1));
                assert_eq!(words.len() as u32, sizes.sum::<u32>());
                assert!(bytes(&words).iter().all(|&t| t == [10, 100, 200, 55]));
            }
        }
    }

    #[test]
    fn every_texel_of_an_odd_side_counts_alike() {
        for size in [3, 5, 7, 9] {
            // One bright texel, wherever it is: the sum of the next image is the same share of it.
            for bright in 0..size {
                let one = texture(size, 1, |x, _| [if x == bright { 250 } else { 0 }; 4]);
                let next = &bytes(&smaller(&one, false))[..(size / 2) as usize];
                let sum: f64 = next.iter().map(|t| f64::from(t[0])).sum();
                let expected = 250.0 * f64::from(size / 2) / f64::from(size);
                assert!(
                    (sum - expected).abs() <= 1.0,
                    "{size} {bright}: {sum} {expected}"
                );
            }
        }
    }

    #[test]
    fn normals_that_differ_become_shorter() {
        let bumps = texture(2, 1, |x, _| {
            if x == 0 {
                [255, 128, 128, 0]
            } else {
                [0, 128, 128, 0]
            }
        });
        assert_eq!(bytes(&smaller(&bumps, false)), [[128, 128, 128, 0]]);
    }
}
