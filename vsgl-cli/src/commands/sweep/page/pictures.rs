//! Which pictures the page holds: the reference, what is advised and the front, as far as they fit.

use super::choice::Choice;
use super::text::{escape, seconds};
use super::{base64, folded, label, points, words};
use serde_json::Value;
use std::collections::BTreeMap;

/// Bytes of PNGs in a page; base 64 makes a third more of them.
const BYTES_MAX: usize = 7 << 20;
/// How a PNG begins.
const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Pictures as `data:` addresses.
pub(super) struct Pictures {
    reference: Option<String>,
    /// By the id of their point.
    of: BTreeMap<String, String>,
    /// Points of the front without.
    left_out: usize,
}

impl Pictures {
    /// Takes what fits.
    pub(super) fn new(document: &Value, read: &dyn Fn(&str) -> Option<Vec<u8>>) -> Self {
        let mut room = BYTES_MAX;
        let mut take = |value: &Value| {
            let bytes = read(value.as_str().filter(|name| inside(name))?)?;
            if !bytes.starts_with(SIGNATURE) || bytes.len() > room {
                return None;
            }
            room -= bytes.len();
            Some(format!("data:image/png;base64,{}", base64::encode(&bytes)))
        };
        let reference = take(&document["reference"]["picture"]);
        let front: Vec<_> = points(document)
            .iter()
            .filter(|p| p["front"] == true)
            .collect();
        let advice = document["advice"].as_array().map_or(&[][..], Vec::as_slice);
        let advised = |p: &Value| advice.iter().any(|a| a["id"] == p["id"]);
        // What is advised first, then every 8th, 4th, 2nd … of the front: what does not fit is missing evenly.
        let mut order: Vec<_> = front.iter().enumerate().collect();
        order.sort_by_key(|(index, p)| (!advised(p), std::cmp::Reverse(index.trailing_zeros())));
        let more = points(document)
            .iter()
            .filter(|p| advised(p) && p["front"] != true);
        let wanted = more.chain(order.into_iter().map(|(_, p)| *p));
        let mut of = BTreeMap::new();
        for point in wanted {
            if let Some(picture) = take(&point["picture"]) {
                of.insert(words(point, "id").to_owned(), picture);
            }
        }
        let left_out = front
            .iter()
            .filter(|p| !of.contains_key(words(p, "id")))
            .count();
        Self {
            reference,
            of,
            left_out,
        }
    }

    /// All of them, with what made them; the script shows them elsewhere as well.
    pub(super) fn gallery(&self, document: &Value, choice: &Choice) -> String {
        let size = match (document["width"].as_u64(), document["height"].as_u64()) {
            (Some(w), Some(h)) => format!(" width=\"{w}\" height=\"{h}\""),
            _ => String::new(),
        };
        let mut figures = String::new();
        if let Some(picture) = &self.reference {
            let made = super::reference(document);
            figures += &format!(
                "<figure><img id=\"reference\" alt=\"The reference\" src=\"{picture}\"{size}>\n\
                 <figcaption><b>The reference</b><br>{}</figcaption></figure>\n",
                escape(&made)
            );
        }
        let mut shown: Vec<_> = points(document).iter().collect();
        shown.retain(|p| self.of.contains_key(words(p, "id")));
        let time = |p: &Value| choice.time(p).map_or(f64::INFINITY, |[median, ..]| median);
        shown.sort_by(|a, b| time(a).total_cmp(&time(b)));
        for point in shown {
            let (id, name) = (words(point, "id"), label(point));
            let figures_of = match choice.figures(point) {
                text if text.is_empty() => choice.time(point).map_or(text, |[t, ..]| seconds(t)),
                text => text,
            };
            figures += &format!(
                "<figure data-id=\"{id}\"><img data-picture=\"{id}\" alt=\"Picture with {name}\" src=\"{}\"{size}>\n\
                 <figcaption><b>{}</b><br>{name}\n{}</figcaption></figure>\n",
                self.of[id],
                escape(&figures_of),
                folded(words(point, "command")),
                id = escape(id),
                name = escape(&name),
            );
        }
        if figures.is_empty() {
            return String::new();
        }
        let mut note = String::from("All with the same exposure.");
        if self.left_out > 0 {
            note += &format!(
                " {} of the front left out to keep this file small; they are in the folder of the sweep.",
                super::count(self.left_out as u64, "picture")
            );
        }
        format!(
            "<section id=\"pictures\">\n<h2>Pictures of the front</h2>\n<p class=\"small\">{note}</p>\n\
             <div class=\"gallery\">\n{figures}</div>\n</section>\n"
        )
    }
}

/// Whether a name is that of a file in the sweep's folder or below: the document may have been changed by hand.
pub(super) fn inside(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || "._-+=,/".contains(c);
    let parts = || name.split('/');
    name.chars().all(plain) && parts().all(|p| !p.is_empty() && p != "." && p != "..")
}
