//! Von Mises–Fisher distributions: mean length and sharpness, and the convolution of lobes.
//!
//! A normalised lobe `G/A` is a von Mises–Fisher distribution. The length `r` of its mean vector runs from 0 (constant)
//! to 1 (a direction). For sharp lobes all information sits in the *complement* `1 − r ≈ 1/κ`, which a rounded `r` has
//! lost; every function that turns a length into a sharpness therefore takes the complement too.

use super::lobe::SHARPNESS_MAX;
use crate::math::elementary::exp;
use crate::math::polynomial::horner;

/// Smallest complement: that of [`SHARPNESS_MAX`].
const COMPLEMENT_MIN: f32 = 1.0 / SHARPNESS_MAX;

/// `r/κ` up to a sharpness of 1, of `κ²`.
const MEAN_LENGTH: [f32; 6] = [
    -1.615_416e-6,
    2.079_772e-5,
    -2.113_485_7e-4,
    2.116_334_9e-3,
    -2.222_221_7e-2,
    0.333_333_34,
];

/// What [`sharpness`] adds to the form of 2005, over `r³`, of `r²`.
const SHARPNESS_CORRECTION: [f32; 6] = [
    -2.892_192,
    7.301_261_4,
    -5.822_696_7,
    1.680_648_9,
    -0.578_665_14,
    -0.187_402_04,
];

crate::constants::shared!(
    scalars: [COMPLEMENT_MIN],
    polynomials: [MEAN_LENGTH, SHARPNESS_CORRECTION]
);

/// Length of a mean vector with its complement, each accurate by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanLength {
    /// `r`, 0 … 1.
    pub length: f32,
    /// `1 − r`, 1 … 0, without the rounding error of `length`.
    pub complement: f32,
}

impl MeanLength {
    /// The mean length of a direction: 1 and 0.
    pub const DIRECTION: Self = Self {
        length: 1.0,
        complement: 0.0,
    };

    /// From a length alone. The complement is exact for the given `f32`, but has the error of whatever rounded it: fine
    /// up to a sharpness of about 1000.
    ///
    /// ```
    /// use vsgl_core::sg::vmf::{self, MeanLength};
    /// assert_eq!(MeanLength::from_length(0.75).complement, 0.25);
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn from_length(length: f32) -> Self {
        let length = length.clamp(0.0, 1.0);
        Self {
            length,
            complement: 1.0 - length,
        }
    }

    /// Mean length of the convolution of two lobes: the lengths multiply (exact for rotationally symmetric lobes).
    ///
    /// ```
    /// use vsgl_core::sg::vmf::{self, MeanLength};
    /// let blurred = vmf::mean(100.0).convolve(vmf::mean(100.0));
    /// assert!((vmf::sharpness(blurred) / 50.0 - 1.0).abs() < 0.02);
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn convolve(self, other: Self) -> Self {
        Self {
            length: self.length * other.length,
            // 1 − (1−a)(1−b); symmetric, and at most one bit is lost since both are at most 1.
            complement: (self.complement + other.complement) - self.complement * other.complement,
        }
    }
}

/// Mean length of a lobe: `r = coth κ − 1/κ` and `1 − r`.
///
/// `κ/3` for small, `1 − 1/κ` for large sharpness. Relative error of both at most 3e-7.
///
/// ```
/// use vsgl_core::sg::vmf::{self, MeanLength};
/// assert!((vmf::mean(1e6).complement * 1e6 - 1.0).abs() < 1e-5);
/// ```
#[inline(always)]
#[must_use]
pub fn mean(sharpness: f32) -> MeanLength {
    let k = sharpness.min(SHARPNESS_MAX);
    let near = k.min(1.0);
    let square = near * near;
    let p = horner(MEAN_LENGTH, square);
    let length_near = p * near;
    let far = k.max(1.0);
    let decay = exp(-2.0 * far);
    // coth κ − 1 = 2 e^{−2κ}/(1 − e^{−2κ}).
    let complement_far = 1.0 / far - 2.0 * decay / (1.0 - decay);
    let small = k < 1.0;
    MeanLength {
        length: if small {
            length_near
        } else {
            1.0 - complement_far
        },
        complement: if small {
            1.0 - length_near
        } else {
            complement_far
        },
    }
}

