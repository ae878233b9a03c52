//! Arguments of `vsgl compare`.

use clap::Args;
use std::path::PathBuf;
use vsgl_core::metrics::Metric;

const EXAMPLES: &str = "\
Examples:
  vsgl compare out.exr reference.exr
  vsgl compare out.exr reference.exr --layer indirect --box 8 --metric mape,bias
  vsgl compare out.exr reference.exr --box 8 --fail-above mape=3 -o error.png

Metrics are taken on linear luminance, 0.2126 R + 0.7152 G + 0.0722 B. With x of A, r of B, and eps = 1 % of the mean r:
  rmse         sqrt(mean((x - r)^2))
  relmse       mean((x - r)^2 / (r^2 + eps^2))
  rmspe        100 sqrt(mean(((x - r) / max(r, eps))^2))
  mape         100 mean(|x - r| / max(r, eps))
  mape_median  the median in place of that mean
  smape        100 mean(|x - r| / max((|x| + |r|) / 2, eps)), 0 to 200
  psnr         20 log10(max(r) / rmse); of equal pictures infinite, null in JSON
  mae          mean(|x - r|)
  bias         100 (mean(x) / mean(r) - 1); a limit is for its size
Pixels where r is exactly 0 received no light; they, and blocks that hold one, are left out and counted. So are pixels
that are not finite; with one of those every limit counts as exceeded.";

/// Arguments of `vsgl compare`.
#[derive(Args, Debug)]
#[command(after_long_help = format!("{EXAMPLES}\n\n{}", crate::exit::EXIT_CODES), after_help = "--help has examples and the formulas.")]
pub struct CompareArgs {
    /// Picture to test: EXR, or PNG (made linear from sRGB)
    #[arg(value_name = "A")]
    pub test: PathBuf,
    /// Reference: EXR or PNG
    #[arg(value_name = "B")]
    pub reference: PathBuf,
    /// Layer of EXR files, such as indirect; a file that has R,G,B alone is taken to be that layer
    #[arg(long, value_name = "NAME", default_value = "")]
    pub layer: String,
    /// Compare the means of blocks of PIXELS by PIXELS as well [default: 8, if a block fits]
    #[arg(long = "box", value_name = "PIXELS", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub side: Option<u32>,
    /// Print these metrics alone
    #[arg(long, value_name = "NAME[,NAME]", value_delimiter = ',', value_parser = metric)]
    pub metric: Vec<Metric>,
    /// Exit with 1 if the metric is above VALUE: after --box if that is given, else per pixel (repeatable)
    #[arg(long, value_name = "NAME=VALUE", value_parser = limit)]
    pub fail_above: Vec<Limit>,
    /// Write a false-colour map of |x - r| / max(r, eps), a pixel each (PNG)
    #[arg(short, long, value_name = "MAP.png")]
    pub output: Option<PathBuf>,
    /// Print one JSON document on standard output, and nothing else
    #[arg(long)]
    pub json: bool,
}

/// A metric and what it may be at most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// The metric.
    pub metric: Metric,
    /// The greatest value that passes; of [`Metric::Bias`] the greatest absolute value.
    pub value: f64,
}

fn metric(word: &str) -> Result<Metric, String> {
    Metric::from_word(word).ok_or_else(|| {
        let words: Vec<_> = Metric::ALL.iter().map(|m| m.word()).collect();
        format!("metrics are {}", words.join(", "))
    })
}

fn limit(word: &str) -> Result<Limit, String> {
    let (name, value) = word
        .split_once('=')
        .ok_or("give NAME=VALUE, such as mape=3")?;
    let metric = metric(name)?;
    if metric == Metric::Psnr {
        return Err("psnr is better the higher it is; limit rmse instead".into());
    }
    let value = value
        .parse()
        .ok()
        .filter(|v: &f64| v.is_finite() && *v >= 0.0);
    let value = value.ok_or("give a limit that is a number from 0")?;
    Ok(Limit { metric, value })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_a_metric_and_a_number() {
        let mape = Limit {
            metric: Metric::Mape,
            value: 3.5,
        };
        assert_eq!(limit("mape=3.5"), Ok(mape));
        for bad in [
            "mape", "mape=", "mape=NaN", "mape=-1", "mse=1", "psnr=30", "=3",
        ] {
            assert!(limit(bad).is_err(), "{bad}");
        }
    }
}
