//! Triangles of one primitive, in the space of its mesh.

use super::accessor::{Indices, Vectors};
use super::buffers::Buffers;
use super::document::Document;
use super::fault::{Fault, Result};
use super::limits::Limits;
use super::materials::{Mapping, Materials};
use super::sharing::{compact, unshared};
use super::topology::Topology;
use super::warnings::Warnings;
use glam::{DVec3, Vec2, Vec3};
use gltf::json::mesh::{self, Mode, Semantic};
use gltf::json::validation::Checked;
use gltf::json::{Accessor, Index};

/// Indexed triangles with only those vertices that they use.
pub(super) struct Primitive {
    pub(super) positions: Vec<Vec3>,
    /// One a vertex, of any length; zero where the file has none that can be used.
    pub(super) normals: Vec<Vec3>,
    /// One a vertex; empty if the material needs none.
    pub(super) texcoords: Vec<Vec2>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Index into the scene's materials.
    pub(super) material: u32,
}

/// What reading a primitive needs besides itself.
pub(super) struct Reader<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: &'a Buffers<'a>,
    pub(super) materials: Materials<'a>,
    pub(super) limits: &'a Limits,
    /// Triangles and vertices that were read so far, each mesh once.
    pub(super) triangles: u64,
    pub(super) vertices: u64,
}

impl<'a> Reader<'a> {
    /// Reads a primitive; none if it draws nothing. `place` is its JSON path.
    pub(super) fn read(
        &mut self,
        primitive: &mesh::Primitive,
        place: &str,
        warnings: &mut Warnings,
    ) -> Result<Option<Primitive>> {
        let Some(topology) = topology(primitive, place, warnings)? else {
            return Ok(None);
        };
        let Some(positions) = self.vectors::<3>(primitive, Semantic::Positions, place)? else {
            warnings.add("primitives without positions are left out");
            return Ok(None);
        };
        note_ignored(primitive, warnings);
        let vertices = positions.len();
        let triangles = self.triangles(primitive, topology, &positions, place)?;
        if triangles.is_empty() {
            return Ok(None);
        }
        let normals = self.vectors::<3>(primitive, Semantic::Normals, place)?;
        check_len(normals.as_ref(), vertices, "NORMAL", place)?;
        let most = match &normals {
            Some(normals) => normals.len().min(3 * triangles.len()),
            None => 3 * triangles.len(),
        };
        self.vertices += most as u64;
        check_vertices(self.vertices, self.limits, place)?;
        let (triangles, sources) = match &normals {
            Some(_) => compact(triangles, vertices),
            None => unshared(triangles),
        };
        let at = |&source: &u32| Vec3::from(positions.get(source));
        let positions = sources.iter().map(at).collect();
        let normals = sources.iter().map(|&source| match &normals {
            Some(normals) => usable(Vec3::from(normals.get(source))),
            None => Vec3::ZERO,
        });
        let normals = normals.collect();
        let (material, mapping) = self.materials.intern(primitive.material, place, warnings)?;
        let texcoords = match mapping {
            Some(mapping) => self.texcoords(primitive, &mapping, &sources, place, warnings)?,
            None => Vec::new(),
        };
        Ok(Some(Primitive {
            positions,
            normals,
            texcoords,
            triangles,
            material,
        }))
    }

    /// Triangles that have an area, as indices of the file's vertices.
    fn triangles(
        &mut self,
        primitive: &mesh::Primitive,
        topology: Topology,
        positions: &Vectors<'_, 3>,
        place: &str,
    ) -> Result<Vec<[u32; 3]>> {
        let vertices = positions.len();
        let place_of_positions = format!("{place}.attributes.POSITION");
        let place = format!("{place}.indices");
        let indices = primitive
            .indices
            .map(|index| Indices::new(self.document, self.buffers, index, || place.clone()))
            .transpose()?;
        let corners = indices.as_ref().map_or(vertices, Indices::len);
        if topology == Topology::List && !corners.is_multiple_of(3) {
            return Err(Fault::new(
                place,
                format!("{corners} corners do not make whole triangles"),
                "the file is broken; export it again",
            ));
        }
        let count = topology.triangles(corners);
        self.triangles = self.triangles.saturating_add(count as u64);
        check_triangles(self.triangles, self.limits, &place)?;
        let vertex = |corner: usize| {
            let index = match &indices {
                Some(indices) => indices.get(corner),
                // Below the limit of triangles, three times over.
                None => corner as u32,
            };
            if (index as usize) < vertices {
                return Ok(index);
            }
            Err(Fault::new(
                &place,
                format!("number {corner} is {index}, but there are {vertices} vertices"),
                "the file is broken; export it again",
            ))
        };
        let mut triangles = Vec::new();
        for i in 0..count {
            let [a, b, c] = topology.triangle(i);
            let triangle = [vertex(a)?, vertex(b)?, vertex(c)?];
            let mut corners = [Vec3::ZERO; 3];
            for (corner, v) in corners.iter_mut().zip(triangle) {
                *corner = position(positions, v, &place_of_positions)?;
            }
            // Tested here, so that a file of nothing but points costs no memory.
            if cross(corners) != DVec3::ZERO {
                triangles.push(triangle);
            }
        }
        Ok(triangles)
    }

