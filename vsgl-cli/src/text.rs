//! Text for people: standard streams that may be closed, numbers of a readable length, quoted commands.

use crate::exit::{Failure, Result};
use std::borrow::Cow;
use std::io::{ErrorKind, Write};

/// Writes to standard output. A reader that has gone (`| head`) is no failure.
///
/// # Errors
/// [`Failure::Output`] if the stream fails otherwise.
pub(crate) fn print(text: &str) -> Result<()> {
    let text = harmless(text, |_| "\u{fffd}".into());
    let mut stdout = std::io::stdout().lock();
    let written = stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush());
    match written {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::Output(format!("standard output: {e}")))
        }
        _ => Ok(()),
    }
}

/// Prints one JSON document on standard output.
///
/// # Errors
/// As [`print`].
pub(crate) fn print_json(document: &serde_json::Value) -> Result<()> {
    let text = format!("{document:#}\n");
    // In a document such characters are inside strings only.
    let text = harmless(&text, |c| format!("\\u{:04x}", u32::from(c)));
    print(&text)
}

/// The text with something else in the place of what a terminal would obey: names come from files that anyone may have
/// made.
fn harmless(text: &str, instead: impl Fn(char) -> String) -> Cow<'_, str> {
    let obeyed = |c: char| {
        (c.is_control() && !matches!(c, '\n' | '\t'))
            || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    if !text.contains(obeyed) {
        return Cow::Borrowed(text);
    }
    let mut clean = String::with_capacity(text.len());
    for c in text.chars() {
        if obeyed(c) {
            clean += &instead(c);
        } else {
            clean.push(c);
        }
    }
    Cow::Owned(clean)
}

/// Writes a line to standard error; if that is closed there is nobody to tell.
pub(crate) fn warn(line: &str) {
    let line = harmless(line, |_| "\u{fffd}".into());
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// A number with five significant digits.
pub(crate) fn number(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    if !(1e-4..1e6).contains(&magnitude) {
        return format!("{value:.4e}");
    }
    let decimals = 4 - magnitude.log10().floor() as i32;
    format!("{value:.*}", decimals.max(0) as usize)
}

/// A finite number for JSON, which has no others.
pub(crate) fn json_number(value: f64) -> serde_json::Value {
    serde_json::Number::from_f64(value).map_or(serde_json::Value::Null, Into::into)
}

/// A command line that a shell reads as these words.
pub(crate) fn shell(words: &[String]) -> String {
    let quote = |word: &String| {
        let plain = |c: char| c.is_ascii_alphanumeric() || "_-+=./:,@%".contains(c);
        if !word.is_empty() && word.chars().all(plain) {
            word.clone()
        } else {
            format!("'{}'", word.replace('\'', "'\\''"))
        }
    };
    words.iter().map(quote).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_five_digits() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1.0000"),
            (-123.456_78, "-123.46"),
            (0.000_123_456, "0.00012346"),
            (99_999.0, "99999"),
            (1e-9, "1.0000e-9"),
            (3.2e7, "3.2000e7"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn what_a_terminal_obeys_is_replaced() {
        let mark = |_: char| "?".to_owned();
        assert_eq!(
            harmless("a\u{1b}[2Jb\u{9b}c\u{202e}d\ne", mark),
            "a?[2Jb?c?d\ne"
        );
        assert!(matches!(harmless("grün\n", mark), Cow::Borrowed(_)));
        let name = serde_json::json!("\u{1b}\u{9b}\u{202e}");
        let shown =
            harmless(&name.to_string(), |c| format!("\\u{:04x}", u32::from(c))).into_owned();
        assert_eq!(shown, r#""\u001b\u009b\u202e""#);
        assert_eq!(
            serde_json::from_str::<serde_json::Value>(&shown).ok(),
            Some(name)
        );
    }

    #[test]
    fn words_are_quoted_where_a_shell_would_split_them() {
        let words = ["vsgl", "a b", "it's", "", "--spot=1,2,3:0,0,0:9:30"].map(String::from);
        assert_eq!(
            shell(&words),
            r"vsgl 'a b' 'it'\''s' '' --spot=1,2,3:0,0,0:9:30"
        );
    }
}
