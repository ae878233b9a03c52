//! Triangles of one primitive, in the space of its mesh.

use super::accessor::Indices;
use super::attributes::Attributes;
use super::buffers::Buffers;
use super::document::Document;
use super::draco::{Budget, Unpacked};
use super::fault::{Fault, Result};
use super::limits::Limits;
use super::materials::Materials;
use super::morph::{Morph, Shape};
use super::sharing::{compact, unshared};
use super::skins::Influences;
use super::tangents::{self, Surface};
use super::topology::Topology;
use super::warnings::Warnings;
use glam::{DVec3, Vec2, Vec3, Vec4};
use gltf::json::mesh::{self, Mode, MorphTarget, Semantic};
use gltf::json::validation::Checked;

/// Indexed triangles with only those vertices that they use.
pub(super) struct Primitive {
    pub(super) positions: Vec<Vec3>,
    /// One a vertex, of any length; zero where the file has none that can be used.
    pub(super) normals: Vec<Vec3>,
    /// The first and the second set, one a vertex each; empty if the material does not read it.
    pub(super) texcoords: [Vec<Vec2>; 2],
    /// One a vertex, w the sign of the bitangent; zero where there is none. Empty if the material reads none.
    pub(super) tangents: Vec<Vec4>,
    /// One a vertex; empty if the file has none.
    pub(super) colors: Vec<Vec4>,
    /// Joints of the vertices, if it is to be bent.
    pub(super) influences: Option<Influences>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Index into the scene's materials.
    pub(super) material: u32,
}

impl Primitive {
    /// Makes tangents along a set of texture coordinates. Returns the vertices that were doubled, because their triangles
    /// have different ones; the doubles stand at the end.
    fn make_tangents(&mut self, set: usize) -> Vec<u32> {
        let surface = Surface {
            positions: &self.positions,
            normals: &self.normals,
            texcoords: &self.texcoords[set],
            triangles: &self.triangles,
        };
        let corners = tangents::tangents(&surface);
        let vertices = self.positions.len();
        let (tangents, doubled) = tangents::split(vertices, &mut self.triangles, &corners);
        self.tangents = tangents;
        double(&mut self.positions, &doubled);
        double(&mut self.normals, &doubled);
        for set in &mut self.texcoords {
            if !set.is_empty() {
                double(set, &doubled);
            }
        }
        doubled
    }
}

/// Appends copies of the elements at `places`.
fn double<T: Copy>(list: &mut Vec<T>, places: &[u32]) {
    list.reserve(places.len());
    for &place in places {
        list.push(list[place as usize]);
    }
}

/// What reading a primitive needs besides itself.
pub(super) struct Reader<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: &'a Buffers<'a>,
    pub(super) materials: Materials<'a>,
    pub(super) limits: &'a Limits,
    /// Triangles, vertices and displacements by morph targets that were read so far, each mesh once.
    pub(super) triangles: u64,
    pub(super) vertices: u64,
    pub(super) displacements: u64,
    /// What may yet be unpacked.
    pub(super) packed: Budget,
}

/// In which form a mesh is shown.
#[derive(Clone, Copy, Debug)]
pub(super) struct Form<'a> {
    /// Weights of the morph targets.
    pub(super) weights: &'a [f32],
    /// Whether joints bend it.
    pub(super) bent: bool,
}

