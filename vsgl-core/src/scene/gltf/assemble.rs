//! All triangles of the scene in one space.

use super::buffers::Buffers;
use super::document::{Document, lookup};
use super::fault::{Fault, Result};
use super::limits::Limits;
use super::materials::Materials;
use super::nodes::{LARGEST, Placed};
use super::primitive::{Primitive, Reader, check_triangles, check_vertices, cross};
use super::warnings::Warnings;
use crate::scene::{Material, Mesh};
use glam::{DMat3, DMat4, DVec3, Vec2, Vec3};

/// What the meshes of the file come to.
pub(super) struct Geometry {
    pub(super) mesh: Mesh,
    /// Centre of the bounds in the world.
    pub(super) origin: DVec3,
    /// Materials that triangles use.
    pub(super) materials: Vec<Material>,
    /// Images that these materials use, as indices of the file, in the order of the scene's textures.
    pub(super) images: Vec<usize>,
}

/// Smallest half extent that is accepted \[m\], for the same reason as [`LARGEST`].
const SMALLEST: f64 = 1e-9;

/// Reads every mesh that a node shows, once, and places its instances.
pub(super) fn geometry(
    document: &Document,
    buffers: &Buffers<'_>,
    placed: &[Placed<'_>],
    limits: &Limits,
    warnings: &mut Warnings,
) -> Result<Geometry> {
    let mut reader = Reader {
        document,
        buffers,
        materials: Materials::new(document),
        limits,
        triangles: 0,
        vertices: 0,
    };
    let mut meshes: Vec<Option<Vec<Primitive>>> = Vec::new();
    meshes.resize_with(document.root.meshes.len(), || None);
    let mut instances: Vec<(usize, &Placed<'_>)> = Vec::new();
    for place in placed {
        let Some(mesh) = place.node.mesh else {
            continue;
        };
        let at = || format!("nodes[{}].mesh", place.index);
        let slot = mesh.value();
        lookup(&meshes, "meshes", slot, at)?;
        if meshes[slot].is_none() {
            meshes[slot] = Some(read_mesh(&mut reader, slot, warnings)?);
        }
        instances.push((slot, place));
    }
    let instances: Vec<Instance<'_>> = instances
        .into_iter()
        .flat_map(|(slot, place)| meshes[slot].iter().flatten().map(move |p| (p, place)))
        .map(|(primitive, place)| Instance { primitive, place })
        .collect();
    let origin = centre(&instances)?;
    let (materials, images) = reader.materials.finish();
    Ok(Geometry {
        mesh: join(&instances, origin, limits)?,
        origin,
        materials,
        images,
    })
}

fn read_mesh(
    reader: &mut Reader<'_>,
    index: usize,
    warnings: &mut Warnings,
) -> Result<Vec<Primitive>> {
    let mesh = &reader.document.root.meshes[index];
    let mut primitives = Vec::new();
    for (i, primitive) in mesh.primitives.iter().enumerate() {
        let place = format!("meshes[{index}].primitives[{i}]");
        primitives.extend(reader.read(primitive, &place, warnings)?);
    }
    Ok(primitives)
}

/// A primitive where a node puts it.
struct Instance<'a> {
    primitive: &'a Primitive,
    place: &'a Placed<'a>,
}

impl Instance<'_> {
    fn positions(&self) -> impl Iterator<Item = DVec3> {
        let world = self.place.world;
        let positions = self.primitive.positions.iter();
        positions.map(move |p| world.transform_point3(p.as_dvec3()))
    }
}

/// Centre of the bounds of all vertices.
fn centre(instances: &[Instance<'_>]) -> Result<DVec3> {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for instance in instances {
        for position in instance.positions() {
            if !position.is_finite() {
                return Err(Fault::new(
                    format!("nodes[{}]", instance.place.index),
                    "moves its mesh out of the range of numbers",
                    "the file is broken; export it again",
                ));
            }
            low = low.min(position);
            high = high.max(position);
        }
    }
    if instances.is_empty() {
        return Ok(DVec3::ZERO);
    }
    let half = (high - low) * 0.5;
    let size = half.max_element();
    if size > LARGEST {
        return Err(Fault::new(
            "scene",
            format!("is more than {:e} m across", 2.0 * LARGEST),
            "scale it down, or leave out what lies far off",
        ));
    }
    if size > 0.0 && size < SMALLEST {
        return Err(Fault::new(
            "scene",
            format!("is less than {:e} m across", 2.0 * SMALLEST),
            "scale it up",
        ));
    }
    Ok(low + half)
}

