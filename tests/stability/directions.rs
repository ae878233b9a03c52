//! Arguments at and near the edge.

use proptest::prelude::*;
use vsgl_core::glam::Vec3;
use vsgl_core::sg::SHARPNESS_MAX;

/// Sharpness 0 to `f32::MAX`, with the edges of branches often among them.
pub(crate) fn sharpness() -> impl Strategy<Value = f32> {
    prop_oneof![
        2 => prop::sample::select(vec![
            0.0, 1e-45, 1e-40, f32::MIN_POSITIVE, 1e-30, 1e-6, 0.999_999_94, 1.0, 1.000_000_1, 87.0, 88.0, 1e4, 1e6,
            SHARPNESS_MAX, 1e20, f32::MAX,
        ]),
        6 => (-12.0f32..13.0).prop_map(|x| 10f32.powf(x)),
        1 => any::<u32>().prop_map(|bits| f32::from_bits(bits & 0x7f7f_ffff)),
    ]
}

/// Cosines with the ends, zero and their neighbourhoods often among them.
pub(crate) fn cosine() -> impl Strategy<Value = f32> {
    prop_oneof![
        1 => prop::sample::select(vec![-1.0, -0.999_999_94, -1e-6, -0.0, 0.0, 1e-30, 1e-6, 0.999_999_94, 1.0]),
        2 => -1.0f32..=1.0,
        1 => (-8.0f32..0.0, any::<bool>()).prop_map(|(x, up)| if up { 10f32.powf(x) } else { -10f32.powf(x) }),
    ]
}

/// Roughness 1e-4 to 1.
pub(crate) fn alpha() -> impl Strategy<Value = f32> {
    prop_oneof![
        1 => prop::sample::select(vec![0.0, 1e-4, 1e-3, 0.999_999_94, 1.0]),
        2 => (-4.0f32..0.0).prop_map(|x| 10f32.powf(x)),
    ]
}

/// Unit vectors, also along the axes and within 1e-7 of the horizon.
pub(crate) fn direction() -> impl Strategy<Value = Vec3> {
    (cosine(), 0.0f32..std::f32::consts::TAU).prop_map(|(z, turn)| {
        let ring = ((1.0 - z) * (1.0 + z)).sqrt();
        Vec3::new(ring * turn.cos(), ring * turn.sin(), z)
    })
}

/// A second direction: independent, equal, opposite, or at a small angle.
pub(crate) fn pair() -> impl Strategy<Value = (Vec3, Vec3)> {
    (direction(), direction(), 0usize..5, -7.0f32..0.0).prop_map(|(a, b, kind, small)| {
        let near = vsgl_core::math::vec::normalize(a + b * 10f32.powf(small));
        (a, [b, a, -a, near, -near][kind])
    })
}
