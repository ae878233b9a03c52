//! All triangles of the scene in one space.

use super::buffers::Buffers;
use super::document::{Document, lookup};
use super::draco::Budget;
use super::fault::{Fault, Result};
use super::frames::{Frame, Frames, Turn};
use super::instancing::Copies;
use super::limits::Limits;
use super::materials::Materials;
use super::nodes::{LARGEST, Placed, Tree};
use super::primitive::{Form, Primitive, Reader, check_triangles, check_vertices, cross};
use super::skins::{Influences, Skins};
use super::warnings::Warnings;
use crate::scene::{Material, Mesh};
use glam::{DMat4, DVec3, Vec2, Vec3, Vec4};
use std::collections::HashMap;

/// What the meshes of the file come to.
pub(super) struct Geometry {
    pub(super) mesh: Mesh,
    /// Centre of the bounds in the world.
    pub(super) origin: DVec3,
    /// Half the diagonal of the bounds \[m\].
    pub(super) radius: f64,
    /// Materials that triangles use.
    pub(super) materials: Vec<Material>,
    /// Images that these materials use, as indices of the file, in the order of the scene's textures.
    pub(super) images: Vec<usize>,
    /// Triangles that were read, each mesh in each of its forms once.
    pub(super) unique_triangles: u64,
}

/// Smallest half extent that is accepted \[m\], for the same reason as [`LARGEST`].
const SMALLEST: f64 = 1e-9;

/// Reads every mesh that a node shows, once for each form that it has, and places its instances.
pub(super) fn geometry(
    document: &Document,
    buffers: &Buffers<'_>,
    tree: &Tree<'_>,
    limits: &Limits,
    warnings: &mut Warnings,
) -> Result<Geometry> {
    let mut forms = Forms {
        reader: Reader {
            document,
            buffers,
            materials: Materials::new(document),
            limits,
            triangles: 0,
            vertices: 0,
            displacements: 0,
            packed: Budget::new(limits),
        },
        places: HashMap::new(),
        read: Vec::new(),
    };
    let mut skins = Skins::new(document, buffers, limits, &tree.worlds);
    let mut shown = Vec::new();
    for place in &tree.placed {
        let Some(mesh) = place.node.mesh else {
            continue;
        };
        let at = || format!("nodes[{}].mesh", place.index);
        lookup(&document.root.meshes, "meshes", mesh.value(), at)?;
        let at = || format!("nodes[{}].skin", place.index);
        let joints = match place.node.skin {
            Some(skin) => skins.matrices(skin.value(), at, warnings)?,
            None => None,
        };
        let copies = Copies::of(document, buffers, place.node, place.index)?;
        let form = forms.read(mesh.value(), place.weights, joints.is_some(), warnings)?;
        shown.push((form, place, joints, copies));
    }
    let mut instances = Vec::new();
    for (form, place, joints, copies) in &shown {
        for primitive in &forms.read[*form] {
            let frames = match (joints, &primitive.influences, copies) {
                (Some(joints), Some(influences), _) => {
                    check_joints(influences, joints, place)?;
                    Frames::Bent(joints, influences)
                }
                (.., Some(copies)) => Frames::Many(&place.world, copies),
                (.., None) => Frames::One(&place.world),
            };
            instances.push(Instance {
                primitive,
                node: place.index,
                frames,
            });
        }
    }
    let size = Size::of(&instances);
    check_triangles(size.triangles, limits, "scene")?;
    check_vertices(size.vertices, limits, "scene")?;
    let (origin, radius) = bounds(&instances)?;
    let sizes = forms
        .read
        .iter()
        .flatten()
        .map(|p| p.triangles.len() as u64);
    let unique_triangles = sizes.sum();
    let (materials, images) = forms.reader.materials.finish();
    Ok(Geometry {
        mesh: join(&instances, origin, &size),
        origin,
        radius,
        materials,
        images,
        unique_triangles,
    })
}

/// Meshes in the forms in which they are shown.
struct Forms<'a> {
    reader: Reader<'a>,
    /// Mesh, bits of the weights of its morph targets, whether joints bend it: to its place in `read`.
    places: HashMap<(usize, Vec<u32>, bool), usize>,
    read: Vec<Vec<Primitive>>,
}

impl Forms<'_> {
    /// The place of mesh `index`, which exists, with these weights of its morph targets, else its own.
    fn read(
        &mut self,
        index: usize,
        weights: Option<&[f32]>,
        bent: bool,
        warnings: &mut Warnings,
    ) -> Result<usize> {
        let mesh = &self.reader.document.root.meshes[index];
        let weights = weights.or(mesh.weights.as_deref()).unwrap_or_default();
        let bits = weights.iter().map(|w| w.to_bits()).collect();
        let key = (index, bits, bent);
        if let Some(&known) = self.places.get(&key) {
            return Ok(known);
        }
        let form = Form { weights, bent };
        let mut primitives = Vec::new();
        for (i, primitive) in mesh.primitives.iter().enumerate() {
            let place = format!("meshes[{index}].primitives[{i}]");
            primitives.extend(self.reader.read(primitive, form, &place, warnings)?);
        }
        self.read.push(primitives);
        self.places.insert(key, self.read.len() - 1);
        Ok(self.read.len() - 1)
    }
}

