//! Reading pictures.

pub mod exr;
pub mod png;

use crate::exit::{Failure, Result};
use crate::picture::Picture;
use std::io::Read as _;
use std::path::Path;

/// Most pixels of a picture that is read.
pub const PIXELS_MAX: u64 = 1 << 26;

/// A picture from a file, and how it came to be linear.
#[derive(Clone, Debug, PartialEq)]
pub struct Read {
    /// The picture.
    pub picture: Picture,
    /// Kind of the file, for reports.
    pub format: &'static str,
    /// What was done to the values, for the user.
    pub notes: Vec<String>,
}

/// Longest file that is read, in bytes.
const BYTES_MAX: u64 = 1 << 31;
const EXR_MAGIC: &[u8] = &[0x76, 0x2f, 0x31, 0x01];
const PNG_MAGIC: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Reads an EXR or PNG file; its first bytes tell which.
///
/// # Errors
/// [`Failure::Input`] if it cannot be read, is neither, or is broken.
pub fn read(path: &Path) -> Result<Read> {
    let broken = |problem: String| {
        let remedy = "give a complete EXR or PNG file, or write it anew";
        Failure::input(path, problem, remedy)
    };
    let bytes = bytes(path).map_err(|e| broken(e.to_string()))?;
    if bytes.starts_with(EXR_MAGIC) {
        let picture = exr::parse(&bytes).map_err(broken)?;
        return Ok(Read {
            picture,
            format: "EXR",
            notes: Vec::new(),
        });
    }
    if bytes.starts_with(PNG_MAGIC) {
        let (picture, notes) = png::parse(&bytes).map_err(broken)?;
        return Ok(Read {
            picture,
            format: "PNG",
            notes,
        });
    }
    Err(broken("neither EXR nor PNG".into()))
}

/// All bytes of a picture; only the first of anything else, which may have no end.
pub(crate) fn bytes(path: &Path) -> std::io::Result<Vec<u8>> {
    let mut file = std::fs::File::open(path)?;
    let mut bytes = Vec::new();
    file.by_ref()
        .take(PNG_MAGIC.len() as u64)
        .read_to_end(&mut bytes)?;
    if bytes.starts_with(EXR_MAGIC) || bytes.starts_with(PNG_MAGIC) {
        file.take(BYTES_MAX).read_to_end(&mut bytes)?;
    }
    if bytes.len() as u64 > BYTES_MAX {
        let problem = format!("longer than {BYTES_MAX} bytes");
        return Err(std::io::Error::other(problem));
    }
    Ok(bytes)
}

/// Whether these are the bytes of an EXR file.
pub(crate) fn is_exr(bytes: &[u8]) -> bool {
    bytes.starts_with(EXR_MAGIC)
}

/// Refuses what would not fit into memory.
fn check_size(width: u64, height: u64) -> std::result::Result<(), String> {
    match width.checked_mul(height) {
        Some(pixels) if (1..=PIXELS_MAX).contains(&pixels) => Ok(()),
        _ => Err(format!(
            "{width}x{height} pixels, where 1 to {PIXELS_MAX} are read"
        )),
    }
}
