//! What a WebP file says about its size before it is decoded.

/// Texels of the largest image in the file, which may be larger than the canvas that the decoder tells: it finds out only
/// after it has decoded it.
///
/// # Errors
/// What is wrong with the file.
///
/// Source: Google, "WebP Container Specification"; RFC 6386, 9.1 (frame header of VP8); "WebP Lossless Bitstream", 3.
pub(super) fn texels(bytes: &[u8]) -> Result<u64, &'static str> {
    let mut rest = bytes.get(12..).unwrap_or_default();
    let mut most = 0;
    while let Some((header, after)) = rest.split_first_chunk::<8>() {
        let [kind @ .., a, b, c, d] = *header;
        let size = u32::from_le_bytes([a, b, c, d]) as usize;
        let data = after.get(..size).unwrap_or(after);
        let sides = match &kind {
            b"VP8 " => data.get(6..10).map(|s| [u16_at(s, 0), u16_at(s, 2)]),
            b"VP8L" => data.get(1..5).map(|s| {
                let bits = u32::from_le_bytes([s[0], s[1], s[2], s[3]]);
                [(bits & 0x3fff) + 1, (bits >> 14 & 0x3fff) + 1]
            }),
            b"ANIM" | b"ANMF" => return Err("it is an animation"),
            _ => Some([0; 2]),
        };
        let [width, height] = sides.ok_or("it is truncated")?;
        most = most.max(u64::from(width) * u64::from(height));
        // Chunks are padded to an even length.
        rest = after
            .get(size.saturating_add(size % 2)..)
            .unwrap_or_default();
    }
    Ok(most)
}

/// The lower 14 bits of a number: the upper two ask for a scale that nobody uses.
fn u16_at(bytes: &[u8], at: usize) -> u32 {
    u32::from(u16::from_le_bytes([bytes[at], bytes[at + 1]])) & 0x3fff
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(chunks: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
        let mut bytes = b"RIFF\0\0\0\0WEBP".to_vec();
        for (kind, data) in chunks {
            bytes.extend_from_slice(*kind);
            bytes.extend((data.len() as u32).to_le_bytes());
            bytes.extend_from_slice(data);
            bytes.resize(bytes.len().next_multiple_of(2), 0);
        }
        bytes
    }

    #[test]
    fn the_largest_image_counts() {
        let canvas: (&[u8; 4], &[u8]) = (b"VP8X", &[0; 10]);
        let lossy: (&[u8; 4], &[u8]) = (b"VP8 ", &[0, 0, 0, 0x9d, 1, 0x2a, 3, 0, 5, 0x40, 9]);
        let lossless: (&[u8; 4], &[u8]) = (b"VP8L", &[0x2f, 0xff, 0xff, 0xff, 0x0f]);
        assert_eq!(texels(&file(&[canvas])), Ok(0));
        assert_eq!(texels(&file(&[canvas, lossy])), Ok(15));
        assert_eq!(texels(&file(&[lossy, lossless])), Ok(1 << 28));
        assert!(texels(&file(&[(b"ANIM", &[0; 6])])).is_err());
        assert!(texels(&file(&[(b"VP8L", &[0x2f])])).is_err());
        assert_eq!(texels(b""), Ok(0));
    }
}
