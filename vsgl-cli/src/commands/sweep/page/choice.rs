//! What is shown: of which light, over which boxes, by which metric, against which time.

use super::points;
use super::text::{number, seconds};
use serde_json::Value;

/// A choice among the errors and times of points. Without a script it is the usual one.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Choice {
    pub(super) layer: &'static str,
    pub(super) scale: &'static str,
    pub(super) metric: &'static str,
    pub(super) time: &'static str,
}

impl Choice {
    /// Light of one bounce over boxes by mape, or the next best of which there are errors.
    pub(super) fn usual(document: &Value) -> Self {
        let of = |layer, scale| Self {
            layer,
            scale,
            metric: "mape",
            time: "wall",
        };
        let choices = [
            ("indirect", "8"),
            ("indirect", "1"),
            ("whole", "8"),
            ("whole", "1"),
        ];
        let mut choices = choices.map(|(layer, scale)| of(layer, scale)).into_iter();
        let known = |c: &Self| points(document).iter().any(|p| c.error(p).is_some());
        choices.find(known).unwrap_or(of("whole", "1"))
    }

    /// The error of a point; none where it is not known.
    pub(super) fn error(&self, point: &Value) -> Option<f64> {
        point["errors"][self.layer][self.scale][self.metric].as_f64()
    }

    /// How far the error may be that of the reference.
    pub(super) fn noise(&self, document: &Value) -> Option<f64> {
        document["reference"]["noise"][self.layer][self.scale][self.metric].as_f64()
    }

    /// Median, least and most seconds of a point; none where they were not measured.
    pub(super) fn time(&self, point: &Value) -> Option<[f64; 3]> {
        let spread = &point[self.time];
        let median = spread["median"].as_f64()?;
        let end = |key: &str| spread[key].as_f64().unwrap_or(median);
        Some([median, end("least"), end("most")])
    }

    /// Time and error of a point.
    pub(super) fn figures(&self, point: &Value) -> String {
        let time = self.time(point).map(|[median, ..]| seconds(median));
        let error = self.error(point).map(|e| format!("{} % error", number(e)));
        let parts: Vec<_> = [time, error].into_iter().flatten().collect();
        parts.join(", ")
    }

    /// The error in words.
    pub(super) fn words(&self) -> String {
        let layer = match self.layer {
            "indirect" => "indirect light",
            _ => "the whole picture",
        };
        let scale = match self.scale {
            "1" => "each pixel".to_owned(),
            side => format!("boxes of {side} × {side} pixels"),
        };
        format!("{layer}, {scale}, mean error ({})", self.metric)
    }
}
