//! What a file said about itself, for reports. No phase reads it.

/// Where a scene comes from. Empty for scenes made in code.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Source {
    /// Bytes of all files that were read.
    pub bytes: u64,
    /// Names of the scenes of the file, in its order; empty names for those without.
    pub scenes: Vec<String>,
    /// Which of them is shown; none if the file has none.
    pub scene: Option<usize>,
    /// Extensions that the file says it uses, in its order.
    pub extensions_used: Vec<String>,
    /// Those of them that are not read.
    pub extensions_ignored: Vec<String>,
    /// Triangles that were read, those of a mesh that is shown several times counted once.
    pub unique_triangles: u64,
    /// Names of [`Scene::lights`](super::Scene::lights).
    pub lights: Vec<String>,
    /// What [`Scene::textures`](super::Scene::textures) are.
    pub images: Vec<ImageSource>,
}

/// The image that a texture was read from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImageSource {
    /// Its name in the file, else its address, else its index.
    pub name: String,
    /// How it was stored: `PNG`, `JPEG` …
    pub format: &'static str,
    /// Its size as it was stored.
    pub bytes: u64,
}
