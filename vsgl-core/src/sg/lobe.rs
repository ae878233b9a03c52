//! The spherical Gaussian, its integral and products.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use crate::math::elementary::{exp, expm1_over_x, log};
use crate::math::vec::one_minus_cos;

/// The sharpest lobe: 2⁴¹. Squares and products of two sharpnesses stay finite, and a lobe of this sharpness is a
/// direction: its half width is 7e-7 rad.
pub const SHARPNESS_MAX: f32 = 2_199_023_255_552.0;

crate::constants::shared!(scalars: [SHARPNESS_MAX], polynomials: []);

/// A spherical Gaussian with an amplitude: `exp(log_amplitude) · exp(sharpness (ω·axis − 1))`.
///
/// The amplitude is kept as its logarithm because that of a product of sharp lobes leaves the range of `f32` long before
/// the quantities that it is multiplied with stop to matter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SgLobe {
    /// Unit vector in which the lobe peaks.
    pub axis: Vec3,
    /// Sharpness, 0 (constant) to [`SHARPNESS_MAX`], twice that for a product; about the inverse of the angular variance
    /// in rad².
    pub sharpness: f32,
    /// Natural logarithm of the peak value.
    pub log_amplitude: f32,
}

impl SgLobe {
    /// The lobe of peak 1 about `axis`, a unit vector; `sharpness` is clamped to 0 … [`SHARPNESS_MAX`].
    ///
    /// ```
    /// use glam::Vec3;
    /// use vsgl_core::sg::lobe::{self, SgLobe};
    /// assert_eq!(SgLobe::new(Vec3::Z, f32::INFINITY).sharpness, lobe::SHARPNESS_MAX);
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn new(axis: Vec3, sharpness: f32) -> Self {
        Self {
            axis,
            sharpness: sharpness.clamp(0.0, SHARPNESS_MAX),
            log_amplitude: 0.0,
        }
    }

    /// Value towards the unit vector `direction`, amplitude included.
    ///
    /// ```
    /// use glam::Vec3;
    /// use vsgl_core::sg::lobe::{self, SgLobe};
    /// assert_eq!(SgLobe::new(Vec3::Z, 30.0).evaluate(Vec3::Z), 1.0);
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn evaluate(self, direction: Vec3) -> f32 {
        exp(self.log_amplitude - self.sharpness * one_minus_cos(direction, self.axis))
    }

    /// Integral over the sphere, amplitude included \[sr\].
    ///
    /// ```
    /// use glam::Vec3;
    /// use vsgl_core::sg::lobe::{self, SgLobe};
    /// assert_eq!(SgLobe::new(Vec3::Z, 30.0).integral(), lobe::integral(30.0));
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn integral(self) -> f32 {
        exp(self.log_amplitude) * integral(self.sharpness)
    }

    /// Logarithm of [`SgLobe::integral`], finite where the integral underflows.
    ///
    /// ```
    /// use glam::Vec3;
    /// use vsgl_core::sg::lobe::{self, SgLobe};
    /// let a = SgLobe::new(Vec3::Z, 30.0);
    /// assert!((a.log_integral() - a.integral().ln()).abs() < 1e-5);
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn log_integral(self) -> f32 {
        self.log_amplitude + log_integral(self.sharpness)
    }
}

/// Value `exp(sharpness (direction·axis − 1))` of the lobe of peak 1, within (0, 1], by way of `|direction − axis|²`.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::lobe::{self, SgLobe};
/// assert!((lobe::evaluate(Vec3::Z, 2.0, Vec3::X) - (-2.0f32).exp()).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn evaluate(axis: Vec3, sharpness: f32, direction: Vec3) -> f32 {
    exp(-sharpness.min(SHARPNESS_MAX) * one_minus_cos(direction, axis))
}

/// Integral of the lobe over the sphere \[sr\]: `A(κ) = 2π (1 − e^{−2κ})/κ`.
///
/// 4π at sharpness 0, falls like 2π/κ. Exact up to rounding: relative error at most 3e-7.
///
/// ```
/// use vsgl_core::sg::lobe;
/// assert_eq!(lobe::integral(0.0), 4.0 * std::f32::consts::PI);
/// assert!((lobe::integral(1e6) * 1e6 / std::f32::consts::TAU - 1.0).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn integral(sharpness: f32) -> f32 {
    4.0 * PI * expm1_over_x(-2.0 * sharpness.min(SHARPNESS_MAX))
}

/// Logarithm of [`integral`].
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::lobe::{self, SgLobe};
/// assert!((lobe::log_integral(30.0) - lobe::integral(30.0).ln()).abs() < 1e-5);
/// ```
#[inline(always)]
#[must_use]
pub fn log_integral(sharpness: f32) -> f32 {
    log(integral(sharpness))
}