/// Length of the mean vector of a lobe: `coth κ − 1/κ`, see [`mean`].
///
/// ```
/// use vsgl_core::sg::vmf::{self, MeanLength};
/// assert!((vmf::mean_length(0.003) - 0.001).abs() < 1e-8);
/// ```
#[inline(always)]
#[must_use]
pub fn mean_length(sharpness: f32) -> f32 {
    mean(sharpness).length
}

/// `1 − mean_length` without cancellation, see [`mean`].
///
/// ```
/// use vsgl_core::sg::vmf::{self, MeanLength};
/// assert!((vmf::mean_length_complement(1e6) * 1e6 - 1.0).abs() < 1e-5);
/// ```
#[inline(always)]
#[must_use]
pub fn mean_length_complement(sharpness: f32) -> f32 {
    mean(sharpness).complement
}

/// Sharpness of the lobe with a given mean length: the inverse of [`mean`], relative error at most 6e-5.
///
/// [`sharpness_banerjee_2005`], which has both limits `3r` and `1/(1 − r)`, plus an odd polynomial from `r³` on, our own
/// fit. Beyond [`SHARPNESS_MAX`] clamped. For rounding accuracy use [`sharpness_exact`].
///
/// ```
/// use vsgl_core::sg::vmf;
/// for k in [1e-3, 0.7, 5.0, 300.0, 1e9] {
///     assert!((vmf::sharpness(vmf::mean(k)) / k - 1.0).abs() < 6e-5);
/// }
/// ```
#[inline(always)]
#[must_use]
pub fn sharpness(mean: MeanLength) -> f32 {
    let r = mean.length;
    let s = r * r;
    let q = horner(SHARPNESS_CORRECTION, s);
    (sharpness_banerjee_2005(mean) + r * s * q).min(SHARPNESS_MAX)
}

/// Sharpness of the lobe with a given mean length, to rounding: [`sharpness`] and one Newton step.
///
/// Relative error at most 1e-6.
///
/// ```
/// use vsgl_core::sg::vmf::{self, MeanLength};
/// assert!((vmf::sharpness_exact(vmf::mean(7.0)) / 7.0 - 1.0).abs() < 2e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn sharpness_exact(mean_length: MeanLength) -> f32 {
    let k = sharpness(mean_length);
    let at = mean(k);
    // Derivative of the mean length, 1/κ² − 1/sinh²κ; for small sharpness 1 − r² − 2r/κ does not cancel.
    let far = k.max(1.0);
    let decay = exp(-2.0 * far);
    let inverse = 1.0 / far;
    let slope_far = inverse * inverse - 4.0 * decay / ((1.0 - decay) * (1.0 - decay));
    let near = k.max(1e-30);
    let slope_near = 1.0 - at.length * at.length - 2.0 * (at.length / near);
    // The difference of lengths where they are small, of complements where those are.
    let miss_near = mean_length.length - at.length;
    let miss_far = at.complement - mean_length.complement.max(COMPLEMENT_MIN);
    let step = if k < 1.0 {
        miss_near / slope_near
    } else {
        miss_far / slope_far
    };
    (k + step).clamp(0.0, SHARPNESS_MAX)
}

/// Sharpness of the convolution of two lobes, e.g. of a lobe blurred by another: their mean lengths multiply.
///
/// Symmetric. About `κ_a κ_b/(κ_a + κ_b)` for sharp lobes, `κ_a κ_b/3` for wide ones, and `κ_b` for
/// `κ_a → ∞` (within 6e-5). The convolution is not itself a spherical Gaussian; this is the one of equal mean.
///
/// Source: Mardia and Jupp 2000, "Directional Statistics", section 9.3 (mean lengths of convolutions multiply).
///
/// ```
/// use vsgl_core::sg::vmf::{self, MeanLength};
/// assert!((vmf::convolve(1000.0, 500.0) / 333.3 - 1.0).abs() < 0.01);
/// ```
#[inline(always)]
#[must_use]
pub fn convolve(a: f32, b: f32) -> f32 {
    sharpness(mean(a).convolve(mean(b)))
}

