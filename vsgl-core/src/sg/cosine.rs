//! Integral of a spherical Gaussian against a clamped cosine: diffuse lighting.
//!
//! `B(κ, z) = ∫ G(ω; ξ, κ) max(ω·n, 0) dω` \[sr\] with `z = ξ·n`. Radiance reflected by a Lambertian surface is
//! `albedo/π · amplitude · B`. At `z = ±1` it is known in closed form; in between the published forms differ:
//!
//! | form | max error / value at z = 1 | notes |
//! |---|---|---|
//! | [`constant`] | 3.0 | exact for sharp lobes above the horizon; zero below it |
//! | [`sg_2015`] | 0.15 | the cosine is itself a lobe; two-VSGL paper |
//! | [`sg_iwasaki_2012`] | 0.14 | the same, normalised |
//! | [`sg_product`] | 0.14 | the same with the exact product |
//! | [`lobes_2018`] | 1.5e-2 | negative in places, clamped |
//! | [`lobes_2022`] | 4.2e-3 | negative in places, clamped; f32 noise of 5e-4 |
//! | [`interpolated_2024`] | 1.53e-3 | always positive |
//! | [`interpolated_v13`] | 1.2e-4 | ours; the default |
//! | [`interpolated_v14`] | 4.5e-5 | ours; one more term |
//!
//! # How the last three are evaluated
//!
//! `B = B₋ + v (B₊ − B₋)` with the published factor
//! `v = (z erfc(−tz) + erfc(t))/2 − e^{−t²z²} expm1(t²(z² − 1))/(2√π t)`. Sorting its terms by the functions of `t` and of
//! `tz` gives, with `S(u) = ∫₀ᵘ erf`,
//!
//! `v = (1 + z)/2 − (S(t) − S(t|z|))/(2t)`:
//!
//! no quotient that cancels at small `t`, no exponentials, and `v(z) − v(−z) = z` is evident.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use super::lobe::{self, SHARPNESS_MAX};
use super::polar::PolarMoments;
use super::{hemisphere, vmf};
use crate::math::elementary::{INV_SQRT_PI, erf_integral, erfc_integral_scaled, exp, log};
use crate::math::polynomial::horner;

/// Sharpness of the lobe that stands for a clamped cosine in the papers of 2015 and 2016, and agrees with Toksvig's map.
pub const COSINE_SHARPNESS_2015: f32 = 2.0;

/// Sharpness of the normalised lobe closest to a normalised clamped cosine in least squares.
pub const COSINE_SHARPNESS: f32 = 2.292_504;

/// Sharpness of the wide lobe of [`lobes_2018`].
const LOBES_2018_WIDE: f32 = 0.0315;

/// Its amplitude.
const LOBES_2018_PRODUCT: f32 = 32.708;

/// What is taken away.
const LOBES_2018_CONSTANT: f32 = 31.703;

/// The same of [`lobes_2022`].
const LOBES_2022_WIDE: f32 = 8.456_087e-4;

const LOBES_2022_PRODUCT: f32 = 1_183.246_8;

const LOBES_2022_CONSTANT: f32 = 1_182.246_7;

/// Steepness of the step across the horizon, squared, over `κ²/2`: numerator of the form of 2024.
const COSINE_2024_ABOVE: [f32; 3] = [1.0, 2.736_083, 17.021_298];

/// Its denominator.
const COSINE_2024_BELOW: [f32; 4] = [1.0, 4.010_082_7, 15.219_156, 76.087_9];

/// The same of v13.
const COSINE_V13_ABOVE: [f32; 3] = [1.0, 21.396_498, 144.713_6];

const COSINE_V13_BELOW: [f32; 4] = [1.0, 21.267_452, 14.727_96, 673.976_8];

/// Denominators of the correction of v13, to the power 7/4 and 5/2.
const COSINE_V13_ONE: [f32; 3] = [1.0, -7.048_938, 25.317_42];

const COSINE_V13_NOUGHT: [f32; 3] = [1.0, 3.616_068_8, 13.015_574];

/// Weights of its terms.
const V13_NOUGHT: f32 = 4.828_551_3;

const V13_ONE: f32 = 1.445_659_7e-2;

/// Steepness of v14.
const COSINE_V14_ABOVE: [f32; 3] = [1.0, 2.299_231_8, 17.791_126];

