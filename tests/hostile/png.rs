//! PNG files, sound and otherwise.

use std::io::Write;

/// A picture of two colours.
pub(crate) fn checks(width: u32, height: u32) -> Vec<u8> {
    let pixel = |i: u32| {
        let dark = (i % width + i / width).is_multiple_of(2);
        [if dark { 40 } else { 220 }, 180, 90]
    };
    let data: Vec<u8> = (0..width * height).flat_map(pixel).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&data).expect("pixels");
    writer.finish().expect("an end");
    bytes
}

/// A picture of one colour: little data, however large it is.
pub(crate) fn plain(
    width: u32,
    height: u32,
    color: png::ColorType,
    depth: png::BitDepth,
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == png::ColorType::Indexed {
        encoder.set_palette(vec![7; 3]);
    }
    let mut writer = encoder.write_header().expect("a header");
    let bits = color.samples() as u64 * depth as u64;
    let row = vec![0; (u64::from(width) * bits).div_ceil(8) as usize];
    let mut stream = writer.stream_writer().expect("a stream");
    for _ in 0..height {
        stream.write_all(&row).expect("a row");
    }
    stream.finish().expect("an end");
    writer.finish().expect("an end");
    bytes
}

/// The chunks of a file, as (kind, content).
pub(crate) fn chunks(bytes: &[u8]) -> Vec<([u8; 4], Vec<u8>)> {
    let mut rest = &bytes[8..];
    let mut chunks = Vec::new();
    while rest.len() >= 12 {
        let length = u32::from_be_bytes(rest[..4].try_into().expect("four")) as usize;
        let kind = rest[4..8].try_into().expect("four");
        chunks.push((kind, rest[8..8 + length].to_vec()));
        rest = &rest[12 + length..];
    }
    chunks
}

/// A file of these chunks, with the checksums that they must have.
pub(crate) fn join(chunks: &[([u8; 4], Vec<u8>)]) -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    for (kind, content) in chunks {
        bytes.extend((content.len() as u32).to_be_bytes());
        let start = bytes.len();
        bytes.extend(kind);
        bytes.extend(content);
        bytes.extend(checksum(&bytes[start..]).to_be_bytes());
    }
    bytes
}

/// A small picture that claims to be of another size.
pub(crate) fn claiming(width: u32, height: u32) -> Vec<u8> {
    let mut chunks = chunks(&checks(4, 4));
    chunks[0].1[..4].copy_from_slice(&width.to_be_bytes());
    chunks[0].1[4..8].copy_from_slice(&height.to_be_bytes());
    join(&chunks)
}

/// A small picture with a packed text of this many bytes; as `profile` in the place of a colour profile.
pub(crate) fn stuffed(bytes: usize, profile: bool) -> Vec<u8> {
    let mut plain = Vec::new();
    let mut encoder = png::Encoder::new(&mut plain, 4, 4);
    encoder.set_color(png::ColorType::Grayscale);
    let text = String::from_utf8(vec![b' '; bytes]).expect("blanks");
    encoder.add_ztxt_chunk("k".into(), text).expect("a text");
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[0; 16]).expect("pixels");
    writer.finish().expect("an end");
    let mut chunks = chunks(&plain);
    if profile {
        // Keyword, zero, method, packed bytes: the two kinds are built alike.
        for (kind, _) in &mut chunks {
            if kind == b"zTXt" {
                *kind = *b"iCCP";
            }
        }
        // A profile must come before the pixels.
        let at = chunks
            .iter()
            .position(|(kind, _)| kind == b"iCCP")
            .expect("the text");
        let chunk = chunks.remove(at);
        chunks.insert(1, chunk);
    }
    join(&chunks)
}

/// CRC of PNG (ISO 3309).
pub(crate) fn checksum(bytes: &[u8]) -> u32 {
    let mut crc = u32::MAX;
    for &byte in bytes {
        crc ^= u32::from(byte);
        for _ in 0..8 {
            crc = (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg());
        }
    }
    !crc
}
