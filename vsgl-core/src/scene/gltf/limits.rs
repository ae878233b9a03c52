//! How much a file may ask for.

/// What is read at most. The defaults keep the memory for a hostile file below a gigabyte; raise them for scenes that
/// need more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of all files of the scene together. 512 MiB.
    pub file_bytes: u64,
    /// JSON objects; nodes, meshes, accessors and so on are one each. 2^20.
    pub objects: u64,
    /// Triangles drawn, instances counted. 2^23.
    pub triangles: u64,
    /// Vertices drawn, instances counted; triangles without normals have three each. 2^23.
    pub vertices: u64,
    /// Displacements by morph targets that have a weight: one for each vertex and target. 2^25.
    pub displacements: u64,
    /// Joints of all skins in use. 2^16.
    pub joints: u64,
    /// Texels of all images that materials use; those of 16 bits count twice. 2^27.
    pub texels: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            file_bytes: 512 << 20,
            objects: 1 << 20,
            triangles: 1 << 23,
            vertices: 1 << 23,
            displacements: 1 << 25,
            joints: 1 << 16,
            texels: 1 << 27,
        }
    }
}
