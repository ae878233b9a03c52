//! Images that are broken, or other than they seem.

use super::Case;
use super::Fate::{self, Drawn, Either, Refused};
use crate::file::File;
use crate::png;
use serde_json::json;

/// The sound scene with other bytes as its image.
pub(super) fn shown(image: &[u8]) -> File {
    let mut file = File::sound();
    let view = file.view(image);
    file.set("/images/0/bufferView", json!(view))
}

pub(super) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add =
        |name: String, image: &[u8], fate: Fate| cases.push(Case::glb(name, &shown(image), fate));
    let sound = png::checks(4, 4);
    for length in [
        0,
        1,
        7,
        8,
        16,
        24,
        32,
        33,
        40,
        sound.len() - 12,
        sound.len() - 1,
    ] {
        add(
            format!("PNG cut after {length} bytes"),
            &sound[..length],
            Either,
        );
    }
    for (width, height) in [
        (0, 0),
        (0, 4),
        (4, 0),
        (5, 4),
        (4, 5),
        (3, 3),
        (1 << 31, 1 << 31),
        (u32::MAX, u32::MAX),
        (65_535, 65_535),
        (1 << 30, 1),
        (1, 1 << 30),
        (16_384, 16_384),
    ] {
        let fate = if width == 3 {
            Either
        } else {
            Refused("images[0]")
        };
        add(
            format!("PNG of 4x4 that says {width}x{height}"),
            &png::claiming(width, height),
            fate,
        );
    }
    for (at, name) in [
        (8, "depth"),
        (9, "colours"),
        (10, "packing"),
        (11, "filter"),
        (12, "interlacing"),
    ] {
        for value in [1, 3, 7, 16, 255] {
            let mut chunks = png::chunks(&sound);
            chunks[0].1[at] = value;
            add(
                format!("PNG with {name} {value}"),
                &png::join(&chunks),
                Either,
            );
        }
    }
    let mut wrong = sound.clone();
    wrong[29] ^= 1;
    add("PNG with a wrong checksum".into(), &wrong, Either);
    let mut wrong = sound.clone();
    wrong[8] = 0x7f;
    add("PNG chunk of 2 GB".into(), &wrong, Refused("images[0]"));
    let chunks = png::chunks(&sound);
    let kinds = |order: &[usize]| -> Vec<_> { order.iter().map(|&i| chunks[i].clone()).collect() };
    add(
        "PNG without pixels".into(),
        &png::join(&kinds(&[0, chunks.len() - 1])),
        Refused("images[0]"),
    );
    add(
        "PNG that begins with its end".into(),
        &png::join(&kinds(&[2, 0, 1])),
        Either,
    );
    add(
        "PNG with two headers".into(),
        &png::join(&kinds(&[0, 0, 1, 2])),
        Either,
    );
    let mut empty = chunks.clone();
    for _ in 0..100_000 {
        empty.insert(1, (*b"IDAT", Vec::new()));
    }
    add(
        "PNG with 100,000 empty chunks".into(),
        &png::join(&empty),
        Either,
    );
    let mut noise = chunks.clone();
    noise[1].1 = (0..999u32).map(|i| ((i * 7919) >> 3) as u8).collect();
    add(
        "PNG of noise".into(),
        &png::join(&noise),
        Refused("images[0]"),
    );
    for (name, indices) in [
        ("palette missing", None),
        ("palette too short", Some(vec![1, 2, 3])),
        ("palette odd", Some(vec![1; 4])),
    ] {
        let mut chunks = png::chunks(&png::plain(
            4,
            4,
            ::png::ColorType::Indexed,
            ::png::BitDepth::Eight,
        ));
        chunks.retain(|(kind, _)| kind != b"PLTE");
        if let Some(palette) = indices {
            chunks.insert(1, (*b"PLTE", palette));
        }
        add(format!("PNG: {name}"), &png::join(&chunks), Either);
    }
    for color in [
        ::png::ColorType::Grayscale,
        ::png::ColorType::GrayscaleAlpha,
        ::png::ColorType::Rgba,
    ] {
        for depth in [::png::BitDepth::Eight, ::png::BitDepth::Sixteen] {
            add(
                format!("PNG {color:?} {depth:?}"),
                &png::plain(7, 3, color, depth),
                Drawn,
            );
        }
    }
    add(
        "PNG of one bit".into(),
        &png::plain(9, 9, ::png::ColorType::Grayscale, ::png::BitDepth::One),
        Drawn,
    );
    add(
        "PNG of 1x1".into(),
        &png::plain(1, 1, ::png::ColorType::Rgb, ::png::BitDepth::Eight),
        Drawn,
    );
    add(
        "PNG of 1x10000".into(),
        &png::plain(1, 10_000, ::png::ColorType::Rgb, ::png::BitDepth::Eight),
        Drawn,
    );
    for (name, bytes) in [
        ("GIF", &b"GIF89a\x01\0\x01\0\0\0\0;"[..]),
        (
            "BMP",
            b"BM\x1a\0\0\0\0\0\0\0\x1a\0\0\0\x0c\0\0\0\x01\0\x01\0\x01\0\x18\0",
        ),
        (
            "SVG",
            b"<svg xmlns='http://www.w3.org/2000/svg'><image href='file:///etc/passwd'/></svg>",
        ),
        ("TIFF", b"II*\0\x08\0\0\0\0\0"),
        ("EXR", b"\x76\x2f\x31\x01\x02\0\0\0"),
        ("HDR", b"#?RADIANCE\n\n-Y 99999 +X 99999\n"),
        ("KTX2", b"\xabKTX 20\xbb\r\n\x1a\n\0\0\0\0"),
        ("WebP of nothing", b"RIFF\xff\xff\xff\xffWEBPVP8L"),
        (
            "WebP of 16384x16384",
            b"RIFF\x20\0\0\0WEBPVP8L\x14\0\0\0\x2f\xff\xff\xff\x0f\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0",
        ),
        (
            "WebP VP8X of 16M x 16M",
            b"RIFF\x20\0\0\0WEBPVP8X\x0a\0\0\0\0\0\0\0\xff\xff\xff\xff\xff\xff\0\0\0\0\0\0\0\0",
        ),
        ("text", b"hello"),
        ("zeros", &[0; 64]),
    ] {
        add(format!("image is {name}"), bytes, Refused("images[0]"));
    }
    cases.extend(jpegs());
    cases.extend(tables());
    cases
}

