//! Directional albedo of the GGX lobe: what share of light from one direction it reflects in all.

use glam::Vec3;

use super::ggx;

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
    let above_0 =
        ((2.380_291_4e-2 * alpha - 5.420_340_6e-2) * alpha + 3.647_007e-2) * alpha - 4.340_96e-3;
    let above_1 = (0.690_236_3 * alpha + 0.175_009_1) * alpha + 0.197_991_46;
    let above_2 = -0.274_850_22 * alpha + 7.652_091e-3;
    let above = ((-0.199_871_32 * p + above_2) * p + above_1) * p + above_0;
    let below_0 = (0.576_382_4 * alpha - 1.289_446_2) * alpha + 1.0;
    let below_1 = 1.305_199_4 * alpha + 0.229_110_51;
    let below = (-0.966_559_6 * p + below_1) * p + below_0;
    let total = (1.0 - above / below).clamp(0.0, 1.0);

    // Polynomial of degree 3 in (p, r, s): innermost in s, then r, outermost p.
    let c00 = ((-0.387_809_1 * s + 0.147_051_95) * s + 1.290_437_3) * s - 7.341_055_7e-3;
    let c01 = (1.309_804_7 * s - 0.459_051_45) * s + 0.325_711_5;
    let c02 = -0.881_692_5 * s - 0.157_153_23;
    let c0 = ((-0.716_228 * r + c02) * r + c01) * r + c00;
    let c10 = (1.150_085_1e-2 * s - 3.827_944_8e-2) * s + 5.692_958e-3;
    let c11 = -0.370_475_86 * s - 0.273_857_84;
    let c1 = (0.989_525 * r + c11) * r + c10;
    let c2 = -3.698_079_7e-2 * r + (-0.245_802_66 * s + 1.292_970_2e-2);
    let effective = ((-1.249_554_9e-2 * p + c2) * p + c1) * p + c0;
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
