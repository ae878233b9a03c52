//! `vsgl render --dump`: pictures of what lies between scene and picture.

use crate::exit::Result;
use std::path::Path;
use vsgl_core::backend::Backend;
use vsgl_core::render::Frame;

pub(super) struct Dump;

pub(super) fn prepare(_folder: &Path) -> Result<Dump> {
    Ok(Dump)
}

impl Dump {
    pub(super) fn write<B: Backend>(self, _backend: &B, _frame: &Frame<B>) -> Result<Vec<String>> {
        Ok(Vec::new())
    }
}