fn jpegs() -> Vec<Case> {
    let sound = jpeg(16, 16);
    let mut cases = Vec::new();
    let mut add =
        |name: String, image: &[u8], fate: Fate| cases.push(Case::glb(name, &shown(image), fate));
    add("JPEG".into(), &sound, Drawn);
    for length in [
        2,
        3,
        20,
        100,
        sound.len() / 2,
        sound.len() - 3,
        sound.len() - 1,
    ] {
        add(
            format!("JPEG cut after {length} bytes"),
            &sound[..length.min(sound.len())],
            Either,
        );
    }
    let frame = sound
        .windows(2)
        .position(|w| w == b"\xff\xc0")
        .expect("a frame");
    for (width, height) in [
        (0u16, 0u16),
        (0, 16),
        (16, 0),
        (65_535, 65_535),
        (65_535, 1),
        (1, 65_535),
        (17, 16),
        (4_000, 4_000),
    ] {
        let mut image = sound.clone();
        image[frame + 5..frame + 7].copy_from_slice(&height.to_be_bytes());
        image[frame + 7..frame + 9].copy_from_slice(&width.to_be_bytes());
        add(
            format!("JPEG of 16x16 that says {width}x{height}"),
            &image,
            Either,
        );
    }
    for (at, name) in [
        (2, "length"),
        (3, "length"),
        (4, "precision"),
        (9, "components"),
        (11, "sampling"),
        (12, "table"),
    ] {
        for value in [0, 1, 2, 0x44, 255] {
            let mut image = sound.clone();
            image[frame + at] = value;
            add(format!("JPEG with {name} {at} {value}"), &image, Either);
        }
    }
    for marker in [0xc1, 0xc2, 0xc3, 0xc5, 0xc9, 0xca, 0xcf, 0xd9, 0x01] {
        let mut image = sound.clone();
        image[frame + 1] = marker;
        add(format!("JPEG with frame {marker:#x}"), &image, Either);
    }
    let scan = sound
        .windows(2)
        .position(|w| w == b"\xff\xda")
        .expect("a scan");
    let mut image = sound.clone();
    image.truncate(scan);
    add("JPEG without a scan".into(), &image, Either);
    let (head, body) = sound.split_at(scan);
    for count in [90, 5_000] {
        let image = [head, &body[..body.len() - 2].repeat(count), b"\xff\xd9"].concat();
        add(format!("JPEG of {count} scans"), &image, Either);
    }
    let restart = [head, b"\xff\xdd\0\x04\0\x01", body].concat();
    add(
        "JPEG with restarts that are not there".into(),
        &restart,
        Either,
    );
    // Application segments: an orientation, a profile of many parts, nothing at all.
    for (name, segment) in [
        ("an orientation of 9", b"\xff\xe1\0\x22Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x09\0\0\0\0\0\0\0".to_vec()),
        ("Exif that points at itself", b"\xff\xe1\0\x16Exif\0\0II*\0\x08\0\0\0\0\0\x08\0\0\0".to_vec()),
        ("an empty segment", b"\xff\xe2\0\x02".to_vec()),
        ("a segment of no length", b"\xff\xe2\0\0".to_vec()),
        ("part 255 of a profile", b"\xff\xe2\0\x12ICC_PROFILE\0\xff\xff\0\0".to_vec()),
        ("1,000 full segments", [&b"\xff\xe1\xff\xff"[..], &[b' '; 65_533]].concat().repeat(1_000)),
        ("a million fill bytes", vec![0xff; 1_000_000]),
    ] {
        let image = [&sound[..2], &segment, &sound[2..]].concat();
        add(format!("JPEG with {name}"), &image, Either);
    }
    cases
}

