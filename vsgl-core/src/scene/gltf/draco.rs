//! Triangles packed by `KHR_draco_mesh_compression`.

use super::buffers::Buffers;
use super::fault::{Fault, Result, printable};
use super::limits::Limits;
use draco_core::{DecodeLimits, DecoderBuffer, ErrorKind, Mesh, MeshDecoder};
use gltf::json::mesh::{Primitive, Semantic};
use gltf::json::{Index, Value};
use std::collections::HashMap;

/// Name of the extension.
pub(super) const NAME: &str = "KHR_draco_mesh_compression";

/// Bytes of an unpacked vertex at most, for all attributes that glTF has.
const VERTEX_BYTES: u64 = 256;
/// Bytes of an unpacked primitive at most: with more, the copies that are made of it would take a gigabyte.
const MOST_BYTES: u64 = 256 << 20;

/// What was unpacked so far, and may be at most: a file may name the same packed triangles again and again.
#[derive(Debug)]
pub(super) struct Budget {
    /// Packed bytes that may yet be read.
    bytes: u64,
    points: u64,
    faces: u64,
}

impl Budget {
    pub(super) fn new(limits: &Limits) -> Self {
        Self {
            bytes: limits.file_bytes,
            points: limits.vertices,
            faces: limits.triangles,
        }
    }
}

/// An unpacked primitive.
pub(super) struct Unpacked {
    mesh: Mesh,
    /// Number in the packed data of each attribute, by its name.
    ids: HashMap<String, u32>,
}

impl Unpacked {
    /// Unpacks a primitive; none if it is not packed. `place` is its JSON path.
    pub(super) fn new(
        buffers: &Buffers<'_>,
        primitive: &Primitive,
        budget: &mut Budget,
        place: &str,
    ) -> Result<Option<Self>> {
        let extensions = primitive.extensions.as_ref();
        let Some(extension) = extensions.and_then(|e| e.others.get(NAME)) else {
            return Ok(None);
        };
        let place = format!("{place}.extensions.{NAME}");
        let broken = |what: &str| {
            let place = format!("{place}.{what}");
            Fault::new(place, "is not what the extension says", BROKEN)
        };
        let number = |value: &Value| u32::try_from(value.as_u64()?).ok();
        let view = number(&extension["bufferView"]).ok_or_else(|| broken("bufferView"))?;
        let attributes = extension["attributes"].as_object();
        let id = |(name, id): (&String, &Value)| Some((name.clone(), number(id)?));
        let ids = attributes.and_then(|a| a.iter().map(id).collect());
        let ids = ids.ok_or_else(|| broken("attributes"))?;
        let at = || format!("{place}.bufferView");
        let (bytes, _) = buffers.view(Index::new(view), at)?;
        let mesh = decode(bytes, budget);
        let mesh = mesh.map_err(|(problem, remedy)| Fault::new(place, problem, remedy))?;
        Ok(Some(Self { mesh, ids }))
    }

    /// Vertices of the triangles.
    pub(super) fn indices(&self) -> Vec<u32> {
        let faces = self.mesh.faces().iter();
        faces.flat_map(|face| face.map(|vertex| vertex.0)).collect()
    }

    /// The numbers of an attribute, `components` a vertex; none if it is not packed.
    pub(super) fn numbers(&self, semantic: &Semantic, components: usize) -> Option<Vec<f32>> {
        let id = *self.ids.get(&semantic.to_string())?;
        let attribute = self.mesh.attribute_by_unique_id(id)?;
        Some(attribute.read_f32s(self.mesh.num_points(), components))
    }
}

const BROKEN: &str = "the file is broken; export it again";

/// Unpacks within the budget; otherwise the problem and its remedy.
fn decode(bytes: &[u8], budget: &mut Budget) -> std::result::Result<Mesh, (String, &'static str)> {
    const TOO_MUCH: &str =
        "simplify it, or raise the limits `triangles`, `vertices` and `file_bytes`";
    let Some(left) = budget.bytes.checked_sub(bytes.len() as u64) else {
        return Err(("too many packed bytes in the file".into(), TOO_MUCH));
    };
    budget.bytes = left;
    let limits = DecodeLimits::default()
        .with_max_points(budget.points)
        .with_max_faces(budget.faces)
        .with_max_decoded_bytes(budget.points.saturating_mul(VERTEX_BYTES).min(MOST_BYTES));
    let mut buffer = DecoderBuffer::new(bytes).with_limits(limits);
    let mut mesh = Mesh::new();
    if let Err(error) = MeshDecoder::new().decode(&mut buffer, &mut mesh) {
        let problem = format!("cannot be unpacked: {}", printable(&error.to_string()));
        let broken = error.kind() != ErrorKind::LimitExceeded;
        return Err((problem, if broken { BROKEN } else { TOO_MUCH }));
    }
    let points = budget.points.checked_sub(mesh.num_points() as u64);
    let faces = budget.faces.checked_sub(mesh.num_faces() as u64);
    let (Some(points), Some(faces)) = (points, faces) else {
        return Err(("too many packed triangles in the file".into(), TOO_MUCH));
    };
    (budget.points, budget.faces) = (points, faces);
    Ok(mesh)
}