const COSINE_V14_BELOW: [f32; 4] = [1.0, 3.491_588_4, 8.598_863, 81.642_5];

/// Denominators of the correction of v14; of the first the constant only.
const V14_NOUGHT_BELOW: f32 = 9.404_963;

const COSINE_V14_ONE: [f32; 3] = [1.0, 3.415_573_6, 37.932_312];

const COSINE_V14_TWO: [f32; 3] = [1.0, -11.132_406, 58.319_52];

/// Weights of its terms, the last one linear in the sharpness.
const V14_NOUGHT: f32 = 0.482_650_16;

const V14_ONE: f32 = -7.851_023e-2;

const COSINE_V14_TWO_ABOVE: [f32; 2] = [-1.112_346_2e-3, -6.766_903e-2];

crate::constants::shared!(
    scalars: [
        COSINE_SHARPNESS, COSINE_SHARPNESS_2015, LOBES_2018_WIDE, LOBES_2018_PRODUCT, LOBES_2018_CONSTANT,
        LOBES_2022_WIDE, LOBES_2022_PRODUCT, LOBES_2022_CONSTANT, V13_NOUGHT, V13_ONE,
        V14_NOUGHT_BELOW, V14_NOUGHT, V14_ONE,
    ],
    polynomials: [
        COSINE_2024_ABOVE, COSINE_2024_BELOW, COSINE_V13_ABOVE, COSINE_V13_BELOW,
        COSINE_V13_ONE, COSINE_V13_NOUGHT, COSINE_V14_ABOVE, COSINE_V14_BELOW, COSINE_V14_ONE,
        COSINE_V14_TWO, COSINE_V14_TWO_ABOVE,
    ]
);

/// `B` with the axis along the normal \[sr\]: `2π (e^{−κ} − 1 + κ)/κ²`. Exact; π at sharpness 0.
///
/// ```
/// use vsgl_core::sg::cosine;
/// assert!((cosine::upper(0.0) - std::f32::consts::PI).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn upper(sharpness: f32) -> f32 {
    TAU * PolarMoments::new(sharpness).upper
}

/// `B` with the axis against the normal \[sr\]: `2π e^{−κ} (1 − e^{−κ} − κ e^{−κ})/κ²`. Exact; π at sharpness 0, and 0
/// above 87, where it would be below 1e-38.
///
/// ```
/// use vsgl_core::sg::cosine;
/// assert!(cosine::lower(10.0) < 1e-3 * cosine::upper(10.0));
/// ```
#[inline(always)]
#[must_use]
pub fn lower(sharpness: f32) -> f32 {
    let m = PolarMoments::new(sharpness);
    TAU * (m.decay * m.lower)
}

/// Logarithm of [`lower`], finite for every sharpness: about `−κ`.
///
/// ```
/// use vsgl_core::sg::cosine;
/// // Far below what `lower` can hold.
/// assert!(cosine::log_lower(1e4) < -1e4);
/// ```
#[inline(always)]
#[must_use]
pub fn log_lower(sharpness: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    log(TAU * PolarMoments::new(k).lower) - k
}

/// Cosine taken at the axis: `A(κ) max(z, 0)` \[sr\]. The limit of sharp lobes.
///
/// Source: Tokuyoshi 2015, "Virtual Spherical Gaussian Lights for Real-Time Glossy Indirect Illumination" (with `2π/κ`
/// for `A`).
///
/// ```
/// use vsgl_core::sg::cosine;
/// assert_eq!(cosine::constant(50.0, -0.1), 0.0);
/// ```
#[inline(always)]
#[must_use]
pub fn constant(sharpness: f32, cosine: f32) -> f32 {
    lobe::integral(sharpness) * cosine.max(0.0)
}

/// Clamped cosine as a lobe of sharpness [`COSINE_SHARPNESS_2015`] and peak 1, with the sharp-lobe inner product.
///
/// Its integral is taken for π, which it misses by 1.8 %.
/// Source: Tokuyoshi 2015, "Fast Indirect Illumination Using Two Virtual Spherical Gaussian Lights", supplement,
/// section 3.2.
///
/// ```
/// use vsgl_core::sg::cosine;
/// let exact = cosine::interpolated_v13(50.0, 0.8);
/// assert!((cosine::sg_2015(50.0, 0.8) / exact - 1.0).abs() < 0.2);
/// ```
#[inline(always)]
#[must_use]
pub fn sg_2015(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let sum = k + COSINE_SHARPNESS_2015;
    exp((cosine - 1.0) * (k / sum) * COSINE_SHARPNESS_2015) * (TAU / sum)
}

