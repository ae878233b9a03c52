//! The files: a line a layer, its name and its numbers.

use std::path::PathBuf;

/// A layer of a picture.
#[derive(Clone, Debug)]
pub(crate) struct Layer {
    pub(crate) name: String,
    pub(crate) values: Vec<f64>,
}

/// Where the picture of this name is kept.
pub(crate) fn path(name: &str) -> PathBuf {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/golden/pictures");
    PathBuf::from(folder).join(format!("{name}.txt"))
}

/// All layers as text. Numbers are f32 in their shortest spelling that reads back the same.
pub(crate) fn write(layers: &[Layer]) -> String {
    let mut text = String::new();
    for layer in layers {
        text.push_str(&layer.name);
        for value in &layer.values {
            text.push_str(&format!(" {:e}", *value as f32));
        }
        text.push('\n');
    }
    text
}

/// The layers of a text.
pub(crate) fn read(text: &str) -> Vec<Layer> {
    let layer = |line: &str| {
        let mut words = line.split(' ');
        Layer {
            name: words.next().expect("a name").into(),
            values: words
                .map(|w| w.parse::<f32>().expect("a number").into())
                .collect(),
        }
    };
    text.lines().map(layer).collect()
}
