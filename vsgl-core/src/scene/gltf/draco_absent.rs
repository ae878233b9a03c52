//! Stands in for `draco` where that feature is not built: nothing is packed.

use super::buffers::Buffers;
use super::fault::Result;
use super::limits::Limits;
use gltf::json::mesh::{Primitive, Semantic};

/// Nothing to count.
#[derive(Debug)]
pub(super) struct Budget;

impl Budget {
    pub(super) fn new(_: &Limits) -> Self {
        Self
    }
}

/// There is none.
pub(super) enum Unpacked {}

impl Unpacked {
    pub(super) fn new(
        _: &Buffers<'_>,
        _: &Primitive,
        _: &mut Budget,
        _: &str,
    ) -> Result<Option<Self>> {
        Ok(None)
    }

    pub(super) fn indices(&self) -> Vec<u32> {
        match *self {}
    }

    pub(super) fn numbers(&self, _: &Semantic, _: usize) -> Option<Vec<f32>> {
        match *self {}
    }
}
