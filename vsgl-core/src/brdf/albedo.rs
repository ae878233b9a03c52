//! Directional albedo of the GGX lobe: what share of light from one direction it reflects in all.

use glam::Vec3;

use super::ggx;
use crate::math::polynomial::horner;

/// Numerator of the loss: coefficients of `p` as polynomials in roughness, from the constant up.
const ALBEDO_ABOVE_0: [f32; 4] = [2.380_291_4e-2, -5.420_340_6e-2, 3.647_007e-2, -4.340_96e-3];

const ALBEDO_ABOVE_1: [f32; 3] = [0.690_236_3, 0.175_009_1, 0.197_991_46];

const ALBEDO_ABOVE_2: [f32; 2] = [-0.274_850_22, 7.652_091e-3];

const ALBEDO_ABOVE_3: f32 = -0.199_871_32;

/// Denominator of the loss.
const ALBEDO_BELOW_0: [f32; 3] = [0.576_382_4, -1.289_446_2, 1.0];

const ALBEDO_BELOW_1: [f32; 2] = [1.305_199_4, 0.229_110_51];

const ALBEDO_BELOW_2: f32 = -0.966_559_6;

/// Effective cosine: coefficients of `pⁱ rʲ` as polynomials in `s`.
const EFFECTIVE_00: [f32; 4] = [-0.387_809_1, 0.147_051_95, 1.290_437_3, -7.341_055_7e-3];

const EFFECTIVE_01: [f32; 3] = [1.309_804_7, -0.459_051_45, 0.325_711_5];

const EFFECTIVE_02: [f32; 2] = [-0.881_692_5, -0.157_153_23];

const EFFECTIVE_03: f32 = -0.716_228;

const EFFECTIVE_10: [f32; 3] = [1.150_085_1e-2, -3.827_944_8e-2, 5.692_958e-3];

const EFFECTIVE_11: [f32; 2] = [-0.370_475_86, -0.273_857_84];

const EFFECTIVE_12: f32 = 0.989_525;

const EFFECTIVE_20: [f32; 2] = [-0.245_802_66, 1.292_970_2e-2];

const EFFECTIVE_21: f32 = -3.698_079_7e-2;

const EFFECTIVE_30: f32 = -1.249_554_9e-2;

crate::constants::shared!(
    scalars: [
        ALBEDO_ABOVE_3, ALBEDO_BELOW_2, EFFECTIVE_03, EFFECTIVE_12, EFFECTIVE_21, EFFECTIVE_30,
    ],
    polynomials: [
        ALBEDO_ABOVE_0, ALBEDO_ABOVE_1, ALBEDO_ABOVE_2, ALBEDO_BELOW_0, ALBEDO_BELOW_1,
        EFFECTIVE_00, EFFECTIVE_01, EFFECTIVE_02, EFFECTIVE_10, EFFECTIVE_11, EFFECTIVE_20,
    ]
);

/// Albedo for Schlick's Fresnel `f0 + (f90 − f0)(1 − c)⁵` as `f0 · a + f90 · b`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Albedo {
    /// Weight of the reflectance at normal incidence, 0 … 1.
    pub a: f32,
    /// Weight of the reflectance at grazing incidence, 0 … 1; `a + b` is at most 1.
    pub b: f32,
}

impl Albedo {
    /// `f0 a + f90 b`, for each colour.
    #[inline(always)]
    #[must_use]
    pub fn weigh(self, f0: Vec3, f90: Vec3) -> Vec3 {
        f0 * self.a + f90 * self.b
    }
}

