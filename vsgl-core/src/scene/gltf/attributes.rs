//! Attributes of vertices, looked up by their meaning.

use super::accessor::{Vectors, component_count};
use super::buffers::Buffers;
use super::document::Document;
use super::draco::Unpacked;
use super::fault::{Fault, Result};
use glam::Vec4;
use gltf::json::mesh::{self, Semantic};
use gltf::json::validation::Checked;
use gltf::json::{Accessor, Index};

/// The attributes of one primitive.
#[derive(Clone, Copy)]
pub(super) struct Attributes<'a, 'p> {
    pub(super) document: &'a Document,
    pub(super) buffers: &'a Buffers<'a>,
    pub(super) primitive: &'p mesh::Primitive,
    /// JSON path of the primitive.
    pub(super) place: &'p str,
    /// What is packed, if anything is: it goes before what the accessors say.
    pub(super) packed: Option<&'p Unpacked>,
}

impl<'a> Attributes<'a, '_> {
    /// An attribute of `N` components; none if the primitive does not have it.
    pub(super) fn get<const N: usize>(&self, semantic: Semantic) -> Result<Option<Vectors<'a, N>>> {
        let Some(index) = self.index(semantic.clone()) else {
            return Ok(None);
        };
        let place = || self.path(&semantic);
        let numbers = self.packed.and_then(|p| p.numbers(&semantic, N));
        match numbers {
            Some(numbers) => Vectors::unpacked(self.document, index, numbers, place),
            None => Vectors::new(self.document, self.buffers, index, place),
        }
        .map(Some)
    }

    /// The same, refused if it has not an element for each of the `vertices`.
    pub(super) fn full<const N: usize>(
        &self,
        semantic: Semantic,
        vertices: usize,
    ) -> Result<Option<Vectors<'a, N>>> {
        let path = self.path(&semantic);
        let found = self.get(semantic)?;
        if let Some(found) = &found {
            check_len(found, vertices, &path)?;
        }
        Ok(found)
    }

    /// Linear colours of the vertices; none if the primitive has none.
    ///
    /// Source: glTF 2.0 specification, 3.7.2.1: three or four components, clamped to 0..=1.
    pub(super) fn colors(&self, vertices: usize) -> Result<Option<Colors<'a>>> {
        let semantic = Semantic::Colors(0);
        let Some(index) = self.index(semantic.clone()) else {
            return Ok(None);
        };
        let path = self.path(&semantic);
        if component_count(self.document, index, || path)? == Some(3) {
            let rgb = self.full(semantic, vertices)?;
            return Ok(rgb.map(|rgb| Colors::Opaque(rgb.into_shares())));
        }
        let rgba = self.full(semantic, vertices)?;
        Ok(rgba.map(|rgba| Colors::Alpha(rgba.into_shares())))
    }

    /// JSON path of an attribute.
    pub(super) fn path(&self, semantic: &Semantic) -> String {
        format!("{}.attributes.{}", self.place, semantic.to_string())
    }

    fn index(&self, semantic: Semantic) -> Option<Index<Accessor>> {
        let attributes = &self.primitive.attributes;
        attributes.get(&Checked::Valid(semantic)).copied()
    }
}

/// Colours without or with alpha.
pub(super) enum Colors<'a> {
    Opaque(Vectors<'a, 3>),
    Alpha(Vectors<'a, 4>),
}

impl Colors<'_> {
    /// Red, green, blue and alpha of a vertex, 0..=1.
    pub(super) fn get(&self, vertex: u32) -> Vec4 {
        let color = match self {
            Self::Opaque(rgb) => {
                let [r, g, b] = rgb.get(vertex);
                [r, g, b, 1.0]
            }
            Self::Alpha(rgba) => rgba.get(vertex),
        };
        // What is no number becomes 0.
        Vec4::from(color.map(|c| c.max(0.0).clamp(0.0, 1.0)))
    }
}

/// Refuses an accessor with fewer elements than are needed.
pub(super) fn check_len<const N: usize>(
    attribute: &Vectors<'_, N>,
    needed: usize,
    path: &str,
) -> Result<()> {
    if attribute.len() >= needed {
        return Ok(());
    }
    Err(Fault::new(
        path,
        format!("{} elements where {needed} are needed", attribute.len()),
        "the file is broken; export it again",
    ))
}
