//! How bright a picture is shown.

use vsgl_core::metrics::luminance;

/// Exposure of an 8-bit picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// Chosen from the picture by [`automatic`].
    Auto,
    /// So many stops: light is multiplied by 2 to this power.
    Stops(f32),
}

/// Most stops either way.
pub const STOPS_MAX: f32 = 60.0;

/// Luminance that the log-average of a picture is brought to.
const KEY: f64 = 0.25;
/// Luminance that 95 of 100 lit pixels stay below.
const BRIGHT: f64 = 1.5;

impl Exposure {
    /// Reads `auto` or a number of stops.
    ///
    /// # Errors
    /// What would be accepted.
    pub fn parse(word: &str) -> Result<Self, String> {
        if word == "auto" {
            return Ok(Self::Auto);
        }
        let stops = word.parse().ok().filter(|s: &f32| s.abs() <= STOPS_MAX);
        stops.map(Self::Stops).ok_or_else(|| {
            format!("give `auto` or a number of stops from -{STOPS_MAX} to {STOPS_MAX}")
        })
    }

    /// The stops for a picture.
    pub fn stops(self, pixels: &[[f32; 3]]) -> f32 {
        match self {
            Self::Auto => automatic(pixels),
            Self::Stops(stops) => stops,
        }
    }
}

impl std::fmt::Display for Exposure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Stops(stops) => write!(f, "{stops}"),
        }
    }
}

/// Stops that bring the geometric mean of the luminance to 0.25, or less where that would put more than one lit pixel
/// in twenty above 1.5.
///
/// Only lit pixels count: luminance finite and above a millionth of the brightest. A black picture has exposure 0.
pub fn automatic(pixels: &[[f32; 3]]) -> f32 {
    let mut lit: Vec<f64> = pixels
        .iter()
        .map(|&p| luminance(p))
        .filter(|l| l.is_finite() && *l > 0.0)
        .collect();
    let brightest = lit.iter().copied().fold(0.0, f64::max);
    lit.retain(|&l| l > 1e-6 * brightest);
    if lit.is_empty() {
        return 0.0;
    }
    let mean_log = lit.iter().map(|l| l.log2()).sum::<f64>() / lit.len() as f64;
    let index = (lit.len() - 1) * 95 / 100;
    let (_, &mut bright, _) = lit.select_nth_unstable_by(index, f64::total_cmp);
    let stops = (KEY.log2() - mean_log).min(BRIGHT.log2() - bright.log2());
    (stops as f32).clamp(-STOPS_MAX, STOPS_MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grey_goes_to_the_key_whatever_its_unit() {
        for value in [1e-12f32, 0.25, 5.0, 1e15] {
            let stops = automatic(&[[value; 3]; 10]);
            assert!((value * stops.exp2() - 0.25).abs() < 1e-4, "{value}");
        }
    }

    #[test]
    fn black_nan_and_fireflies_do_not_count() {
        assert_eq!(automatic(&[]), 0.0);
        assert_eq!(automatic(&[[0.0; 3], [f32::NAN; 3], [-1.0; 3]]), 0.0);
        let mut pixels = vec![[0.25; 3]; 1000];
        pixels.extend([[0.0; 3]; 5000]);
        pixels.push([f32::INFINITY; 3]);
        assert!(automatic(&pixels).abs() < 1e-3);
        pixels.push([1e3; 3]);
        assert!(automatic(&pixels).abs() < 0.02);
    }

    #[test]
    fn a_large_bright_part_is_kept_in_range() {
        let mut pixels = vec![[1e-3; 3]; 900];
        pixels.extend([[1.0; 3]; 100]);
        assert!((automatic(&pixels) - 1.5f32.log2()).abs() < 1e-3);
    }

    #[test]
    fn only_words_and_finite_stops_are_read() {
        assert_eq!(Exposure::parse("auto"), Ok(Exposure::Auto));
        assert_eq!(Exposure::parse("-1.5"), Ok(Exposure::Stops(-1.5)));
        for bad in ["NaN", "inf", "1e9", "", "bright"] {
            assert!(Exposure::parse(bad).is_err(), "{bad}");
        }
    }
}
