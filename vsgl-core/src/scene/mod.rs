//! A scene as it was read or made: triangles, materials, lights, cameras. SI units, y up by custom only.
//!
//! Positions are stored relative to [`Scene::origin`], which is kept in double precision, so that a scene far from
//! the world's origin loses no digits in the f32 arithmetic of the pipeline.

mod camera;
mod emitters;
pub mod facts;
#[cfg(feature = "gltf")]
pub mod gltf;
pub mod light;
mod material;
mod prepare;
mod pyramid;
pub mod samples;
mod shares;
mod source;

pub use camera::Camera;
pub use emitters::POINTS as EMITTER_POINTS;
pub use facts::{SceneFacts, SurfaceFacts};
pub use light::{DirectionalLight, Light, PointLight, SpotLight};
pub use material::{Filter, Material, Slot, Texture, TextureRef, Wrap};
pub use source::{ImageSource, Source};

use glam::{DVec3, Vec2, Vec3, Vec4};

/// Triangles, materials, lights and cameras.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// A name for reports: file name or sample name.
    pub name: String,
    /// World position of the local origin \[m\]: the centre of the bounds. Everything else is relative to it.
    pub origin: DVec3,
    /// All triangles.
    pub mesh: Mesh,
    /// Materials that [`Mesh::material`] refers to.
    pub materials: Vec<Material>,
    /// Images that materials refer to.
    pub textures: Vec<Texture>,
    /// Lights of the file, in file order.
    pub lights: Vec<Light>,
    /// Cameras of the file with their names, in file order.
    pub cameras: Vec<(String, Camera)>,
    /// What was ignored while reading, a line each, for the user.
    pub warnings: Vec<String>,
    /// What the file was, for reports.
    pub source: Source,
}

impl Scene {
    /// Local position of a world position.
    pub fn local(&self, world: DVec3) -> Vec3 {
        (world - self.origin).as_vec3()
    }

    /// Bytes that vertices, triangles and texels take.
    pub fn memory_bytes(&self) -> u64 {
        fn bytes<T>(list: &[T]) -> u64 {
            size_of_val(list) as u64
        }
        let mesh = &self.mesh;
        let vertices = bytes(&mesh.positions)
            + bytes(&mesh.normals)
            + bytes(&mesh.texcoords)
            + bytes(&mesh.texcoords_second)
            + bytes(&mesh.tangents)
            + bytes(&mesh.colors);
        let texels: u64 = self.textures.iter().map(|t| bytes(&t.texels)).sum();
        vertices + bytes(&mesh.triangles) + bytes(&mesh.material) + texels
    }

    /// About how many bytes [`SceneData::take`](crate::data::SceneData::take) needs besides those of the scene.
    pub fn prepared_bytes(&self) -> u64 {
        let mesh = &self.mesh;
        let each = |floats: u64, wanted: bool| if wanted { 4 * floats } else { 0 };
        // Corners, twice while the hierarchy is built, with its boxes, nodes and order; normals, material.
        let triangle = each(9 + 9 + 8 + 8 + 1 + 9 + 1, true)
            + each(6, !mesh.texcoords.is_empty())
            + each(6, !mesh.texcoords_second.is_empty())
            + each(12, !mesh.tangents.is_empty())
            + each(12, !mesh.colors.is_empty());
        // Copied one by one, while those before are freed; and a third for the smaller images, for colours and for
        // numbers.
        let texels: u64 = self.textures.iter().map(|t| t.texels.len() as u64).sum();
        mesh.triangles.len() as u64 * triangle + 4 * texels * 2 / 3
    }

    /// Smallest box around all vertices, as (least, greatest) corner \[m\]; zero without triangles.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let mut corners = self.mesh.positions.iter();
        let Some(&first) = corners.next() else {
            return (Vec3::ZERO, Vec3::ZERO);
        };
        corners.fold((first, first), |(low, high), &p| (low.min(p), high.max(p)))
    }
}

/// Indexed triangles of all objects, already placed in the scene.
///
/// The vectors of vertices run side by side where they are not empty; so do `triangles` and `material`.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Vertex positions relative to [`Scene::origin`] \[m\].
    pub positions: Vec<Vec3>,
    /// Unit shading normals, one a vertex.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, one a vertex; empty where no material has a texture.
    pub texcoords: Vec<Vec2>,
    /// A second set of texture coordinates, one a vertex; empty where no material reads it.
    pub texcoords_second: Vec<Vec2>,
    /// Unit tangents along increasing u of the texture coordinates of the normal map, w: +1 or -1, the sign of the
    /// bitangent `w (normal × tangent)`, which points along decreasing v. Zero where a vertex has none that can be used.
    /// One a vertex; empty where no material has a normal map or anisotropy.
    pub tangents: Vec<Vec4>,
    /// Linear colours, red, green, blue, alpha, that base colours are multiplied by; one a vertex. Empty where no
    /// object has them.
    pub colors: Vec<Vec4>,
    /// Vertex indices of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Index into [`Scene::materials`] of each triangle.
    pub material: Vec<u32>,
}
