//! Integral of a spherical Gaussian over a hemisphere.
//!
//! `H(κ, z) = ∫_{ω·n > 0} G(ω; ξ, κ) dω` with `z = ξ·n`. Between its bounds, reached with the axis at `±n`, it is an
//! interpolation `H = C₋ + v (C₊ − C₋)`; the published forms differ in `v`.
//!
//! | form | error / value at z = 1, max | mean |
//! |---|---|---|
//! | [`integral_2018`] | 1.2e-2 | 8.6e-4 |
//! | [`integral_2022`] | 4.9e-3 | 1.5e-4 |
//! | [`integral`] | 6.1e-4 | 3e-5 |

use std::f32::consts::TAU;

use super::lobe::SHARPNESS_MAX;
use super::polar::PolarMoments;
use crate::math::elementary::{
    INV_SQRT_PI, bessel_i0_scaled, erf, erfc_scaled, exp, expm1, expm1_over_x, log,
};
use crate::math::polynomial::horner;

/// Steepness of the logistic step of 2018 over `√κ κ`: numerator.
const HEMISPHERE_2018_ABOVE: [f32; 2] = [1.6988, 10.8438];

/// Its denominator.
const HEMISPHERE_2018_BELOW: [f32; 3] = [1.0, 6.2201, 10.2415];

/// Steepness of the step of 2022 over `κ`, squared.
const HEMISPHERE_2022_ABOVE: [f32; 2] = [0.5, 0.651_732_9];

const HEMISPHERE_2022_BELOW: [f32; 3] = [1.0, 1.341_828, 7.221_669];

/// The same of our form.
const HEMISPHERE_ODD_ABOVE: [f32; 2] = [0.5, 4.272_561_4];

const HEMISPHERE_ODD_BELOW: [f32; 3] = [1.0, 3.666_031_6, 24.360_69];

/// Depth of its odd correction for sharp lobes, times `√κ`, and denominator of the way there.
const HEMISPHERE_BEND: f32 = 0.965_734_6;

const HEMISPHERE_BEND_BELOW: [f32; 3] = [1.0, 1.952_873_5, 76.409_51];

crate::constants::shared!(
    scalars: [HEMISPHERE_BEND],
    polynomials: [
        HEMISPHERE_2018_ABOVE, HEMISPHERE_2018_BELOW, HEMISPHERE_2022_ABOVE,
        HEMISPHERE_2022_BELOW, HEMISPHERE_ODD_ABOVE, HEMISPHERE_ODD_BELOW,
        HEMISPHERE_BEND_BELOW,
    ]
);

/// Integral over the hemisphere about the axis \[sr\]: `2π (1 − e^{−κ})/κ`. Exact; 2π at sharpness 0.
///
/// ```
/// use vsgl_core::sg::hemisphere;
/// assert!((hemisphere::upper(0.0) - std::f32::consts::TAU).abs() < 1e-5);
/// ```
#[inline(always)]
#[must_use]
pub fn upper(sharpness: f32) -> f32 {
    TAU * PolarMoments::new(sharpness).mass
}

/// Integral over the hemisphere opposite to the axis \[sr\]: `2π e^{−κ} (1 − e^{−κ})/κ`. Exact; 2π at sharpness 0, and 0
/// above 87, where it would be below 1e-38.
///
/// ```
/// use vsgl_core::sg::hemisphere;
/// assert!(hemisphere::lower(10.0) < 1e-4 * hemisphere::upper(10.0));
/// ```
#[inline(always)]
#[must_use]
pub fn lower(sharpness: f32) -> f32 {
    let m = PolarMoments::new(sharpness);
    TAU * (m.decay * m.mass)
}

/// Logarithm of [`lower`], finite for every sharpness: about `−κ`.
///
/// ```
/// use vsgl_core::sg::hemisphere;
/// assert!((hemisphere::log_lower(2.0) - hemisphere::lower(2.0).ln()).abs() < 1e-5);
/// ```
#[inline(always)]
#[must_use]
pub fn log_lower(sharpness: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    log(TAU * PolarMoments::new(k).mass) - k
}

