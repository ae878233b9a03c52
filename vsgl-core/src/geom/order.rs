//! The lesser and the greater of two numbers, in one instruction each: `f32::min` takes four, to pass over NaN.

/// The lesser of two numbers; the second if one of them is NaN.
#[inline(always)]
pub(super) fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The greater of two numbers; the second if one of them is NaN.
#[inline(always)]
pub(super) fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
