//! How far a picture is from its reference: error metrics on one channel, free of files.
//!
//! In all formulas `x` is the tested value, `r` the reference, means run over the values that are compared, and
//! `eps` is 1 % of the mean reference over the same values. Compared are pixels, or the means of square blocks of
//! pixels, which tell bias from noise.
//!
//! - A pixel whose reference is exactly 0 received no light there at all (background, or outside of all that the lamp
//!   reaches): a relative error says nothing about it. Such pixels, and blocks that hold one, are left out and counted.
//! - A pixel that is not finite on either side, and a block that holds one, is left out and counted on its own: a
//!   picture with one has a fault, whatever the metrics of the rest say.
//! - Blocks lie side by side from the top left; pixels right and below of the last whole block belong to none.
//!
//! ```
//! use vsgl_core::metrics::{Metric, Plane, compare};
//!
//! let test = Plane::new(2, 1, vec![1.1, 3.6])?;
//! let reference = Plane::new(2, 1, vec![1.0, 4.0])?;
//! let errors = compare(&test, &reference, 1)?.expect("both pixels have light");
//! assert!((errors.get(Metric::Mape) - 10.0).abs() < 1e-9);
//! # Ok::<(), vsgl_core::Error>(())
//! ```

use crate::error::{Error, Result};

/// Share of the mean reference below which a relative error is taken against the share instead.
pub const EPS_SHARE: f64 = 0.01;

/// A way to put the error of a picture into one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Metric {
    /// Root of the mean square error, `sqrt(mean((x - r)²))`, in the picture's unit.
    Rmse,
    /// Relative mean square error, `mean((x - r)² / (r² + eps²))`.
    Relmse,
    /// Root of the mean square percentage error, `100 sqrt(mean(((x - r) / max(r, eps))²))` in percent.
    Rmspe,
    /// Mean absolute percentage error, `100 mean(|x - r| / max(r, eps))` in percent.
    Mape,
    /// Median of the absolute percentage errors that [`Metric::Mape`] is the mean of, in percent.
    MapeMedian,
    /// Symmetric mean absolute percentage error, `100 mean(|x - r| / max((|x| + |r|) / 2, eps))`: 0 to 200 percent.
    Smape,
    /// Peak signal-to-noise ratio, `20 log10(max(r) / rmse)` in decibels: infinite for equal pictures.
    Psnr,
    /// Mean absolute error, `mean(|x - r|)`, in the picture's unit.
    Mae,
    /// Too much or too little light in all, `100 (mean(x) / mean(r) - 1)` in percent.
    Bias,
}

impl Metric {
    /// All metrics, in the order of reports.
    pub const ALL: &'static [Self] = &[
        Self::Rmse,
        Self::Relmse,
        Self::Rmspe,
        Self::Mape,
        Self::MapeMedian,
        Self::Smape,
        Self::Psnr,
        Self::Mae,
        Self::Bias,
    ];

    /// Spelling on the command line and in reports.
    pub fn word(self) -> &'static str {
        match self {
            Self::Rmse => "rmse",
            Self::Relmse => "relmse",
            Self::Rmspe => "rmspe",
            Self::Mape => "mape",
            Self::MapeMedian => "mape_median",
            Self::Smape => "smape",
            Self::Psnr => "psnr",
            Self::Mae => "mae",
            Self::Bias => "bias",
        }
    }

    /// The metric with this spelling.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|m| m.word() == word)
    }

    /// Unit as printed behind a value; empty for the picture's own unit and for pure numbers.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Rmse | Self::Relmse | Self::Mae => "",
            Self::Psnr => "dB",
            _ => "%",
        }
    }
}

/// One channel of a picture, row-major from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    width: u32,
    height: u32,
    values: Vec<f64>,
}