/// Interpolation factor of Meder and Brüderlin, a logistic function; `(1 + z)/2` at sharpness 0.
///
/// The printed quotient of exponentials overflows for sharpness above 670; half the quotient of two hyperbolic tangents
/// is the same function and does not.
#[inline(always)]
fn factor_2018(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness;
    let t = k.sqrt() * ((horner(HEMISPHERE_2018_ABOVE, k) * k) / horner(HEMISPHERE_2018_BELOW, k));
    // tanh(x/2) = (1 − e^{−x})/(1 + e^{−x}), with x ≥ 0.
    let a = -expm1(-t * cosine.abs());
    let b = -expm1(-t);
    let ratio = a * (2.0 - b) / ((2.0 - a) * b.max(1e-30));
    let signed = if cosine < 0.0 { -ratio } else { ratio };
    let linear = 0.5 * (1.0 + cosine);
    if t < 1e-6 {
        linear
    } else {
        (0.5 + 0.5 * signed).clamp(0.0, 1.0)
    }
}

/// `t` of Tokuyoshi 2022: the inverse width of the step across the horizon. Like `0.30 κ` for small, `√(κ/2)` for large
/// sharpness.
#[inline(always)]
fn steepness_2022(k: f32) -> f32 {
    k * (horner(HEMISPHERE_2022_ABOVE, k) / horner(HEMISPHERE_2022_BELOW, k)).sqrt()
}

/// Interpolation factor of Tokuyoshi 2022, an error function; `(1 + z)/2` at sharpness 0, where the listing has 0/0.
#[inline(always)]
fn factor_2022(sharpness: f32, cosine: f32) -> f32 {
    let t = steepness_2022(sharpness);
    let ratio = erf(t * cosine) / erf(t).max(1e-30);
    let linear = 0.5 * (1.0 + cosine);
    if t < 1e-6 {
        linear
    } else {
        (0.5 + 0.5 * ratio).clamp(0.0, 1.0)
    }
}

/// Interpolation factor of our own: an error function with an odd correction `z (1 − z²) e^{−t²z²} d(κ)`.
///
/// The correction keeps `v(z) + v(−z) = 1` and the ends, and has the width of the step.
#[inline(always)]
fn factor_odd(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness;
    let t = k * (horner(HEMISPHERE_ODD_ABOVE, k) / horner(HEMISPHERE_ODD_BELOW, k)).sqrt();
    let tz = t * cosine;
    let ratio = erf(tz) / erf(t).max(1e-30);
    // Beyond 1e6 the correction is below 1e-6.
    let j = k.min(1e6);
    let depth = HEMISPHERE_BEND * (j * j) / (horner(HEMISPHERE_BEND_BELOW, j) * (j + 1.0).sqrt());
    let bend = cosine * ((1.0 - cosine) * (1.0 + cosine)) * exp(-tz * tz) * depth;
    let linear = 0.5 * (1.0 + cosine);
    let bent = (0.5 + 0.5 * ratio - bend).clamp(0.0, 1.0);
    if t < 1e-6 { linear } else { bent }
}

/// Hemispherical integral \[sr\] with the logistic interpolation of 2018. Superseded; for comparison.
///
/// `cosine` is `axis·normal`. Error at most 1.25e-2 of the value at cosine 1.
/// Source: Meder and Brüderlin 2018, "Hemispherical Gaussians for Accurate Light Integration", Eq. 13.
///
/// ```
/// use vsgl_core::sg::hemisphere;
/// let better = hemisphere::integral(20.0, 0.1);
/// assert!((hemisphere::integral_2018(20.0, 0.1) / better - 1.0).abs() < 0.03);
/// ```
#[inline(always)]
#[must_use]
pub fn integral_2018(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let m = PolarMoments::new(k);
    let v = factor_2018(k, cosine);
    TAU * m.mass * (m.decay + v * (1.0 - m.decay))
}

/// Hemispherical integral \[sr\] with the error-function interpolation of 2022.
///
/// `cosine` is `axis·normal`. Error at most 4.8e-3 of the value at cosine 1; `H(z) + H(−z)` is the whole integral exactly.
/// Source: Tokuyoshi 2022, "Accurate Diffuse Lighting from Spherical Gaussian Lights", supplement, section 2.2.
///
/// ```
/// use vsgl_core::sg::{hemisphere, lobe};
/// let (above, below) = (hemisphere::integral_2022(8.0, 0.4), hemisphere::integral_2022(8.0, -0.4));
/// assert!(((above + below) / lobe::integral(8.0) - 1.0).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn integral_2022(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let m = PolarMoments::new(k);
    let v = factor_2022(k, cosine);
    TAU * m.mass * (m.decay + v * (1.0 - m.decay))
}

