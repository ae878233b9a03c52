//! What a picture costs and how far it is from the truth: for `vsgl sweep`, and for settings that are chosen by time or error.

mod errors;
mod front;
mod reference;
mod times;

pub(crate) use errors::Layers;
pub(crate) use front::front;
pub(crate) use reference::{Reference, Wanted, half};
pub(crate) use times::{Effort, Measured, Shot, measure};
