//! Exponential, logarithm and error functions in `f32`, built from `+ - * /`, `floor`, comparisons and bits only.
//!
//! Standard libraries and shader compilers each round these functions in their own way. The ones here are texts:
//! every backend that repeats them operation for operation obtains the same bits, and a loop over lanes vectorises.
//! Polynomials are in Horner form from the highest coefficient down. The coefficients, in `coefficients.rs`, are our own
//! minimax fits.
//!
//! Arguments are finite. Errors were measured against exact values, see `docs/accuracy.md`.

use super::coefficients::*;
use super::polynomial::horner;

/// Above this argument [`exp`] stays at its value there, about 1.65e38.
pub const EXP_ARGUMENT_MAX: f32 = 88.0;

/// Below this argument [`exp`] is zero: its value would leave the normal numbers, which some devices flush.
pub const EXP_ARGUMENT_MIN: f32 = -87.0;

/// Below this argument `e^x − 1` is −1 to rounding. Smaller ones would be computed with subnormal numbers, which are slow.
const EXPM1_ARGUMENT_MIN: f32 = -30.0;

/// `1/√π`.
pub const INV_SQRT_PI: f32 = 0.564_189_6;

crate::constants::shared!(
    scalars: [
        EXP_ARGUMENT_MAX, EXP_ARGUMENT_MIN, EXPM1_ARGUMENT_MIN, INV_SQRT_PI, LN_2_HEAD,
        LN_2_TAIL, ERF_SQUARE, ERFC_VALUE_MAX, BESSEL_SQUARE, BESSEL_ROOT, ERF_INTEGRAL_SQUARE,
    ],
    polynomials: [
        EXP_SLOPE, EXP_SHORT, LOG, ERF, ERFC_SCALED, ERFC_INVERSE_CENTRE, ERFC_INVERSE_TAIL,
        BESSEL_NEAR, BESSEL_FAR, ERF_INTEGRAL, ERFC_INTEGRAL_SCALED, SINE, COSINE,
    ]
);

/// An argument split as `x = n ln 2 + r`, with what [`exp`] and its relatives share.
#[derive(Clone, Copy)]
struct Reduced {
    /// `n`, a whole number in -126 … 127.
    whole: f32,
    /// `2ⁿ`.
    scale: f32,
    /// `r`, within ±0.3466.
    rest: f32,
    /// `(eʳ − 1)/r`.
    slope: f32,
}

#[inline(always)]
fn reduce(x: f32) -> Reduced {
    let x = x.clamp(EXP_ARGUMENT_MIN, EXP_ARGUMENT_MAX);
    let whole = (x * std::f32::consts::LOG2_E + 0.5).floor();
    // ln 2 in two parts; the first has few bits, so that its product with a small whole number is exact.
    let rest = (x - whole * LN_2_HEAD) - whole * LN_2_TAIL;
    let slope = horner(EXP_SLOPE, rest);
    // 2^23 + 127 + n has n + 127 in its lowest bits; the shift drops the rest and leaves the bits of 2ⁿ. No conversion
    // to an integer, which would saturate in Rust and not elsewhere.
    let scale = f32::from_bits((whole + 8_388_735.0).to_bits() << 23);
    Reduced {
        whole,
        scale,
        rest,
        slope,
    }
}

/// `e^x`.
///
/// Zero below [`EXP_ARGUMENT_MIN`], constant above [`EXP_ARGUMENT_MAX`]: always finite, never subnormal, monotone.
/// Relative error at most 1e-7 between.
///
/// ```
/// use vsgl_core::math::elementary;
/// assert!((elementary::exp(1.0) - std::f32::consts::E).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn exp(x: f32) -> f32 {
    let r = reduce(x);
    let value = (r.slope * r.rest + 1.0) * r.scale;
    if x < EXP_ARGUMENT_MIN { 0.0 } else { value }
}