/// [`integral_2022`] of the normalised lobe: the share of a von Mises–Fisher distribution that lies above the horizon,
/// within 0 … 1, ½ at cosine 0 or sharpness 0.
///
/// Source: Tokuyoshi et al. 2024, "Hierarchical Light Sampling with Accurate Spherical Gaussian Lighting", section 4.4.
///
/// ```
/// use vsgl_core::sg::hemisphere;
/// assert!((hemisphere::share_2022(20.0, 0.0) - 0.5).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn share_2022(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let decay = exp(-k);
    let v = factor_2022(k, cosine);
    (v + decay * (1.0 - v)) / (1.0 + decay)
}

/// Hemispherical integral \[sr\], refitted with an odd correction: the most accurate here.
///
/// `cosine` is `axis·normal`. Error at most 6.2e-4 of the value at cosine 1; `H(z) + H(−z)` is the whole integral exactly.
/// Ours, made by `scripts/fit_interpolations.py`.
///
/// ```
/// use vsgl_core::sg::hemisphere;
/// assert!((hemisphere::integral(0.0, -0.3) - std::f32::consts::TAU).abs() < 1e-5);
/// ```
#[inline(always)]
#[must_use]
pub fn integral(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let m = PolarMoments::new(k);
    let v = factor_odd(k, cosine);
    TAU * m.mass * (m.decay + v * (1.0 - m.decay))
}

/// [`integral`] of the normalised lobe, 0 … 1: its share above the horizon.
///
/// ```
/// use vsgl_core::sg::hemisphere;
/// assert!((hemisphere::share(20.0, 0.3) + hemisphere::share(20.0, -0.3) - 1.0).abs() < 1e-5);
/// ```
#[inline(always)]
#[must_use]
pub fn share(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let decay = exp(-k);
    let v = factor_odd(k, cosine);
    (v + decay * (1.0 - v)) / (1.0 + decay)
}

/// Logarithm of the hemispherical integral, finite for every argument and accurate far below the horizon, where the integral
/// leaves the range of `f32` and [`integral`] keeps no digit.
///
/// `cosine` is `axis·normal`. The error of the logarithm is at most 0.045, at sharpness 4 … 6 with the axis at the pole below,
/// and there at most 0.024 above sharpness 8, 0.01 above 13; add a few roundings of the logarithm itself. Above the horizon and
/// below sharpness 4 this is the logarithm of [`integral`], error at most 9e-3.
///
/// With the horizon as equator the integral is `2π e^{−κ} ∫₀¹ I₀(κ s √(1 − y²)) e^{−κ|z| y} dy`, `s = √(1 − z²)`; a Gaussian
/// in `y` takes the place of the Bessel function, as high as it and as wide as makes the horizon exact. Ours,
/// `docs/derivations.md`.
///
/// ```
/// use vsgl_core::sg::hemisphere;
/// // The limit −ln κ − κ + ln 2π at the pole.
/// let pole = hemisphere::log_integral(1e4, -1.0);
/// assert!((pole + 1e4 + 7.37).abs() < 0.01);
/// ```
#[inline(always)]
#[must_use]
pub fn log_integral(sharpness: f32, cosine: f32) -> f32 {
    let k = sharpness.min(SHARPNESS_MAX);
    let m = PolarMoments::new(k);
    let v = factor_odd(k, cosine);
    let plain = log(TAU * m.mass * (m.decay + v * (1.0 - m.decay)));

    let z = cosine.clamp(-1.0, 0.0);
    let s = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    let x = k * s;
    let bessel = bessel_i0_scaled(x);
    let reach = expm1_over_x(-2.0 * x) / bessel;
    let across = reach * erfc_scaled(-k * z * reach * INV_SQRT_PI);
    let far = log(TAU * bessel * across) - k * (z * z / (1.0 + s));

    let weight = if cosine < 0.0 {
        (0.5 * k - 2.0).clamp(0.0, 1.0)
    } else {
        0.0
    };
    plain + weight * (far - plain)
}

