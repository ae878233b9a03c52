//! Line plots as SVG, and their numbers as CSV.

use crate::exit::Result;
use crate::output::Pending;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

/// How numbers are laid out along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Scale {
    /// Evenly.
    Linear,
    /// By their logarithm; smaller values than the low end lie on it.
    Logarithmic,
}

/// One axis: label, low and high end, scale.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    pub(super) label: &'static str,
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) scale: Scale,
}

/// A plot of several functions of one variable.
pub(super) struct Plot {
    pub(super) name: String,
    pub(super) title: String,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) at: Vec<f64>,
    pub(super) lines: Vec<(&'static str, Vec<f64>)>,
}

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 440.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 200.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 50.0;
/// Told apart also without colour vision; the first is for the exact value.
const COLORS: [&str; 9] = [
    "#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#999999",
    "#800080",
];

impl Axis {
    /// Position of a value, 0 … 1.
    fn place(&self, value: f64) -> f64 {
        let share = match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Logarithmic => {
                (value.max(self.low).ln() - self.low.ln()) / (self.high.ln() - self.low.ln())
            }
        };
        share.clamp(0.0, 1.0)
    }

    /// Values that get a mark.
    fn marks(&self) -> Vec<f64> {
        match self.scale {
            Scale::Linear => (0..=5)
                .map(|i| self.low + (self.high - self.low) * f64::from(i) / 5.0)
                .collect(),
            Scale::Logarithmic => {
                let (low, high) = (
                    self.low.log10().round() as i32,
                    self.high.log10().round() as i32,
                );
                (low..=high).map(|e| 10f64.powi(e)).collect()
            }
        }
    }
}

impl Plot {
    /// Writes `name.svg` and `name.csv` into `folder`.
    ///
    /// # Errors
    /// [`crate::exit::Failure::Output`] if a file cannot be written.
    pub(super) fn write(&self, folder: &Path) -> Result<()> {
        for (extension, text) in [("svg", self.svg()), ("csv", self.csv())] {
            let path = folder.join(format!("{}.{extension}", self.name));
            Pending::create(&path)?.write(|file| file.write_all(text.as_bytes()))?;
        }
        Ok(())
    }

    fn csv(&self) -> String {
        let names: Vec<&str> = self.lines.iter().map(|l| l.0).collect();
        let mut text = format!("{},{}\n", self.x.label, names.join(","));
        for (i, x) in self.at.iter().enumerate() {
            let values: Vec<String> = self
                .lines
                .iter()
                .map(|l| format!("{:.9e}", l.1[i]))
                .collect();
            let _ = writeln!(text, "{x:.9e},{}", values.join(","));
        }
        text
    }

    fn svg(&self) -> String {
        let (width, height) = (WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM);
        let place = |x: f64, y: f64| {
            (
                LEFT + width * self.x.place(x),
                TOP + height * (1.0 - self.y.place(y)),
            )
        };
        let mut s = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" \
             font-size=\"12\">\n<rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"white\"/>\n\
             <text x=\"{LEFT}\" y=\"22\" font-size=\"14\">{}</text>\n",
            self.title
        );
        for mark in self.x.marks() {
            let (x, y) = place(mark, self.y.low);
            let _ = writeln!(
                s,
                "<path d=\"M{x:.1} {y:.1}V{TOP}\" stroke=\"#ddd\"/><text x=\"{x:.1}\" y=\"{:.1}\" \
                 text-anchor=\"middle\">{}</text>",
                y + 16.0,
                label(mark)
            );
        }
        for mark in self.y.marks() {
            let (x, y) = place(self.x.low, mark);
            let _ = writeln!(
                s,
                "<path d=\"M{x:.1} {y:.1}H{:.1}\" stroke=\"#ddd\"/><text x=\"{:.1}\" y=\"{:.1}\" \
                 text-anchor=\"end\">{}</text>",
                LEFT + width,
                x - 6.0,
                y + 4.0,
                label(mark)
            );
        }
        let _ = writeln!(
            s,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\
             <text transform=\"translate(16 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            LEFT + width / 2.0,
            HEIGHT - 12.0,
            self.x.label,
            TOP + height / 2.0,
            self.y.label
        );
        for (i, (name, values)) in self.lines.iter().enumerate() {
            let points: Vec<String> = self
                .at
                .iter()
                .zip(values)
                .map(|(x, y)| place(*x, *y))
                .map(|(x, y)| format!("{x:.1},{y:.1}"))
                .collect();
            let color = COLORS[i % COLORS.len()];
            let row = TOP + 14.0 + 18.0 * i as f64;
            let from = LEFT + width + 12.0;
            let _ = writeln!(
                s,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.5\"/>\
                 <path d=\"M{from} {row}h18\" stroke=\"{color}\" stroke-width=\"2\"/>\
                 <text x=\"{}\" y=\"{}\">{name}</text>",
                points.join(" "),
                from + 24.0,
                row + 4.0
            );
        }
        s.push_str("</svg>\n");
        s
    }
}

fn label(value: f64) -> String {
    let magnitude = value.abs();
    if value != 0.0 && !(0.01..1e4).contains(&magnitude) {
        format!("{value:.0e}")
    } else {
        let text = format!("{value:.2}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    }
}