/// A JPEG file of one colour and a little noise.
fn jpeg(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let pixels: Vec<u8> = (0..width * height * 3)
        .map(|i| ((i * 7919) >> 4) as u8)
        .collect();
    let mut encoder = image::codecs::jpeg::JpegEncoder::new(&mut bytes);
    encoder
        .encode(&pixels, width, height, image::ExtendedColorType::Rgb8)
        .expect("a picture");
    bytes
}

/// The JSON about images.
fn tables() -> Vec<Case> {
    let of = |name: &str, pointer: &str, value, fate| {
        Case::of(name, &File::sound().set(pointer, value), fate)
    };
    vec![
        of(
            "image without anything",
            "/images/0",
            json!({}),
            Refused("images[0]"),
        ),
        of("image null", "/images/0", json!(null), Refused("JSON")),
        of(
            "no image",
            "/images",
            json!([]),
            Refused("textures[0].source"),
        ),
        of(
            "image with both",
            "/images/0/uri",
            json!("s.png"),
            Refused("images[0]"),
        ),
        of(
            "another type",
            "/images/0/mimeType",
            json!("image/jpeg"),
            Drawn,
        ),
        of(
            "no image type",
            "/images/0/mimeType",
            json!("text/\u{1b}[31m"),
            Either,
        ),
        of("no texture source", "/textures/0", json!({}), Either),
        of(
            "sampler of unknown words",
            "/samplers/0",
            json!({"wrapS": 1, "wrapT": 0, "magFilter": 7, "minFilter": 9}),
            Either,
        ),
        of(
            "sampler with texts",
            "/samplers/0/wrapS",
            json!("REPEAT"),
            Refused("JSON"),
        ),
        of(
            "sampler negative",
            "/samplers/0/wrapS",
            json!(-1),
            Refused("JSON"),
        ),
        of(
            "a WebP image that is not there",
            "/textures/0",
            json!({"extensions": {"EXT_texture_webp": {"source": 99}}}),
            Either,
        ),
        of(
            "a KTX2 image",
            "/textures/0",
            json!({"extensions": {"KHR_texture_basisu": {"source": 0}}}),
            Either,
        ),
        of(
            "10,000 textures of one image",
            "/textures",
            json!(vec![json!({"source": 0}); 10_000]),
            Drawn,
        ),
    ]
}