    fn texcoords(
        &self,
        primitive: &mesh::Primitive,
        mapping: &Mapping,
        sources: &[u32],
        place: &str,
        warnings: &mut Warnings,
    ) -> Result<Vec<Vec2>> {
        let semantic = Semantic::TexCoords(mapping.set);
        let Some(texcoords) = self.vectors::<2>(primitive, semantic, place)? else {
            warnings.add("textured surfaces without texture coordinates show one texel");
            return Ok(vec![Vec2::ZERO; sources.len()]);
        };
        let needed = sources.iter().max().map_or(0, |&last| last as usize + 1);
        check_len(Some(&texcoords), needed, "TEXCOORD", place)?;
        let at = |&source| {
            let mapped = mapping.apply(Vec2::from(texcoords.get(source)));
            if mapped.is_finite() {
                mapped
            } else {
                Vec2::ZERO
            }
        };
        Ok(sources.iter().map(at).collect())
    }

    fn vectors<const N: usize>(
        &self,
        primitive: &mesh::Primitive,
        semantic: Semantic,
        place: &str,
    ) -> Result<Option<Vectors<'a, N>>> {
        let name = semantic.to_string();
        let index: Option<&Index<Accessor>> = primitive.attributes.get(&Checked::Valid(semantic));
        let place = || format!("{place}.attributes.{name}");
        index
            .map(|&index| Vectors::new(self.document, self.buffers, index, place))
            .transpose()
    }
}

/// Refuses more triangles than the limits allow.
pub(super) fn check_triangles(count: u64, limits: &Limits, place: &str) -> Result<()> {
    if count <= limits.triangles {
        return Ok(());
    }
    Err(Fault::new(
        place,
        format!("more than {} triangles", limits.triangles),
        "simplify the scene, or raise the limit `triangles`",
    ))
}

/// Refuses more vertices than the limits allow.
pub(super) fn check_vertices(count: u64, limits: &Limits, place: &str) -> Result<()> {
    if count <= limits.vertices.min(u32::MAX.into()) {
        return Ok(());
    }
    Err(Fault::new(
        place,
        format!("more than {} vertices", limits.vertices),
        "simplify the scene, or raise the limit `vertices`",
    ))
}

fn topology(
    primitive: &mesh::Primitive,
    place: &str,
    warnings: &mut Warnings,
) -> Result<Option<Topology>> {
    match primitive.mode {
        Checked::Valid(Mode::Triangles) => Ok(Some(Topology::List)),
        Checked::Valid(Mode::TriangleStrip) => Ok(Some(Topology::Strip)),
        Checked::Valid(Mode::TriangleFan) => Ok(Some(Topology::Fan)),
        Checked::Valid(Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) => {
            warnings.add("points and lines are left out");
            Ok(None)
        }
        Checked::Invalid => Err(Fault::new(
            format!("{place}.mode"),
            "is not one of glTF 2.0",
            "the file is broken; export it again",
        )),
    }
}

fn note_ignored(primitive: &mesh::Primitive, warnings: &mut Warnings) {
    if primitive.targets.as_ref().is_some_and(|t| !t.is_empty()) {
        warnings.add("morph targets are ignored");
    }
    let colored = |s: &Checked<Semantic>| matches!(s, Checked::Valid(Semantic::Colors(_)));
    if primitive.attributes.keys().any(colored) {
        warnings.add("vertex colours are ignored");
    }
}

fn check_len<const N: usize>(
    attribute: Option<&Vectors<'_, N>>,
    vertices: usize,
    name: &str,
    place: &str,
) -> Result<()> {
    match attribute {
        Some(attribute) if attribute.len() < vertices => Err(Fault::new(
            format!("{place}.attributes.{name}"),
            format!("{} elements for {vertices} vertices", attribute.len()),
            "the file is broken; export it again",
        )),
        _ => Ok(()),
    }
}

fn position(positions: &Vectors<'_, 3>, source: u32, place: &str) -> Result<Vec3> {
    let position = Vec3::from(positions.get(source));
    if position.is_finite() {
        return Ok(position);
    }
    Err(Fault::new(
        place,
        format!("vertex {source} is at {position}, which is no place"),
        "the file is broken; export it again",
    ))
}

/// The normal, or zero if it points nowhere.
fn usable(normal: Vec3) -> Vec3 {
    if normal.is_finite() {
        normal
    } else {
        Vec3::ZERO
    }
}

/// Twice the area of a triangle along its normal. Zero for a line or a point: the corners are f32, this is f64.
pub(super) fn cross(corners: [Vec3; 3]) -> DVec3 {
    let [a, b, c] = corners.map(|p| p.as_dvec3());
    (b - a).cross(c - a)
}