/// `e^x − 1` without cancellation, relative error at most 1.5e-7. Saturates above [`EXP_ARGUMENT_MAX`] as [`exp`] does.
///
/// ```
/// use vsgl_core::math::elementary;
/// assert!((elementary::expm1(1e-5) / 1.000005e-5 - 1.0).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn expm1(x: f32) -> f32 {
    let r = reduce(x.max(EXPM1_ARGUMENT_MIN));
    let near = r.slope * r.rest;
    let far = near * r.scale + (r.scale - 1.0);
    if r.whole == 0.0 { near } else { far }
}

/// `(e^x − 1)/x`, 1 at 0, relative error at most 1.3e-7; tends to `−1/x` for `x → −∞`.
///
/// Near zero this is the polynomial of the reduction itself, so nothing is divided by a small number.
/// Meant for `x ≤ 0`; saturates above [`EXP_ARGUMENT_MAX`].
///
/// ```
/// use vsgl_core::math::elementary;
/// assert_eq!(elementary::expm1_over_x(0.0), 1.0);
/// ```
#[inline(always)]
#[must_use]
pub fn expm1_over_x(x: f32) -> f32 {
    let r = reduce(x.max(EXPM1_ARGUMENT_MIN));
    let near = r.whole == 0.0;
    // The division is always carried out: one under a condition would keep loops from becoming vectors.
    let far = (r.slope * r.rest * r.scale + (r.scale - 1.0)) * (1.0 / (if near { 1.0 } else { x }));
    if near { r.slope } else { far }
}

/// Natural logarithm, relative error at most 1.2e-7 for normal positive `x`.
///
/// Zero, negative and subnormal arguments give `ln 2⁻¹²⁶ ≈ −87.34`: always finite.
///
/// ```
/// use vsgl_core::math::elementary;
/// assert!((elementary::log(2.0) - std::f32::consts::LN_2).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn log(x: f32) -> f32 {
    let bits = x.max(f32::MIN_POSITIVE).to_bits();
    // Exponent and mantissa such that the mantissa lies in [√½, √2): the bits of √½ become the zero of the count.
    let shifted = bits.wrapping_sub(0x3f35_04f3);
    let exponent = ((shifted as i32) >> 23) as f32;
    let mantissa = f32::from_bits((shifted & 0x007f_ffff).wrapping_add(0x3f35_04f3));
    let m = mantissa - 1.0;
    let p = horner(LOG, m);
    p * m + exponent * std::f32::consts::LN_2
}

/// Error function, odd, relative error at most 2.3e-7; ±1 beyond ±3.9.
///
/// One polynomial for the whole range: no exponential and no division. For the complement of large arguments use
/// [`erfc`], since `1 − erf(x)` has no correct digit beyond 3.7.
///
/// ```
/// use vsgl_core::math::elementary;
/// assert!((elementary::erf(0.5) - 0.520_499_9).abs() < 1e-6);
/// ```
#[inline(always)]
#[must_use]
pub fn erf(x: f32) -> f32 {
    let u = x.clamp(-3.9, 3.9);
    let s = u * u * ERF_SQUARE - 1.0;
    let p = horner(ERF, s);
    let near = (p * u).clamp(-1.0, 1.0);
    let right = if x < 3.9 { near } else { 1.0 };
    if x > -3.9 { right } else { -1.0 }
}

/// `e^{−u²}` without the relative error of `u²` 6e-8 that a rounded square would cost; `u` in 0 … 10.
#[inline(always)]
fn exp_minus_square(u: f32) -> f32 {
    // The head of u squares exactly; what is left of the exponent is below 0.05, where a short series is enough.
    let head = f32::from_bits(u.to_bits() & 0xffff_f000);
    let rest = (u - head) * (u + head);
    let correction = horner(EXP_SHORT, rest);
    exp(-(head * head)) * correction
}

