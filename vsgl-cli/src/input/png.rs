//! Reading PNG: 8 or 16 bit, taken as sRGB and made linear.

use super::check_size;
use crate::output::srgb;
use crate::picture::Picture;

/// Reads the colours, and says what was done to them.
///
/// # Errors
/// What is wrong with the file.
pub fn parse(bytes: &[u8]) -> Result<(Picture, Vec<String>), String> {
    let mut decoder =
        png::Decoder::new_with_limits(std::io::Cursor::new(bytes), png::Limits { bytes: 1 << 30 });
    let normal = png::Transformations::EXPAND;
    decoder.set_transformations(normal);
    let header = decoder.read_header_info().map_err(|e| e.to_string())?;
    let (width, height) = (header.width, header.height);
    check_size(u64::from(width), u64::from(height))?;
    let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
    let size = reader.output_buffer_size().ok_or("too large")?;
    let mut samples = vec![0; size];
    let info = reader.next_frame(&mut samples).map_err(|e| e.to_string())?;
    // The checksums at the end of a file that was cut.
    reader.finish().map_err(|e| e.to_string())?;
    let channels = info.color_type.samples();
    let values: Vec<f32> = match info.bit_depth {
        png::BitDepth::Sixteen => samples
            .chunks_exact(2)
            .map(|b| f32::from(u16::from_be_bytes([b[0], b[1]])) / 65535.0)
            .collect(),
        _ => samples.iter().map(|&b| f32::from(b) / 255.0).collect(),
    };
    let pixels: Vec<[f32; 3]> = values
        .chunks_exact(channels)
        .map(|p| {
            if channels < 3 {
                [p[0]; 3]
            } else {
                [p[0], p[1], p[2]]
            }
        })
        .map(|p| p.map(srgb::decode))
        .collect();
    let mut notes = vec!["sRGB made linear; exposure and tone curve stay in".to_owned()];
    if channels == 2 || channels == 4 {
        notes.push("alpha is ignored".into());
    }
    Ok((Picture::from_rgb(width, height, &pixels), notes))
}
