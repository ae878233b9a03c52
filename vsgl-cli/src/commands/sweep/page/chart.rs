//! Error against time as SVG, for readers without a script: `chart.js` draws the same for any choice.

use super::choice::Choice;
use super::text::{escape, short, short_seconds};
use super::{label, points, words};
use serde_json::Value;

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 470.0;
const LEFT: f64 = 66.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 12.0;
const BOTTOM: f64 = 48.0;

/// The chart, and the backends in the order of their colours.
pub(super) fn figure<'a>(document: &'a Value, choice: &Choice) -> (String, Vec<&'a str>) {
    let mut backends: Vec<&str> = Vec::new();
    for point in points(document) {
        let name = words(point, "backend");
        if !backends.contains(&name) {
            backends.push(name);
        }
    }
    let shown: Vec<_> = points(document)
        .iter()
        .filter_map(|p| Some((p, choice.time(p)?, choice.error(p)?)))
        .filter(|(_, [median, least, most], error)| {
            [median, least, most, error]
                .iter()
                .all(|v| v.is_finite() && **v > 0.0)
        })
        .collect();
    if shown.is_empty() {
        return ("<p>Nothing is measured yet.</p>".into(), backends);
    }
    let times = shown.iter().flat_map(|(_, time, _)| *time);
    let noise = choice.noise(document).filter(|n| *n > 0.0);
    let errors = shown.iter().map(|(.., error)| *error);
    let least_error = errors.clone().fold(f64::INFINITY, f64::min);
    let floor = noise.filter(|n| *n > 0.1 * least_error);
    let across = Axis::new(times, LEFT, WIDTH - RIGHT);
    let up = Axis::new(errors.chain(floor), HEIGHT - BOTTOM, TOP);

    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"Error against time; the tables below have the \
         same numbers\">\n"
    );
    if let Some(noise) = floor {
        let top = up.place(noise).min(HEIGHT - BOTTOM);
        svg += &format!(
            "<rect class=\"noise\" x=\"{LEFT}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\"></rect>\n",
            WIDTH - LEFT - RIGHT,
            HEIGHT - BOTTOM - top
        );
    }
    svg += &axes(&across, &up, choice);
    for (index, backend) in backends.iter().enumerate() {
        let mut front: Vec<_> = shown
            .iter()
            .filter(|(p, ..)| p["front"] == true && words(p, "backend") == *backend)
            .map(|(_, [median, ..], error)| (across.place(*median), up.place(*error)))
            .collect();
        front.sort_by(|a, b| a.0.total_cmp(&b.0));
        let stairs = front.windows(2).fold(String::new(), |path, pair| {
            format!("{path}H{:.1}V{:.1}", pair[1].0, pair[1].1)
        });
        if let Some((x, y)) = front.first() {
            svg += &format!(
                "<path class=\"front b{}\" d=\"M{x:.1} {y:.1}{stairs}\"></path>\n",
                index % 6
            );
        }
    }
    for (point, [median, least, most], error) in &shown {
        let index = backends
            .iter()
            .position(|b| *b == words(point, "backend"))
            .unwrap_or(0);
        let (x, y) = (across.place(*median), up.place(*error));
        svg += &format!(
            "<g class=\"point b{}\"><title>{}: {}</title><path class=\"spread\" d=\"M{:.1} {y:.1}H{:.1}\"></path>{}</g>\n",
            index % 6,
            escape(&label(point)),
            escape(&choice.figures(point)),
            across.place(*least),
            across.place(*most),
            mark(index, x, y, point["front"] == true)
        );
    }
    svg += "</svg>";
    (svg, backends)
}

