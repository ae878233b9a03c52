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
//! | `meshopt…`, `draco` | packed bytes and triangles |
//! | `buffers`, `accessor` | elements of vertex attributes and indices |
//! | `attributes`, `morph`, `topology`, `sharing`, `primitive` | triangles of one primitive in its own space |
//! | `nodes`, `animation`, `skins`, `instancing`, `frames`, `assemble` | the tree of nodes, and all triangles in one space |
//! | `materials`, `textures`, `images` | surfaces |
//! | `lights`, `cameras` | what stands in the nodes besides meshes |

mod accessor;
mod animation;
mod assemble;
mod attributes;
mod buffers;
mod cameras;
mod container;
mod document;
#[cfg_attr(not(feature = "draco"), path = "draco_absent.rs")]
mod draco;
mod fault;
mod files;
mod frames;
mod images;
mod instancing;
mod lights;
mod limits;
mod materials;
mod meshopt;
mod meshopt_filters;
mod meshopt_indices;
mod meshopt_vertices;
mod morph;
mod nodes;
mod options;
mod primitive;
mod sharing;
mod skins;
mod tangents;
mod textures;
mod topology;
mod uri;
mod warnings;
mod webp;

#[cfg(test)]
mod tests;

use super::{Scene, Source};
use crate::error::Result;
use animation::Pose;
use buffers::Buffers;
use container::Container;
use document::Document;
use files::Files;
use std::path::Path;
use warnings::Warnings;

pub use images::THREAD as IMAGE_THREAD;
pub use limits::Limits;
pub use options::Options;

/// Reads a `.gltf` or `.glb` file with the buffers and images that it refers to.
///
/// Read are triangles with normals, colours, tangents and two sets of texture coordinates, moved by morph targets at their
/// default weights and by skins at rest, copied by nodes and by `EXT_mesh_gpu_instancing`; metallic-roughness materials
/// with all their textures (PNG, JPEG and WebP), emission, normal maps and alpha masks, `KHR_materials_specular`,
/// `KHR_materials_ior`, `KHR_materials_anisotropy`, `KHR_materials_emissive_strength`, `KHR_materials_unlit`,
/// `KHR_texture_transform`, `KHR_mesh_quantization`, `EXT_meshopt_compression`, `KHR_draco_mesh_compression` (feature `draco`),
/// `KHR_lights_punctual`, and cameras. What else a file holds is left out with a line in
/// [`Scene::warnings`]; if the file *requires* it, it is refused.
///
/// Orthographic cameras become perspective ones of the same view from far behind, with a warning: what lies behind the
/// camera shows, and parallels meet by half a degree.
///
/// Animations are ignored unless a time is asked for: see [`Options::time`].
///
/// Node transforms are composed in f64. A scene without triangles is no error here.
///
/// # Errors
/// [`Error::Scene`](crate::Error::Scene) with file, place and remedy. The default [`Limits`] apply.
pub fn load(path: &Path) -> Result<Scene> {
    load_with(path, &Options::default())
}

/// As [`load`], with other limits, another scene of the file, or at a time of its animations.
///
/// # Errors
/// As [`load`]; [`Error::Setting`](crate::Error::Setting) if the file has not the scene that is asked for.
pub fn load_with(path: &Path, options: &Options) -> Result<Scene> {
    read(path, options).map_err(|fault| fault.into_error(path))
}

fn read(path: &Path, options: &Options) -> fault::Result<Scene> {
    let limits = &options.limits;
    let files = Files::beside(path, limits.file_bytes)?;
    let mut warnings = Warnings::default();
    let Container { json, bin } = container::read(&files, path)?;
    let document = Document::parse(&json, limits, &mut warnings)?;
    drop(json);
    let shown = document.scene(options.scene.as_deref(), &mut warnings)?;
    let buffers = Buffers::new(&document, &files, bin);
    let pose = match options.time {
        Some(time) => Pose::at(&document, &buffers, time)?,
        None => Pose::default(),
    };
    if options.time.is_none() && !document.root.animations.is_empty() {
        warnings.add("animations are ignored: the scene is shown at rest; a time can be chosen");
    }
    let tree = nodes::walk(&document, shown, &pose)?;
    let placed = &tree.placed;
    let geometry = assemble::geometry(&document, &buffers, &tree, limits, &mut warnings)?;
    let (textures, images) = images::decode(&document, &buffers, &files, &geometry.images, limits)?;
    let origin = geometry.origin;
    let (lights, light_names) = lights::collect(&document, placed, origin, &mut warnings)?;
    if lights.len() as u64 > limits.lights {
        return Err(fault::Fault::new(
            "nodes",
            format!("hold {} lights, more than {}", lights.len(), limits.lights),
            "use fewer lights, or raise the limit `lights`",
        ));
    }
    let cameras = cameras::collect(&document, placed, &geometry, &mut warnings)?;
    let (extensions_used, extensions_ignored) = document.extensions();
    let scene = Scene {
        name: container::name(path),
        origin,
        mesh: geometry.mesh,
        materials: geometry.materials,
        textures,
        lights,
        cameras,
        warnings: warnings.into_lines(),
        source: Source {
            bytes: files.bytes_read(),
            scenes: document.scene_names(),
            scene: shown,
            extensions_used,
            extensions_ignored,
            unique_triangles: geometry.unique_triangles,
            lights: light_names,
            images,
        },
    };
    let needed = scene.memory_bytes() + scene.prepared_bytes();
    if needed > limits.memory {
        return Err(fault::Fault::new(
            "scene",
            format!("takes {needed} bytes, more than {}", limits.memory),
            "simplify it, use smaller images, or raise the limit `memory`",
        ));
    }
    Ok(scene)
}