/// [`convolve`] where the mean length of one lobe is at hand, as for a light that is seen from many points.
///
/// ```
/// use vsgl_core::sg::vmf::{self, MeanLength};
/// let normals = vmf::mean(40.0);
/// assert!((vmf::convolve_with(normals, 10.0) / vmf::convolve(40.0, 10.0) - 1.0).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn convolve_with(a: MeanLength, b: f32) -> f32 {
    sharpness(a.convolve(mean(b)))
}

/// Banerjee's sharpness for a mean length: `κ = r (3 − r²)/(1 − r²)`. Within 5 % of the exact one, exact in both limits.
///
/// With this map a clamped cosine (normalised, as the diffuse lobe of a light) is best matched by a sharpness of 2.2925.
/// Source: Banerjee et al. 2005, "Clustering on the Unit Hypersphere using von Mises-Fisher Distributions", Eq. 4.4.
///
/// ```
/// use vsgl_core::sg::vmf::{self, MeanLength};
/// assert!((vmf::sharpness_banerjee_2005(vmf::mean(7.0)) / 7.0 - 1.0).abs() < 0.06);
/// ```
#[inline(always)]
#[must_use]
pub fn sharpness_banerjee_2005(mean: MeanLength) -> f32 {
    let r = mean.length;
    (r * (3.0 - r * r) / (mean.complement.max(COMPLEMENT_MIN) * (1.0 + r))).min(SHARPNESS_MAX)
}

/// The mean length that [`sharpness_banerjee_2005`] maps to `sharpness`: the root in [0, 1] of
/// `r (3 − r²) = κ (1 − r²)`.
///
/// Newton's method, on the length below sharpness 1 and on the complement above: no trigonometry, no cancellation.
/// Relative error of both fields at most 5e-7.
///
/// ```
/// use vsgl_core::sg::vmf::{self, MeanLength};
/// let k = vmf::sharpness_banerjee_2005(vmf::mean_banerjee_2005(7.0));
/// assert!((k / 7.0 - 1.0).abs() < 1e-5);
/// ```
#[inline(always)]
#[must_use]
pub fn mean_banerjee_2005(sharpness: f32) -> MeanLength {
    let k = sharpness.min(SHARPNESS_MAX);
    let near = k.min(1.0);
    let mut r = near * (1.0 / 3.0);
    for _ in 0..3 {
        // f(r) = r (3 − r²) − κ (1 − r²).
        let square = r * r;
        let value = r * (3.0 - square) - near * (1.0 - square);
        let slope = 3.0 * (1.0 - square) + 2.0 * near * r;
        r -= value / slope;
    }
    let far = k.max(1.0);
    let mut c = 1.0 / (1.0 + far);
    for _ in 0..4 {
        // The same with r = 1 − c: f(c) = (1−c)(2 + 2c − c²) − κ c (2 − c).
        let value = (1.0 - c) * (2.0 + c * (2.0 - c)) - far * c * (2.0 - c);
        let slope = 3.0 * c * (c - 2.0) - 2.0 * far * (1.0 - c);
        c -= value / slope;
    }
    let small = k < 1.0;
    MeanLength {
        length: if small { r } else { 1.0 - c },
        complement: if small { 1.0 - r } else { c },
    }
}

/// Toksvig's sharpness for a mean length: `κ = r/(1 − r)`.
///
/// Three times too large for wide lobes. Consistent with a sharpness of 2 for the clamped cosine.
/// Source: Toksvig 2005, "Mipmapping Normal Maps".
///
/// ```
/// use vsgl_core::sg::vmf::{self, MeanLength};
/// assert_eq!(vmf::sharpness_toksvig_2005(MeanLength::from_length(0.75)), 3.0);
/// ```
#[inline(always)]
#[must_use]
pub fn sharpness_toksvig_2005(mean: MeanLength) -> f32 {
    (mean.length / mean.complement.max(COMPLEMENT_MIN)).min(SHARPNESS_MAX)
}