impl Plane {
    /// A channel from its values.
    ///
    /// # Errors
    /// [`Error::Columns`] if there are not `width * height` values.
    pub fn new(width: u32, height: u32, values: Vec<f64>) -> Result<Self> {
        if values.len() as u64 != u64::from(width) * u64::from(height) {
            let problem = format!("{} values for {width}x{height} pixels", values.len());
            return Err(Error::Columns {
                resource: "plane",
                problem,
            });
        }
        Ok(Self {
            width,
            height,
            values,
        })
    }

    /// The luminance of a picture of linear Rec. 709 colours.
    ///
    /// # Errors
    /// As [`Plane::new`].
    pub fn luminance(width: u32, height: u32, pixels: &[[f32; 3]]) -> Result<Self> {
        Self::new(
            width,
            height,
            pixels.iter().copied().map(luminance).collect(),
        )
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The values, row-major from the top left.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The values of one block, row by row.
    fn block(&self, column: u32, row: u32, side: u32) -> impl Iterator<Item = f64> + '_ {
        (row * side..(row + 1) * side).flat_map(move |y| {
            let start = y as usize * self.width as usize + (column * side) as usize;
            self.values[start..start + side as usize].iter().copied()
        })
    }
}

/// Luminance of a linear Rec. 709 colour.
pub fn luminance([r, g, b]: [f32; 3]) -> f64 {
    0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
}

/// The error that [`Metric::Mape`] averages, as a share: `|x - r| / max(r, eps)`.
pub fn relative_error(test: f64, reference: f64, eps: f64) -> f64 {
    (test - reference).abs() / reference.max(eps)
}

/// Errors of a picture at one scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    /// Side of the blocks in pixels; 1 compares pixels.
    pub side: u32,
    /// Pixels or blocks compared.
    pub compared: usize,
    /// Pixels or blocks left out because some reference in them is exactly 0.
    pub left_out: usize,
    /// Pixels or blocks left out because something in them is not finite.
    pub not_finite: usize,
    /// The `eps` of the formulas.
    pub eps: f64,
    /// Mean of the tested values.
    pub mean_test: f64,
    /// Mean of the references.
    pub mean_reference: f64,
    values: [f64; Metric::ALL.len()],
}

impl Errors {
    /// The value of a metric. Only [`Metric::Psnr`] may be infinite.
    pub fn get(&self, metric: Metric) -> f64 {
        self.values[metric as usize]
    }
}

/// Compares the means of blocks of `side` by `side` pixels; a side of 1 compares pixels.
///
/// `None` if nothing is left to compare.
///
/// # Errors
/// [`Error::Setting`] if the planes differ in size or `side` is 0.
pub fn compare(test: &Plane, reference: &Plane, side: u32) -> Result<Option<Errors>> {
    if (test.width, test.height) != (reference.width, reference.height) {
        return Err(Error::setting(
            "size",
            format!(
                "{}x{} against {}x{} pixels",
                test.width, test.height, reference.width, reference.height
            ),
            "compare pictures of one size",
        ));
    }
    if side == 0 {
        return Err(Error::setting("box", "0", "give at least 1"));
    }
    let (mut left_out, mut not_finite) = (0, 0);
    let mut pairs = Vec::new();
    for row in 0..reference.height / side {
        for column in 0..reference.width / side {
            let values = || {
                test.block(column, row, side)
                    .zip(reference.block(column, row, side))
            };
            if values().any(|(x, r)| !(x.is_finite() && r.is_finite())) {
                not_finite += 1;
            } else if values().any(|(_, r)| r == 0.0) {
                left_out += 1;
            } else {
                let (x, r) =
                    values().fold((0.0, 0.0), |sum, pair| (sum.0 + pair.0, sum.1 + pair.1));
                let count = f64::from(side) * f64::from(side);
                pairs.push((x / count, r / count));
            }
        }
    }
    if pairs.is_empty() {
        return Ok(None);
    }
    let mean_test = mean(&pairs, |x, _| x);
    let mean_reference = mean(&pairs, |_, r| r);
    // References made as differences of noisy pictures may be negative; eps must not become so.
    let eps = (EPS_SHARE * mean_reference.abs()).max(f64::MIN_POSITIVE);
    let values = std::array::from_fn(|i| value(Metric::ALL[i], &pairs, eps));
    Ok(Some(Errors {
        side,
        compared: pairs.len(),
        left_out,
        not_finite,
        eps,
        mean_test,
        mean_reference,
        values,
    }))
}

