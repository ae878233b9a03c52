//! Meshes bent by the joints of a skeleton.

use super::accessor::Vectors;
use super::attributes::{Attributes, check_len};
use super::buffers::Buffers;
use super::document::{Document, lookup};
use super::fault::{Fault, Result};
use super::limits::Limits;
use super::warnings::Warnings;
use glam::{DMat4, Mat4};
use gltf::json::mesh::Semantic;
use std::collections::HashMap;
use std::rc::Rc;

/// Which joints move each vertex, and by how much.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Influences {
    /// Vertex after vertex: joint and weight; the weights of a vertex add up to 1.
    joints: Vec<(u16, f32)>,
    each: usize,
}

impl Influences {
    /// Reads the influences on the vertices `sources`; none if the primitive has none.
    pub(super) fn read(
        attributes: &Attributes<'_, '_>,
        vertices: usize,
        sources: &[u32],
    ) -> Result<Option<Self>> {
        /// Eight joints a vertex, which is what exporters write at most.
        const SETS: u32 = 2;
        let mut sets = Vec::new();
        for set in 0..SETS {
            let joints = attributes.full::<4>(Semantic::Joints(set), vertices)?;
            let weights = attributes.full::<4>(Semantic::Weights(set), vertices)?;
            let (Some(joints), Some(weights)) = (joints, weights) else {
                break;
            };
            sets.push((joints, weights.into_shares()));
        }
        if sets.is_empty() {
            return Ok(None);
        }
        let each = 4 * sets.len();
        let mut joints = Vec::with_capacity(each * sources.len());
        for &source in sources {
            let first = joints.len();
            for (set, weights) in &sets {
                let pairs = set.get(source).into_iter().zip(weights.get(source));
                joints.extend(pairs.map(|(joint, weight)| (joint as u16, weight.max(0.0))));
            }
            normalize(&mut joints[first..]);
        }
        Ok(Some(Self { joints, each }))
    }

    /// Number of the first joint beyond `count` that moves a vertex.
    pub(super) fn beyond(&self, count: usize) -> Option<u16> {
        let moving = self.joints.iter().filter(|(_, weight)| *weight > 0.0);
        moving
            .map(|&(joint, _)| joint)
            .find(|&joint| joint as usize >= count)
    }

    /// What moves a vertex: the weighted sum of its joints' matrices, all of which must be there.
    pub(super) fn blend(&self, vertex: usize, matrices: &[DMat4]) -> DMat4 {
        let joints = &self.joints[vertex * self.each..][..self.each];
        let moving = joints.iter().filter(|(_, weight)| *weight > 0.0);
        moving.fold(DMat4::ZERO, |sum, &(joint, weight)| {
            sum + matrices[joint as usize] * f64::from(weight)
        })
    }
}

/// Makes weights add up to 1; without any the first joint has all.
fn normalize(joints: &mut [(u16, f32)]) {
    let sum: f32 = joints.iter().map(|(_, weight)| weight).sum();
    if sum > 0.0 && sum.is_finite() {
        joints.iter_mut().for_each(|(_, weight)| *weight /= sum);
    } else {
        joints.iter_mut().for_each(|(_, weight)| *weight = 0.0);
        joints[0].1 = 1.0;
    }
}

/// The skins of the file, each looked at when it is first used.
pub(super) struct Skins<'a> {
    document: &'a Document,
    buffers: &'a Buffers<'a>,
    limits: &'a Limits,
    /// Transforms of the scene's nodes.
    worlds: &'a [Option<DMat4>],
    joints: u64,
    known: HashMap<usize, Option<Rc<[DMat4]>>>,
}

impl<'a> Skins<'a> {
    pub(super) fn new(
        document: &'a Document,
        buffers: &'a Buffers<'a>,
        limits: &'a Limits,
        worlds: &'a [Option<DMat4>],
    ) -> Self {
        Self {
            document,
            buffers,
            limits,
            worlds,
            joints: 0,
            known: HashMap::new(),
        }
    }

    /// From the mesh to the world by each joint of skin `index`; none, with a warning, if a joint is not in the scene.
    /// `place` is where the index stands.
    pub(super) fn matrices(
        &mut self,
        index: usize,
        place: impl FnOnce() -> String,
        warnings: &mut Warnings,
    ) -> Result<Option<Rc<[DMat4]>>> {
        if let Some(known) = self.known.get(&index) {
            return Ok(known.clone());
        }
        let matrices = self.read(index, place, warnings)?.map(Rc::from);
        self.known.insert(index, matrices.clone());
        Ok(matrices)
    }

    /// Source: glTF 2.0 specification, 3.7.3.3: what the mesh's own node does is left out.
    fn read(
        &mut self,
        index: usize,
        place: impl FnOnce() -> String,
        warnings: &mut Warnings,
    ) -> Result<Option<Vec<DMat4>>> {
        let skin = lookup(&self.document.root.skins, "skins", index, place)?;
        let here = format!("skins[{index}]");
        self.joints += skin.joints.len() as u64;
        if self.joints > self.limits.joints {
            return Err(Fault::new(
                format!("{here}.joints"),
                format!("more than {} joints", self.limits.joints),
                "bake the pose, or raise the limit `joints`",
            ));
        }
        let path = format!("{here}.inverseBindMatrices");
        let inverse = skin.inverse_bind_matrices.map(|accessor| {
            Vectors::<16>::new(self.document, self.buffers, accessor, || path.clone())
        });
        let inverse = inverse.transpose()?;
        if let Some(inverse) = &inverse {
            check_len(inverse, skin.joints.len(), &path)?;
        }
        let mut matrices = Vec::with_capacity(skin.joints.len());
        for (i, joint) in skin.joints.iter().enumerate() {
            let path = || format!("{here}.joints[{i}]");
            let Some(world) = *lookup(self.worlds, "nodes", joint.value(), path)? else {
                warnings.add(
                    "skins with joints outside the scene are ignored: meshes are shown unbent",
                );
                return Ok(None);
            };
            let bind = |inverse: &Vectors<'_, 16>| {
                Mat4::from_cols_array(&inverse.get(i as u32)).as_dmat4()
            };
            matrices.push(world * inverse.as_ref().map_or(DMat4::IDENTITY, bind));
        }
        Ok(Some(matrices))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn weights_add_up_to_one_whatever_they_were() {
        for (weights, expected) in [
            ([1.0, 3.0, 0.0, 0.0], [0.25, 0.75, 0.0, 0.0]),
            ([0.0; 4], [1.0, 0.0, 0.0, 0.0]),
            ([f32::INFINITY, 1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]),
        ] {
            let mut joints = weights.map(|w| (3, w));
            normalize(&mut joints);
            assert_eq!(joints.map(|(_, w)| w), expected);
        }
    }

    #[test]
    fn a_vertex_moves_with_the_mean_of_its_joints() {
        let influences = Influences {
            joints: vec![(1, 0.25), (0, 0.75), (9, 0.0), (9, 0.0)],
            each: 4,
        };
        assert_eq!(influences.beyond(2), None);
        assert_eq!(influences.beyond(1), Some(1));
        let matrices = [DMat4::IDENTITY, DMat4::from_translation(DVec3::X * 4.0)];
        let moved = influences.blend(0, &matrices).transform_point3(DVec3::Y);
        assert_eq!(moved, DVec3::new(1.0, 1.0, 0.0));
    }
}