/// `2π/κ`, the limit of [`integral`] for sharp lobes, as several papers use it.
///
/// Relative error `e^{−2κ}`: 1.8 % at 2, 4.5e-5 at 5. Above 4π for sharpness below ½, where it must not be used; the
/// sharpness is raised to 1e-30 to stay finite.
/// Source: Iwasaki et al. 2012, "Interactive Bi-scale Editing of Highly Glossy Materials".
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::lobe::{self, SgLobe};
/// assert!((lobe::integral_sharp(50.0) / lobe::integral(50.0) - 1.0).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn integral_sharp(sharpness: f32) -> f32 {
    TAU / sharpness.clamp(1e-30, SHARPNESS_MAX)
}

/// Product of two lobes: `G_a(ω) G_b(ω) = exp(log_amplitude) G(ω; axis, sharpness)` for every ω.
///
/// Exact. The sharpness is the length of `κ_a ξ_a + κ_b ξ_b`. The textbook `log_amplitude = κ − κ_a − κ_b` cancels for
/// sharp lobes; with `κ² − (κ_a + κ_b)² = −κ_a κ_b |ξ_a − ξ_b|²` it becomes a quotient of sums. The smaller sharpness is
/// set against the larger one first, so nothing under- or overflows.
///
/// Opposite lobes of one sharpness cancel to sharpness 0; the axis is then the second one's and has no influence.
///
/// Source: Wang et al. 2009, "All-Frequency Rendering of Dynamic, Spatially-Varying Reflectance" (the product);
/// Tokuyoshi 2022, "Accurate Diffuse Lighting from Spherical Gaussian Lights", supplement, Eq. 2 (a stable amplitude,
/// with `ξ_a·ξ_b − 1`); the difference of axes follows that author's published VSGL shaders.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::lobe;
/// let (a, b) = (Vec3::Z, Vec3::new(0.6, 0.0, 0.8));
/// let p = lobe::product(a, 30.0, b, 50.0);
/// let direction = Vec3::new(0.0, 0.28, 0.96);
/// let apart = lobe::evaluate(a, 30.0, direction) * lobe::evaluate(b, 50.0, direction);
/// assert!((p.evaluate(direction) / apart - 1.0).abs() < 1e-5);
/// ```
#[inline(always)]
#[must_use]
pub fn product(a_axis: Vec3, a_sharpness: f32, b_axis: Vec3, b_sharpness: f32) -> SgLobe {
    let a = a_sharpness.min(SHARPNESS_MAX);
    let b = b_sharpness.min(SHARPNESS_MAX);
    let larger = a.max(b);
    let smaller = a.min(b);
    let unit = 1.0 / larger.max(f32::MIN_POSITIVE);
    let (ra, rb) = (a * unit, b * unit);
    let sum = a_axis * ra + b_axis * rb;
    // The length relative to the larger sharpness, within 0 … 2.
    let length = sum.dot(sum).sqrt();
    let cancelled = length < 1e-18;
    let inverse = 1.0 / (if cancelled { 1.0 } else { length });
    let unit_axis = sum * inverse;
    let axis = if cancelled { b_axis } else { unit_axis };
    let log_amplitude =
        -2.0 * one_minus_cos(a_axis, b_axis) * smaller / (ra + rb + length).max(1.0);
    SgLobe {
        axis,
        sharpness: larger * length,
        log_amplitude,
    }
}

/// Sharpness and logarithm of the amplitude of [`product`], from the squared chord `|ξ_a − ξ_b|²` of the axes, 0 … 4.
///
/// For axes known by the angle between them; both results keep their relative accuracy up to opposite axes.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::lobe::{self, SgLobe};
/// // Equal axes: the sharpnesses add, nothing is lost.
/// assert_eq!(lobe::product_by_chord(3.0, 5.0, 0.0), (8.0, 0.0));
/// ```
#[inline(always)]
#[must_use]
pub fn product_by_chord(a_sharpness: f32, b_sharpness: f32, chord2: f32) -> (f32, f32) {
    let a = a_sharpness.min(SHARPNESS_MAX);
    let b = b_sharpness.min(SHARPNESS_MAX);
    let larger = a.max(b);
    let ratio = a.min(b) / larger.max(f32::MIN_POSITIVE);
    // Both terms are positive, also for opposite axes, where `(1 + ratio)² − ratio chord²` would cancel.
    let apart = 1.0 - ratio;
    let length = (apart * apart + ratio * (4.0 - chord2).max(0.0)).sqrt();
    let log_amplitude = -chord2 * a.min(b) / (1.0 + ratio + length);
    (larger * length, log_amplitude)
}