fn mean(pairs: &[(f64, f64)], term: impl Fn(f64, f64) -> f64) -> f64 {
    pairs.iter().map(|&(x, r)| term(x, r)).sum::<f64>() / pairs.len() as f64
}

fn value(metric: Metric, pairs: &[(f64, f64)], eps: f64) -> f64 {
    let square = |v: f64| v * v;
    let relative = |x, r| relative_error(x, r, eps);
    match metric {
        Metric::Rmse => mean(pairs, |x, r| square(x - r)).sqrt(),
        Metric::Relmse => mean(pairs, |x, r| square(x - r) / (square(r) + square(eps))),
        Metric::Rmspe => 100.0 * mean(pairs, |x, r| square(relative(x, r))).sqrt(),
        Metric::Mape => 100.0 * mean(pairs, relative),
        Metric::MapeMedian => 100.0 * median(pairs.iter().map(|&(x, r)| relative(x, r)).collect()),
        Metric::Smape => {
            let half_sum = |x: f64, r: f64| (0.5 * (x.abs() + r.abs())).max(eps);
            100.0 * mean(pairs, |x, r| (x - r).abs() / half_sum(x, r))
        }
        Metric::Psnr => {
            let peak = pairs.iter().fold(0.0f64, |peak, &(_, r)| peak.max(r));
            20.0 * (peak.max(f64::MIN_POSITIVE) / value(Metric::Rmse, pairs, eps)).log10()
        }
        Metric::Mae => mean(pairs, |x, r| (x - r).abs()),
        Metric::Bias => {
            let reference = mean(pairs, |_, r| r);
            100.0 * mean(pairs, |x, r| x - r) / reference.abs().max(f64::MIN_POSITIVE)
        }
    }
}

