//! Writing a picture into files with what they say about it.

use crate::args::DisplayArgs;
use crate::exit::Result;
use crate::output::{self, Format, Metadata, Pending};
use crate::part::{self, About};
use crate::picture::Picture;
use crate::text;
use serde_json::{Value, json};
use vsgl_core::data::Image;
use vsgl_core::trace::Sums;

/// A file that was written.
pub(super) struct Written {
    pub(super) path: String,
    pub(super) format: &'static str,
    /// Stops of a PNG.
    pub(super) exposure: Option<f32>,
}

impl Written {
    pub(super) fn new(path: String, format: &'static str) -> Self {
        Self {
            path,
            format,
            exposure: None,
        }
    }

    /// A line for people.
    pub(super) fn text(&self) -> String {
        let mut line = format!("  {}  {}", self.path, self.format);
        if let Some(stops) = self.exposure {
            line += &format!(", exposure {stops:+.2} stops");
        }
        line + "\n"
    }

    /// For machines.
    pub(super) fn json(&self) -> Value {
        json!({"file": self.path, "format": self.format, "exposure": self.exposure})
    }
}

/// What files say about a picture.
pub(super) struct Sheet<'a> {
    /// Of an EXR. The command is without the flags that decide how a PNG looks.
    pub(super) metadata: Metadata,
    /// How a PNG looks.
    pub(super) display: &'a DisplayArgs,
    /// Which samples it holds, if it is one of paths; and their sums, unless it is whole.
    pub(super) paths: Option<(&'a About, Option<&'a Sums>)>,
}

impl Sheet<'_> {
    /// Writes one file.
    ///
    /// # Errors
    /// [`crate::exit::Failure::Output`] if that fails.
    pub(super) fn write(&self, image: &Image, format: Format, file: Pending) -> Result<Written> {
        let path = file.path().to_string_lossy().into_owned();
        let mut written = Written::new(path, format.name());
        let metadata = Metadata {
            paths: self.paths.map(|(about, _)| about.json()),
            ..self.metadata.clone()
        };
        match format {
            Format::Exr => file.write(|file| self.exr(file, image, &metadata))?,
            Format::Png => {
                let pixels = image.beauty();
                let stops = self.display.exposure.stops(&pixels);
                written.exposure = Some(stops);
                let metadata = self.png_metadata(metadata, stops);
                let scale = stops.exp2();
                let code = |p: &[f32; 3]| {
                    let tonemap = self.display.tonemap;
                    tonemap.apply(p.map(|c| c * scale)).map(output::srgb::code)
                };
                let codes: Vec<[u8; 3]> = pixels.iter().map(code).collect();
                let (width, height) = (image.width, image.height);
                file.write(|file| output::png::write(file, width, height, &codes, &metadata))?;
            }
        }
        Ok(written)
    }

    /// Writes what there is into the place of an EXR that is still to be.
    ///
    /// # Errors
    /// As [`Sheet::write`].
    pub(super) fn save(&self, image: &Image, file: &Pending) -> Result<()> {
        file.write_before(|file| self.exr(file, image, &self.metadata))
    }

    fn exr(
        &self,
        file: impl std::io::Write + std::io::Seek,
        image: &Image,
        metadata: &Metadata,
    ) -> std::result::Result<(), exr::error::Error> {
        match self.paths {
            Some((about, Some(sums))) => part::write(file, image, sums, about, metadata),
            _ => output::exr::write(file, Picture::from_image(image), metadata),
        }
    }

    fn png_metadata(&self, mut metadata: Metadata, stops: f32) -> Metadata {
        if let Value::Object(settings) = &mut metadata.settings {
            settings.insert("exposure".into(), text::json_number(f64::from(stops)));
            settings.insert("tonemap".into(), self.display.tonemap.word().into());
        }
        let words = self.display.words();
        if !words.is_empty() {
            metadata.command += &format!(" {}", text::shell(&words));
        }
        metadata
    }
}