/// Clamped cosine as a lobe of sharpness [`COSINE_SHARPNESS_2015`] and integral π, with the sharp-lobe inner product.
///
/// Source: Iwasaki et al. 2012, "Interactive Bi-scale Editing of Highly Glossy Materials".
///
/// ```
/// use vsgl_core::sg::cosine;
/// let exact = cosine::interpolated_v13(50.0, 0.8);
/// assert!((cosine::sg_iwasaki_2012(50.0, 0.8) / exact - 1.0).abs() < 0.2);
/// ```
#[inline(always)]
#[must_use]
pub fn sg_iwasaki_2012(sharpness: f32, cosine: f32) -> f32 {
    sg_2015(sharpness, cosine) * (PI / lobe::integral(COSINE_SHARPNESS_2015))
}

/// Clamped cosine as a lobe of sharpness [`COSINE_SHARPNESS_2015`] and integral π, with the exact inner product.
///
/// ```
/// use vsgl_core::sg::cosine;
/// let exact = cosine::interpolated_v13(50.0, 0.8);
/// assert!((cosine::sg_product(50.0, 0.8) / exact - 1.0).abs() < 0.2);
/// ```
#[inline(always)]
#[must_use]
pub fn sg_product(sharpness: f32, cosine: f32) -> f32 {
    let (axis, normal) = axis_and_normal(cosine);
    lobe::inner_product(axis, sharpness, normal, COSINE_SHARPNESS_2015)
        * (PI / lobe::integral(COSINE_SHARPNESS_2015))
}

/// Two unit vectors whose dot product is `cosine`.
#[inline(always)]
fn axis_and_normal(cosine: f32) -> (Vec3, Vec3) {
    let sine = ((1.0 - cosine) * (1.0 + cosine)).max(0.0).sqrt();
    (Vec3::new(sine, 0.0, cosine), Vec3::Z)
}

/// The product with a very wide lobe about the normal: amplitude, sharpness, and cosine of its axis.
///
/// Lights of 2018 and 2022 are the difference of the hemispherical integrals of that product and of the lobe itself.
#[inline(always)]
fn widened(k: f32, z: f32, wide: f32) -> (f32, f32, f32) {
    let (axis, normal) = axis_and_normal(z);
    let p = lobe::product(axis, k, normal, wide);
    (exp(p.log_amplitude), p.sharpness, p.axis.z.clamp(-1.0, 1.0))
}

/// Two hemispherical integrals of 2018, clamped to zero where their difference is negative. Superseded.
///
/// Source: Meder and Brüderlin 2018, "Hemispherical Gaussians for Accurate Light Integration", section 4.
///
/// ```
/// use vsgl_core::sg::cosine;
/// let exact = cosine::interpolated_v13(50.0, 0.8);
/// assert!((cosine::lobes_2018(50.0, 0.8) / exact - 1.0).abs() < 0.03);
/// ```
#[inline(always)]
#[must_use]
pub fn lobes_2018(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let (amplitude, k3, z3) = widened(k, cosine, LOBES_2018_WIDE);
    let product = LOBES_2018_PRODUCT * amplitude * hemisphere::integral_2018(k3, z3);
    (product - LOBES_2018_CONSTANT * hemisphere::integral_2018(k, cosine)).max(0.0)
}

/// Two hemispherical integrals of 2022, clamped to zero where their difference is negative. Superseded.
///
/// The amplitude of 1182 times the difference of nearly equal integrals costs four digits in `f32`.
/// Source: Tokuyoshi 2022, "Accurate Diffuse Lighting from Spherical Gaussian Lights".
///
/// ```
/// use vsgl_core::sg::cosine;
/// let exact = cosine::interpolated_v13(50.0, 0.8);
/// assert!((cosine::lobes_2022(50.0, 0.8) / exact - 1.0).abs() < 0.01);
/// ```
#[inline(always)]
#[must_use]
pub fn lobes_2022(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let (amplitude, k3, z3) = widened(k, cosine, LOBES_2022_WIDE);
    let product = LOBES_2022_PRODUCT * amplitude * hemisphere::integral_2022(k3, z3);
    (product - LOBES_2022_CONSTANT * hemisphere::integral_2022(k, cosine)).max(0.0)
}

