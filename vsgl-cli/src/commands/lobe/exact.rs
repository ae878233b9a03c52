//! Exact integrals in `f64` by quadrature, for the plots.

use std::f64::consts::{PI, TAU};

/// `e^{−x} I₀(x)` by the trapezoid rule, which converges exponentially for periodic functions.
fn bessel_scaled(x: f64) -> f64 {
    let n = (24.0 + 8.0 * x.sqrt()) as usize;
    let sum: f64 = (0..n)
        .map(|i| (x * (((i as f64 + 0.5) * PI / n as f64).cos() - 1.0)).exp())
        .sum();
    sum / n as f64
}

/// `∫₀¹ u^power 2π e^{−κ} I₀(κ s √(1 − u²)) e^{κ z u} du`: hemispherical integral for power 0, clamped cosine for 1.
pub(super) fn above_horizon(sharpness: f64, cosine: f64, power: i32) -> f64 {
    let (k, z) = (sharpness, cosine);
    let s = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    // Nodes in the angle to the horizon, where the integrand is smooth and its peak as wide as the lobe; denser towards the
    // ends, which raises the order of the midpoint rule.
    let n = 200 + (12.0 * k.sqrt()) as usize;
    let sum: f64 = (0..n)
        .map(|i| (i as f64 + 0.5) / n as f64)
        .map(|t| {
            let within = t * (1.0 - t);
            let (u, c) = (t * t * t * (10.0 - t * (15.0 - 6.0 * t)) * 0.5 * PI).sin_cos();
            let x = k * s * c;
            30.0 * (within * within)
                * u.powi(power)
                * c
                * bessel_scaled(x)
                * (x + k * z * u - k).exp()
        })
        .sum();
    TAU * sum * 0.5 * PI / n as f64
}

/// `∫ f (ω·n) G dω` for isotropic GGX, Fresnel factor 1, light and view in one plane with the normal; angles from the normal,
/// that of the light towards the mirrored side.
pub(super) fn glossy(alpha: f64, view_angle: f64, light_angle: f64, sharpness: f64) -> f64 {
    let n = 160;
    let (vs, vc) = view_angle.sin_cos();
    let (ls, lc) = light_angle.sin_cos();
    let axis = [-ls, 0.0, lc];
    let reach = |z: f64| (alpha * alpha + (1.0 - alpha * alpha) * z * z).sqrt();
    let grid = |f: &dyn Fn(f64, f64) -> f64| -> f64 {
        let step = |i: usize| (i as f64 + 0.5) / n as f64;
        (0..n)
            .flat_map(|i| (0..n).map(move |j| (i, j)))
            .map(|(i, j)| f(step(i), step(j)))
            .sum::<f64>()
            / (n * n) as f64
    };
    if 2.0 * sharpness * alpha * alpha < 1.0 {
        // The light is wide: over visible normals.
        let stretch = 1.0 / (alpha * alpha * vs * vs + vc * vc).sqrt();
        let (sx, sz) = (alpha * vs * stretch, vc * stretch);
        grid(&|u, v| {
            let z = (1.0 - v) * (1.0 + sz) - sz;
            let ring = (1.0 - z * z).max(0.0).sqrt();
            let turn = TAU * u;
            let h = [
                alpha * (ring * turn.cos() + sx),
                alpha * ring * turn.sin(),
                z + sz,
            ];
            let length = (h[0] * h[0] + h[1] * h[1] + h[2] * h[2]).sqrt();
            let h = h.map(|c| c / length);
            let c = h[0] * vs + h[2] * vc;
            let o = [2.0 * c * h[0] - vs, 2.0 * c * h[1], 2.0 * c * h[2] - vc];
            let oz = o[2].max(0.0);
            let weight = oz * (vc + reach(vc)) / (oz * reach(vc) + reach(oz) * vc);
            let chord2: f64 = (0..3).map(|i| (o[i] - axis[i]).powi(2)).sum();
            weight * (-0.5 * sharpness * chord2).exp()
        })
    } else {
        // The light is narrow: over its own directions, `t = 1 − cos` from its axis as the square of a uniform variable.
        let end = (36.0 / sharpness).min(2.0).sqrt();
        let side = [lc, 0.0, ls];
        grid(&|u, v| {
            let t = (u * end).powi(2);
            let (ct, st) = (1.0 - t, (t * (2.0 - t)).sqrt());
            let (sin, cos) = (TAU * v).sin_cos();
            let o = [
                ct * axis[0] + st * cos * side[0],
                st * sin,
                ct * axis[2] + st * cos * side[2],
            ];
            let oz = o[2].max(0.0);
            let h = [o[0] + vs, o[1], o[2] + vc];
            let flat = h[0] * h[0] + h[1] * h[1];
            let form = flat + alpha * alpha * h[2] * h[2];
            let d = alpha * alpha / PI * ((flat + h[2] * h[2]) / form).powi(2);
            let f = d * oz / (2.0 * (reach(vc) * oz + reach(oz) * vc));
            f * (-sharpness * t).exp() * 2.0 * u * end * end * TAU
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_closed_forms() {
        for k in [0.01f64, 1.0, 30.0, 1e4] {
            let e = (-k).exp();
            let cosine = TAU
                * if k < 0.1 {
                    0.5 - k / 6.0 + k * k / 24.0
                } else {
                    (e - 1.0 + k) / (k * k)
                };
            assert!(
                (above_horizon(k, 1.0, 1) / cosine - 1.0).abs() < 1e-5,
                "{k}"
            );
            let half = TAU * (1.0 - e * e) / (2.0 * k);
            assert!((above_horizon(k, 0.0, 0) / half - 1.0).abs() < 1e-5, "{k}");
        }
    }

    #[test]
    fn glossy_peak_is_that_of_the_mixture() {
        // Normal incidence, small alpha, b = 2 κ α² = 1: 1 − e E₁(1).
        assert!((glossy(0.01, 0.0, 0.0, 5000.0) - 0.403_65).abs() < 1e-3);
        assert!((glossy(0.01, 0.0, 0.0, 4999.0) - 0.403_7).abs() < 1e-3);
    }
}
