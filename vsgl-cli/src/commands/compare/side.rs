//! One of the two pictures of a comparison.

use crate::exit::{Failure, Result};
use crate::input;
use serde_json::{Value, json};
use std::path::Path;
use vsgl_core::metrics::Plane;

/// One of the two pictures.
pub(super) struct Side<'a> {
    pub(super) path: &'a Path,
    pub(super) plane: Plane,
    format: &'static str,
    /// The layer asked for is not there, and R,G,B stand for it.
    pub(super) stands_in: bool,
    layer: String,
    notes: Vec<String>,
}

impl<'a> Side<'a> {
    /// Reads the layer of a file.
    pub(super) fn read(path: &'a Path, layer: &str) -> Result<Self> {
        let read = input::read(path)?;
        let mut notes = read.notes;
        let picture = &read.picture;
        let bare = !picture.channels.iter().any(|c| c.name.contains('.'));
        let (pixels, found) = match (picture.rgb(layer), picture.rgb("")) {
            (Some(pixels), _) => (pixels, layer),
            (None, Some(pixels)) if bare => {
                notes.push(format!("has no layers; R,G,B are taken for `{layer}`"));
                (pixels, "")
            }
            _ => {
                let layers = picture.layers();
                let names: Vec<_> = layers.iter().map(|l| layer_name(l)).collect();
                let problem = format!("no layer `{}`", layer_name(layer));
                let remedy = format!("it has {}: choose with --layer", names.join(", "));
                return Err(Failure::input(path, problem, &remedy));
            }
        };
        Ok(Self {
            path,
            plane: Plane::luminance(picture.width, picture.height, &pixels)?,
            format: read.format,
            stands_in: found != layer,
            layer: layer_name(found).to_owned(),
            notes,
        })
    }

    /// A line for people.
    pub(super) fn describe(&self) -> String {
        let (width, height) = (self.plane.width(), self.plane.height());
        let mut line = format!(
            "{}  {width}x{height} {}, {}",
            self.path.display(),
            self.format,
            self.layer
        );
        for note in &self.notes {
            line += &format!("; {note}");
        }
        line
    }

    /// The same for machines.
    pub(super) fn json(&self) -> Value {
        json!({
            "file": self.path.to_string_lossy(),
            "format": self.format,
            "layer": self.layer,
            "width": self.plane.width(),
            "height": self.plane.height(),
            "notes": self.notes,
        })
    }
}

fn layer_name(layer: &str) -> &str {
    if layer.is_empty() { "R,G,B" } else { layer }
}