/// `v = (1 + z)/2 − (S(t) − S(t|z|))/(2t)`, see the module.
#[inline(always)]
fn factor(t: f32, z: f32) -> f32 {
    let fold = erf_integral(t) - erf_integral(t * z.abs());
    0.5 * (1.0 + z) - fold * (0.5 / t.max(1e-30))
}

/// `t` of 2024: like `0.334 κ` for small, `√(κ/2)` for large sharpness.
#[inline(always)]
fn steepness_2024(k: f32) -> f32 {
    let above = horner(COSINE_2024_ABOVE, k);
    let below = horner(COSINE_2024_BELOW, k);
    k * (above / (2.0 * below)).sqrt()
}

/// `t` of v13.
#[inline(always)]
fn steepness_v13(k: f32) -> f32 {
    let above = horner(COSINE_V13_ABOVE, k);
    let below = horner(COSINE_V13_BELOW, k);
    k * (above / (2.0 * below)).sqrt()
}

/// Interpolation factor of 2024, within 0 … 1.
#[inline(always)]
fn factor_2024(k: f32, z: f32) -> f32 {
    factor(steepness_2024(k), z).clamp(0.0, 1.0)
}

/// Even correction of v13 without its factor `(1 − z²) e^{−t²z²}`: `c₀ + c₁ z²`.
///
/// It fades like `1/√κ` times `z² e^{−κz²/2}`: below 1e-8 from 1e4 on, where its powers would begin to leave the range of f32.
#[inline(always)]
fn correction_v13(k: f32, z: f32) -> f32 {
    let j = k.min(1e4);
    let one = horner(COSINE_V13_ONE, j);
    let nought = horner(COSINE_V13_NOUGHT, j);
    let root = one.sqrt();
    let one_power = one * root * root.sqrt();
    let nought_power = nought * nought * nought.sqrt();
    let square = z * z;
    let mixed = V13_NOUGHT * one_power + V13_ONE * square * nought_power;
    j * j * j * mixed / (one_power * nought_power)
}

/// Interpolation factor of v13, within 0 … 1.
#[inline(always)]
fn factor_v13(k: f32, z: f32) -> f32 {
    let t = steepness_v13(k);
    let tz = t * z;
    let even = (1.0 - z) * (1.0 + z) * exp(-tz * tz) * correction_v13(k, z);
    (factor(t, z) + even).clamp(0.0, 1.0)
}

/// Interpolation factor of v14, within 0 … 1: as v13 with a third even term.
#[inline(always)]
fn factor_v14(k: f32, z: f32) -> f32 {
    let above = horner(COSINE_V14_ABOVE, k);
    let below = horner(COSINE_V14_BELOW, k);
    let t = k * (above / (2.0 * below)).sqrt();
    // As in v13 the powers are evaluated up to 1e4, where the correction has faded.
    let j = k.min(1e4);
    let a = j * j + V14_NOUGHT_BELOW;
    let b = horner(COSINE_V14_ONE, j);
    let c = horner(COSINE_V14_TWO, j);
    let root = b.sqrt();
    let nought = V14_NOUGHT * j / (a * a * a.sqrt());
    let one = V14_ONE * j / (b * root * root.sqrt());
    let two = horner(COSINE_V14_TWO_ABOVE, j) / (c * c.sqrt());
    let square = z * z;
    let correction = ((two * square + one) * square + nought) * (j * j);
    let tz = t * z;
    let even = (1.0 - z) * (1.0 + z) * exp(-tz * tz) * correction;
    (factor(t, z) + even).clamp(0.0, 1.0)
}

/// Clamped-cosine integral of 2024 \[sr\]: one interpolation between the exact bounds.
///
/// `cosine` is `axis·normal`. Error at most 1.53e-3 of [`upper`], never negative.
/// Source: Tokuyoshi et al. 2024, "Hierarchical Light Sampling with Accurate Spherical Gaussian Lighting", section 5.1.
///
/// ```
/// use vsgl_core::sg::cosine;
/// let exact = cosine::interpolated_v13(50.0, 0.8);
/// assert!((cosine::interpolated_2024(50.0, 0.8) / exact - 1.0).abs() < 0.003);
/// ```
#[inline(always)]
#[must_use]
pub fn interpolated_2024(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let m = PolarMoments::new(k);
    let low = m.decay * m.lower;
    TAU * (low + factor_2024(k, cosine) * (m.upper - low))
}

