//! Bytes of buffers and of ranges in them.

use super::document::{Document, lookup};
use super::fault::{Fault, Result};
use super::files::Files;
use gltf::json::{Index, buffer};
use std::cell::OnceCell;

/// The buffers of a file, each read when it is first used.
pub(super) struct Buffers<'a> {
    document: &'a Document,
    files: &'a Files,
    bin: Option<Vec<u8>>,
    loaded: Vec<OnceCell<Vec<u8>>>,
}

impl<'a> Buffers<'a> {
    pub(super) fn new(document: &'a Document, files: &'a Files, bin: Option<Vec<u8>>) -> Self {
        let loaded = document.root.buffers.iter().map(|_| OnceCell::new());
        Self {
            document,
            files,
            bin,
            loaded: loaded.collect(),
        }
    }

    /// The bytes of a buffer view and its stride. `place` is where its index stands.
    pub(super) fn view(
        &self,
        index: Index<buffer::View>,
        place: impl FnOnce() -> String,
    ) -> Result<(&[u8], Option<usize>)> {
        let index = index.value();
        let views = &self.document.root.buffer_views;
        let view = lookup(views, "bufferViews", index, place)?;
        let buffer = self.buffer(view.buffer.value(), || {
            format!("bufferViews[{index}].buffer")
        })?;
        let start = view.byte_offset.unwrap_or_default().0;
        let bytes = range(buffer, start, view.byte_length.0).ok_or_else(|| {
            Fault::new(
                format!("bufferViews[{index}]"),
                format!(
                    "bytes {start} and {} more reach beyond the buffer's {}",
                    view.byte_length.0,
                    buffer.len()
                ),
                "the file is broken; export it again",
            )
        })?;
        Ok((bytes, view.byte_stride.map(|stride| stride.0)))
    }

    fn buffer(&self, index: usize, place: impl FnOnce() -> String) -> Result<&[u8]> {
        let cell = lookup(&self.loaded, "buffers", index, place)?;
        if let Some(bytes) = cell.get() {
            return Ok(bytes);
        }
        let bytes = self.load(index)?;
        Ok(cell.get_or_init(|| bytes))
    }

    fn load(&self, index: usize) -> Result<Vec<u8>> {
        let buffer = &self.document.root.buffers[index];
        let place = format!("buffers[{index}]");
        let mut bytes = match (&buffer.uri, &self.bin) {
            (Some(uri), _) => self.files.resolve(uri, &place)?,
            (None, Some(bin)) if index == 0 => bin.clone(),
            (None, _) => {
                return Err(Fault::new(
                    place,
                    "has neither an address nor the binary data of a .glb file",
                    "the file is broken; export it again",
                ));
            }
        };
        let length = buffer.byte_length.0;
        if (bytes.len() as u64) < length {
            return Err(Fault::new(
                place,
                format!("holds {} bytes instead of {length}", bytes.len()),
                "the data is truncated; fetch or export it again",
            ));
        }
        bytes.truncate(length as usize);
        Ok(bytes)
    }
}

/// `length` bytes from `start`, if there are so many.
fn range(bytes: &[u8], start: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(start).ok()?;
    let end = start.checked_add(usize::try_from(length).ok()?)?;
    bytes.get(start..end)
}