/// Complementary error function `1 − erf(x)`, relative error at most 3e-7; 0 beyond about 9.3.
///
/// `e^{x²} erfc(x)` is smooth and slowly varying: a polynomial in `(x − 2)/(x + 2)` after division by `1 + 2x`.
/// Source of that form: Shepherd and Laframboise 1981, "Chebyshev Approximation of (1+2x)exp(x²)erfc x in 0 ≤ x < ∞";
/// the coefficients are our own, for `f32`.
///
/// ```
/// use vsgl_core::math::elementary;
/// assert!((elementary::erfc(5.0) / 1.537_46e-12 - 1.0).abs() < 1e-4);
/// ```
#[inline(always)]
#[must_use]
pub fn erfc(x: f32) -> f32 {
    let u = x.abs().min(10.0);
    let tail = exp_minus_square(u) * erfc_scaled(u);
    if x < 0.0 { 2.0 - tail } else { tail }
}

/// `e^{x²} erfc(x)` for `x ≥ 0`: 1 at 0, falls like `1/(√π x)`; relative error at most 3e-7.
#[inline(always)]
#[must_use]
pub fn erfc_scaled(x: f32) -> f32 {
    let u = x.clamp(0.0, 10.0);
    let q = (u - 2.0) / (u + 2.0);
    let p = horner(ERFC_SCALED, q);
    // Beyond, four terms of the asymptotic series.
    let inverse = 1.0 / x.clamp(10.0, 1e30);
    let r = inverse * inverse;
    let far = ((-1.875 * r + 0.75) * r - 0.5) * r + 1.0;
    if x < 10.0 {
        p / (1.0 + 2.0 * u)
    } else {
        far * inverse * INV_SQRT_PI
    }
}

/// Inverse of [`erfc`] for values of 1e-7 … 2 − 1e-7, to which the argument is clamped: within ±3.77.
///
/// Absolute error at most 1.5e-6 for values up to 1, beyond which the rounding of the value itself counts.
/// Source: Giles 2012, "Approximating the erfinv Function" (GPU Computing Gems), single precision.
#[inline(always)]
#[must_use]
pub fn erfc_inverse(value: f32) -> f32 {
    let y = value.clamp(1e-7, ERFC_VALUE_MAX);
    let w = -log(y * (2.0 - y));
    let a = w - 2.5;
    let p = horner(ERFC_INVERSE_CENTRE, a);
    let b = w.max(0.0).sqrt() - 3.0;
    let t = horner(ERFC_INVERSE_TAIL, b);
    (if w < 5.0 { p } else { t }) * (1.0 - y)
}

/// `e^{−x} I₀(x)` for `x ≥ 0` with the modified Bessel function: 1 at 0, falls like `1/√(2πx)`; relative error at most
/// 5e-7.
///
/// Source: Abramowitz and Stegun 1964, "Handbook of Mathematical Functions", 9.8.1 and 9.8.2.
#[inline(always)]
#[must_use]
pub fn bessel_i0_scaled(x: f32) -> f32 {
    let near = x.clamp(0.0, 3.75);
    let s = (near * near) * BESSEL_SQUARE;
    let p = horner(BESSEL_NEAR, s);
    let far = x.clamp(3.75, 1e30);
    let t = 3.75 / far;
    let q = horner(BESSEL_FAR, t);
    if x < 3.75 {
        p * exp(-near)
    } else {
        // 1/√3.75 is what the root of t lacks.
        q * t.sqrt() * BESSEL_ROOT
    }
}

/// `∫₀ᵘ erf(s) ds = u erf(u) − (1 − e^{−u²})/√π` for `u ≥ 0`; error at most 2e-7 `u`.
///
/// The interpolation of the clamped-cosine integrals consists of two of these and of no other special function, see
/// [`crate::sg::cosine`]. Grows like `u²/√π` from 0 and like `u − 1/√π` to infinity.
#[inline(always)]
#[must_use]
pub fn erf_integral(u: f32) -> f32 {
    let v = u.min(3.5);
    let w = v * v;
    let s = w * ERF_INTEGRAL_SQUARE - 1.0;
    let p = horner(ERF_INTEGRAL, s);
    if u < 3.5 { p * w } else { u - INV_SQRT_PI }
}

/// `∫ₓ^∞ erfc(s) ds = e^{−x²}/√π − x erfc(x)` for `x ≥ 0`, relative error at most 8e-7; 0 beyond about 9.2.
///
/// What a Gaussian leaves on the far side of a plane; both terms of the definition cancel for large `x`.
#[inline(always)]
#[must_use]
pub fn erfc_integral(x: f32) -> f32 {
    let u = x.clamp(0.0, 10.0);
    exp_minus_square(u) * INV_SQRT_PI * erfc_integral_scaled(u)
}

