//! How much a file may ask for.

/// What is read at most. The defaults keep the memory for a hostile file below about a gigabyte and hold every scene
/// that this renderer can draw in reasonable time; raise them for larger ones.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of all files of the scene together. 512 MiB.
    pub file_bytes: u64,
    /// JSON objects; nodes, meshes, accessors and so on are one each. 2^20.
    pub objects: u64,
    /// Triangles drawn, instances counted. 2^24.
    pub triangles: u64,
    /// Vertices drawn, instances counted. 2^24.
    pub vertices: u64,
    /// Texels of all images that materials use. 2^27.
    pub texels: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            file_bytes: 512 << 20,
            objects: 1 << 20,
            triangles: 1 << 24,
            vertices: 1 << 24,
            texels: 1 << 27,
        }
    }
}