/// Clamped-cosine integral \[sr\], refitted with an even correction: the default.
///
/// `cosine` is `axis·normal`. Error at most 1.2e-4 of [`upper`], never negative, monotone in the cosine;
/// `B(z) − B(−z) = z A(κ) L(κ)` holds as in the exact integral.
///
/// ```
/// use vsgl_core::sg::cosine;
/// // A constant lobe, and a direction.
/// assert!((cosine::interpolated_v13(0.0, 0.3) - std::f32::consts::PI).abs() < 1e-6);
/// let sharp = cosine::interpolated_v13(1e10, 0.3) * 1e10 / std::f32::consts::TAU;
/// assert!((sharp - 0.3).abs() < 1e-5);
/// ```
#[inline(always)]
#[must_use]
pub fn interpolated_v13(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let m = PolarMoments::new(k);
    let low = m.decay * m.lower;
    TAU * (low + factor_v13(k, cosine) * (m.upper - low))
}

/// Clamped-cosine integral \[sr\] with a third even term: error at most 4.5e-5 of [`upper`], otherwise as
/// [`interpolated_v13`], which is the cheaper default.
///
/// Ours, made by `scripts/fit_interpolations.py`.
///
/// ```
/// use vsgl_core::sg::cosine;
/// let other = cosine::interpolated_v13(50.0, 0.8);
/// assert!((cosine::interpolated_v14(50.0, 0.8) / other - 1.0).abs() < 1e-3);
/// ```
#[inline(always)]
#[must_use]
pub fn interpolated_v14(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let m = PolarMoments::new(k);
    let low = m.decay * m.lower;
    TAU * (low + factor_v14(k, cosine) * (m.upper - low))
}

/// Logarithm of the clamped-cosine integral, finite and of the right order also far below the horizon.
///
/// There the integral falls like `e^{−κ(1 − √(1 − z²))}`, leaves the range of `f32`, and [`interpolated_v13`] keeps no more
/// than its exact lower bound: enough for shading, not for a light tree that has to compare two lights below the horizon.
/// Above it this is the logarithm of [`interpolated_v13`]. The error is at most 13 % of one plus the logarithm's
/// magnitude, mostly for sharpness 10 … 100 close to the pole below; its mean is 0.2 %.
///
/// With the factor rewritten by `∫ erfc`, all its terms below the horizon share `e^{−t²z²}`, which is taken out and given the
/// exact rate. Ours.
///
/// ```
/// use vsgl_core::sg::cosine;
/// // The plain form is zero here.
/// assert!(cosine::log_interpolated(1e4, -0.9) < -1e3);
/// ```
#[inline(always)]
#[must_use]
pub fn log_interpolated(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let m = PolarMoments::new(k);
    let low = m.decay * m.lower;
    let above = log(low + factor_v13(k, cosine) * (m.upper - low));

    let z = cosine.min(0.0);
    let t = steepness_v13(k);
    let sine2 = (1.0 - z) * (1.0 + z);
    let own = erfc_integral_scaled(-t * z);
    let end = erfc_integral_scaled(t) * exp(-(t * t) * sine2);
    let step = (own - end).max(0.0) * (0.5 * INV_SQRT_PI / t.max(1e-30));
    let factor = step + sine2 * correction_v13(k, z);
    let rate = 2.0 * (t * t) * (z * z) / (1.0 + sine2.max(0.0).sqrt());
    let bent = log(factor * (m.upper - low)) - rate;
    let least = log(m.lower) - k;
    // Sum of the two, by their logarithms.
    let larger = bent.max(least);
    let below = larger + log(1.0 + exp(bent.min(least) - larger));
    // Wide lobes do not fade: they keep the plain form.
    let far = cosine < 0.0 && k > 1.0;
    log(TAU) + if far { below } else { above }
}