/// `∫ G_a G_b dω` over the sphere \[sr\]: `e^{log_amplitude} A(sharpness)` of the product.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::lobe::{self, SgLobe};
/// let same = lobe::inner_product(Vec3::Z, 3.0, Vec3::Z, 5.0);
/// assert!((same / lobe::integral(8.0) - 1.0).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn inner_product(a_axis: Vec3, a_sharpness: f32, b_axis: Vec3, b_sharpness: f32) -> f32 {
    product(a_axis, a_sharpness, b_axis, b_sharpness).integral()
}

/// Logarithm of [`inner_product`], finite where the integral underflows.
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::lobe::{self, SgLobe};
/// // The inner product itself underflows.
/// assert!(lobe::log_inner_product(Vec3::Z, 1e4, -Vec3::Z, 1e4) < -1e4);
/// ```
#[inline(always)]
#[must_use]
pub fn log_inner_product(a_axis: Vec3, a_sharpness: f32, b_axis: Vec3, b_sharpness: f32) -> f32 {
    product(a_axis, a_sharpness, b_axis, b_sharpness).log_integral()
}

/// [`inner_product`] for sharp lobes with close axes: `2π G(ξ_a; ξ_b, κ_a κ_b/(κ_a + κ_b))/(κ_a + κ_b)`.
///
/// Overestimates when the sum of the sharpnesses is not large, and ignores how the product's sharpness depends on the
/// angle between the axes.
/// Source: Iwasaki et al. 2012, "Interactive Bi-scale Editing of Highly Glossy Materials".
///
/// ```
/// use glam::Vec3;
/// use vsgl_core::sg::lobe::{self, SgLobe};
/// let exact = lobe::inner_product(Vec3::Z, 300.0, Vec3::Z, 500.0);
/// assert!((lobe::inner_product_sharp(Vec3::Z, 300.0, Vec3::Z, 500.0) / exact - 1.0).abs() < 1e-3);
/// ```
#[inline(always)]
#[must_use]
pub fn inner_product_sharp(a_axis: Vec3, a_sharpness: f32, b_axis: Vec3, b_sharpness: f32) -> f32 {
    let a = a_sharpness.min(SHARPNESS_MAX);
    let b = b_sharpness.min(SHARPNESS_MAX);
    let sum = (a + b).max(1e-30);
    TAU * exp(-one_minus_cos(a_axis, b_axis) * a * (b / sum)) / sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn product_of_equal_lobes() {
        let p = product(Vec3::X, 3.0, Vec3::X, 4.0);
        assert_eq!(p.axis, Vec3::X);
        assert!((p.sharpness - 7.0).abs() < 1e-6);
        assert_eq!(p.log_amplitude, 0.0);
    }

    #[test]
    fn product_edges() {
        let opposite = product(Vec3::Z, 5.0, -Vec3::Z, 5.0);
        assert_eq!(opposite.sharpness, 0.0);
        assert_eq!(opposite.log_amplitude, -10.0);
        assert_eq!(opposite.axis, -Vec3::Z);
        let none = product(Vec3::Z, 0.0, Vec3::X, 0.0);
        assert_eq!((none.sharpness, none.log_amplitude), (0.0, 0.0));
        let one = product(Vec3::Z, 0.0, Vec3::X, 7.0);
        assert_eq!(
            (one.axis, one.sharpness, one.log_amplitude),
            (Vec3::X, 7.0, 0.0)
        );
        let huge = product(Vec3::Z, f32::MAX, Vec3::X, f32::MAX);
        assert!(
            huge.sharpness.is_finite() && huge.log_amplitude.is_finite() && huge.axis.is_finite()
        );
        let tiny = product(Vec3::Z, 1e-40, Vec3::X, 1e-38);
        assert!(tiny.sharpness >= 0.0 && (tiny.axis.length() - 1.0).abs() < 1e-6);
    }

    #[test]
    fn sharp_product_keeps_small_angles() {
        // Two lobes of sharpness 1e8 and 4e8 at an angle of 1e-4.
        let b = Vec3::new(1e-4, 0.0, 1.0);
        let p = product(Vec3::Z, 1e8, b, 4e8);
        let exact = -1e8f64 * 4e8 * 1e-8 / (5e8 + 5e8);
        assert!((f64::from(p.log_amplitude) / exact - 1.0).abs() < 1e-6);
    }

    #[test]
    fn integral_limits() {
        assert_eq!(integral(0.0), 4.0 * PI);
        assert_eq!(integral(f32::MAX), integral(SHARPNESS_MAX));
        assert!((log_integral(1e12) - (TAU / 1e12).ln()).abs() < 1e-5);
    }
}
