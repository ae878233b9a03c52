//! Addresses: data inside the address, or a file beside the scene.

use super::fault::{Fault, Result, quoted};
use std::path::{Component, Path, PathBuf};

/// What an address stands for.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// The bytes themselves.
    Data(Vec<u8>),
    /// Relative paths that stay inside the folder, the likeliest first.
    File(Vec<PathBuf>),
}

/// Takes an address apart. `place` is where it stands.
pub(super) fn parse(uri: &str, place: &str) -> Result<Target> {
    if let Some(rest) = strip_scheme(uri, "data") {
        return data(rest, place).map(Target::Data);
    }
    if has_scheme(uri) {
        return Err(Fault::new(
            format!("{place}.uri"),
            format!("{} is not a file beside the scene", quoted(uri)),
            "copy the file into the scene's folder and name it by a relative path",
        ));
    }
    // Addresses are percent-encoded, but some exporters forget to.
    let decoded = percent_decoded(uri)
        .and_then(|bytes| String::from_utf8(bytes).ok())
        .filter(|decoded| decoded != uri);
    let mut paths = Vec::new();
    for text in decoded.iter().map(String::as_str).chain([uri]) {
        paths.push(inside(text).ok_or_else(|| {
            Fault::new(
                format!("{place}.uri"),
                format!("{} leaves the scene's folder", quoted(uri)),
                "files must lie in the folder of the scene or below",
            )
        })?);
    }
    Ok(Target::File(paths))
}

fn strip_scheme<'a>(uri: &'a str, scheme: &str) -> Option<&'a str> {
    let (head, rest) = uri.split_once(':')?;
    head.eq_ignore_ascii_case(scheme).then_some(rest)
}

/// Whether the address begins like `http:` or `C:`.
fn has_scheme(uri: &str) -> bool {
    uri.split_once(':').is_some_and(|(head, _)| {
        head.starts_with(|c: char| c.is_ascii_alphabetic())
            && head
                .chars()
                .all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c))
    })
}

/// The path, if it cannot lead out of the folder it is taken relative to (links aside).
fn inside(text: &str) -> Option<PathBuf> {
    if text.is_empty() || text.contains('\0') {
        return None;
    }
    let mut path = PathBuf::new();
    for component in Path::new(text).components() {
        match component {
            Component::Normal(name) => path.push(name),
            Component::CurDir => {}
            Component::ParentDir => {
                if !path.pop() {
                    return None;
                }
            }
            Component::RootDir | Component::Prefix(_) => return None,
        }
    }
    Some(path)
}

/// What follows `data:`, decoded.
fn data(rest: &str, place: &str) -> Result<Vec<u8>> {
    let broken = |problem: &str| {
        Fault::new(
            format!("{place}.uri"),
            format!("data URI {problem}"),
            "expected `data:<type>;base64,<data>`",
        )
    };
    let (kind, body) = rest
        .split_once(',')
        .ok_or_else(|| broken("without a comma"))?;
    if kind.to_ascii_lowercase().ends_with(";base64") {
        base64(body.as_bytes()).ok_or_else(|| broken("is not base64"))
    } else {
        percent_decoded(body).ok_or_else(|| broken("with a broken percent sign"))
    }
}

/// Each `%41` replaced by its byte; none if a percent sign stands alone.
fn percent_decoded(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let [first, after @ ..] = rest {
        rest = after;
        if *first == b'%' {
            let [high, low, after @ ..] = rest else {
                return None;
            };
            let digit = |d: u8| char::from(d).to_digit(16);
            bytes.push((digit(*high)? * 16 + digit(*low)?) as u8);
            rest = after;
        } else {
            bytes.push(*first);
        }
    }
    Some(bytes)
}

/// Decodes base64 of the usual alphabet, with or without padding.
fn base64(text: &[u8]) -> Option<Vec<u8>> {
    let end = text.iter().rposition(|&c| c != b'=').map_or(0, |i| i + 1);
    let (digits, padding) = text.split_at(end);
    if padding.len() > 2 || digits.len() % 4 == 1 {
        return None;
    }
    let mut bytes = Vec::with_capacity(digits.len() / 4 * 3 + 2);
    for group in digits.chunks(4) {
        let mut word = 0u32;
        for (i, &c) in group.iter().enumerate() {
            word |= base64_digit(c)? << (18 - 6 * i);
        }
        bytes.extend_from_slice(&word.to_be_bytes()[1..group.len()]);
    }
    Some(bytes)
}

fn base64_digit(c: u8) -> Option<u32> {
    Some(u32::from(match c {
        b'A'..=b'Z' => c - b'A',
        b'a'..=b'z' => c - b'a' + 26,
        b'0'..=b'9' => c - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        _ => return None,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(uri: &str) -> Option<PathBuf> {
        match parse(uri, "buffers[0]") {
            Ok(Target::File(paths)) => Some(paths[0].clone()),
            _ => None,
        }
    }

    #[test]
    fn base64_with_and_without_padding() {
        for (text, bytes) in [
            ("", &b""[..]),
            ("Zg==", b"f"),
            ("Zg", b"f"),
            ("Zm8=", b"fo"),
            ("Zm9v", b"foo"),
            ("+/+/", &[0xfb, 0xff, 0xbf]),
        ] {
            assert_eq!(base64(text.as_bytes()).as_deref(), Some(bytes), "{text}");
        }
        for text in ["Z", "Zg===", "Z!==", "=Zg", "Zm9v\n"] {
            assert_eq!(base64(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn data_uris() {
        let data = |uri| match parse(uri, "images[0]") {
            Ok(Target::Data(bytes)) => Some(bytes),
            _ => None,
        };
        assert_eq!(data("data:;base64,Zm9v"), Some(b"foo".to_vec()));
        assert_eq!(data("DATA:image/png;BASE64,Zm9v"), Some(b"foo".to_vec()));
        assert_eq!(data("data:,a%20b"), Some(b"a b".to_vec()));
        assert_eq!(data("data:;base64"), None);
        assert_eq!(data("data:;base64,!"), None);
        assert_eq!(data("data:,%2"), None);
    }

    #[test]
    fn relative_paths() {
        assert_eq!(file("a.bin"), Some("a.bin".into()));
        assert_eq!(file("./t/a%20b.png"), Some("t/a b.png".into()));
        assert_eq!(file("t/../a.bin"), Some("a.bin".into()));
        assert_eq!(file("100%.bin"), Some("100%.bin".into()));
        assert_eq!(file("grün.png"), Some("grün.png".into()));
    }

    #[test]
    fn nothing_leads_out_of_the_folder() {
        for uri in [
            "../a.bin",
            "t/../../a.bin",
            "%2e%2e/a.bin",
            "/etc/hostname",
            "%2Fetc/hostname",
            "file:///etc/hostname",
            "FILE:a.bin",
            "http://example.org/a.bin",
            "",
            "a%00b",
        ] {
            assert_eq!(file(uri), None, "{uri}");
        }
    }
}
