//! Numbers that shaders share with this crate: named constants and the coefficients of fits.
//!
//! A shader's text is generated from these lists, so no number is written twice. Not for users of the library.

use crate::{brdf, math, sg};

/// The shared numbers of one module.
#[derive(Clone, Copy, Debug)]
pub struct Constants {
    /// Constants by name.
    pub scalars: &'static [(&'static str, f32)],
    /// Arguments of [`math::polynomial::horner`] by name.
    pub polynomials: &'static [(&'static str, &'static [f32])],
}

/// Lists constants of a module under their own names, as an item `CONSTANTS`; `a as b` calls it `b`, shaders having one
/// space of names.
macro_rules! shared {
    (
        scalars: [$($scalar:ident $(as $name:ident)?),* $(,)?],
        polynomials: [$($polynomial:ident),* $(,)?]
    ) => {
        /// What shaders share with this module.
        pub(crate) const CONSTANTS: $crate::constants::Constants = $crate::constants::Constants {
            scalars: &[$(($crate::constants::shared!(@name $scalar $($name)?), $scalar)),*],
            polynomials: &[$((stringify!($polynomial), &$polynomial)),*],
        };
    };
    (@name $own:ident) => { stringify!($own) };
    (@name $own:ident $name:ident) => { stringify!($name) };
}
pub(crate) use shared;

mod standard {
    use std::f32::consts::{FRAC_1_PI, LN_2, LOG2_E, PI, TAU};
    const F32_MAX: f32 = f32::MAX;
    const F32_MIN_POSITIVE: f32 = f32::MIN_POSITIVE;
    super::shared!(
        scalars: [FRAC_1_PI, LN_2, LOG2_E, PI, TAU, F32_MAX, F32_MIN_POSITIVE],
        polynomials: []
    );
}

/// All shared numbers; a name occurs once.
pub const ALL: &[Constants] = &[
    standard::CONSTANTS,
    math::elementary::CONSTANTS,
    math::vec::CONSTANTS,
    sg::cosine::CONSTANTS,
    sg::glossy::CONSTANTS,
    sg::glossy_blend::CONSTANTS,
    sg::hemisphere::CONSTANTS,
    sg::lobe::CONSTANTS,
    sg::polar::CONSTANTS,
    sg::vmf::CONSTANTS,
    brdf::albedo::CONSTANTS,
    brdf::roughness::CONSTANTS,
];

#[cfg(test)]
mod tests {
    #[test]
    fn names_occur_once_and_numbers_are_normal() {
        let mut names = std::collections::BTreeSet::new();
        for constants in super::ALL {
            for (name, value) in constants.scalars {
                assert!(names.insert(*name), "{name} twice");
                assert!(value.is_normal(), "{name} = {value}");
            }
            for (name, coefficients) in constants.polynomials {
                assert!(names.insert(*name), "{name} twice");
                assert!(coefficients.iter().all(|c| c.is_normal()), "{name}");
            }
        }
    }
}
