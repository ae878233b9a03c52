//! The report of a sweep: one HTML file that needs no others.
//!
//! The tables, a chart and the pictures are there without any script; the script adds the choice of what is shown. Names
//! come from files that anyone may have made: all text goes through [`text::escape`], the document through
//! [`text::script_data`], and the policy of the page lets nothing be loaded and only our own script and style run.

mod base64;
mod chart;
mod choice;
mod digest;
mod pictures;
mod reading;
mod tables;
mod text;

#[cfg(test)]
mod tests;

use choice::Choice;
use pictures::Pictures;
use serde_json::Value;
use text::{count, escape, seconds};

const STYLE: &str = include_str!("page/style.css");
const SCRIPT: &str = concat!(
    "(() => {\n'use strict';\n",
    include_str!("page/words.js"),
    include_str!("page/state.js"),
    include_str!("page/chart.js"),
    include_str!("page/chosen.js"),
    include_str!("page/table.js"),
    include_str!("page/controls.js"),
    "})();\n",
);

/// The page of a sweep's document; `pictures` has the bytes of a PNG in the sweep's folder by its name.
///
/// What the document lacks is left out of the page: a sweep that was interrupted has a page too.
pub(super) fn page(document: &Value, pictures: &dyn Fn(&str) -> Option<Vec<u8>>) -> String {
    let choice = Choice::usual(document);
    let pictures = Pictures::new(document, pictures);
    let style = format!("\n{STYLE}");
    let script = format!("\n{SCRIPT}");
    let policy = format!(
        "default-src 'none'; img-src data:; style-src 'sha256-{}'; script-src 'sha256-{}'; base-uri 'none'; form-action 'none'",
        base64::encode(&digest::sha256(style.as_bytes())),
        base64::encode(&digest::sha256(script.as_bytes())),
    );
    let title = format!("What time buys in {}", scene_name(document));
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <meta name=\"referrer\" content=\"no-referrer\">\n\
         <title>{title}</title>\n<style>{style}</style>\n</head>\n<body>\n",
        title = escape(&title),
    );
    html += &header(document, &title);
    html += "<main>\n";
    html += &advice(document, &choice);
    html += &explorer(document, &choice);
    html += &tables::front(document, &choice);
    html += &tables::all(document, &choice);
    html += &pictures.gallery(document, &choice);
    html += &reading::section(document, &choice);
    html += "</main>\n";
    html += &format!(
        "<script type=\"application/json\" id=\"document\">{}</script>\n<script>{script}</script>\n</body>\n</html>\n",
        text::script_data(document)
    );
    html
}

/// The points of a document.
fn points(document: &Value) -> &[Value] {
    document["points"].as_array().map_or(&[], Vec::as_slice)
}

/// The point of this name.
fn point<'a>(document: &'a Value, id: &str) -> Option<&'a Value> {
    points(document).iter().find(|p| p["id"] == id)
}

/// A text of the document; empty where there is none.
fn words<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or("")
}

/// The scene without its folder.
fn scene_name(document: &Value) -> &str {
    let name = words(&document["scene"], "name");
    match name.rsplit(['/', '\\']).next() {
        None | Some("") => "a scene",
        Some(file) => file,
    }
}

fn header(document: &Value, title: &str) -> String {
    let mut facts = Vec::new();
    let scene = &document["scene"];
    for (key, one) in [("triangles", "triangle"), ("lights", "light")] {
        if let Some(number) = scene[key].as_u64() {
            facts.push(count(number, one));
        }
    }
    if let (Some(w), Some(h)) = (document["width"].as_u64(), document["height"].as_u64()) {
        facts.push(format!("{w} × {h} pixels"));
    }
    let machine = &document["machine"];
    let processor = words(machine, "processor");
    let of = |key: &str, one: &str| machine[key].as_u64().map(|n| count(n, one));
    let threads = of("threads", "thread").or_else(|| of("cores", "core"));
    let machine = [
        Some(processor.to_owned()).filter(|p| !p.is_empty()),
        threads,
    ];
    let machine: Vec<_> = machine.into_iter().flatten().collect();
    facts.push(machine.join(", "));
    facts.extend([
        words(document, "date").into(),
        words(document, "software").into(),
    ]);
    let facts = facts.iter().filter(|f| !f.is_empty());
    let facts: Vec<_> = facts.map(|f| format!("<li>{}</li>", escape(f))).collect();
    let mut html = format!(
        "<header>\n<h1>{}</h1>\n<ul class=\"facts\">{}</ul>\n",
        escape(title),
        facts.join("")
    );
    if let Some(note) = unfinished(document) {
        html += &format!("<p class=\"note\" role=\"status\">{}</p>\n", escape(&note));
    }
    html += "</header>\n";
    html
}

