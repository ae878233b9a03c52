//! One file a phase: what its kernels bind, and in which order they run. Everything is recorded into the caller's encoder.

pub(crate) mod cluster;
pub(crate) mod gbuffer;
pub(crate) mod pdf;
pub(crate) mod resolve;
pub(crate) mod rsm;
pub(crate) mod shade;

/// A `bool` as an `override` constant.
fn flag(value: bool) -> f64 {
    f64::from(u8::from(value))
}
