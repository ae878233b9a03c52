//! Sums of light that are the same in whichever order and in however many parts they were added up.
//!
//! Sums of floats depend on their order. Here a number is cut where multiples of 2³² of its smallest unit begin, and whole
//! numbers are added up: nothing is rounded. Of all such pieces only the two uppermost are kept, by the greatest number of the
//! sum, so what is left out does not depend on the order either.
//!
//! Idea: Demmel and Nguyen 2015, "Parallel Reproducible Summation" (numbers cut along fixed borders, all but the uppermost
//! pieces left out); with integers instead of floats.

use crate::data::{Image, Radiance};
use crate::error::{Error, Result};
use std::ops::{Add, Range};

/// Bits of a piece of a number.
const PIECE: u32 = 32;
/// Where the number of the upper piece lies in [`Sum::upper`].
const PLACE: u32 = 56;
/// Number of the upper piece of a sum that is no number.
const BROKEN: u64 = 0xff;
/// Exponent of the smallest unit of f32.
const LEAST: i32 = -149;

/// A sum of numbers that are not negative.
///
/// Less than 2⁻³² of the greatest number is left out of each; 2²⁴ numbers fit in.
///
/// ```
/// use vsgl_core::trace::Sum;
/// let numbers = [1e-3f32, 7e4, 0.1, 3e-9];
/// let sum = |order: [usize; 4]| order.into_iter().fold(Sum::default(), |sum, i| sum + Sum::of(numbers[i]));
/// assert_eq!(sum([0, 1, 2, 3]), sum([3, 1, 0, 2]));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sum {
    /// Upper pieces, added up, and above them the number of that piece, counted from the least bit of f32.
    upper: u64,
    /// The pieces below, added up.
    lower: u64,
}

impl Sum {
    /// A number; what is negative counts as zero.
    #[inline]
    #[must_use]
    pub fn of(number: f32) -> Self {
        if !number.is_finite() {
            return Self::broken();
        }
        if number <= 0.0 {
            return Self::default();
        }
        let bits = number.to_bits();
        let (exponent, fraction) = (bits >> 23, bits & 0x007f_ffff);
        let (shift, mantissa) = match exponent {
            0 => (0, fraction),
            _ => (exponent - 1, fraction | 0x0080_0000),
        };
        let place = u64::from(shift / PIECE);
        let wide = u64::from(mantissa) << (shift % PIECE);
        let (high, low) = (wide >> PIECE, wide & u64::from(u32::MAX));
        match high {
            0 => Self::new(place, low, 0),
            _ => Self::new(place + 1, high, low),
        }
    }

    fn new(place: u64, upper: u64, lower: u64) -> Self {
        Self {
            upper: place << PLACE | upper,
            lower,
        }
    }

    fn broken() -> Self {
        Self::new(BROKEN, 0, 0)
    }

    fn place(self) -> u64 {
        self.upper >> PLACE
    }

    /// Both pieces as seen from a place that is not below its own.
    #[inline]
    fn seen_from(self, place: u64) -> (u64, u64) {
        let upper = self.upper & ((1 << PLACE) - 1);
        match place - self.place() {
            0 => (upper, self.lower),
            1 => (0, upper),
            _ => (0, 0),
        }
    }

    /// The sum, rounded once; NaN if something was added that is no number.
    #[must_use]
    pub fn value(self) -> f64 {
        if self.place() == BROKEN {
            return f64::NAN;
        }
        let (upper, lower) = self.seen_from(self.place());
        let whole = (u128::from(upper) << PIECE) + u128::from(lower);
        let exponent = PIECE as i32 * (self.place() as i32 - 1) + LEAST;
        // Within -181 and 75.
        whole as f64 * f64::from_bits(((1023 + exponent) as u64) << 52)
    }

    /// As four words, the least first.
    #[must_use]
    pub fn words(self) -> [u32; 4] {
        let [lower, upper] = [self.lower, self.upper].map(|w| [w as u32, (w >> 32) as u32]);
        [lower[0], lower[1], upper[0], upper[1]]
    }