/// The middle value, or the mean of the two in the middle. `values` must not be empty.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let middle = values.len() / 2;
    if values.len() % 2 == 1 {
        values[middle]
    } else {
        0.5 * (values[middle - 1] + values[middle])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(width: u32, values: &[f64]) -> Plane {
        let height = values.len() as u32 / width;
        Plane::new(width, height, values.to_vec()).expect("test data fits")
    }

    fn errors(test: &[f64], reference: &[f64]) -> Errors {
        let width = test.len() as u32;
        let errors = compare(&plane(width, test), &plane(width, reference), 1);
        errors.expect("same size").expect("something to compare")
    }

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() <= 1e-12 * b.abs().max(1.0), "{a} is not {b}");
    }

    /// x = (1.5, 2, 0.03), r = (1, 4, 0.01): the mean reference is 5.01/3, so eps = 0.0167 > 0.01.
    #[test]
    fn every_metric_equals_its_value_by_hand() {
        let e = errors(&[1.5, 2.0, 0.03], &[1.0, 4.0, 0.01]);
        let eps: f64 = 0.0167;
        close(e.eps, eps);
        close(e.mean_test, 3.53 / 3.0);
        close(e.mean_reference, 1.67);
        let (p, q, s) = (0.5, 0.5, 0.02 / eps);
        close(e.get(Metric::Rmse), ((0.25 + 4.0 + 0.0004) / 3.0f64).sqrt());
        let e2 = eps * eps;
        close(
            e.get(Metric::Relmse),
            (0.25 / (1.0 + e2) + 4.0 / (16.0 + e2) + 0.0004 / (0.0001 + e2)) / 3.0,
        );
        close(
            e.get(Metric::Rmspe),
            100.0 * ((p * p + q * q + s * s) / 3.0).sqrt(),
        );
        close(e.get(Metric::Mape), 100.0 * (p + q + s) / 3.0);
        close(e.get(Metric::MapeMedian), 50.0);
        close(
            e.get(Metric::Smape),
            100.0 * (0.5 / 1.25 + 2.0 / 3.0 + 0.02 / 0.02) / 3.0,
        );
        close(
            e.get(Metric::Psnr),
            20.0 * (4.0 / (4.2504f64 / 3.0).sqrt()).log10(),
        );
        close(e.get(Metric::Mae), 2.52 / 3.0);
        close(e.get(Metric::Bias), 100.0 * (3.53 / 5.01 - 1.0));
    }

    #[test]
    fn equal_pictures_have_no_error() {
        let e = errors(&[1.0, 2.0], &[1.0, 2.0]);
        for &metric in Metric::ALL {
            let none = if metric == Metric::Psnr {
                f64::INFINITY
            } else {
                0.0
            };
            assert_eq!(e.get(metric), none, "{}", metric.word());
        }
        assert_eq!((e.compared, e.left_out, e.not_finite), (2, 0, 0));
    }

    #[test]
    fn a_median_of_an_even_count_lies_between_the_middle_two() {
        close(
            errors(&[1.0, 1.1, 1.3, 9.0], &[1.0; 4]).get(Metric::MapeMedian),
            20.0,
        );
    }

    #[test]
    fn pixels_without_reference_light_and_broken_ones_are_counted_not_compared() {
        let e = errors(
            &[1.0, 7.0, f64::NAN, 1.0, 0.0],
            &[1.0, 0.0, 0.0, f64::INFINITY, 2.0],
        );
        assert_eq!((e.compared, e.left_out, e.not_finite), (2, 1, 2));
        close(e.get(Metric::Mape), 50.0);
        let dark = plane(2, &[0.0; 2]);
        assert_eq!(compare(&dark, &dark, 1).expect("same size"), None);
    }

    #[test]
    fn blocks_are_whole_and_those_with_a_dark_pixel_are_left_out() {
        // Three blocks of 2x2 in the two upper rows; the last column and row belong to none.
        let reference = plane(
            7,
            &[
                1.0, 1.0, 2.0, 2.0, 3.0, 0.0, 9.0, //
                1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 9.0, //
                9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0,
            ],
        );
        let mut noisy = reference.values().to_vec();
        (noisy[0], noisy[1]) = (0.5, 1.5);
        noisy[2] = 3.0;
        let test = plane(7, &noisy);
        let e = compare(&test, &reference, 2)
            .expect("same size")
            .expect("two blocks");
        assert_eq!((e.compared, e.left_out, e.not_finite), (2, 1, 0));
        // The noise of the first block cancels, the second is 2.25 against 2.
        close(e.get(Metric::Mape), 100.0 * 0.125 / 2.0);
        close(e.eps, 0.015);
        assert_eq!(compare(&test, &reference, 4).expect("same size"), None);
    }

    #[test]
    fn negative_references_keep_eps_positive() {
        let e = errors(&[-1.0, 0.5], &[-2.0, 1.0]);
        close(e.eps, 0.005);
        close(e.get(Metric::Mape), 100.0 * (1.0 / 0.005 + 0.5) / 2.0);
    }

    #[test]
    fn sizes_must_agree() {
        let (a, b) = (plane(2, &[1.0; 4]), plane(4, &[1.0; 4]));
        assert!(compare(&a, &b, 1).is_err());
        assert!(compare(&a, &a, 0).is_err());
        assert!(Plane::new(3, 3, vec![0.0]).is_err());
    }

    #[test]
    fn words_round_trip() {
        for &metric in Metric::ALL {
            assert_eq!(Metric::from_word(metric.word()), Some(metric));
            assert_eq!(Metric::ALL[metric as usize], metric);
        }
        assert_eq!(Metric::from_word("mse"), None);
    }
}
