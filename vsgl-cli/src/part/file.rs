//! Parts as EXR files.

use super::{About, Part};
use crate::exit::{Failure, Result};
use crate::input::{self, exr::Opened};
use crate::output::exr::{WORDS, Words};
use crate::output::{self, Metadata};
use crate::picture::Picture;
use serde_json::Value;
use std::io::{Seek, Write};
use std::path::Path;
use vsgl_core::data::Image;
use vsgl_core::trace::{Sum, Sums};

/// Name of the channel with one of the four words of a sum.
fn name(layer: &str, channel: &str, word: usize) -> String {
    format!("{WORDS}{layer}.{channel}.{word}")
}

/// Writes a picture of paths: with its sums where not all samples are there, so that it is a part.
///
/// # Errors
/// What the writer returns.
pub fn write(
    file: impl Write + Seek,
    image: &Image,
    sums: &Sums,
    about: &About,
    metadata: &Metadata,
) -> std::result::Result<(), exr::error::Error> {
    let metadata = Metadata {
        paths: Some(about.json()),
        ..metadata.clone()
    };
    let words = match about.is_whole() {
        true => Vec::new(),
        false => words(sums),
    };
    output::exr::write_with(file, Picture::from_image(image), words, &metadata)
}

fn words(sums: &Sums) -> Vec<Words> {
    let mut columns = Vec::new();
    for (index, (layer, channel)) in Sums::CHANNELS.into_iter().enumerate() {
        for word in 0..4 {
            let values = sums.pixels().iter().map(|p| p[index].words()[word]);
            columns.push(Words {
                name: name(layer, channel, word),
                values: values.collect(),
            });
        }
    }
    columns
}

/// Reads a picture of paths.
///
/// # Errors
/// [`Failure::Input`] if it cannot be read, [`Failure::Parts`] if it is a picture of something else.
pub fn read(path: &Path) -> Result<Part> {
    let broken =
        |problem: String| Failure::input(path, problem, "give a complete part, or make it anew");
    let foreign = || {
        super::misfit(
            path,
            "no picture of paths by this program",
            "give parts: pictures by `vsgl render --method path` with --samples, or interrupted ones",
        )
    };
    let bytes = input::bytes(path).map_err(|e| broken(e.to_string()))?;
    if !input::is_exr(&bytes) {
        return Err(foreign());
    }
    let Opened {
        picture,
        words,
        metadata,
    } = input::exr::open(&bytes).map_err(broken)?;
    let paths: Option<&Value> = metadata.paths.as_ref();
    let about = paths.and_then(About::from_json).ok_or_else(foreign)?;
    let image = picture
        .to_image()
        .ok_or_else(|| broken("layers are missing".into()))?;
    let sums = match about.is_whole() {
        true => None,
        false => {
            let sums = gather(&words, &image, about.samples.count());
            Some(sums.ok_or_else(|| broken("its sums are missing or broken".into()))?)
        }
    };
    Ok(Part {
        path: path.to_owned(),
        about,
        image,
        sums,
        metadata,
    })
}

/// The sums of all pixels; none if words are missing or wrong.
fn gather(words: &[Words], image: &Image, samples: u32) -> Option<Sums> {
    let find = |name: String| words.iter().find(|w| w.name == name);
    let mut columns = Vec::new();
    for (layer, channel) in Sums::CHANNELS {
        let mut four = Vec::new();
        for word in 0..4 {
            four.push(&find(name(layer, channel, word))?.values[..]);
        }
        columns.push(<[&[u32]; 4]>::try_from(four).ok()?);
    }
    let columns = <[[&[u32]; 4]; 9]>::try_from(columns).ok()?;
    let pixel = |i: usize| {
        let mut sums = [Sum::default(); 9];
        for (sum, column) in sums.iter_mut().zip(&columns) {
            *sum = Sum::from_words(column.map(|values| values[i]))?;
        }
        Some(sums)
    };
    let count = image.width as usize * image.height as usize;
    let pixels: Option<Vec<_>> = (0..count).map(pixel).collect();
    Sums::from_pixels(image.width, image.height, samples, pixels?).ok()
}

#[cfg(test)]
mod tests {
    use super::super::Ranges;
    use super::*;
    use std::io::Cursor;
    use vsgl_core::data::Radiance;

    fn layer(seed: f32) -> Vec<[f32; 3]> {
        (0..6)
            .map(|i| [seed + i as f32, 0.1 * seed, 1e-9])
            .collect()
    }

    fn part() -> (Image, Sums, About) {
        let radiance = Radiance {
            width: 3,
            height: 2,
            direct: layer(1.0),
            indirect_diffuse: layer(0.3),
            indirect_glossy: layer(7e4),
            ..Radiance::default()
        };
        let mut sums = Sums::new(3, 2);
        sums.add(&radiance, &(8..16)).expect("of one size");
        let image = Image {
            width: 3,
            height: 2,
            albedo: layer(0.5),
            normal: layer(0.2),
            depth: vec![2.0; 6],
            ..Image::default()
        };
        let about = About {
            samples: Ranges::of(8..16),
            of: 24,
            fingerprint: "0f".into(),
            command: "vsgl render \"é\"".into(),
        };
        (sums.mean(image), sums, about)
    }

    fn bytes(image: &Image, sums: &Sums, about: &About) -> Vec<u8> {
        let metadata = Metadata {
            software: output::software(),
            settings: serde_json::json!({"spp": 24}),
            ..Metadata::default()
        };
        let mut file = Cursor::new(Vec::new());
        write(&mut file, image, sums, about, &metadata).expect("written to memory");
        file.into_inner()
    }

    #[test]
    fn a_part_is_read_back_bit_by_bit() {
        let (image, sums, about) = part();
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("part.exr");
        std::fs::write(&path, bytes(&image, &sums, &about)).expect("writable");
        let read = read(&path).expect("own files are readable");
        assert_eq!((&read.image, read.sums.as_ref()), (&image, Some(&sums)));
        assert_eq!(read.about, about);
        assert_eq!(read.metadata.settings["spp"], 24);
        read.check_version().expect("this one");
        // Other readers see the mean alone.
        let seen = input::read(&path).expect("a picture").picture;
        assert_eq!(seen, {
            let mut picture = Picture::from_image(&image);
            picture.channels.sort_by(|a, b| a.name.cmp(&b.name));
            picture
        });
    }

    #[test]
    fn a_broken_part_is_refused() {
        let (image, sums, about) = part();
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("part.exr");
        let code = |bytes: &[u8]| {
            std::fs::write(&path, bytes).expect("writable");
            read(&path).map_err(|f| f.code()).map(|_| ())
        };
        let whole = bytes(&image, &sums, &about);
        assert_eq!(code(&whole), Ok(()));
        assert_eq!(code(&whole[..whole.len() / 2]), Err(3));
        assert_eq!(code(b"text"), Err(6));
        let mut plain = Cursor::new(Vec::new());
        let picture = Picture::from_image(&image);
        output::exr::write(&mut plain, picture.clone(), &Metadata::default()).expect("written");
        assert_eq!(code(plain.get_ref()), Err(6));
        // Says that it is a part, and has no sums.
        let metadata = Metadata {
            settings: serde_json::json!({}),
            paths: Some(about.json()),
            ..Metadata::default()
        };
        let mut empty = Cursor::new(Vec::new());
        output::exr::write(&mut empty, picture, &metadata).expect("written");
        assert_eq!(code(empty.get_ref()), Err(3));
    }
}
