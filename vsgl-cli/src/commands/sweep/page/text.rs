//! Text of the page: escaped, numbers of a readable length with their units.

use serde_json::Value;

/// Text as it stands in HTML, between tags and inside quoted attributes. What would turn the direction of text, and
/// control characters, are shown as a replacement.
pub(super) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&#39;",
            '\n' | '\t' | '\u{2028}' | '\u{2029}' => out.push(' '),
            '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => out.push('\u{fffd}'),
            c if c.is_control() => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// A document as it stands in a script element: no character that could end the element or begin a comment in it.
pub(super) fn script_data(document: &Value) -> String {
    let text = document.to_string();
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        // In JSON these are inside strings only.
        match c {
            '<' | '>' | '&' | '\'' | '\u{2028}' | '\u{2029}' => {
                out += &format!("\\u{:04x}", u32::from(c))
            }
            '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => out += "\\ufffd",
            c if c.is_control() => out += &format!("\\u{:04x}", u32::from(c)),
            c => out.push(c),
        }
    }
    out
}

/// A number with three significant digits, thousands grouped from 10,000 on.
pub(super) fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let magnitude = value.abs();
    if magnitude < 1e-4 {
        return format!("{value:.1e}").replace('-', "\u{2212}");
    }
    let decimals = (2 - magnitude.log10().floor() as i32).max(0) as usize;
    let text = format!("{magnitude:.decimals$}");
    let sign = if value < 0.0 { "\u{2212}" } else { "" };
    match text.split_once('.') {
        Some(_) => format!("{sign}{text}"),
        None => format!("{sign}{}", grouped(&text)),
    }
}

/// Digits with commas, from five digits on.
fn grouped(digits: &str) -> String {
    if digits.len() < 5 {
        return digits.to_owned();
    }
    let mut out = String::new();
    for (index, c) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            out.push(',');
        }
        out.push(c);
    }
    out
}

/// A number of things.
pub(super) fn count(number: u64, one: &str) -> String {
    let many = if number == 1 { "" } else { "s" };
    format!("{} {one}{many}", grouped(&number.to_string()))
}

/// A whole number, thousands grouped.
pub(super) fn whole(number: u64) -> String {
    grouped(&number.to_string())
}

/// A time in the unit that suits it.
pub(super) fn seconds(value: f64) -> String {
    match value {
        v if v < 0.999_5e-3 => format!("{} µs", number(v * 1e6)),
        v if v < 0.999_5 => format!("{} ms", number(v * 1e3)),
        v if v < 120.0 => format!("{} s", number(v)),
        v => format!("{} min", number(v / 60.0)),
    }
}

/// The same for the label of an axis: no digits that say nothing.
pub(super) fn short_seconds(value: f64) -> String {
    match value {
        v if v < 0.999_5e-3 => format!("{} µs", short(v * 1e6)),
        v if v < 0.999_5 => format!("{} ms", short(v * 1e3)),
        v => format!("{} s", short(v)),
    }
}

/// A round number without trailing zeros.
pub(super) fn short(value: f64) -> String {
    let text = number(value);
    match text.contains('.') && !text.contains('e') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}