/// Clamped cosine averaged over a normalised lobe, `B(κ, z)/A(κ)`, by [`interpolated_v13`].
///
/// Within 0 … 1: ¼ at sharpness 0, `max(z, 0)` for a direction. The irradiance of a light of strength `c A(κ)` about
/// `axis` is that strength times this; error at most 1.3e-4 of the value at cosine 1.
///
/// ```
/// use vsgl_core::sg::cosine;
/// // A direction, and no direction at all.
/// assert!((cosine::mean_clamped_cosine(1e9, 0.6) - 0.6).abs() < 1e-4);
/// assert!((cosine::mean_clamped_cosine(0.0, 0.6) - 0.25).abs() < 1e-4);
/// ```
#[inline(always)]
#[must_use]
pub fn mean_clamped_cosine(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let m = PolarMoments::new(k);
    let low = m.decay * m.lower;
    (low + factor_v13(k, cosine) * (m.upper - low)) / m.sphere()
}

/// The odd half of `B`, exact: `B(z) − B(−z) = z A(κ) L(κ)` \[sr\].
///
/// ```
/// use vsgl_core::sg::cosine;
/// let (k, z) = (7.0, 0.3);
/// let difference = cosine::interpolated_v13(k, z) - cosine::interpolated_v13(k, -z);
/// assert!((difference / cosine::odd_part(k, z) - 1.0).abs() < 1e-4);
/// ```
#[inline(always)]
#[must_use]
pub fn odd_part(sharpness: f32, cosine: f32) -> f32 {
    cosine * lobe::integral(sharpness) * vmf::mean_length(sharpness)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHARPNESSES: [f32; 12] = [
        0.0,
        1e-30,
        1e-6,
        0.03,
        0.5,
        1.0,
        3.0,
        17.0,
        300.0,
        1e6,
        1e12,
        f32::MAX,
    ];

    #[test]
    fn bounds_at_the_poles() {
        for k in SHARPNESSES {
            for f in [interpolated_2024, interpolated_v13, interpolated_v14] {
                assert!((f(k, 1.0) / upper(k) - 1.0).abs() < 1e-6, "{k}");
                assert!((f(k, -1.0) - lower(k)).abs() <= 1e-6 * upper(k), "{k}");
            }
        }
    }

    #[test]
    fn odd_part_is_exact() {
        for k in SHARPNESSES {
            for z in [0.01, 0.3, 0.8, 1.0] {
                for f in [interpolated_2024, interpolated_v13, interpolated_v14] {
                    assert!(
                        (f(k, z) - f(k, -z) - odd_part(k, z)).abs() <= 1e-6 * upper(k),
                        "{k} {z}"
                    );
                }
            }
        }
    }

    #[test]
    fn value_on_the_horizon() {
        // B(κ, 0) = 2π e^{−κ} I₁(κ)/κ; I₁(1) = 0.565159103992485, I₁(10) = 2670.98830370125.
        for (k, bessel) in [(1.0f32, 0.565_159_1), (10.0, 2_670.988_3)] {
            let exact = TAU * (-k).exp() * bessel / k;
            assert!((interpolated_v13(k, 0.0) - exact).abs() < 1.3e-4 * upper(k));
            assert!((interpolated_2024(k, 0.0) - exact).abs() < 1.6e-3 * upper(k));
        }
    }

    #[test]
    fn mean_limits() {
        assert!((mean_clamped_cosine(0.0, -0.7) - 0.25).abs() < 1e-7);
        for z in [-1.0f32, -0.4, 0.0, 0.2, 1.0] {
            assert!((mean_clamped_cosine(f32::MAX, z) - z.max(0.0)).abs() < 1e-6);
        }
    }

    #[test]
    fn superseded_forms_are_in_their_range() {
        for (k, z) in [(0.5f32, 0.3f32), (3.0, 0.9), (20.0, 0.1), (300.0, 0.6)] {
            let peak = upper(k);
            let best = interpolated_v13(k, z);
            for (f, limit) in [
                (sg_2015 as fn(f32, f32) -> f32, 0.17),
                (sg_iwasaki_2012, 0.16),
                (sg_product, 0.16),
                (lobes_2018, 1.6e-2),
                (lobes_2022, 6e-3),
                (interpolated_2024, 1.7e-3),
            ] {
                assert!((f(k, z) - best).abs() < limit * peak, "{k} {z}");
            }
        }
    }
}