fn check_joints(influences: &Influences, joints: &[DMat4], place: &Placed<'_>) -> Result<()> {
    let Some(joint) = influences.beyond(joints.len()) else {
        return Ok(());
    };
    Err(Fault::new(
        format!("nodes[{}].skin", place.index),
        format!(
            "has {} joints, but a vertex of the mesh follows number {joint}",
            joints.len()
        ),
        "the file is broken; export it again",
    ))
}

/// A primitive where a node puts it, once or more often.
struct Instance<'a> {
    primitive: &'a Primitive,
    /// Index of the node.
    node: usize,
    frames: Frames<'a>,
}

/// Centre and radius of the bounds of all vertices.
fn bounds(instances: &[Instance<'_>]) -> Result<(DVec3, f64)> {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let frames = instances.iter().flat_map(|instance| {
        let frames = (0..instance.frames.len()).map(|i| instance.frames.frame(i));
        frames.map(move |frame| (instance, frame))
    });
    for (instance, frame) in frames {
        for position in frame.positions(instance.primitive) {
            if !position.is_finite() {
                return Err(Fault::new(
                    format!("nodes[{}]", instance.node),
                    "moves its mesh out of the range of numbers",
                    "the file is broken; export it again",
                ));
            }
            low = low.min(position);
            high = high.max(position);
        }
    }
    if low.x > high.x {
        return Ok((DVec3::ZERO, 0.0));
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
    Ok((low + half, half.length()))
}

/// What the joined mesh will hold.
struct Size {
    triangles: u64,
    vertices: u64,
    /// Whether there is a first and a second set of texture coordinates.
    textured: [bool; 2],
    tangents: bool,
    colored: bool,
}

impl Size {
    fn of(instances: &[Instance<'_>]) -> Self {
        let any = |has: fn(&Primitive) -> bool| instances.iter().any(|i| has(i.primitive));
        let sum = |size: fn(&Primitive) -> usize| {
            let sizes = instances.iter().map(|i| {
                let copies = i.frames.len() as u64;
                copies.saturating_mul(size(i.primitive) as u64)
            });
            sizes.fold(0, u64::saturating_add)
        };
        Self {
            triangles: sum(|p| p.triangles.len()),
            vertices: sum(|p| p.positions.len()),
            textured: [
                any(|p| !p.texcoords[0].is_empty()),
                any(|p| !p.texcoords[1].is_empty()),
            ],
            tangents: any(|p| !p.tangents.is_empty()),
            colored: any(|p| !p.colors.is_empty()),
        }
    }
}

/// One mesh of all instances, relative to `origin`.
fn join(instances: &[Instance<'_>], origin: DVec3, size: &Size) -> Mesh {
    let (triangles, vertices) = (size.triangles as usize, size.vertices as usize);
    let mut mesh = Mesh::default();
    mesh.positions.reserve_exact(vertices);
    mesh.normals.reserve_exact(vertices);
    mesh.triangles.reserve_exact(triangles);
    mesh.material.reserve_exact(triangles);
    if size.textured[0] {
        mesh.texcoords.reserve_exact(vertices);
    }
    if size.textured[1] {
        mesh.texcoords_second.reserve_exact(vertices);
    }
    if size.tangents {
        mesh.tangents.reserve_exact(vertices);
    }
    if size.colored {
        mesh.colors.reserve_exact(vertices);
    }
    for instance in instances {
        for i in 0..instance.frames.len() {
            let frame = instance.frames.frame(i);
            append(&mut mesh, instance.primitive, &frame, origin, size);
        }
    }
    mesh
}

fn append(mesh: &mut Mesh, primitive: &Primitive, frame: &Frame<'_>, origin: DVec3, size: &Size) {
    let first = mesh.positions.len();
    let positions = frame.positions(primitive);
    let local = positions.map(|p| (p - origin).as_vec3());
    mesh.positions.extend(local);
    let count = mesh.positions.len();
    let turn = Turn::of(frame);
    let normals = primitive.normals.iter().enumerate();
    mesh.normals
        .extend(normals.map(|(v, n)| turn.at(v).normal(*n)));
    let sets = [&mut mesh.texcoords, &mut mesh.texcoords_second];
    for (i, all) in sets.into_iter().enumerate() {
        if size.textured[i] {
            all.extend(&primitive.texcoords[i]);
            all.resize(count, Vec2::ZERO);
        }
    }
    if size.tangents {
        let tangents = primitive.tangents.iter().enumerate();
        mesh.tangents
            .extend(tangents.map(|(v, t)| turn.at(v).tangent(*t)));
        mesh.tangents.resize(count, Vec4::ZERO);
    }
    if size.colored {
        mesh.colors.extend(&primitive.colors);
        mesh.colors.resize(count, Vec4::ONE);
    }
    for &[a, b, c] in &primitive.triangles {
        let mirrored = turn.at(a as usize).mirrored;
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