    /// From [`Sum::words`]; none from words that no sum has.
    #[must_use]
    pub fn from_words(words: [u32; 4]) -> Option<Self> {
        let wide = |low: u32, high: u32| u64::from(high) << 32 | u64::from(low);
        let sum = Self {
            lower: wide(words[0], words[1]),
            upper: wide(words[2], words[3]),
        };
        let fits = sum.place() <= 8 && sum.lower < 1 << PLACE;
        (fits || sum == Self::broken()).then_some(sum)
    }
}

impl Add for Sum {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let place = self.place().max(other.place());
        if place == BROKEN {
            return Self::broken();
        }
        let (a, b) = (self.seen_from(place), other.seen_from(place));
        Self::new(place, a.0 + b.0, a.1 + b.1)
    }
}

/// Light of all paths so far through each pixel, by layer and channel, and how many paths there were.
///
/// Parts of a picture that were made elsewhere are added by [`Sums::merge`]: the result has the same bits as if all had been
/// made here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sums {
    width: u32,
    height: u32,
    samples: u32,
    /// Nine of each pixel, in the order of [`Sums::CHANNELS`]; pixels row-major from the top left.
    sums: Vec<[Sum; 9]>,
}

impl Sums {
    /// Layer and channel of the sums of a pixel.
    pub const CHANNELS: [(&'static str, &'static str); 9] = [
        ("direct", "R"),
        ("direct", "G"),
        ("direct", "B"),
        ("indirect_diffuse", "R"),
        ("indirect_diffuse", "G"),
        ("indirect_diffuse", "B"),
        ("indirect_glossy", "R"),
        ("indirect_glossy", "G"),
        ("indirect_glossy", "B"),
    ];

    /// No paths yet.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            samples: 0,
            sums: vec![[Sum::default(); 9]; width as usize * height as usize],
        }
    }

    /// From sums that were kept, in the order of [`Sums::CHANNELS`] and of pixels.
    ///
    /// # Errors
    /// [`Error::Columns`] if there are not as many as pixels.
    pub fn from_pixels(width: u32, height: u32, samples: u32, sums: Vec<[Sum; 9]>) -> Result<Self> {
        let pixels = width as usize * height as usize;
        if sums.len() != pixels {
            return Err(unlike(format!("{} sums of {pixels} pixels", sums.len())));
        }
        Ok(Self {
            width,
            height,
            samples,
            sums,
        })
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// Paths through each pixel.
    #[must_use]
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// The sums of each pixel.
    #[must_use]
    pub fn pixels(&self) -> &[[Sum; 9]] {
        &self.sums
    }

    /// Adds what a backend returned for some samples; see [`crate::backend::Backend::trace`].
    ///
    /// # Errors
    /// [`Error::Columns`] for a picture of another size.
    pub fn add(&mut self, piece: &Radiance, samples: &Range<u32>) -> Result<()> {
        let layers = [
            &piece.direct,
            &piece.indirect_diffuse,
            &piece.indirect_glossy,
        ];
        if layers.iter().any(|layer| layer.len() != self.sums.len()) {
            let (width, height) = (piece.width, piece.height);
            return Err(unlike(format!("paths of {width}x{height} pixels")));
        }
        self.samples += samples.end - samples.start;
        for (pixel, sums) in self.sums.iter_mut().enumerate() {
            for (layer, values) in layers.into_iter().enumerate() {
                for (channel, &value) in values[pixel].iter().enumerate() {
                    let sum = &mut sums[3 * layer + channel];
                    *sum = *sum + Sum::of(value);
                }
            }
        }
        Ok(())
    }

    /// Adds another part of the same picture: other samples of it.
    ///
    /// # Errors
    /// [`Error::Columns`] for a picture of another size.
    pub fn merge(&mut self, other: &Self) -> Result<()> {
        if self.size() != other.size() {
            let (width, height) = other.size();
            return Err(unlike(format!("a part of {width}x{height} pixels")));
        }
        self.samples += other.samples;
        for (sums, others) in self.sums.iter_mut().zip(&other.sums) {
            for (sum, other) in sums.iter_mut().zip(others) {
                *sum = *sum + *other;
            }
        }
        Ok(())
    }

    /// Means over all paths, as layers of a picture; the other layers are those of `image`. Black without paths.
    #[must_use]
    pub fn mean(&self, image: Image) -> Image {
        let samples = f64::from(self.samples.max(1));
        let layer = |layer: usize| {
            let pixel = |sums: &[Sum; 9]| {
                [0, 1, 2].map(|channel| (sums[3 * layer + channel].value() / samples) as f32)
            };
            self.sums.iter().map(pixel).collect()
        };
        Image {
            direct: layer(0),
            indirect_diffuse: layer(1),
            indirect_glossy: layer(2),
            ..image
        }
    }
}