/// Logarithm of the share above the horizon: [`log_integral`] of the normalised lobe, with its error. At most about 0.
///
/// ```
/// use vsgl_core::sg::hemisphere;
/// assert!(hemisphere::log_share(1e4, -0.9) < -1e3);
/// ```
#[inline(always)]
#[must_use]
pub fn log_share(sharpness: f32, cosine: f32) -> f32 {
    log_integral(sharpness, cosine) - log(TAU * PolarMoments::new(sharpness).sphere())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Logarithm of the integral by quadrature.
    fn log_exact(k: f64, z: f64) -> f64 {
        let s = (1.0 - z * z).max(0.0).sqrt();
        let (n, turns) = (2000, 200);
        let far = (40.0 / (k * z.abs() + k.sqrt())).min(1.0);
        let mut sum = 0.0;
        for i in 0..n {
            let y = (f64::from(i) + 0.5) / f64::from(n) * far;
            let x = k * s * (1.0 - y * y).sqrt();
            let turn = |j: i32| (f64::from(j) + 0.5) / f64::from(turns) * std::f64::consts::PI;
            let ring: f64 = (0..turns).map(|j| (x * turn(j).cos() - k * s).exp()).sum();
            sum += ring / f64::from(turns) * (k * z * y).exp();
        }
        (sum * far / f64::from(n) * std::f64::consts::TAU).ln() - k * (z * z / (1.0 + s))
    }

    #[test]
    fn log_integral_agrees_with_quadrature() {
        let mut worst = [0.0f64; 3];
        for k in [
            0.0f32, 0.3, 1.0, 3.0, 3.9, 4.5, 5.0, 6.0, 7.0, 9.0, 14.0, 30.0, 100.0, 1000.0,
        ] {
            for z in [-1.0f32, -0.999, -0.95, -0.8, -0.5, -0.2, -0.05, -0.003] {
                let exact = log_exact(f64::from(k), f64::from(z));
                let error =
                    (f64::from(log_integral(k, z)) - exact).abs() / (1.0 + 1e-6 * exact.abs());
                let range = if k < 4.0 {
                    0
                } else if k < 13.0 {
                    1
                } else {
                    2
                };
                worst[range] = worst[range].max(error);
            }
        }

        assert!(
            worst[0] < 9e-3 && worst[1] < 0.045 && worst[2] < 0.01,
            "{worst:?}"
        );
    }

    #[test]
    fn log_integral_limits() {
        for k in [0.0f32, 1e-30, 0.5, 4.0, 6.0, 40.0, 1e4, 1e12, f32::MAX] {
            let mut last = f32::MIN;
            for i in 0..=400 {
                let z = i as f32 / 200.0 - 1.0;
                let value = log_integral(k, z);
                assert!(value.is_finite(), "{k} {z}");
                assert!(
                    value >= last - 1e-6 * last.abs() - 1e-4,
                    "{k} {z} {last} {value}"
                );
                last = value;
            }
            // No step at the horizon.
            let (below, above) = (log_integral(k, -1e-30), log_integral(k, 0.0));
            assert!(
                (below - above).abs() < 2e-5 + 1e-6 * above.abs(),
                "{k} {below} {above}"
            );
            assert!((log_share(k, 0.0) - 0.5f32.ln()).abs() < 2e-5, "{k}");
        }
    }
    use crate::sg::lobe;

    #[test]
    fn bounds_at_the_poles() {
        for k in [0.0, 1e-8, 0.3, 2.0, 40.0, 1e4, 1e12, f32::MAX] {
            for f in [integral_2018, integral_2022, integral] {
                assert!((f(k, 1.0) / upper(k) - 1.0).abs() < 1e-6, "{k}");
                assert!((f(k, -1.0) - lower(k)).abs() <= 1e-6 * upper(k), "{k}");
                assert!(
                    (f(k, 0.0) / (0.5 * lobe::integral(k)) - 1.0).abs() < 1e-6,
                    "{k}"
                );
            }
        }
    }

    #[test]
    fn share_is_the_normalised_integral() {
        for k in [0.0, 0.3, 2.0, 40.0] {
            for z in [-0.9, -0.1, 0.0, 0.2, 0.99] {
                let expected = integral_2022(k, z) / lobe::integral(k);
                assert!((share_2022(k, z) - expected).abs() < 3e-7, "{k} {z}");
            }
        }
    }
}