/// Directional albedo of `F D G₂/(4 v o)` (GGX, height-correlated Smith, single scattering) at `cosine` to the normal.
///
/// Absolute error of `a + b` and of `b` at most 7e-3 for `alpha` of 5e-4 … 1; below it is that of 5e-4.
/// A closed form without tables. For Fresnel factor 1 the loss `1 − a − b` is a rational function of roughness and of
/// `cos/√(α² + (1 − α²) cos²)`: in that variable surfaces of all roughnesses look alike at grazing angles. `b/(a + b)` is
/// `(1 − c)⁵` at an effective cosine, which is nearly a polynomial.
///
/// Our own fit, made by `scripts/fit_albedo.py` from a quadrature over visible normals.
///
/// ```
/// use vsgl_core::brdf::albedo::ggx_albedo;
/// let smooth = ggx_albedo(0.8, 0.01);
/// assert!((smooth.a + smooth.b - 1.0).abs() < 0.01);
/// let rough = ggx_albedo(1.0, 1.0);
/// assert!((rough.a + rough.b - 0.307).abs() < 0.01);
/// ```
#[inline(always)]
#[must_use]
pub fn ggx_albedo(cosine: f32, alpha: f32) -> Albedo {
    let alpha = alpha.clamp(5e-4, 1.0);
    let mu = cosine.clamp(0.0, 1.0);
    let s = ggx::reach(mu, alpha * alpha);
    let p = mu / s;
    let r = alpha.sqrt();

    // Nested Horner: inner polynomials in alpha, outer in p.
    let above_0 = horner(ALBEDO_ABOVE_0, alpha);
    let above_1 = horner(ALBEDO_ABOVE_1, alpha);
    let above_2 = horner(ALBEDO_ABOVE_2, alpha);
    let above = ((ALBEDO_ABOVE_3 * p + above_2) * p + above_1) * p + above_0;
    let below_0 = horner(ALBEDO_BELOW_0, alpha);
    let below_1 = horner(ALBEDO_BELOW_1, alpha);
    let below = (ALBEDO_BELOW_2 * p + below_1) * p + below_0;
    let total = (1.0 - above / below).clamp(0.0, 1.0);

    // Polynomial of degree 3 in (p, r, s): innermost in s, then r, outermost p.
    let c00 = horner(EFFECTIVE_00, s);
    let c01 = horner(EFFECTIVE_01, s);
    let c02 = horner(EFFECTIVE_02, s);
    let c0 = ((EFFECTIVE_03 * r + c02) * r + c01) * r + c00;
    let c10 = horner(EFFECTIVE_10, s);
    let c11 = horner(EFFECTIVE_11, s);
    let c1 = (EFFECTIVE_12 * r + c11) * r + c10;
    let c2 = EFFECTIVE_21 * r + horner(EFFECTIVE_20, s);
    let effective = ((EFFECTIVE_30 * p + c2) * p + c1) * p + c0;
    let bend = 1.0 - effective.clamp(0.0, 1.0);
    let square = bend * bend;
    let b = total * (square * square * bend);
    Albedo { a: total - b, b }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The two integrals by a product rule over visible normals (spherical caps).
    fn exact(mu: f64, alpha: f64) -> (f64, f64) {
        let n = 200;
        let sine = (1.0 - mu * mu).max(0.0).sqrt();
        let scale = 1.0 / (alpha * alpha * sine * sine + mu * mu).sqrt();
        let (vx, vz) = (alpha * sine * scale, mu * scale);
        let reach = |c: f64| (alpha * alpha + (1.0 - alpha * alpha) * c * c).sqrt();
        let (mut a, mut b) = (0.0, 0.0);
        for i in 0..n {
            let turn = (f64::from(i) + 0.5) / f64::from(n) * std::f64::consts::PI;
            for j in 0..n {
                let z = (1.0 - (f64::from(j) + 0.5) / f64::from(n)) * (1.0 + vz) - vz;
                let ring = (1.0 - z * z).max(0.0).sqrt();
                let (x, y, z) = (
                    alpha * (ring * turn.cos() + vx),
                    alpha * ring * turn.sin(),
                    z + vz,
                );
                let inverse = 1.0 / (x * x + y * y + z * z).sqrt();
                let c = (x * sine + z * mu) * inverse;
                let o = (2.0 * c * z * inverse - mu).max(0.0);
                let weight = o * (mu + reach(mu)) / (o * reach(mu) + reach(o) * mu);
                let schlick = (1.0 - c).max(0.0).powi(5);
                a += weight * (1.0 - schlick);
                b += weight * schlick;
            }
        }
        (a / f64::from(n * n), b / f64::from(n * n))
    }

    #[test]
    fn agrees_with_quadrature() {
        let (mut worst_total, mut worst_b) = (0.0f64, 0.0f64);
        for i in 0..24 {
            let mu = (f64::from(i) + 0.4) / 24.0;
            for j in 0..12 {
                let alpha = ((f64::from(j) + 0.7) / 12.0).powi(2);
                let (a, b) = exact(mu, alpha);
                let value = ggx_albedo(mu as f32, alpha as f32);
                worst_total = worst_total.max((f64::from(value.a + value.b) - a - b).abs());
                worst_b = worst_b.max((f64::from(value.b) - b).abs());
            }
        }
        assert!(
            worst_total < 7e-3 && worst_b < 7e-3,
            "{worst_total} {worst_b}"
        );
    }

    #[test]
    fn stays_in_range() {
        for i in 0..=100 {
            for j in 0..=100 {
                let (cosine, alpha) = ((i as f32 / 100.0).powi(4), (j as f32 / 100.0).powi(4));
                let value = ggx_albedo(cosine, alpha);
                assert!(
                    value.a >= 0.0 && value.b >= 0.0 && value.a + value.b <= 1.0 + 1e-6,
                    "{cosine} {alpha}"
                );
            }
        }
    }
}
