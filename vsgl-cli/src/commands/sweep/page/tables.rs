//! The points as tables; the script sorts them.

use super::choice::Choice;
use super::text::{escape, number, seconds, whole};
use super::{count, points, words};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Settings that come first, in this order.
const FIRST: [&str; 3] = ["lights", "interleave", "occlusion"];

/// What no other setting of its backend beats, fastest first.
pub(super) fn front(document: &Value, choice: &Choice) -> String {
    let mut rows: Vec<_> = points(document)
        .iter()
        .filter(|p| p["front"] == true)
        .collect();
    rows.sort_by(|a, b| order(choice, a).total_cmp(&order(choice, b)));
    let caption = format!("By {}, against wall time.", choice.words());
    format!(
        "<section id=\"front\">\n<h2>The front</h2>\n<p class=\"small\" id=\"front-note\">{}</p>\n{}</section>\n",
        escape(&caption),
        table("front-table", &columns(document), &rows, choice)
    )
}

/// All points.
pub(super) fn all(document: &Value, choice: &Choice) -> String {
    let mut rows: Vec<_> = points(document).iter().collect();
    rows.sort_by(|a, b| order(choice, a).total_cmp(&order(choice, b)));
    format!(
        "<section id=\"all\">\n<details>\n<summary><h2>All {}</h2></summary>\n{}</details>\n</section>\n",
        count(rows.len() as u64, "point"),
        table("all-table", &columns(document), &rows, choice)
    )
}

fn order(choice: &Choice, point: &Value) -> f64 {
    choice
        .time(point)
        .map_or(f64::INFINITY, |[median, ..]| median)
}

/// The settings that are not the same for all points.
fn columns(document: &Value) -> Vec<&str> {
    let mut values: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    let settings = || {
        points(document)
            .iter()
            .filter_map(|p| p["settings"].as_object())
    };
    for (key, value) in settings().flatten() {
        values
            .entry(key)
            .or_default()
            .insert(value.as_str().unwrap_or(""));
    }
    let everywhere = |key: &str| settings().all(|s| s.contains_key(key));
    let mut keys: Vec<_> = values
        .iter()
        .filter(|(key, values)| values.len() > 1 || !everywhere(key))
        .map(|(key, _)| *key)
        .collect();
    keys.sort_by_key(|key| FIRST.iter().position(|f| f == key).unwrap_or(FIRST.len()));
    keys
}

fn table(id: &str, columns: &[&str], rows: &[&Value], choice: &Choice) -> String {
    let mut html = format!(
        "<div class=\"scroll\"><table id=\"{id}\">\n<thead><tr><th scope=\"col\">backend</th>"
    );
    for column in columns {
        html += &format!("<th scope=\"col\">{}</th>", escape(column));
    }
    html += "<th scope=\"col\">virtual lights</th><th scope=\"col\">wall time</th><th scope=\"col\">CPU time</th>";
    html += "<th scope=\"col\">error</th></tr></thead>\n<tbody>\n";
    for point in rows {
        html += &format!(
            "<tr data-id=\"{}\"><td>{}</td>",
            escape(words(point, "id")),
            escape(words(point, "backend"))
        );
        for column in columns {
            html += &format!("<td>{}</td>", escape(words(&point["settings"], column)));
        }
        let lights = point["virtual_lights"].as_u64().map_or("–".into(), whole);
        let time = |key: &str| point[key]["median"].as_f64().map_or("–".into(), seconds);
        let error = choice
            .error(point)
            .map_or("–".into(), |e| format!("{} %", number(e)));
        for text in [lights, time("wall"), time("cpu"), error] {
            html += &format!("<td class=\"number\">{text}</td>");
        }
        html += "</tr>\n";
    }
    html += "</tbody>\n</table></div>\n";
    html
}
