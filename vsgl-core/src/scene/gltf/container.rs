//! The file itself: JSON, or JSON and binary data in a .glb container.

use super::fault::{Fault, Result};
use super::files::Files;
use std::ops::Range;
use std::path::Path;

/// The parts of a scene file.
pub(super) struct Container {
    pub(super) json: Vec<u8>,
    /// Data of the first buffer of a .glb file.
    pub(super) bin: Option<Vec<u8>>,
}

const MAGIC: &[u8] = b"glTF";
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BIN: u32 = u32::from_le_bytes(*b"BIN\0");

/// Reads the file and takes it apart. The first bytes decide, not the name.
pub(super) fn read(files: &Files, path: &Path) -> Result<Container> {
    let bytes = files.read(path)?;
    if bytes.is_empty() {
        return Err(Fault::new("file", "is empty", "name a glTF 2.0 file"));
    }
    if bytes.starts_with(MAGIC) {
        return split(bytes);
    }
    let json = match bytes.strip_prefix(b"\xef\xbb\xbf") {
        Some(without_mark) => without_mark.to_vec(),
        None => bytes,
    };
    Ok(Container { json, bin: None })
}

/// The last part of the path, for reports.
pub(super) fn name(path: &Path) -> String {
    path.file_name()
        .unwrap_or(path.as_os_str())
        .to_string_lossy()
        .into_owned()
}

fn split(mut bytes: Vec<u8>) -> Result<Container> {
    let broken = |problem: String| {
        Fault::new(
            "file",
            problem,
            "export it again as binary glTF 2.0, or fetch it again",
        )
    };
    let truncated = || broken("is a truncated .glb file".into());
    let mut rest = &bytes[MAGIC.len()..];
    let version = take_u32(&mut rest).ok_or_else(truncated)?;
    if version != 2 {
        return Err(broken(format!("is a .glb file of version {version}")));
    }
    let length = take_u32(&mut rest).ok_or_else(truncated)? as usize;
    if length > bytes.len() {
        return Err(truncated());
    }
    let mut json = None;
    let mut bin: Option<Range<usize>> = None;
    // Up to seven bytes that cannot be a chunk may follow as padding.
    while rest.len() >= 8 {
        let size = take_u32(&mut rest).ok_or_else(truncated)? as usize;
        let kind = take_u32(&mut rest).ok_or_else(truncated)?;
        let chunk = rest.get(..size).ok_or_else(truncated)?;
        let start = bytes.len() - rest.len();
        rest = &rest[size..];
        match kind {
            JSON if json.is_none() => json = Some(chunk.to_vec()),
            BIN if bin.is_none() => bin = Some(start..start + size),
            // Chunks of other kinds are to be ignored.
            _ => {}
        }
    }
    let json = json.ok_or_else(|| broken("is a .glb file without JSON".into()))?;
    // The bytes themselves, moved: a copy would hold a large file twice.
    let bin = bin.map(|range| {
        bytes.truncate(range.end);
        bytes.drain(..range.start);
        bytes
    });
    Ok(Container { json, bin })
}

fn take_u32(bytes: &mut &[u8]) -> Option<u32> {
    let (head, tail) = bytes.split_first_chunk::<4>()?;
    *bytes = tail;
    Some(u32::from_le_bytes(*head))
}