/// Grid, numbers and titles.
fn axes(across: &Axis, up: &Axis, choice: &Choice) -> String {
    let mut svg = String::new();
    let (bottom, right) = (HEIGHT - BOTTOM, WIDTH - RIGHT);
    for (value, named) in across.ticks() {
        let x = across.place(value);
        let class = if named { "grid" } else { "grid faint" };
        svg += &format!("<path class=\"{class}\" d=\"M{x:.1} {TOP}V{bottom}\"></path>");
        if named {
            svg += &format!(
                "<text class=\"tick\" x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                bottom + 18.0,
                short_seconds(value)
            );
        }
    }
    for (value, named) in up.ticks() {
        let y = up.place(value);
        let class = if named { "grid" } else { "grid faint" };
        svg += &format!("<path class=\"{class}\" d=\"M{LEFT} {y:.1}H{right}\"></path>");
        if named {
            svg += &format!(
                "<text class=\"tick\" x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{} %</text>",
                LEFT - 7.0,
                y + 4.0,
                short(value)
            );
        }
    }
    let middle = (TOP + bottom) / 2.0;
    svg += &format!(
        "<text class=\"axis\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">wall time of a frame</text>",
        (LEFT + right) / 2.0,
        HEIGHT - 8.0
    );
    svg += &format!(
        "<text class=\"axis\" x=\"14\" y=\"{middle}\" text-anchor=\"middle\" transform=\"rotate(-90 14 {middle})\">mean \
         error ({})</text>\n",
        choice.metric
    );
    svg
}

/// The mark of a backend: another shape as well as another colour.
pub(super) fn mark(backend: usize, x: f64, y: f64, full: bool) -> String {
    let r = if full { 5.5 } else { 4.5 };
    let d = match backend % 4 {
        0 => format!(
            "M{:.1} {y:.1}a{r} {r} 0 1 0 {} 0a{r} {r} 0 1 0 {} 0z",
            x - r,
            2.0 * r,
            -2.0 * r
        ),
        1 => format!(
            "M{:.1} {:.1}h{w}v{w}h-{w}z",
            x - 0.9 * r,
            y - 0.9 * r,
            w = 1.8 * r
        ),
        2 => format!(
            "M{x:.1} {:.1}l{:.2} {h:.2}h{:.2}z",
            y - 1.15 * r,
            1.1 * r,
            -2.2 * r,
            h = 2.0 * r
        ),
        _ => format!(
            "M{x:.1} {:.1}l{s} {s}l-{s} {s}l-{s} -{s}z",
            y - 1.25 * r,
            s = 1.25 * r
        ),
    };
    let class = if full { "mark full" } else { "mark" };
    format!("<path class=\"{class} b{}\" d=\"{d}\"></path>", backend % 6)
}

/// A logarithmic axis.
struct Axis {
    least: f64,
    most: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// Around these values, between two places in the picture.
    fn new(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let (least, most) = values.fold((f64::INFINITY, 0.0_f64), |(a, b), v| (a.min(v), b.max(v)));
        // A third more on both sides, and never less than a factor of two in all.
        let middle = (least * most).sqrt();
        let reach = (most / least).sqrt().powf(1.08).max(1.5) * 1.08;
        Self {
            least: middle / reach,
            most: middle * reach,
            from,
            to,
        }
    }

    fn place(&self, value: f64) -> f64 {
        let share = (value / self.least).ln() / (self.most / self.least).ln();
        self.from + share * (self.to - self.from)
    }

    /// Round values, and whether each gets its number.
    fn ticks(&self) -> Vec<(f64, bool)> {
        let decades = (self.most / self.least).log10();
        let named: &[u32] = match decades {
            d if d < 1.3 => &[1, 2, 3, 5, 7],
            d if d < 2.6 => &[1, 2, 5],
            _ => &[1],
        };
        let mut ticks = Vec::new();
        for decade in self.least.log10().floor() as i32..=self.most.log10().ceil() as i32 {
            for digit in 1..10 {
                let value = f64::from(digit) * 10_f64.powi(decade);
                if (self.least..=self.most).contains(&value) {
                    ticks.push((value, named.contains(&digit)));
                }
            }
        }
        ticks
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_hold_their_values_and_have_numbers() {
        for values in [vec![1.0], vec![0.9, 1.1], vec![1e-6, 1e6], vec![3.0, 40.0]] {
            let axis = Axis::new(values.iter().copied(), 10.0, 110.0);
            for value in &values {
                assert!((10.0..=110.0).contains(&axis.place(*value)));
            }
            let named = axis.ticks().iter().filter(|(_, named)| *named).count();
            assert!((2..16).contains(&named), "{values:?}: {named}");
        }
    }

    #[test]
    fn places_are_logarithmic() {
        let axis = Axis::new([1.0, 100.0].into_iter(), 0.0, 1.0);
        let (a, b, c) = (axis.place(1.0), axis.place(10.0), axis.place(100.0));
        assert!((b - a - (c - b)).abs() < 1e-12 && b > a);
    }
}
