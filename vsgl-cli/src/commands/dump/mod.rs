//! `vsgl render --dump`: pictures of what lies between scene and picture.

mod clusters;
mod map;
mod shadows;

use crate::exit::Result;
use crate::interrupt;
use crate::output::font::Canvas;
use crate::output::{self, Metadata, Pending};
use map::Map;
use std::path::{Path, PathBuf};
use vsgl_core::backend::Backend;
use vsgl_core::data::{Occlusion, Pdf, Rsm, Vsgls};

/// Most maps that are drawn.
const MAPS_MAX: u32 = 16;

/// What light bounces from, where the backend keeps it.
pub(super) struct Senders<B: Backend> {
    pub(super) rsm: Option<B::Res<Rsm>>,
    pub(super) pdf: Option<B::Res<Pdf>>,
    pub(super) vsgls: Option<B::Res<Vsgls>>,
    pub(super) occlusion: Option<B::Res<Occlusion>>,
}

/// A folder for the pictures.
pub(super) struct Dump {
    folder: PathBuf,
}

/// Makes sure that files can be made in the folder.
///
/// # Errors
/// [`crate::exit::Failure::Output`] if not.
pub(super) fn prepare(folder: &Path) -> Result<Dump> {
    drop(Pending::create(&folder.join("map0.exr"))?);
    Ok(Dump {
        folder: folder.to_owned(),
    })
}

impl Dump {
    /// Writes the pictures of each map, and returns their paths with their formats.
    ///
    /// # Errors
    /// [`crate::exit::Failure::Output`] for a file that cannot be written.
    pub(super) fn write<B: Backend>(
        &self,
        backend: &B,
        senders: &Senders<B>,
        metadata: &Metadata,
    ) -> Result<Vec<(PathBuf, &'static str)>> {
        let Some(rsm) = &senders.rsm else {
            return Ok(Vec::new());
        };
        let rsm = backend.download(rsm)?;
        let pdf = senders
            .pdf
            .as_ref()
            .map(|p| backend.download(p))
            .transpose()?;
        let vsgls = senders
            .vsgls
            .as_ref()
            .map(|v| backend.download(v))
            .transpose()?;
        let mut written = Vec::new();
        for index in 0..rsm.maps.min(MAPS_MAX) {
            interrupt::check()?;
            let map = Map::new(&rsm, pdf.as_ref(), vsgls.as_ref(), index);
            let mut pictures = vec![
                ("position", map.positions()),
                ("normal", map.normals()),
                ("flux", map.fluxes()),
            ];
            if let Some(density) = map.densities() {
                pictures.push(("pdf", density));
            }
            if let Some(vsgls) = &vsgls {
                pictures.push(("clusters", clusters::draw(&map, vsgls)));
            }
            for (what, canvas) in pictures {
                let path = self.folder.join(format!("map{index}-{what}.png"));
                write_png(&path, &canvas, metadata)?;
                written.push((path, "PNG"));
            }
            let path = self.folder.join(format!("map{index}.exr"));
            let picture = map.picture();
            let file = Pending::create(&path)?;
            file.write(|file| output::exr::write(file, picture, metadata))?;
            written.push((path, "EXR"));
        }
        if let Some(maps) = &senders.occlusion {
            interrupt::check()?;
            let path = self.folder.join("shadow-maps.png");
            write_png(&path, &shadows::draw(&backend.download(maps)?), metadata)?;
            written.push((path, "PNG"));
        }
        Ok(written)
    }
}

fn write_png(path: &Path, canvas: &Canvas, metadata: &Metadata) -> Result<()> {
    let (width, height) = (canvas.width as u32, canvas.height as u32);
    Pending::create(path)?
        .write(|file| output::png::write(file, width, height, &canvas.pixels, metadata))
}