/// `√π e^{x²}` times [`erfc_integral`]: 1 at 0, falls like `1/(2x²)`; relative error at most 5e-7.
#[inline(always)]
#[must_use]
pub fn erfc_integral_scaled(x: f32) -> f32 {
    let u = x.clamp(0.0, 1e15);
    let q = (u - 2.0) / (u + 2.0);
    let p = horner(ERFC_INTEGRAL_SCALED, q);
    p / (1.0 + 2.0 * (u * u))
}

/// Sine and cosine of `2π turns`, absolute error at most 1.5e-7 within ±16 turns.
#[inline(always)]
#[must_use]
pub fn sin_cos_turns(turns: f32) -> (f32, f32) {
    let quarter = (4.0 * turns + 0.5).floor();
    // Both exact: the product, and a difference of close numbers.
    let u = turns - 0.25 * quarter;
    let square = u * u;
    let p = horner(SINE, square);
    let sine = p * u;
    let q = horner(COSINE, square);
    let cosine = q * square + 1.0;
    // Remainder of the quarter by 4, within 0 … 3.
    let turn = quarter - 4.0 * (0.25 * quarter).floor();
    let odd = turn - 2.0 * (0.5 * turn).floor() > 0.5;
    let (s, c) = if odd { (cosine, sine) } else { (sine, cosine) };
    let sine_negative = turn > 1.5;
    let cosine_negative = (turn - 1.5).abs() < 1.0;
    (
        if sine_negative { -s } else { s },
        if cosine_negative { -c } else { c },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn relative(value: f32, exact: f64) -> f64 {
        (f64::from(value) - exact).abs() / exact.abs().max(f64::from(f32::MIN_POSITIVE))
    }

    /// Largest relative error of `f` over evenly spaced arguments.
    fn worst(low: f64, high: f64, f: impl Fn(f32) -> f32, exact: impl Fn(f64) -> f64) -> f64 {
        (0..=200_000)
            .map(|i| (low + (high - low) * f64::from(i) / 200_000.0) as f32)
            .map(|x| relative(f(x), exact(f64::from(x))))
            .fold(0.0, f64::max)
    }

    #[test]
    fn agree_with_libm() {
        assert!(worst(-87.0, 88.0, exp, libm::exp) < 1.0e-7);
        assert!(worst(-20.0, 20.0, expm1, libm::expm1) < 1.5e-7);
        assert!(worst(-1.1, 1.1, expm1, libm::expm1) < 1.5e-7);
        assert!(worst(-30.0, -1e-3, expm1_over_x, |x| libm::expm1(x) / x) < 1.5e-7);
        assert!(worst(1e-6, 40.0, log, libm::log) < 1.25e-7);
        assert!(worst(-4.5, 4.5, erf, libm::erf) < 2.5e-7);
        assert!(worst(-4.0, 9.1, erfc, libm::erfc) < 3.2e-7);
        let integral =
            |u: f64| u * libm::erf(u) + libm::expm1(-u * u) / std::f64::consts::PI.sqrt();
        assert!(worst(0.2, 30.0, erf_integral, integral) < 2e-6);
        for i in 0..20_000 {
            let u = i as f32 * 1e-3;
            assert!(
                (f64::from(erf_integral(u)) - integral(f64::from(u))).abs() <= 2e-7 * f64::from(u)
            );
        }
    }

    #[test]
    fn scaled_and_inverse() {
        let erfcx = |x: f64| libm::exp(x * x) * libm::erfc(x);
        assert!(worst(0.0, 10.0, erfc_scaled, erfcx) < 3e-7);
        assert!(worst(10.0, 25.0, erfc_scaled, erfcx) < 3e-7);
        let far = 1.0 / (1e6 * std::f64::consts::PI.sqrt());
        assert!(relative(erfc_scaled(1e6), far) < 3e-7);
        for i in 0..=40_000 {
            let x = -3.5 + 7.2 * f64::from(i) / 40_000.0;
            let value = libm::erfc(x) as f32;
            // What half a unit of the rounded value is worth in the argument.
            let slope = libm::exp(-x * x) * std::f64::consts::FRAC_2_SQRT_PI;
            let blur = f64::from(value) * 6e-8 / slope;
            let error = (f64::from(erfc_inverse(value)) - x).abs();
            assert!(error < 1.5e-6 + 2.0 * blur, "{x} {error} {blur}");
        }
        assert!(erfc_inverse(0.0).is_finite() && erfc_inverse(2.0).is_finite());
        // I₀(x) = ∫₀^π e^{x cos φ} dφ/π; the trapezoidal rule of a periodic function converges at once.
        let bessel = |x: f64| {
            let n = 400;
            (0..n)
                .map(|i| {
                    (x * ((f64::from(i) + 0.5) / f64::from(n) * std::f64::consts::PI).cos() - x)
                        .exp()
                })
                .sum::<f64>()
                / f64::from(n)
        };
        for i in 0..=2_000 {
            let x = f64::from(i) * 0.02;
            let error = relative(bessel_i0_scaled(x as f32), bessel(f64::from(x as f32)));
            assert!(error < 6e-7, "{x} {error}");
        }
    }

    #[test]
    fn tails_and_turns() {
        let scaled = |x: f64| {
            // Continued fraction of √π e^{x²} erfc for large x, direct below.
            let erfcx = libm::exp(x * x) * libm::erfc(x);
            1.0 - std::f64::consts::PI.sqrt() * x * erfcx
        };
        assert!(worst(0.0, 5.0, erfc_integral_scaled, scaled) < 6e-7);
        let tail = |x: f64| libm::exp(-x * x) / std::f64::consts::PI.sqrt() - x * libm::erfc(x);
        assert!(worst(0.0, 5.0, erfc_integral, tail) < 8e-7);
        for i in -40_000..=40_000 {
            let turns = i as f32 * 3.7e-4;
            let (s, c) = sin_cos_turns(turns);
            let angle = f64::from(turns) * std::f64::consts::TAU;
            assert!(
                (f64::from(s) - angle.sin()).abs() < 1.5e-7
                    && (f64::from(c) - angle.cos()).abs() < 1.5e-7
            );
        }
    }

    #[test]
    fn logarithm_over_all_exponents() {
        for exponent in -126..=127 {
            for i in 0..64 {
                let x = (f64::from(1 + i) / 64.0 + 1.0) * 2f64.powi(exponent);
                let x = (x as f32).min(f32::MAX);
                assert!(
                    (f64::from(log(x)) - libm::log(f64::from(x))).abs()
                        < 1.2e-7 * libm::log(f64::from(x)).abs() + 6e-8
                );
            }
        }
        assert_eq!(log(1.0), 0.0);
        assert_eq!(log(0.0), log(f32::MIN_POSITIVE));
    }

    #[test]
    fn edges() {
        assert_eq!(exp(0.0), 1.0);
        assert_eq!(exp(-0.0), 1.0);
        assert_eq!(exp(f32::MIN), 0.0);
        assert!(exp(f32::MAX).is_finite());
        assert_eq!(expm1(0.0), 0.0);
        assert_eq!(expm1(1e-30), 1e-30);
        assert_eq!(expm1(f32::MIN), -1.0);
        assert_eq!(expm1_over_x(0.0), 1.0);
        assert_eq!(expm1_over_x(1e-40), 1.0);
        assert_eq!(expm1_over_x(-1e30), 1e-30);
        assert_eq!(erf(0.0), 0.0);
        assert_eq!(erf(f32::MAX), 1.0);
        assert_eq!(erfc(0.0), 1.0);
        assert_eq!(erfc(f32::MAX), 0.0);
        assert_eq!(erfc(f32::MIN), 2.0);
        assert_eq!(erf_integral(0.0), 0.0);
        assert!(erf_integral(f32::MAX).is_finite());
    }
}
