//! Images of textures.

use super::buffers::Buffers;
use super::document::Document;
use super::fault::{Fault, Result, printable, quoted};
use super::files::Files;
use super::limits::Limits;
use super::webp;
use crate::scene::{ImageSource, Texture};
use image::{ImageDecoder, ImageFormat, ImageReader};
use std::borrow::Cow;
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Name of the threads that decode images. A panic there is caught and becomes an error; a program whose panic hook
/// prints may want to leave it out.
pub const THREAD: &str = "vsgl image";

/// A JPEG file with more scans than this is built to keep a decoder busy; ordinary ones have about ten.
const SCANS_MAX: usize = 100;

/// Memory for what stands before the texels, such as a colour profile, which may be packed a thousandfold.
const HEADER_BYTES: u64 = 32 << 20;

/// An image that is known to be of a format and size that can be decoded.
struct Encoded<'a> {
    /// Index in the file.
    index: usize,
    bytes: Cow<'a, [u8]>,
    format: ImageFormat,
    /// Texels by its header; those of 16 bits count twice.
    texels: u64,
}

/// Decodes the images with these indices, in this order, and says what they were, on as many threads as there are cores.
pub(super) fn decode(
    document: &Document,
    buffers: &Buffers<'_>,
    files: &Files,
    indices: &[usize],
    limits: &Limits,
) -> Result<(Vec<Texture>, Vec<ImageSource>)> {
    let mut left = limits.texels;
    let mut images = Vec::with_capacity(indices.len());
    for &index in indices {
        let image = encoded(document, buffers, files, index)?;
        left = left.checked_sub(image.texels).ok_or_else(|| {
            Fault::new(
                format!("images[{index}]"),
                format!(
                    "with it, all images hold more than {} texels",
                    limits.texels
                ),
                "use smaller images, or raise the limit `texels`",
            )
        })?;
        images.push(image);
    }
    let next = AtomicUsize::new(0);
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let take = || {
        let i = next.fetch_add(1, Ordering::Relaxed);
        images.get(i).map(|image| (i, image))
    };
    let work = || -> Vec<_> {
        let decoded = |image: &Encoded<'_>| sheltered(image.index, || image.decode());
        std::iter::from_fn(take)
            .map(|(i, image)| (i, decoded(image)))
            .collect()
    };
    let workers = threads.min(images.len());
    let mut textures: Vec<(usize, Result<Texture>)> =
        on_threads(workers, work).into_iter().flatten().collect();
    // The order of the list, whichever thread was first; so is the error that is told.
    textures.sort_by_key(|&(i, _)| i);
    let textures: Result<_> = textures.into_iter().map(|(_, texture)| texture).collect();
    let sources = images.iter().map(|image| image.source(document)).collect();
    Ok((textures?, sources))
}

/// What `work` returns on each of `count` threads with the name [`THREAD`].
fn on_threads<T: Send>(count: usize, work: impl Fn() -> T + Sync) -> Vec<T> {
    thread::scope(|scope| {
        let spawn = |_| {
            let named = thread::Builder::new().name(THREAD.into());
            named.spawn_scoped(scope, &work)
        };
        let mut done = Vec::with_capacity(count);
        let workers: Vec<_> = (0..count).map(spawn).collect();
        for worker in workers {
            match worker.map(|worker| worker.join()) {
                Ok(Ok(result)) => done.push(result),
                Ok(Err(panic)) => resume_unwind(panic),
                // The system has no thread to spare.
                Err(_) => done.push(work()),
            }
        }
        done
    })
}

/// Turns a panic of a decoder into an error: decoders are others' work, and some panic on broken images.
fn sheltered<T>(index: usize, work: impl FnOnce() -> Result<T>) -> Result<T> {
    catch_unwind(AssertUnwindSafe(work))
        .unwrap_or_else(|_| Err(undecodable(index, "it makes the decoder fail")))
}