fn unlike(problem: String) -> Error {
    Error::Columns {
        resource: "sums",
        problem,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::sobol::hash;

    fn sum(numbers: impl Iterator<Item = f32>) -> Sum {
        numbers.fold(Sum::default(), |sum, number| sum + Sum::of(number))
    }

    /// Numbers over all magnitudes that f32 has, or over some.
    fn numbers(count: u32, magnitudes: u32) -> Vec<f32> {
        let number = |i: u32| {
            let exponent = hash(i) % magnitudes;
            f32::from_bits((127 - magnitudes / 2 + exponent) << 23 | hash(!i) >> 9)
        };
        (0..count).map(number).collect()
    }

    #[test]
    fn one_number_is_itself() {
        let least = f32::from_bits(1);
        for x in [
            0.0,
            least,
            3.0 * least,
            f32::MIN_POSITIVE,
            1e-20,
            0.1,
            1.0,
            7e11,
            f32::MAX,
        ] {
            assert_eq!(Sum::of(x).value(), f64::from(x), "{x}");
        }
        assert_eq!(Sum::of(-1e-9), Sum::default());
        for broken in [f32::NAN, f32::INFINITY] {
            assert!(sum([1.0, broken, 2.0].into_iter()).value().is_nan());
        }
    }

    #[test]
    fn sums_do_not_depend_on_order_or_parts() {
        for magnitudes in [8, 40, 254] {
            let numbers = numbers(5000, magnitudes);
            let whole = sum(numbers.iter().copied());
            for seed in 0..20 {
                let mut order: Vec<u32> = (0..5000).collect();
                order.sort_by_key(|&i| hash(i ^ hash(seed)));
                let mut parts = vec![Sum::default(); 1 + seed as usize];
                for &i in &order {
                    let part = hash(i + seed) as usize % parts.len();
                    parts[part] = parts[part] + Sum::of(numbers[i as usize]);
                }
                let merged = parts.into_iter().fold(Sum::default(), Sum::add);
                assert_eq!(merged, whole, "{magnitudes} {seed}");
            }
            let sum: f64 = numbers.iter().map(|&n| f64::from(n)).sum();
            assert!((whole.value() - sum).abs() <= 1e-6 * sum);
            // Floats would not do.
            let there: f32 = numbers.iter().sum();
            let back: f32 = numbers.iter().rev().sum();
            assert!(magnitudes > 40 || there != back, "no hard numbers");
        }
    }

    /// Left out is less than the stated share of the greatest number for each.
    #[test]
    fn what_is_left_out_is_small() {
        let big = 1.000_000_1f32;
        let small = big / 4e9;
        let found = sum(std::iter::once(big).chain((0..1000).map(|_| small))).value();
        let exact = f64::from(big) + 1000.0 * f64::from(small);
        assert!(found <= exact);
        assert!(exact - found < 1001.0 * 2f64.powi(-32) * f64::from(big));
    }

    #[test]
    fn as_many_as_a_picture_can_have_fit() {
        let mut sum = Sum::of(f32::from_bits(0x7f7f_ffff));
        for _ in 0..24 {
            sum = sum + sum;
        }
        let exact = f64::from(f32::MAX) * 2f64.powi(24);
        assert!((sum.value() - exact).abs() < 1e-15 * exact);
    }

    #[test]
    fn words_round_trip_and_nonsense_is_refused() {
        for number in numbers(200, 254) {
            let sum = Sum::of(number) + Sum::of(3.0 * number);
            assert_eq!(Sum::from_words(sum.words()), Some(sum));
        }
        let broken = Sum::of(f32::NAN);
        assert_eq!(Sum::from_words(broken.words()), Some(broken));
        assert_eq!(Sum::from_words([0, 0, 0, 9 << 24]), None);
        assert_eq!(Sum::from_words([0, u32::MAX, 0, 0]), None);
    }
}
