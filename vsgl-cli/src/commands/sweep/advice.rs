//! What a sweep comes to: the front, and the cheapest settings for an error or the best for a time.

use crate::measure::front;
use serde_json::{Value, json};

/// Errors that users ask for, in percent.
const ERRORS: [f64; 5] = [20.0, 10.0, 5.0, 2.0, 1.0];
/// Times that users have, in seconds.
const TIMES: [f64; 7] = [0.033, 0.1, 0.2, 0.5, 1.0, 5.0, 20.0];

/// The error that advice is about: mean absolute percentage error of the indirect light after a box of 8 by 8 pixels, or of
/// all light where none is indirect.
pub(super) fn error(point: &Value) -> f64 {
    let layers = ["indirect", "whole"].map(|layer| &point["errors"][layer]["8"]["mape"]);
    let error = layers.into_iter().find_map(Value::as_f64);
    error.unwrap_or(f64::INFINITY)
}

/// Marks the points of the front, and says which to take for what.
pub(super) fn give(points: &mut [Value]) -> Value {
    let pairs: Vec<_> = points
        .iter()
        .map(|p| (super::seconds(p), error(p)))
        .collect();
    let best = front(&pairs);
    for (index, point) in points.iter_mut().enumerate() {
        point["front"] = best.contains(&index).into();
    }
    let id = |index: &usize| points[*index]["id"].clone();
    let mut advice = Vec::new();
    for limit in ERRORS {
        let cheapest = best.iter().find(|&&i| pairs[i].1 <= limit);
        advice.extend(
            cheapest.map(|i| json!({"for": format!("an error of {limit} %"), "id": id(i)})),
        );
    }
    for limit in TIMES {
        let nearest = best.iter().rev().find(|&&i| pairs[i].0 <= limit);
        advice
            .extend(nearest.map(|i| json!({"for": format!("a frame in {limit} s"), "id": id(i)})));
    }
    advice.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(id: &str, seconds: f64, error: f64) -> Value {
        json!({
            "id": id, "wall": {"median": seconds},
            "errors": {"indirect": {"8": {"mape": error}}},
        })
    }

    #[test]
    fn advice_keeps_to_the_front() {
        let mut points = vec![
            point("slow", 4.0, 1.5),
            point("fast", 0.09, 12.0),
            point("beaten", 5.0, 2.0),
        ];
        let advice = give(&mut points);
        let of = |what: &str| {
            let found = advice
                .as_array()
                .and_then(|a| a.iter().find(|a| a["for"] == what));
            found.map(|a| a["id"].clone())
        };
        assert_eq!(of("an error of 20 %"), Some("fast".into()));
        assert_eq!(of("an error of 10 %"), Some("slow".into()));
        assert_eq!(of("an error of 1 %"), None);
        assert_eq!(of("a frame in 0.033 s"), None);
        assert_eq!(of("a frame in 1 s"), Some("fast".into()));
        assert_eq!(of("a frame in 20 s"), Some("slow".into()));
        assert_eq!(points.iter().filter(|p| p["front"] == true).count(), 2);
    }

    #[test]
    fn without_indirect_light_all_light_counts() {
        let mut point = point("a", 1.0, 2.0);
        point["errors"] = json!({"indirect": {"8": null}, "whole": {"8": {"mape": 3.0}}});
        assert_eq!(error(&point), 3.0);
        assert_eq!(error(&json!({})), f64::INFINITY);
    }
}
