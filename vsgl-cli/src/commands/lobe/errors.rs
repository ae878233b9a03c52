//! Errors of one function over a table, and what they are judged by.

/// How an error is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// In units of the last place of the exact value as `f32`.
    Ulp,
    /// Relative to the exact value.
    Relative,
    /// Relative to the largest value that the function takes for the same sharpness.
    OfPeak,
    /// Of a logarithm: relative to one more than its magnitude.
    Logarithm,
    /// As it is.
    Absolute,
}

impl Measure {
    /// Short name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ulp => "ULP",
            Self::Relative => "relative",
            Self::OfPeak => "of peak",
            Self::Logarithm => "of log",
            Self::Absolute => "absolute",
        }
    }

    /// Error of `value`; `scale` is the peak.
    pub fn error(self, value: f64, exact: f64, scale: f64) -> f64 {
        let apart = (value - exact).abs();
        // Subnormal values count as zero: some devices flush them, and so do our functions.
        let least = f64::from(f32::MIN_POSITIVE);
        if exact.abs() < least && value.abs() <= 2.0 * least {
            return 0.0;
        }
        match self {
            Self::Ulp => apart / ulp(exact.abs().max(least)),
            Self::Relative => apart / exact.abs().max(least),
            Self::OfPeak => apart / scale,
            Self::Logarithm => apart / (1.0 + exact.abs()),
            Self::Absolute => apart,
        }
    }
}

fn ulp(value: f64) -> f64 {
    2f64.powf(value.log2().floor() - 23.0)
}

/// Which of a function's errors is held against the limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// The largest.
    Max(f64),
    /// The 99th percentile.
    P99(f64),
    /// The median: for approximations whose worst cases depend on which cases are asked.
    Median(f64),
}

impl Limit {
    /// The stated figure with the name of the statistic.
    pub fn text(self) -> String {
        match self {
            Self::Max(x) => format!("max {x:.1e}"),
            Self::P99(x) => format!("p99 {x:.1e}"),
            Self::Median(x) => format!("median {x:.2}"),
        }
    }
}

/// Ends of the ranges of sharpness that are reported apart.
pub(super) const RANGES: [(&str, f64, f64); 4] = [
    ("κ < 1", f64::NEG_INFINITY, 1.0),
    ("1 … 100", 1.0, 100.0),
    ("100 … 1e6", 100.0, 1e6),
    ("> 1e6", 1e6, f64::INFINITY),
];

/// Errors of one function over one table.
#[derive(Clone, Debug)]
pub struct Errors {
    /// Path of the function below `vsgl_core`.
    pub function: &'static str,
    /// The measure.
    pub measure: Measure,
    /// What the documentation states.
    pub limit: Limit,
    /// Number of values that are not finite, or negative where none may be.
    pub unfit: usize,
    sorted: Vec<f64>,
    ranges: [Option<f64>; RANGES.len()],
}

impl Errors {
    /// From pairs of error and sharpness (NaN for functions without one).
    pub fn new(
        function: &'static str,
        measure: Measure,
        limit: Limit,
        unfit: usize,
        samples: &[(f64, f64)],
    ) -> Self {
        let mut sorted: Vec<f64> = samples.iter().map(|s| s.0).collect();
        sorted.sort_by(f64::total_cmp);
        let ranges = RANGES.map(|(_, low, high)| {
            let inside = samples.iter().filter(|(_, k)| *k >= low && *k < high);
            inside.map(|s| s.0).reduce(f64::max)
        });
        Self {
            function,
            measure,
            limit,
            unfit,
            sorted,
            ranges,
        }
    }

    /// Number of values compared.
    pub fn count(&self) -> usize {
        self.sorted.len()
    }

    /// The error that the share `p` of all does not exceed.
    pub fn percentile(&self, p: f64) -> f64 {
        let last = self.sorted.len().saturating_sub(1);
        let index = (p * self.sorted.len() as f64).ceil() as usize;
        self.sorted
            .get(index.saturating_sub(1).min(last))
            .copied()
            .unwrap_or(0.0)
    }

    /// The largest error.
    pub fn max(&self) -> f64 {
        self.percentile(1.0)
    }

    /// The mean error.
    pub fn mean(&self) -> f64 {
        self.sorted.iter().sum::<f64>() / self.count().max(1) as f64
    }

    /// The largest error in each of `RANGES`.
    pub fn ranges(&self) -> [Option<f64>; RANGES.len()] {
        self.ranges
    }

    /// Whether the errors are within what is stated, and every value fit.
    pub fn holds(&self) -> bool {
        let within = match self.limit {
            Limit::Max(x) => self.max() <= x,
            Limit::P99(x) => self.percentile(0.99) <= x,
            Limit::Median(x) => self.percentile(0.5) <= x,
        };
        within && self.unfit == 0
    }
}
