//! Writing pictures: formats by suffix, complete files only.

pub mod color;
pub mod exposure;
pub mod exr;
pub mod font;
pub mod legend;
mod pending;
pub mod png;
pub mod srgb;
pub mod tonemap;

pub use pending::{Pending, folder_of, remove_all};

use crate::exit::{Failure, Result};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Key of the samples among the settings of a picture of paths.
const PATHS: &str = "paths";

/// What a file says about how it was made. It holds neither times nor names of files nor the number of threads, so
/// that equal pictures are equal files.
#[derive(Clone, Debug, Default)]
pub struct Metadata {
    /// Name and version of this program.
    pub software: String,
    /// The command that makes the picture again.
    pub command: String,
    /// World to camera space (x right, y up, z to the viewer), for row vectors as OpenEXR has it.
    pub world_to_camera: Option<[f32; 16]>,
    /// All settings.
    pub settings: Value,
    /// Which samples a picture of paths holds; see [`crate::part::About`].
    pub paths: Option<Value>,
}

impl Metadata {
    /// Settings and samples in one document.
    #[must_use]
    pub fn document(&self) -> Value {
        let mut document = self.settings.clone();
        if let (Value::Object(map), Some(paths)) = (&mut document, &self.paths) {
            map.insert(PATHS.into(), paths.clone());
        }
        document
    }

    /// Takes such a document apart.
    pub fn set_document(&mut self, mut document: Value) {
        self.paths = match &mut document {
            Value::Object(map) => map.remove(PATHS),
            _ => None,
        };
        self.settings = document;
    }
}

/// Name and version of this program.
pub fn software() -> String {
    concat!("vsgl ", env!("CARGO_PKG_VERSION")).to_owned()
}

/// Kind of an output file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// 8-bit sRGB.
    Png,
    /// Linear f32 with all layers.
    Exr,
}

impl Format {
    /// The format that a file's suffix stands for.
    ///
    /// # Errors
    /// [`Failure::Usage`] for an unknown suffix.
    pub fn of(path: &Path) -> Result<Self> {
        let suffix = path.extension().map(|s| s.to_string_lossy().to_lowercase());
        match suffix.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("exr") => Ok(Self::Exr),
            _ => Err(Failure::Usage(format!(
                "{}: unknown kind of picture; give a name that ends in .png or .exr",
                path.display()
            ))),
        }
    }

    /// Name for reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Png => "PNG",
            Self::Exr => "EXR",
        }
    }
}

/// Makes the files to be, each with its format.
///
/// # Errors
/// [`Failure::Usage`] for an unknown suffix or a path given twice, [`Failure::Output`] for one that cannot be written.
pub fn open_all(paths: &[PathBuf]) -> Result<Vec<(Format, Pending)>> {
    let formats: Vec<_> = paths.iter().map(|p| Format::of(p)).collect::<Result<_>>()?;
    for (i, path) in paths.iter().enumerate() {
        if paths[..i].iter().any(|other| same_place(other, path)) {
            return Err(Failure::Usage(format!(
                "{}: given twice as output; give each file once",
                path.display()
            )));
        }
    }
    let pending = paths.iter().map(|path| Pending::create(path));
    formats
        .into_iter()
        .zip(pending)
        .map(|(format, pending)| Ok((format, pending?)))
        .collect()
}

/// Whether two paths name one file, as far as can be told without making it.
pub fn same_place(a: &Path, b: &Path) -> bool {
    let place = |path: &Path| {
        if let Ok(real) = path.canonicalize() {
            return real;
        }
        let folder = folder_of(path);
        let folder = folder
            .canonicalize()
            .or_else(|_| std::path::absolute(folder));
        let folder = folder.unwrap_or_default();
        folder.join(path.file_name().unwrap_or_default())
    };
    place(a) == place(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suffixes_decide_and_duplicates_are_refused() {
        assert_eq!(Format::of(Path::new("a.PNG")).ok(), Some(Format::Png));
        assert_eq!(Format::of(Path::new("x/a.exr")).ok(), Some(Format::Exr));
        for bad in ["a.jpg", "a", ".png", ""] {
            let code = Format::of(Path::new(bad)).map_err(|f| f.code());
            assert_eq!(code, Err(2), "{bad}");
        }
        let folder = tempfile::tempdir().expect("a temporary folder");
        let twice = [folder.path().join("a.png"), folder.path().join("./a.png")];
        assert_eq!(open_all(&twice).map_err(|f| f.code()).map(|_| ()), Err(2));
        let different = [folder.path().join("a.png"), folder.path().join("a.exr")];
        assert_eq!(open_all(&different).map(|files| files.len()).ok(), Some(2));
        let left = std::fs::read_dir(folder.path()).map_or(9, Iterator::count);
        assert_eq!(left, 0);
    }
}
