//! Attributes with the morph targets of their primitive applied.

use super::accessor::Vectors;
use super::attributes::{Attributes, check_len};
use super::fault::{Fault, Result};
use super::limits::Limits;
use gltf::json::mesh::{MorphTarget, Semantic};
use gltf::json::{Accessor, Index};

/// An attribute as the file has it, or moved by its morph targets.
pub(super) enum Shape<'a, const N: usize> {
    File(Vectors<'a, N>),
    Morphed(Vec<[f32; N]>),
}

impl<const N: usize> Shape<'_, N> {
    /// Number of elements.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::File(vectors) => vectors.len(),
            Self::Morphed(vectors) => vectors.len(),
        }
    }

    /// Element `index`, which must be below [`Shape::len`].
    pub(super) fn get(&self, index: u32) -> [f32; N] {
        match self {
            Self::File(vectors) => vectors.get(index),
            Self::Morphed(vectors) => vectors[index as usize],
        }
    }
}

/// The morph targets of a primitive that have a weight.
pub(super) struct Morph<'a, 'p> {
    attributes: Attributes<'a, 'p>,
    /// Number of the target, itself, its weight.
    targets: Vec<(usize, &'p MorphTarget, f32)>,
}

impl<'a, 'p> Morph<'a, 'p> {
    /// Pairs targets with weights; those without have none.
    pub(super) fn new(attributes: Attributes<'a, 'p>, weights: &[f32]) -> Self {
        let targets = attributes.primitive.targets.iter().flatten();
        let weighted = targets.zip(weights).enumerate();
        let targets = weighted.map(|(i, (target, &weight))| (i, target, weight));
        Self {
            attributes,
            targets: targets.filter(|&(.., weight)| weight != 0.0).collect(),
        }
    }

    /// `base` plus the weighted displacements that `of` picks from each target; a fourth component stays. `used` counts
    /// the displacements of the whole file.
    pub(super) fn apply<const N: usize>(
        &self,
        base: Vectors<'a, N>,
        semantic: &Semantic,
        of: fn(&MorphTarget) -> Option<Index<Accessor>>,
        limits: &Limits,
        used: &mut u64,
    ) -> Result<Shape<'a, N>> {
        let active = self.targets.iter().filter_map(|&(i, target, weight)| {
            let index = of(target)?;
            Some((i, index, weight))
        });
        let mut moved: Option<Vec<[f32; N]>> = None;
        for (i, index, weight) in active {
            let path = self.path(i, semantic);
            *used = used.saturating_add(base.len() as u64);
            check_used(*used, limits, &path)?;
            let Attributes {
                document, buffers, ..
            } = self.attributes;
            let deltas = Vectors::<3>::new(document, buffers, index, || path.clone())?;
            check_len(&deltas, base.len(), &path)?;
            let count = base.len() as u32;
            let moved = moved.get_or_insert_with(|| (0..count).map(|v| base.get(v)).collect());
            for (vector, v) in moved.iter_mut().zip(0..count) {
                for (component, delta) in vector.iter_mut().zip(deltas.get(v)) {
                    *component += weight * delta;
                }
            }
        }
        Ok(moved.map_or(Shape::File(base), Shape::Morphed))
    }

    fn path(&self, target: usize, semantic: &Semantic) -> String {
        let place = self.attributes.place;
        format!("{place}.targets[{target}].{}", semantic.to_string())
    }
}

/// Refuses more displacements than the limits allow.
fn check_used(count: u64, limits: &Limits, place: &str) -> Result<()> {
    if count <= limits.displacements.min(u32::MAX.into()) {
        return Ok(());
    }
    Err(Fault::new(
        place,
        format!(
            "more than {} displacements of morph targets",
            limits.displacements
        ),
        "bake the shape, or raise the limit `displacements`",
    ))
}