impl<'a> Reader<'a> {
    /// Reads a primitive; none if it draws nothing. `place` is its JSON path.
    pub(super) fn read(
        &mut self,
        primitive: &mesh::Primitive,
        form: Form<'_>,
        place: &str,
        warnings: &mut Warnings,
    ) -> Result<Option<Primitive>> {
        let Some(topology) = topology(primitive, place, warnings)? else {
            return Ok(None);
        };
        let packed = Unpacked::new(self.buffers, primitive, &mut self.packed, place)?;
        let attributes = Attributes {
            document: self.document,
            buffers: self.buffers,
            primitive,
            place,
            packed: packed.as_ref(),
        };
        let Some(positions) = attributes.get::<3>(Semantic::Positions)? else {
            warnings.add("primitives without positions are left out");
            return Ok(None);
        };
        let morph = Morph::new(attributes, form.weights);
        let (limits, used) = (self.limits, &mut self.displacements);
        let of = |target: &MorphTarget| target.positions;
        let positions = morph.apply(positions, &Semantic::Positions, of, limits, used)?;
        let vertices = positions.len();
        let triangles = self.triangles(&attributes, topology, &positions, form.bent)?;
        if triangles.is_empty() {
            return Ok(None);
        }
        let normals = attributes.full::<3>(Semantic::Normals, vertices)?;
        let most = match &normals {
            Some(normals) => normals.len().min(3 * triangles.len()),
            None => 3 * triangles.len(),
        };
        self.vertices += most as u64;
        check_vertices(self.vertices, self.limits, place)?;
        let used = &mut self.displacements;
        let of = |target: &MorphTarget| target.normals;
        let normals = normals
            .map(|normals| morph.apply(normals, &Semantic::Normals, of, limits, used))
            .transpose()?;
        let (triangles, mut sources) = match &normals {
            Some(_) => compact(triangles, vertices),
            None => unshared(triangles),
        };
        let at = |&source: &u32| Vec3::from(positions.get(source));
        let normal = |&source: &u32| match &normals {
            Some(normals) => usable(Vec3::from(normals.get(source))),
            None => Vec3::ZERO,
        };
        let (material, needs) = self.materials.intern(primitive.material, place, warnings)?;
        let mut read = Primitive {
            positions: sources.iter().map(at).collect(),
            normals: sources.iter().map(normal).collect(),
            texcoords: [Vec::new(), Vec::new()],
            tangents: Vec::new(),
            colors: Vec::new(),
            influences: None,
            triangles,
            material,
        };
        for (set, number) in read.texcoords.iter_mut().zip(needs.sets) {
            if let Some(number) = number {
                *set = texcoords(&attributes, number, &sources, warnings)?;
            }
        }
        if let Some(set) = needs.tangents {
            // Without normals those of the file mean nothing.
            let given = match normals {
                Some(_) => attributes.full::<4>(Semantic::Tangents, vertices)?,
                None => None,
            };
            let used = &mut self.displacements;
            let of = |target: &MorphTarget| target.tangents;
            let given = given
                .map(|given| morph.apply(given, &Semantic::Tangents, of, limits, used))
                .transpose()?;
            match given {
                Some(given) => {
                    let tangent = |&source: &u32| usable_tangent(given.get(source));
                    read.tangents = sources.iter().map(tangent).collect();
                }
                None => {
                    let doubled = read.make_tangents(set as usize);
                    self.vertices += doubled.len() as u64;
                    check_vertices(self.vertices, self.limits, place)?;
                    double(&mut sources, &doubled);
                }
            }
        }
        if let Some(colors) = attributes.colors(vertices)? {
            read.colors = sources.iter().map(|&s| colors.get(s)).collect();
        }
        if form.bent {
            read.influences = Influences::read(&attributes, vertices, &sources)?;
        }
        Ok(Some(read))
    }

    /// Triangles that have an area, as indices of the file's vertices; all of them if they will yet be bent.
    fn triangles(
        &mut self,
        attributes: &Attributes<'a, '_>,
        topology: Topology,
        positions: &Shape<'_, 3>,
        bent: bool,
    ) -> Result<Vec<[u32; 3]>> {
        let vertices = positions.len();
        // Packed triangles are a list, whatever they were before.
        let topology = attributes.packed.map_or(topology, |_| Topology::List);
        let place_of_positions = attributes.path(&Semantic::Positions);
        let place = format!("{}.indices", attributes.place);
        let indices = match (attributes.packed, attributes.primitive.indices) {
            (Some(packed), _) => Some(Indices::Unpacked(packed.indices())),
            (None, Some(index)) => {
                let at = || place.clone();
                Some(Indices::new(self.document, self.buffers, index, at)?)
            }
            (None, None) => None,
        };
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
            if bent || cross(corners) != DVec3::ZERO {
                triangles.push(triangle);
            }
        }
        Ok(triangles)
    }
}

fn texcoords(
    attributes: &Attributes<'_, '_>,
    number: u32,
    sources: &[u32],
    warnings: &mut Warnings,
) -> Result<Vec<Vec2>> {
    let semantic = Semantic::TexCoords(number);
    let needed = sources.iter().max().map_or(0, |&last| last as usize + 1);
    let Some(texcoords) = attributes.full::<2>(semantic, needed)? else {
        warnings.add("textured surfaces without texture coordinates show one texel");
        return Ok(vec![Vec2::ZERO; sources.len()]);
    };
    let at = |&source| {
        let texcoord = Vec2::from(texcoords.get(source));
        if texcoord.is_finite() {
            texcoord
        } else {
            Vec2::ZERO
        }
    };
    Ok(sources.iter().map(at).collect())
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

fn position(positions: &Shape<'_, 3>, source: u32, place: &str) -> Result<Vec3> {
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

/// A tangent of length 1 with a sign, or zero if it points nowhere.
fn usable_tangent([x, y, z, w]: [f32; 4]) -> Vec4 {
    let unit = DVec3::new(x.into(), y.into(), z.into()).try_normalize();
    unit.map_or(Vec4::ZERO, |t| t.as_vec3().extend(1f32.copysign(w)))
}

/// Twice the area of a triangle along its normal. Zero for a line or a point: the corners are f32, this is f64.
pub(super) fn cross(corners: [Vec3; 3]) -> DVec3 {
    let [a, b, c] = corners.map(|p| p.as_dvec3());
    (b - a).cross(c - a)
}
