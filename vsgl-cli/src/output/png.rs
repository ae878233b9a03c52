//! Writing PNG: 8-bit sRGB with the settings in a text chunk.

use crate::output::Metadata;
use std::io::Write;

/// Writes sRGB codes, row-major from the top left. The bytes depend on nothing but the arguments.
///
/// # Errors
/// What the encoder returns.
pub fn write(
    file: impl Write,
    width: u32,
    height: u32,
    pixels: &[[u8; 3]],
    metadata: &Metadata,
) -> Result<(), png::EncodingError> {
    let mut encoder = png::Encoder::new(file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    encoder.add_itxt_chunk("Software".into(), metadata.software.clone())?;
    encoder.add_itxt_chunk("Comment".into(), metadata.command.clone())?;
    encoder.add_itxt_chunk("vsgl:settings".into(), metadata.document().to_string())?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels.as_flattened())?;
    writer.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input;
    use crate::output::srgb;

    #[test]
    fn a_written_picture_is_read_back_with_its_settings() {
        let pixels: Vec<[u8; 3]> = (0..20).map(|i| [i * 12, 255 - i, 7]).collect();
        let metadata = Metadata {
            software: "vsgl".into(),
            settings: serde_json::json!({"scene": "ä"}),
            ..Metadata::default()
        };
        let mut file = Vec::new();
        write(&mut file, 5, 4, &pixels, &metadata).expect("written to memory");
        let (read, _) = input::png::parse(&file).expect("own files are readable");
        let codes = |p: [f32; 3]| p.map(srgb::code);
        let read: Vec<_> = read
            .rgb("")
            .expect("colours")
            .into_iter()
            .map(codes)
            .collect();
        assert_eq!(read, pixels);
        let decoder = png::Decoder::new(std::io::Cursor::new(&file));
        let reader = decoder.read_info().expect("own files are readable");
        let info = reader.info();
        assert!(info.srgb.is_some());
        let texts = &info.utf8_text;
        let settings = texts.iter().find(|t| t.keyword == "vsgl:settings");
        let text = settings
            .expect("there is a chunk")
            .get_text()
            .expect("plain text");
        assert_eq!(text, metadata.document().to_string());
        for length in 0..file.len() {
            assert!(
                input::png::parse(&file[..length]).is_err(),
                "{length} bytes"
            );
        }
    }
}
