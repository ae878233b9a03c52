//! Reading glTF 2.0 files.
//!
//! [`load`] is the way in. Parsing is the `gltf` crate's; everything that a file says about itself (ranges, indices,
//! trees, addresses of other files) is checked here before it is used, so that no file can make the program panic,
//! run on, or read outside the folder of the scene.
//!
//! | module | idea |
//! | --- | --- |
//! | `fault`, `limits`, `warnings` | what is refused, how much is accepted, what is left out |
//! | `container`, `files`, `uri` | bytes: the file, files beside it, data inside it |
//! | `document` | JSON to typed values, extensions, lookups that cannot miss |
//! | `buffers`, `accessor` | elements of vertex attributes and indices |
//! | `attributes`, `morph`, `topology`, `sharing`, `primitive` | triangles of one primitive in its own space |
//! | `nodes`, `skins`, `instancing`, `frames`, `assemble` | the tree of nodes, and all triangles in one space |
//! | `materials`, `textures`, `images` | surfaces |
//! | `lights`, `cameras` | what stands in the nodes besides meshes |

mod accessor;
mod assemble;
mod attributes;
mod buffers;
mod cameras;
mod container;
mod document;
mod fault;
mod files;
mod frames;
mod images;
mod instancing;
mod lights;
mod limits;
mod materials;
mod morph;
mod nodes;
mod primitive;
mod sharing;
mod skins;
mod tangents;
mod textures;
mod topology;
mod uri;
mod warnings;

#[cfg(test)]
mod tests;

use super::Scene;
use crate::error::Result;
use buffers::Buffers;
use container::Container;
use document::Document;
use files::Files;
use std::path::Path;
use warnings::Warnings;

pub use limits::Limits;

/// Reads a `.gltf` or `.glb` file with the buffers and images that it refers to.
///
/// Read are triangles with normals, colours and texture coordinates, moved by morph targets at their default weights
/// and by skins at rest, copied by nodes and by `EXT_mesh_gpu_instancing`; metallic-roughness materials with their textures (PNG and
/// JPEG), `KHR_materials_specular` and `KHR_materials_ior` (factors), `KHR_texture_transform`,
/// `KHR_mesh_quantization`, `KHR_lights_punctual`, and perspective cameras. What else a file holds is left
/// out with a line in [`Scene::warnings`]; if the file *requires* it, it is refused.
///
/// Node transforms are composed in f64. A scene without triangles is no error here.
///
/// # Errors
/// [`Error::Scene`](crate::Error::Scene) with file, place and remedy. The default [`Limits`] apply.
pub fn load(path: &Path) -> Result<Scene> {
    load_with(path, &Limits::default())
}

/// As [`load`], within other limits.
///
/// # Errors
/// As [`load`].
pub fn load_with(path: &Path, limits: &Limits) -> Result<Scene> {
    read(path, limits).map_err(|fault| fault.into_error(path))
}

fn read(path: &Path, limits: &Limits) -> fault::Result<Scene> {
    let files = Files::beside(path, limits.file_bytes)?;
    let mut warnings = Warnings::default();
    let Container { json, bin } = container::read(&files, path)?;
    let document = Document::parse(&json, limits, &mut warnings)?;
    drop(json);
    let tree = nodes::walk(&document, &mut warnings)?;
    let placed = &tree.placed;
    let buffers = Buffers::new(&document, &files, bin);
    let geometry = assemble::geometry(&document, &buffers, &tree, limits, &mut warnings)?;
    let textures = images::decode(&document, &buffers, &files, &geometry.images, limits)?;
    let origin = geometry.origin;
    Ok(Scene {
        name: container::name(path),
        origin,
        mesh: geometry.mesh,
        materials: geometry.materials,
        textures,
        lights: lights::collect(&document, placed, origin, &mut warnings)?,
        cameras: cameras::collect(&document, placed, origin, &mut warnings)?,
        warnings: warnings.into_lines(),
    })
}
