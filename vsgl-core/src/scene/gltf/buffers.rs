//! Bytes of buffers and of ranges in them.

use super::document::{Document, lookup};
use super::fault::{Fault, Result};
use super::files::Files;
use super::meshopt::{self, Packed};
use gltf::json::{Index, Value, buffer};
use std::cell::{Cell, OnceCell};
use std::collections::HashMap;

/// The buffers of a file, each read when it is first used.
pub(super) struct Buffers<'a> {
    document: &'a Document,
    files: &'a Files,
    /// Data of the first buffer of a .glb file, until that is used.
    bin: Cell<Option<Vec<u8>>>,
    loaded: Vec<OnceCell<Vec<u8>>>,
    /// Ranges that are packed, by the index of their buffer view, each unpacked when it is first used.
    unpacked: HashMap<usize, OnceCell<Vec<u8>>>,
}

impl<'a> Buffers<'a> {
    pub(super) fn new(document: &'a Document, files: &'a Files, bin: Option<Vec<u8>>) -> Self {
        let loaded = document.root.buffers.iter().map(|_| OnceCell::new());
        let views = document.root.buffer_views.iter().enumerate();
        let packed = views.filter(|(_, view)| packed(view).is_some());
        Self {
            document,
            files,
            bin: Cell::new(bin),
            loaded: loaded.collect(),
            unpacked: packed.map(|(i, _)| (i, OnceCell::new())).collect(),
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
        let stride = view.byte_stride.map(|stride| stride.0);
        if let (Some(extension), Some(cell)) = (packed(view), self.unpacked.get(&index)) {
            if let Some(bytes) = cell.get() {
                return Ok((bytes, stride));
            }
            let bytes = self.unpack(extension, index)?;
            return Ok((cell.get_or_init(|| bytes), stride));
        }
        let start = view.byte_offset.unwrap_or_default().0;
        let place = || format!("bufferViews[{index}]");
        let bytes = self.range(view.buffer.value(), start, view.byte_length.0, place)?;
        Ok((bytes, stride))
    }

    /// The bytes of view `index`, which are packed.
    fn unpack(&self, extension: &Value, index: usize) -> Result<Vec<u8>> {
        let place = || format!("bufferViews[{index}].extensions.{}", meshopt::NAME);
        let packed = Packed::of(extension).map_err(|member| {
            let place = format!("{}.{member}", place());
            Fault::new(place, "is not what the extension says", BROKEN)
        })?;
        let bytes = self.range(packed.buffer, packed.start, packed.length, place)?;
        // Both count: the same bytes may be named again and again.
        self.files
            .charge(packed.length.saturating_add(packed.size()))?;
        let unpacked = packed.unpack(bytes);
        unpacked.ok_or_else(|| Fault::new(place(), "cannot be unpacked", BROKEN))
    }

    fn range(
        &self,
        buffer: usize,
        start: u64,
        length: u64,
        place: impl Fn() -> String,
    ) -> Result<&[u8]> {
        let buffer = self.buffer(buffer, || format!("{}.buffer", place()))?;
        range(buffer, start, length).ok_or_else(|| {
            let size = buffer.len();
            let problem =
                format!("bytes {start} and {length} more reach beyond the buffer's {size}");
            Fault::new(place(), problem, BROKEN)
        })
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
        let bin = match &buffer.uri {
            None if index == 0 => self.bin.take(),
            _ => None,
        };
        let mut bytes = match (&buffer.uri, bin) {
            (Some(uri), _) => self.files.resolve(uri, &place)?,
            (None, Some(bin)) => bin,
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

const BROKEN: &str = "the file is broken; export it again";

/// What a view says about how it is packed.
fn packed(view: &buffer::View) -> Option<&Value> {
    view.extensions.as_ref()?.others.get(meshopt::NAME)
}

/// `length` bytes from `start`, if there are so many.
fn range(bytes: &[u8], start: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(start).ok()?;
    let end = start.checked_add(usize::try_from(length).ok()?)?;
    bytes.get(start..end)
}
