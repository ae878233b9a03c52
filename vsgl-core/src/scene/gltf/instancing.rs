//! Copies of a mesh by `EXT_mesh_gpu_instancing`.

use super::accessor::Vectors;
use super::buffers::Buffers;
use super::document::Document;
use super::fault::{Fault, Result};
use glam::{DMat4, DQuat, DVec3, Quat, Vec3};
use gltf::json::{Accessor, Index, Node};

/// Name of the extension.
pub(super) const NAME: &str = "EXT_mesh_gpu_instancing";

/// Where the copies of a mesh are, relative to its node.
///
/// Source: Khronos Group, `EXT_mesh_gpu_instancing`. Attributes other than these three ask nothing of a reader.
pub(super) struct Copies<'a> {
    count: usize,
    translation: Option<Vectors<'a, 3>>,
    rotation: Option<Vectors<'a, 4>>,
    scale: Option<Vectors<'a, 3>>,
}

impl<'a> Copies<'a> {
    /// The copies that node `index` asks for; none if it has not the extension.
    pub(super) fn of(
        document: &'a Document,
        buffers: &'a Buffers<'_>,
        node: &Node,
        index: usize,
    ) -> Result<Option<Self>> {
        let extension = node.extensions.as_ref().and_then(|e| e.others.get(NAME));
        let Some(extension) = extension else {
            return Ok(None);
        };
        let place = format!("nodes[{index}].extensions.{NAME}.attributes");
        let attribute = |name: &str| -> Result<Option<(Index<Accessor>, String)>> {
            let value = &extension["attributes"][name];
            if value.is_null() {
                return Ok(None);
            }
            let path = format!("{place}.{name}");
            let number = value.as_u64().and_then(|n| u32::try_from(n).ok());
            match number {
                Some(number) => Ok(Some((Index::new(number), path))),
                None => Err(Fault::new(
                    path,
                    "is no index of an accessor",
                    "the file is broken; export it again",
                )),
            }
        };
        fn read<'a, const N: usize>(
            document: &'a Document,
            buffers: &'a Buffers<'_>,
            found: Option<(Index<Accessor>, String)>,
        ) -> Result<Option<Vectors<'a, N>>> {
            let new = |(index, path)| Vectors::new(document, buffers, index, || path);
            found.map(new).transpose()
        }
        let translation = read(document, buffers, attribute("TRANSLATION")?)?;
        let rotation = read(document, buffers, attribute("ROTATION")?)?;
        let scale = read(document, buffers, attribute("SCALE")?)?;
        let counts = [
            translation.as_ref().map(Vectors::len),
            rotation.as_ref().map(Vectors::len),
            scale.as_ref().map(Vectors::len),
        ];
        let mut counts = counts.into_iter().flatten();
        // Without these attributes there is nothing that says how many: one, where the node is.
        let count = counts.next().unwrap_or(1);
        if let Some(other) = counts.find(|&other| other != count) {
            return Err(Fault::new(
                place,
                format!("some have {count} elements, others {other}"),
                "the file is broken; export it again",
            ));
        }
        Ok(Some(Self {
            count,
            translation,
            rotation,
            scale,
        }))
    }

    /// Number of copies.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// From the mesh to its node for copy `index`, which must be below [`Copies::len`] and below 2^32.
    pub(super) fn local(&self, index: usize) -> DMat4 {
        let index = index as u32;
        let vector = |v: &Option<Vectors<'_, 3>>, default: DVec3| {
            v.as_ref()
                .map_or(default, |v| Vec3::from(v.get(index)).as_dvec3())
        };
        let rotation = self
            .rotation
            .as_ref()
            .map(|r| Quat::from_array(r.get(index)));
        let unit = rotation
            .map(|r| r.as_dquat().normalize())
            .filter(|r| r.is_finite());
        DMat4::from_scale_rotation_translation(
            vector(&self.scale, DVec3::ONE),
            unit.unwrap_or(DQuat::IDENTITY),
            vector(&self.translation, DVec3::ZERO),
        )
    }
}