/// The mean length that [`sharpness_toksvig_2005`] maps to `sharpness`: `r = κ/(κ + 1)`.
///
/// ```
/// use vsgl_core::sg::vmf::{self, MeanLength};
/// assert_eq!(vmf::mean_toksvig_2005(3.0).length, 0.75);
/// ```
#[inline(always)]
#[must_use]
pub fn mean_toksvig_2005(sharpness: f32) -> MeanLength {
    let k = sharpness.min(SHARPNESS_MAX);
    let complement = 1.0 / (k + 1.0);
    MeanLength {
        length: k * complement,
        complement,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact_length(k: f64) -> f64 {
        if k < 0.01 {
            k / 3.0 - k.powi(3) / 45.0
        } else {
            1.0 / k.tanh() - 1.0 / k
        }
    }

    fn exact_complement(k: f64) -> f64 {
        if k < 1.0 {
            1.0 - exact_length(k)
        } else {
            1.0 / k - 2.0 / libm::expm1(2.0 * k)
        }
    }

    fn sharpnesses() -> impl Iterator<Item = f32> {
        (0..=3000).map(|i| 10f64.powf(-8.0 + 20.0 * f64::from(i) / 3000.0) as f32)
    }

    #[test]
    fn mean_agrees_with_f64() {
        for k in sharpnesses() {
            let (m, x) = (mean(k), f64::from(k));
            assert!(
                (f64::from(m.length) / exact_length(x) - 1.0).abs() < 3e-7,
                "{k}"
            );
            assert!(
                (f64::from(m.complement) / exact_complement(x) - 1.0).abs() < 3e-7,
                "{k}"
            );
        }
    }

    #[test]
    fn inverses_return() {
        for k in sharpnesses() {
            assert!(
                (sharpness(mean(k)) / k - 1.0).abs() < 6e-5,
                "{k} {}",
                sharpness(mean(k))
            );
            assert!(
                (sharpness_exact(mean(k)) / k - 1.0).abs() < 1e-6,
                "{k} {}",
                sharpness_exact(mean(k))
            );
            assert!(
                (sharpness_banerjee_2005(mean(k)) / k - 1.0).abs() < 0.05,
                "{k}"
            );
            assert!(
                (sharpness_banerjee_2005(mean_banerjee_2005(k)) / k - 1.0).abs() < 2e-6,
                "{k}"
            );
            assert!(
                (sharpness_toksvig_2005(mean_toksvig_2005(k)) / k - 1.0).abs() < 1e-6,
                "{k}"
            );
        }
    }

    #[test]
    fn convolution_limits() {
        for k in sharpnesses() {
            let kept = 1.0 / (1.0 + k / SHARPNESS_MAX);
            assert!(
                (convolve(k, SHARPNESS_MAX) / (k * kept) - 1.0).abs() < 6e-5,
                "{k}"
            );
            assert_eq!(convolve(k, 3.0), convolve(3.0, k));
            assert_eq!(convolve_with(mean(k), 3.0), convolve(3.0, k));
        }
        assert!((convolve(1e8, 3e8) / 0.75e8 - 1.0).abs() < 1e-5);
        assert_eq!(convolve(0.0, 5.0), 0.0);
        assert!((convolve(f32::MAX, f32::MAX) / (0.5 * SHARPNESS_MAX) - 1.0).abs() < 1e-5);
        assert_eq!(convolve_with(MeanLength::DIRECTION, 0.0), 0.0);
    }

    #[test]
    fn edges() {
        assert_eq!(
            mean(0.0),
            MeanLength {
                length: 0.0,
                complement: 1.0
            }
        );
        for f in [
            sharpness,
            sharpness_exact,
            sharpness_banerjee_2005,
            sharpness_toksvig_2005,
        ] {
            assert_eq!(f(MeanLength::from_length(0.0)), 0.0);
            assert!((f(MeanLength::DIRECTION) / SHARPNESS_MAX - 1.0).abs() < 1e-5);
        }
        assert_eq!(mean_banerjee_2005(0.0).length, 0.0);
    }
}
