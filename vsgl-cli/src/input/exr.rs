//! Reading OpenEXR: any part, any compression that the crate knows.

use super::check_size;
use crate::output::Metadata;
use crate::output::exr::{SETTINGS, WORDS, WORDS_MAX, Words};
use crate::picture::{Channel, Picture};
use exr::prelude as e;
use exr::prelude::{ReadChannels, ReadLayers};

/// Most numbers of a file that is read, besides sums: a gibibyte of them.
const VALUES_MAX: u64 = 1 << 28;

/// What a file holds.
#[derive(Clone, Debug, Default)]
pub struct Opened {
    /// The channels, but for those of sums.
    pub picture: Picture,
    /// Channels of sums.
    pub words: Vec<Words>,
    /// What the first part says about itself; empty where it says nothing.
    pub metadata: Metadata,
}

/// Reads all parts into one picture, in the display window of the first. Channels of a named part get the name as
/// prefix, as if they were a layer of the one part that most files have.
///
/// # Errors
/// What is wrong with the file.
pub fn parse(bytes: &[u8]) -> Result<Picture, String> {
    Ok(open(bytes)?.picture)
}

/// As [`parse`], with whole numbers and metadata.
///
/// # Errors
/// What is wrong with the file.
pub fn open(bytes: &[u8]) -> Result<Opened, String> {
    check_headers(bytes)?;
    let image = e::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .non_parallel()
        .from_buffered(std::io::Cursor::new(bytes))
        .map_err(|e| e.to_string())?;
    let window = image.attributes.display_window;
    let mut picture = Picture {
        width: window.size.0 as u32,
        height: window.size.1 as u32,
        channels: Vec::new(),
    };
    let mut words = Vec::new();
    let first = image.layer_data.first();
    let metadata = first.map(|layer| metadata(&layer.attributes));
    for layer in &image.layer_data {
        let bounds = layer.absolute_bounds();
        let prefix = match &layer.attributes.layer_name {
            Some(name) if image.layer_data.len() > 1 => format!("{name}."),
            _ => String::new(),
        };
        for channel in &layer.channel_data.list {
            if channel.sampling != e::Vec2(1, 1) {
                return Err(format!("channel {} has fewer pixels", channel.name));
            }
            let name = format!("{prefix}{}", channel.name);
            if let e::FlatSamples::U32(values) = &channel.sample_data
                && name.starts_with(WORDS)
                && bounds == window
            {
                let values = values.clone();
                words.push(Words { name, values });
                continue;
            }
            let values: Vec<f32> = channel.sample_data.values_as_f32().collect();
            picture.channels.push(Channel {
                name,
                values: place(values, bounds, window),
            });
        }
    }
    Ok(Opened {
        picture,
        words,
        metadata: metadata.unwrap_or_default(),
    })
}

fn metadata(attributes: &e::LayerAttributes) -> Metadata {
    let text = |text: &Option<e::Text>| text.as_ref().map(e::Text::to_string).unwrap_or_default();
    let mut metadata = Metadata {
        software: text(&attributes.software_name),
        command: text(&attributes.comments),
        world_to_camera: attributes.world_to_camera,
        ..Metadata::default()
    };
    if let Some(e::AttributeValue::Text(text)) = attributes.other.get(&e::Text::from(SETTINGS)) {
        metadata.set_document(serde_json::from_str(&text.to_string()).unwrap_or_default());
    }
    metadata
}

/// Looks at sizes before anything is allocated for them.
fn check_headers(bytes: &[u8]) -> Result<(), String> {
    let meta = exr::meta::MetaData::read_from_buffered(bytes, false).map_err(|e| e.to_string())?;
    let mut values = 0u64;
    for header in &meta.headers {
        let window = header.shared_attributes.display_window.size;
        let names = header.channels.list.iter().map(|c| c.name.to_string());
        let sums = names.filter(|name| name.starts_with(WORDS)).count();
        let channels = header.channels.list.len() - sums.min(WORDS_MAX);
        for size in [window, header.layer_size] {
            check_size(size.0 as u64, size.1 as u64)?;
            let pixels = size.0 as u64 * size.1 as u64;
            values = values.saturating_add(pixels * channels as u64);
        }
    }
    if values > 2 * VALUES_MAX {
        return Err(format!(
            "more than {VALUES_MAX} numbers; cut the layers out that matter"
        ));
    }
    Ok(())
}

/// Moves a data window into the display window; what it does not cover is 0.
fn place(values: Vec<f32>, data: e::IntegerBounds, window: e::IntegerBounds) -> Vec<f32> {
    if data == window {
        return values;
    }
    let (width, height) = (window.size.0 as i64, window.size.1 as i64);
    let mut placed = vec![0.0; window.size.0 * window.size.1];
    let dx = i64::from(data.position.0) - i64::from(window.position.0);
    let dy = i64::from(data.position.1) - i64::from(window.position.1);
    for (row, line) in values.chunks(data.size.0.max(1)).enumerate() {
        let y = row as i64 + dy;
        for (column, &value) in line.iter().enumerate() {
            let x = column as i64 + dx;
            if (0..width).contains(&x) && (0..height).contains(&y) {
                placed[(y * width + x) as usize] = value;
            }
        }
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crop_lands_at_its_place() {
        let data = e::IntegerBounds::new((1, -1), (2, 2));
        let window = e::IntegerBounds::new((0, 0), (3, 2));
        let placed = place(vec![1.0, 2.0, 3.0, 4.0], data, window);
        assert_eq!(placed, [0.0, 3.0, 4.0, 0.0, 0.0, 0.0]);
    }
}