/// What to say where the sweep was not finished.
fn unfinished(document: &Value) -> Option<String> {
    let done = points(document).len() as u64;
    let planned = document["planned"].as_u64().unwrap_or(0);
    let stopped = document["finished"] == false;
    if !stopped && planned <= done {
        return None;
    }
    let of = match planned > done {
        true => format!("{done} of {}", count(planned, "point")),
        false => count(done, "point"),
    };
    let end = "The same command goes on where it stopped.";
    Some(format!("This sweep is not finished: {of} measured. {end}"))
}

fn advice(document: &Value, choice: &Choice) -> String {
    let advised = document["advice"].as_array().map_or(&[][..], Vec::as_slice);
    // One card a point, whatever it is good for.
    let mut cards: Vec<(&str, Vec<&str>)> = Vec::new();
    for entry in advised {
        let (id, purpose) = (words(entry, "id"), words(entry, "for"));
        match cards.iter_mut().find(|(other, _)| *other == id) {
            Some((_, purposes)) => purposes.push(purpose),
            None => cards.push((id, vec![purpose])),
        }
    }
    let mut list = String::new();
    for (id, purposes) in cards {
        let Some(point) = point(document, id) else {
            continue;
        };
        list += &format!(
            "<li data-id=\"{}\"><h3>For {}</h3>\n<p>{}</p>\n<p class=\"figures\">{}</p>\n{}</li>\n",
            escape(id),
            escape(&purposes.join(", ")),
            escape(&label(point)),
            escape(&choice.figures(point)),
            folded(words(point, "command")),
        );
    }
    if list.is_empty() {
        return String::new();
    }
    format!(
        "<section id=\"advice\">\n<h2>Advice</h2>\n<ul class=\"cards\">\n{list}</ul>\n</section>\n"
    )
}

/// A point in a few words: its backend and what is set.
fn label(point: &Value) -> String {
    let name = match words(point, "name") {
        "" => words(point, "id"),
        name => name,
    };
    format!("{}: {name}", words(point, "backend"))
}

/// A command to copy; the script adds the button. Lines break between words alone.
fn command(line: &str) -> String {
    let words = line
        .split(' ')
        .map(|w| format!("<span>{}</span>", escape(w)));
    let words: Vec<_> = words.collect();
    format!(
        "<div class=\"command\"><code>{}</code></div>\n",
        words.join(" ")
    )
}

/// The same, shown when asked for.
fn folded(line: &str) -> String {
    format!(
        "<details class=\"folded\"><summary>Command</summary>{}</details>\n",
        command(line)
    )
}

/// The chart, and the place for what is chosen.
fn explorer(document: &Value, choice: &Choice) -> String {
    let (figure, backends) = chart::figure(document, choice);
    let mut legend = String::new();
    for (index, name) in backends.iter().enumerate() {
        legend += &format!(
            "<li class=\"backend\"><svg viewBox=\"-8 -8 16 16\" width=\"16\" height=\"16\" aria-hidden=\"true\">{}</svg> {}</li>",
            chart::mark(index, 0.0, 0.0, true),
            escape(name)
        );
    }
    format!(
        "<section id=\"explore\">\n<h2>Error against time</h2>\n<div id=\"controls\" hidden></div>\n\
         <div class=\"split\">\n<div id=\"plot\">\n<ul class=\"legend\" id=\"legend\">{legend}</ul>\n\
         <div class=\"scroll\" id=\"chart\">{figure}</div>\n<p class=\"small\" id=\"chart-note\">{}</p>\n</div>\n\
         <div id=\"chosen\" hidden aria-live=\"polite\"></div>\n</div>\n</section>\n",
        escape(&reading::chart_note(document, choice)),
    )
}

/// What the reference is, in words.
fn reference(document: &Value) -> String {
    let reference = &document["reference"];
    let mut parts = Vec::new();
    match words(reference, "source") {
        "" => {}
        "path" => parts.push("path tracing".to_owned()),
        other => parts.push(other.to_owned()),
    }
    if let Some(spp) = reference["spp"].as_u64() {
        parts.push(format!("{} a pixel", count(spp, "path")));
    }
    if let Some(time) = reference["seconds"].as_f64() {
        parts.push(format!("made in {}", seconds(time)));
    }
    parts.join(", ")
}