/// One mesh of all instances, relative to `origin`.
fn join(instances: &[Instance<'_>], origin: DVec3, limits: &Limits) -> Result<Mesh> {
    let sum = |size: fn(&Primitive) -> usize| -> u64 {
        instances.iter().map(|i| size(i.primitive) as u64).sum()
    };
    let triangles = sum(|p| p.triangles.len());
    let vertices = sum(|p| p.positions.len());
    check_triangles(triangles, limits, "scene")?;
    check_vertices(vertices, limits, "scene")?;
    let mut mesh = Mesh::default();
    mesh.positions.reserve_exact(vertices as usize);
    mesh.normals.reserve_exact(vertices as usize);
    mesh.triangles.reserve_exact(triangles as usize);
    mesh.material.reserve_exact(triangles as usize);
    let textured = instances.iter().any(|i| !i.primitive.texcoords.is_empty());
    if textured {
        mesh.texcoords.reserve_exact(vertices as usize);
    }
    for instance in instances {
        append(&mut mesh, instance, origin, textured);
    }
    Ok(mesh)
}

fn append(mesh: &mut Mesh, instance: &Instance<'_>, origin: DVec3, textured: bool) {
    let primitive = instance.primitive;
    let first = mesh.positions.len();
    let local = instance.positions().map(|p| (p - origin).as_vec3());
    mesh.positions.extend(local);
    let (turn, mirrored) = normal_matrix(&instance.place.world);
    let normal = |n: &Vec3| {
        let turned = (turn * n.as_dvec3()).try_normalize();
        turned.map_or(Vec3::ZERO, |n| n.as_vec3().normalize_or_zero())
    };
    mesh.normals.extend(primitive.normals.iter().map(normal));
    if textured {
        mesh.texcoords.extend(&primitive.texcoords);
        mesh.texcoords.resize(mesh.positions.len(), Vec2::ZERO);
    }
    for &[a, b, c] in &primitive.triangles {
        let turned = if mirrored { [a, c, b] } else { [a, b, c] };
        let triangle = turned.map(|v| v + first as u32);
        // A scale of zero, or rounding far from the origin, may have left a line.
        if cross(triangle.map(|v| mesh.positions[v as usize])) != DVec3::ZERO {
            mesh.triangles.push(triangle);
            mesh.material.push(primitive.material);
        }
    }
    fill_normals(mesh, first);
}

/// What turns normals when `world` moves points, and whether it mirrors.
///
/// The matrix of cofactors is the inverse transpose times the determinant, and exists where the inverse does not.
fn normal_matrix(world: &DMat4) -> (DMat3, bool) {
    let (x, y, z) = (
        world.x_axis.truncate(),
        world.y_axis.truncate(),
        world.z_axis.truncate(),
    );
    let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    let mirrored = x.dot(y.cross(z)) < 0.0;
    (if mirrored { -cofactors } else { cofactors }, mirrored)
}

/// Gives vertices from `first` on that have no normal the mean of their triangles', weighted by area.
///
/// Vertices of a primitive without normals are not shared: theirs is the triangle's own.
fn fill_normals(mesh: &mut Mesh, first: usize) {
    if !mesh.normals[first..].contains(&Vec3::ZERO) {
        return;
    }
    let mut sums = vec![DVec3::ZERO; mesh.normals.len() - first];
    for triangle in mesh.triangles.iter().rev() {
        if (triangle[0] as usize) < first {
            break;
        }
        let face = cross(triangle.map(|v| mesh.positions[v as usize]));
        for v in triangle {
            sums[*v as usize - first] += face;
        }
    }
    for (normal, sum) in mesh.normals[first..].iter_mut().zip(sums) {
        if *normal == Vec3::ZERO {
            let mean = sum.try_normalize().map(|n| n.as_vec3().normalize_or_zero());
            *normal = mean.filter(|n| *n != Vec3::ZERO).unwrap_or(Vec3::Y);
        }
    }
}
