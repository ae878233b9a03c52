//! Writing OpenEXR: linear f32, one part, layers as channel-name prefixes.

use crate::output::Metadata;
use crate::picture::Picture;
use exr::prelude as e;
use smallvec::SmallVec;
use std::io::{Seek, Write};

/// A channel of whole numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Words {
    /// Name as in EXR files.
    pub name: String,
    /// The numbers, row-major from the top left.
    pub values: Vec<u32>,
}

/// Beginning of the names of such channels.
pub const WORDS: &str = "sums.";
/// Most channels of whole numbers.
pub const WORDS_MAX: usize = 4 * vsgl_core::trace::Sums::CHANNELS.len();
/// Name of the attribute with the settings.
pub const SETTINGS: &str = "vsgl:settings";

/// As [`write_with`], without whole numbers.
///
/// # Errors
/// What the writer returns.
pub fn write(
    file: impl Write + Seek,
    picture: Picture,
    metadata: &Metadata,
) -> Result<(), exr::error::Error> {
    write_with(file, picture, Vec::new(), metadata)
}

/// Writes a picture with its metadata.
///
/// The bytes depend on nothing but the arguments: no date, no host, no order of a hash table (hence all of ours is in
/// one attribute).
///
/// # Errors
/// What the writer returns.
pub fn write_with(
    file: impl Write + Seek,
    picture: Picture,
    words: Vec<Words>,
    metadata: &Metadata,
) -> Result<(), exr::error::Error> {
    let mut channels: SmallVec<[_; 4]> = picture
        .channels
        .into_iter()
        .map(|c| e::AnyChannel::new(text(&c.name), e::FlatSamples::F32(c.values)))
        .collect();
    channels.extend(
        words
            .into_iter()
            .map(|w| e::AnyChannel::new(text(&w.name), e::FlatSamples::U32(w.values))),
    );
    let encoding = e::Encoding {
        compression: e::Compression::ZIP16,
        blocks: e::Blocks::ScanLines,
        line_order: e::LineOrder::Increasing,
    };
    let mut attributes = e::LayerAttributes {
        software_name: Some(text(&metadata.software)),
        comments: Some(text(&metadata.command)),
        world_to_camera: metadata.world_to_camera,
        ..e::LayerAttributes::default()
    };
    let settings = e::AttributeValue::Text(text(&metadata.document().to_string()));
    attributes.other.insert(text(SETTINGS), settings);
    let size = (picture.width as usize, picture.height as usize);
    let layer = e::Layer::new(size, attributes, encoding, e::AnyChannels::sort(channels));
    let mut image = e::Image::from_layer(layer);
    image.attributes.chromaticities = Some(REC_709);
    e::WritableImage::write(&image)
        .non_parallel()
        .to_buffered(file)
}

/// Primaries and white of Rec. 709 with D65.
const REC_709: e::attribute::Chromaticities = e::attribute::Chromaticities {
    red: e::Vec2(0.64, 0.33),
    green: e::Vec2(0.30, 0.60),
    blue: e::Vec2(0.15, 0.06),
    white: e::Vec2(0.3127, 0.3290),
};

/// EXR text holds bytes; what is not ASCII is written as JSON would escape it.
fn text(string: &str) -> e::Text {
    let mut ascii = String::with_capacity(string.len());
    for c in string.chars() {
        if c.is_ascii() {
            ascii.push(c);
        } else {
            let mut units = [0; 2];
            for unit in c.encode_utf16(&mut units) {
                ascii.push_str(&format!("\\u{unit:04x}"));
            }
        }
    }
    e::Text::from(ascii.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input;
    use crate::picture::Channel;
    use serde_json::json;

    fn picture() -> Picture {
        let values: Vec<[f32; 3]> = (0..35).map(|i| [i as f32, 0.5, -1e-20]).collect();
        let mut picture = Picture::from_rgb(7, 5, &values);
        picture.push("indirect.", ["R", "G", "B"], &values);
        picture.channels.push(Channel {
            name: "Z".into(),
            values: vec![f32::MAX; 35],
        });
        picture
    }

    fn metadata() -> Metadata {
        Metadata {
            software: "vsgl test".into(),
            command: "vsgl render \"é\"".into(),
            world_to_camera: None,
            settings: json!({"scene": "ä😀", "lights": 7}),
            paths: None,
        }
    }

    #[test]
    fn a_written_picture_is_read_back_bit_by_bit() {
        let mut file = std::io::Cursor::new(Vec::new());
        write(&mut file, picture(), &metadata()).expect("written to memory");
        let read = input::exr::parse(file.get_ref()).expect("own files are readable");
        let (mut written, mut read) = (picture().channels, read.channels);
        written.sort_by(|a, b| a.name.cmp(&b.name));
        read.sort_by(|a, b| a.name.cmp(&b.name));
        assert_eq!(written, read);
    }

    #[test]
    fn the_same_picture_has_the_same_bytes() {
        let bytes = || {
            let mut file = std::io::Cursor::new(Vec::new());
            write(&mut file, picture(), &metadata()).expect("written to memory");
            file.into_inner()
        };
        assert_eq!(bytes(), bytes());
    }

    #[test]
    fn settings_survive_as_json() {
        let mut file = std::io::Cursor::new(Vec::new());
        write(&mut file, picture(), &metadata()).expect("written to memory");
        let meta = exr::meta::MetaData::read_from_buffered(file.get_ref().as_slice(), true);
        let meta = meta.expect("own files are readable");
        let own = &meta.headers[0].own_attributes;
        let Some(e::AttributeValue::Text(settings)) = own.other.get(&text(SETTINGS)) else {
            panic!("no settings");
        };
        let settings: serde_json::Value =
            serde_json::from_str(&settings.to_string()).expect("valid JSON");
        assert_eq!(settings, metadata().settings);
        assert_eq!(own.software_name, Some(text("vsgl test")));
    }

    #[test]
    fn a_file_cut_anywhere_is_an_error() {
        let mut file = std::io::Cursor::new(Vec::new());
        write(&mut file, picture(), &metadata()).expect("written to memory");
        let bytes = file.into_inner();
        for length in 0..bytes.len() {
            assert!(
                input::exr::parse(&bytes[..length]).is_err(),
                "{length} bytes"
            );
        }
    }
}
