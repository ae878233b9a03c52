//! Reading pictures.

pub mod exr;
pub mod png;

use crate::exit::{Failure, Result};
use crate::picture::Picture;
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

/// Reads an EXR or PNG file; its first bytes tell which.
///
/// # Errors
/// [`Failure::Input`] if it cannot be read, is neither, or is broken.
pub fn read(path: &Path) -> Result<Read> {
    let bytes = std::fs::read(path)
        .map_err(|e| Failure::input(path, e, "give an EXR or PNG file that you may read"))?;
    let broken = |problem: String| {
        let remedy = "give a complete EXR or PNG file, or write it anew";
        Failure::input(path, problem, remedy)
    };
    if bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
        let picture = exr::parse(&bytes).map_err(broken)?;
        return Ok(Read {
            picture,
            format: "EXR",
            notes: Vec::new(),
        });
    }
    if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        let (picture, notes) = png::parse(&bytes).map_err(broken)?;
        return Ok(Read {
            picture,
            format: "PNG",
            notes,
        });
    }
    Err(broken("neither EXR nor PNG".into()))
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