/// The bytes of an image, with format and size from its header.
fn encoded<'a>(
    document: &Document,
    buffers: &'a Buffers<'_>,
    files: &Files,
    index: usize,
) -> Result<Encoded<'a>> {
    let image = &document.root.images[index];
    let place = format!("images[{index}]");
    let bytes = match (&image.uri, image.buffer_view) {
        (Some(uri), _) => Cow::Owned(files.resolve(uri, &place)?),
        (None, Some(view)) => {
            Cow::Borrowed(buffers.view(view, || format!("{place}.bufferView"))?.0)
        }
        (None, None) => {
            return Err(Fault::new(
                place,
                "has neither an address nor a buffer view",
                "the file is broken; export it again",
            ));
        }
    };
    let format = format(&bytes).ok_or_else(|| {
        let name = image.uri.as_deref().filter(|uri| !uri.starts_with("data:"));
        let name = name.map_or("it".into(), quoted);
        let what = match bytes.starts_with(b"\xabKTX ") {
            true => "is a KTX file, and not PNG, JPEG or WebP",
            false => "is neither PNG nor JPEG nor WebP",
        };
        Fault::new(
            &place,
            format!("{name} {what}"),
            "convert it to one of these",
        )
    })?;
    let inner = match format {
        ImageFormat::WebP => webp::texels(&bytes).map_err(|why| undecodable(index, why))?,
        _ => 0,
    };
    if format == ImageFormat::Png {
        check_palette(&bytes).map_err(|why| undecodable(index, &why))?;
    }
    let header = || texels(&bytes, format).map_err(|e| undecodable(index, &e.to_string()));
    let texels = on_threads(1, || sheltered(index, header))
        .remove(0)?
        .max(inner);
    if format == ImageFormat::Jpeg
        && bytes.windows(2).filter(|w| w == b"\xff\xda").count() > SCANS_MAX
    {
        return Err(undecodable(
            index,
            "more scans than any honest JPEG file has",
        ));
    }
    Ok(Encoded {
        index,
        bytes,
        format,
        texels,
    })
}

/// Refuses a palette of a length that makes the decoder panic (`png` 0.18).
fn check_palette(bytes: &[u8]) -> std::result::Result<(), String> {
    let mut rest = bytes.get(8..).unwrap_or_default();
    while let Some((header, after)) = rest.split_first_chunk::<8>() {
        let [a, b, c, d, kind @ ..] = *header;
        let length = u32::from_be_bytes([a, b, c, d]) as usize;
        if kind == *b"PLTE" && (length == 0 || length > 768 || !length.is_multiple_of(3)) {
            return Err(format!("a palette of {length} bytes"));
        }
        // Four bytes of checksum follow.
        rest = after.get(length.saturating_add(4)..).unwrap_or_default();
    }
    Ok(())
}

/// Texels by the header; those of 16 bits count twice.
fn texels(bytes: &[u8], format: ImageFormat) -> image::ImageResult<u64> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(memory(HEADER_BYTES));
    let decoder = reader.into_decoder()?;
    let (width, height) = decoder.dimensions();
    let color = decoder.color_type();
    let wide = u64::from(color.bytes_per_pixel() > color.channel_count());
    Ok((u64::from(width) * u64::from(height)) << wide)
}

impl Encoded<'_> {
    fn source(&self, document: &Document) -> ImageSource {
        let image = &document.root.images[self.index];
        let address = image.uri.as_ref().filter(|uri| !uri.starts_with("data:"));
        let name = image.name.as_ref().filter(|name| !name.is_empty());
        ImageSource {
            name: name
                .or(address)
                .map_or(self.index.to_string(), |n| printable(n)),
            format: name_of(self.format),
            bytes: self.bytes.len() as u64,
        }
    }

    fn decode(&self) -> Result<Texture> {
        let broken = |e: image::ImageError| undecodable(self.index, &e.to_string());
        let mut reader = ImageReader::with_format(Cursor::new(&self.bytes[..]), self.format);
        // Four channels, and as much again to work with.
        reader.limits(memory(self.texels * 8 + HEADER_BYTES));
        let decoder = reader.into_decoder().map_err(broken)?;
        let (width, height) = decoder.dimensions();
        let image = image::DynamicImage::from_decoder(decoder).map_err(broken)?;
        // Four bytes become one texel in place.
        let texels: Vec<[u8; 4]> = bytemuck::allocation::cast_vec(image.into_rgba8().into_raw());
        if texels.is_empty() {
            return Err(undecodable(self.index, "no texels"));
        }
        Ok(Texture {
            width,
            height,
            texels,
        })
    }
}

fn memory(bytes: u64) -> image::Limits {
    let mut limits = image::Limits::default();
    limits.max_alloc = Some(bytes);
    limits
}

fn name_of(format: ImageFormat) -> &'static str {
    match format {
        ImageFormat::Png => "PNG",
        ImageFormat::Jpeg => "JPEG",
        _ => "WebP",
    }
}

/// By the first bytes: the type that files name is often wrong.
fn format(bytes: &[u8]) -> Option<ImageFormat> {
    if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        Some(ImageFormat::Png)
    } else if bytes.starts_with(b"\xff\xd8\xff") {
        Some(ImageFormat::Jpeg)
    } else if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP") {
        Some(ImageFormat::WebP)
    } else {
        None
    }
}

fn undecodable(index: usize, why: &str) -> Fault {
    Fault::new(
        format!("images[{index}]"),
        format!("cannot be decoded: {}", printable(why)),
        "save it again as PNG, JPEG or WebP",
    )
}
