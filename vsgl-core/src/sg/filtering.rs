//! NDF filtering in a tangent frame: anisotropic roughness, reflection and refraction.
//!
//! The general case of [`crate::sg::glossy`], which is the faster path for isotropic reflection. The light's covariance
//! `2/κ`, carried from directions to half vectors by the Jacobian `J` at the normal, is added to the roughness in
//! projected space: `S = (A⁻¹ − E)⁻¹ + (2/κ) J Jᵀ`, `Ā = (S⁻¹ + E)⁻¹`. With `S` a matrix of quotients this over- and
//! underflows and cancels; here numerators and denominator are multiplied with `κ²`, `1 − α²` and the Jacobian's
//! denominator and stay sums of non-negative terms.
//!
//! Frame: normal `+z`, roughness `alpha_x` along `x` and `alpha_y` along `y`.
//!
//! Source: Tokuyoshi et al. 2024, "Hierarchical Light Sampling with Accurate Spherical Gaussian Lighting", sections 1, 5.2
//! and Eq. 12; their expanded determinant pairs `β_x` with `γ₁₁`, where multiplying out gives the crossed pairing used
//! here. Homogeneous form: ours, `docs/derivations.md`.

use std::f32::consts::PI;

use glam::Vec3;

use super::glossy::{ALPHA_MIN, REST_MIN, VIEW_COSINE_MIN, core_on_tail};
use super::lobe::{self, SHARPNESS_MAX};
use super::{cosine, hemisphere};

/// A surface with two roughnesses seen from one direction.
#[derive(Clone, Copy, Debug)]
pub struct FilteredView {
    view: Vec3,
    /// Squared roughnesses and their complements.
    ax: f32,
    ay: f32,
    cx: f32,
    cy: f32,
    /// Axis times sharpness of the unfiltered surface's wide lobe.
    outgoing: Vec3,
    /// Square of the Jacobian's denominator over 4, and whether it degenerates.
    quarter: f32,
    /// Squared cosine of the outgoing axis, times 1 or the squared index.
    cos2: f32,
    /// `κ⁰` factor of `det J Jᵀ` in these units.
    constant: f32,
    /// `1/η²`; 1 for reflection.
    inverse_index2: f32,
    /// `√(vᵀ A v + z²)`.
    reach: f32,
}

/// The filtered roughness matrix at one sharpness, as fractions over a common denominator.
struct Filtered {
    /// Determinant of the matrix, and its numerator.
    determinant: f32,
    numerator: f32,
    /// 1 over the denominator.
    inverse: f32,
    k: f32,
    /// Weight of the Jacobian's part.
    bent: f32,
}

impl FilteredView {
    /// For reflection; `view` is a unit vector in the tangent frame. Roughness is clamped to [`ALPHA_MIN`] … 1 and the
    /// view's cosine raised to [`VIEW_COSINE_MIN`].
    #[inline(always)]
    #[must_use]
    pub fn reflection(view: Vec3, alpha_x: f32, alpha_y: f32) -> Self {
        let z = view.z.max(VIEW_COSINE_MIN);
        let view = Vec3::new(view.x, view.y, z);
        let cos2 = z * z;
        Self::new(
            view,
            alpha_x,
            alpha_y,
            Vec3::new(-view.x, -view.y, z),
            cos2,
            cos2,
            0.25,
            1.0,
        )
    }

    /// For refraction into a medium of relative index `index` (transmitted side over view's side).
    ///
    /// Total internal reflection has no transmitted lobe: its density is 0. As the index tends to 1 the Jacobian
    /// degenerates, no roughness bends light any more and the light's own lobe passes unfiltered.
    #[inline(always)]
    #[must_use]
    pub fn refraction(view: Vec3, alpha_x: f32, alpha_y: f32, index: f32) -> Self {
        let z = view.z.max(VIEW_COSINE_MIN);
        let view = Vec3::new(view.x, view.y, z);
        let excess = (index - 1.0) * (index + 1.0);
        // η |o_z|, by Snell.
        let bent = (excess + z * z).max(0.0).sqrt();
        let inverse = 1.0 / index.max(1e-3);
        let outgoing = Vec3::new(-view.x * inverse, -view.y * inverse, -bent * inverse);
        let cos2 = (outgoing.z * outgoing.z).max(1e-12);
        // Denominator (v·h) + η (o·h) of the Jacobian over η, written without the difference.
        let denominator = (excess / (bent + z)).abs().max(1e-4) * inverse;
        let m2 = denominator * denominator;
        Self::new(
            view,
            alpha_x,
            alpha_y,
            outgoing,
            cos2,
            0.25 * m2,
            cos2 / m2,
            inverse * inverse,
        )
    }

    #[inline(always)]
    #[expect(
        clippy::too_many_arguments,
        reason = "private, one call for each of two cases"
    )]
    fn new(
        view: Vec3,
        alpha_x: f32,
        alpha_y: f32,
        outgoing: Vec3,
        cos2: f32,
        quarter: f32,
        constant: f32,
        inverse_index2: f32,
    ) -> Self {
        let alpha_x = alpha_x.clamp(ALPHA_MIN, 1.0);
        let alpha_y = alpha_y.clamp(ALPHA_MIN, 1.0);
        let (ax, ay) = (alpha_x * alpha_x, alpha_y * alpha_y);
        let cx = ((1.0 - alpha_x) * (1.0 + alpha_x)).max(REST_MIN);
        let cy = ((1.0 - alpha_y) * (1.0 + alpha_y)).max(REST_MIN);
        let wide = ax.max(ay);
        let sharpness = 0.5 * cx.min(cy) / wide;
        let reach = (ax * (view.x * view.x) + ay * (view.y * view.y) + view.z * view.z).sqrt();
        let outgoing = outgoing * sharpness;
        Self {
            view,
            ax,
            ay,
            cx,
            cy,
            outgoing,
            quarter,
            cos2,
            constant,
            inverse_index2,
            reach,
        }
    }

    #[inline(always)]
    fn filter(&self, sharpness: f32) -> Filtered {
        let k = sharpness.min(SHARPNESS_MAX);
        // Entries of the Jacobian's matrix along the roughness axes; 1 − cos² is the squared sine, over η².
        let g11 = self.cos2 + self.view.y * self.view.y * self.inverse_index2;
        let g22 = self.cos2 + self.view.x * self.view.x * self.inverse_index2;
        let both = self.cx * self.cy;
        let crossed = 0.5 * (self.ax * self.cy * g22 + self.ay * self.cx * g11);
        let constant = both * self.constant;
        let numerator = (self.quarter * self.ax * self.ay * k + crossed) * k + constant;
        let bent = 0.5 * both * k;
        let denominator = (self.quarter * k + (crossed + 0.5 * both * (g11 + g22))) * k + constant;
        // Zero for a constant light on a rough surface at a grazing view, where a device has no subnormal numbers.
        let inverse = 1.0 / denominator.max(f32::MIN_POSITIVE);
        Filtered {
            determinant: numerator * inverse,
            numerator,
            inverse,
            k,
            bent,
        }
    }

    /// `wᵀ adj(Ā) w + det(Ā) w_z²` for a half vector of any length.
    #[inline(always)]
    fn half_form(&self, f: &Filtered, half: Vec3) -> f32 {
        let (x2, y2) = (half.x * half.x, half.y * half.y);
        let along = half.x * self.view.x + half.y * self.view.y;
        let own = self.quarter * f.k * f.k * (self.ay * self.cx * x2 + self.ax * self.cy * y2);
        let bent = f.bent * (self.cos2 * (x2 + y2) + along * along * self.inverse_index2);
        let above = own + bent + f.numerator * (x2 + y2);
        (above * f.inverse + f.determinant * (half.z * half.z)).max(f32::MIN_POSITIVE)
    }

    /// `√(vᵀ Ā v + z²)`: projected area of the filtered surface.
    #[inline(always)]
    fn area(&self, f: &Filtered) -> f32 {
        let (x2, y2) = (self.view.x * self.view.x, self.view.y * self.view.y);
        let own = self.quarter * f.k * f.k * (self.ax * self.cy * x2 + self.ay * self.cx * y2);
        let above = own + (f.bent * self.cos2 + f.numerator) * (x2 + y2);
        (above * f.inverse + self.view.z * self.view.z).sqrt()
    }

    /// Density \[1/sr\] of reflected directions at the light's `axis`, filtered by a light of `sharpness`.
    ///
    /// For a view made by [`FilteredView::reflection`]. Integrates to 1 over the sphere.
    #[inline(always)]
    #[must_use]
    pub fn reflected_density(&self, axis: Vec3, sharpness: f32) -> f32 {
        let f = self.filter(sharpness);
        let half = self.view + axis;
        let length2 = half.dot(half);
        let form = self.half_form(&f, half);
        let shape = f.determinant.sqrt() * (f.determinant * length2 / form) * (length2 / form);
        shape / (4.0 * PI * self.area(&f))
    }

    /// Density \[1/sr\] of reflected directions at the light's `axis`, blurred by a light of `sharpness`: a Gaussian core on
    /// the tail of the unblurred surface, as [`GlossyView::density`](super::glossy::GlossyView::density) has it, with the
    /// roots of the matrices' determinants in place of `alpha²`.
    ///
    /// For a view made by [`FilteredView::reflection`]. A tail that follows the ratio of roughnesses in the half vector's own
    /// direction was tried and is no better.
    #[inline(always)]
    #[must_use]
    pub fn density(&self, axis: Vec3, sharpness: f32) -> f32 {
        let f = self.filter(sharpness);
        let half = self.view + axis;
        let length2 = half.dot(half);
        let form = self.half_form(&f, half);
        let root = f.determinant.sqrt();
        let density =
            root * (f.determinant * length2 / form) * (length2 / form) / (4.0 * PI * self.area(&f));
        let level = (f.determinant * (half.z * half.z)).max(f32::MIN_POSITIVE);
        let unblurred = (self.ax * self.ay).sqrt() / root.max(f32::MIN_POSITIVE);
        core_on_tail(unblurred, root, form / level) * density
    }

    /// Density \[1/sr\] of refracted directions at the light's `axis`, filtered by a light of `sharpness`.
    ///
    /// For a view made by [`FilteredView::refraction`] with the same `index`. Zero where no microfacet refracts the view
    /// towards `axis`. The generalised half vector `v + η o` enters unnormalised: its length cancels against the Jacobian.
    #[inline(always)]
    #[must_use]
    pub fn refracted_density(&self, axis: Vec3, sharpness: f32, index: f32) -> f32 {
        let f = self.filter(sharpness);
        let half = self.view + axis * index;
        let form = self.half_form(&f, half);
        let (view_side, light_side) = (self.view.dot(half), axis.dot(half));
        // The two directions lie on either side of the microfacet.
        let crossing = (-view_side * light_side).max(0.0);
        let shape = f.determinant.sqrt() * (f.determinant / form) * (crossing / form);
        let transmitted = if self.outgoing.z < 0.0 { shape } else { 0.0 };
        transmitted * (index * index) / (PI * self.area(&f))
    }

    /// Share of the outgoing lobe on its side of the surface, 0 … 1, and that share times masking for reflection.
    #[inline(always)]
    fn shares(&self, axis: Vec3, sharpness: f32, side: f32) -> (f32, f32) {
        let sum = self.outgoing + axis * sharpness.min(SHARPNESS_MAX);
        let length = sum.dot(sum).sqrt();
        let z = (side * sum.z / length.max(1e-18)).clamp(-1.0, 1.0);
        let k = length.min(SHARPNESS_MAX);
        let share = hemisphere::share_2022(k, z);
        let mean = cosine::mean_clamped_cosine(k, z);
        // Roughness towards the lobe's azimuth.
        let (x2, y2) = (sum.x * sum.x, sum.y * sum.y);
        let weight = x2 + y2;
        let mixed = (self.ax * x2 + self.ay * y2) / weight.max(1e-30);
        let a = if weight > 1e-30 {
            mixed
        } else {
            self.ax.max(self.ay)
        };
        let light_reach = (a * (share * share) + (1.0 - a).max(0.0) * (mean * mean)).sqrt();
        let above = 2.0 * mean * self.reach * share;
        (
            share,
            above / (self.reach * mean + self.view.z * light_reach).max(1e-30),
        )
    }

    /// Reflected radiance for a light of strength 1 and Fresnel factor 1, as published in 2024: `V p̄`.
    #[inline(always)]
    #[must_use]
    pub fn filtered_2024(&self, axis: Vec3, sharpness: f32) -> f32 {
        self.shares(axis, sharpness, 1.0).0 * self.reflected_density(axis, sharpness)
    }

    /// [`FilteredView::density`] times `V` and the masking ratio `G₂/G₁`, see
    /// [`crate::sg::glossy::GlossyView::masked_share`].
    #[inline(always)]
    #[must_use]
    pub fn masked(&self, axis: Vec3, sharpness: f32, horizon_sharpness: f32) -> f32 {
        self.shares(axis, horizon_sharpness, 1.0).1 * self.density(axis, sharpness)
    }

    /// Transmitted radiance for a light of strength 1 and transmittance 1: the refracted density times the share of the
    /// lobe below the surface.
    ///
    /// For sharp lights only. Against a quadrature of the transmitted GGX lobe (separable masking; roughness 0.1 … 0.5, index 1.33,
    /// 1.5 and 1/1.5, cosines 0.5 … 1) towards the refracted view it is too large by a fifth on average and by 42 % at most at
    /// sharpness 300; at sharpness 3 by up to 12 times, since the Jacobian at the normal spreads a wide light over more half
    /// vectors than refract, and the result exceeds the light's peak. Away from the peak the relative error is larger.
    #[inline(always)]
    #[must_use]
    pub fn transmitted_2024(&self, axis: Vec3, sharpness: f32, index: f32) -> f32 {
        self.shares(axis, sharpness, -1.0).0 * self.refracted_density(axis, sharpness, index)
    }
}

/// `∫ f (ω·n) G dω` for a light of peak 1 and Fresnel factor 1 on an anisotropic surface, with masking.
///
/// `view` and `axis` are unit vectors in the tangent frame; the result is radiance per radiance at the light's peak.
///
/// ```
/// use vsgl_core::glam::Vec3;
/// use vsgl_core::sg::filtering;
/// let (view, mirrored) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8));
/// let peak = filtering::masked(view, 0.2, 0.1, mirrored, 100.0);
/// assert!(peak > filtering::masked(view, 0.2, 0.1, view, 100.0));
/// ```
#[inline(always)]
#[must_use]
pub fn masked(view: Vec3, alpha_x: f32, alpha_y: f32, axis: Vec3, sharpness: f32) -> f32 {
    FilteredView::reflection(view, alpha_x, alpha_y).masked(axis, sharpness, sharpness)
        * lobe::integral(sharpness)
}

/// `∫ f (ω·n) G dω` for a light of peak 1 and Fresnel factor 1 on an anisotropic surface, as published in 2024.
#[inline(always)]
#[must_use]
pub fn filtered_2024(view: Vec3, alpha_x: f32, alpha_y: f32, axis: Vec3, sharpness: f32) -> f32 {
    FilteredView::reflection(view, alpha_x, alpha_y).filtered_2024(axis, sharpness)
        * lobe::integral(sharpness)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::ggx_local;
    use crate::brdf::roughness::Roughness;
    use crate::math::vec::tilted;
    use crate::sg::glossy::GlossyView;

    fn over_the_sphere(f: impl Fn(Vec3) -> f32) -> f64 {
        let (rows, columns) = (800, 800);
        let mut sum = 0.0f64;
        for row in 0..rows {
            let height = 1.0 - 2.0 * (row as f32 + 0.5) / rows as f32;
            for column in 0..columns {
                sum += f64::from(f(tilted(
                    height,
                    (column as f32 + 0.5) * 2.0 * PI / columns as f32,
                )));
            }
        }
        sum * f64::from(4.0 * PI) / f64::from(rows * columns)
    }

    #[test]
    fn isotropic_agrees_with_dot_products() {
        for (alpha, k) in [(0.3, 30.0), (0.05, 2000.0), (0.9, 0.1), (1.0, 0.0)] {
            let (view, axis) = (tilted(0.6, 0.1), tilted(0.7, 2.9));
            let local = FilteredView::reflection(view, alpha, alpha);
            let world = GlossyView::new(view, Vec3::Z, alpha);
            assert!(
                (local.reflected_density(axis, k) / world.density_2024(axis, k) - 1.0).abs() < 1e-5
            );
            assert!((local.masked(axis, k, k) / world.masked(axis, k, k) - 1.0).abs() < 1e-5);
        }
    }

    #[test]
    fn reflected_density_integrates_to_one() {
        for (ax, ay, cosine, k) in [
            (0.5, 0.2, 0.7, 20.0),
            (0.3, 0.9, 0.2, 1e4),
            (0.2, 0.6, 1.0, 0.0),
        ] {
            let view = FilteredView::reflection(tilted(cosine, 0.4), ax, ay);
            let integral = over_the_sphere(|o| view.reflected_density(o, k));
            assert!(
                (integral - 1.0).abs() < 5e-3,
                "{ax} {ay} {cosine} {k}: {integral}"
            );
        }
    }

    #[test]
    fn refracted_density_integrates_to_one() {
        // From the thin into the dense medium every microfacet that is seen refracts.
        for (ax, ay, cosine, k, index) in [(0.3, 0.3, 0.8, 1e6, 1.5), (0.2, 0.4, 0.9, 1e6, 1.33)] {
            let view = FilteredView::refraction(tilted(cosine, 0.4), ax, ay, index);
            let integral = over_the_sphere(|o| view.refracted_density(o, k, index));
            assert!(
                (integral - 1.0).abs() < 2e-2,
                "{ax} {ay} {cosine} {index}: {integral}"
            );
        }
        let inside = FilteredView::refraction(tilted(0.3, 0.0), 0.1, 0.1, 1.0 / 1.5);
        assert_eq!(
            inside.refracted_density(-Vec3::Z, 10.0, 1.0 / 1.5),
            0.0,
            "total internal reflection"
        );
    }

    /// Transmitted radiance of GGX (Walter et al. 2007, Eq. 21, transmittance 1) under a light, by quadrature over visible
    /// normals: `∫ G₂/G₁ · G(o) D_v dh` with the refracted direction `o` of each.
    fn refracted_by_quadrature(
        view: Vec3,
        alpha: (f32, f32),
        axis: Vec3,
        k: f32,
        index: f32,
    ) -> f64 {
        let roughness = Roughness::aligned(alpha.0, alpha.1);
        let n = 500;
        let mut sum = 0.0f64;
        for i in 0..n * n {
            let (u, v) = ((i % n) as f32 + 0.5, (i / n) as f32 + 0.5);
            let half =
                ggx_local::sample_visible_normal(view, roughness, u / n as f32, v / n as f32);
            let along = view.dot(half);
            let bent = 1.0 - (1.0 - along * along) / (index * index);
            if bent <= 0.0 || along <= 0.0 {
                continue;
            }
            let out = half * (along / index - bent.sqrt()) - view / index;
            if out.z >= 0.0 {
                continue;
            }
            // Separable masking and shadowing.
            let shadow = 1.0 / (1.0 + f64::from(ggx_local::lambda(out, roughness)));
            let gap = f64::from((out - axis).length_squared()) * 0.5;
            sum += shadow * (-f64::from(k) * gap).exp();
        }
        sum / f64::from(n * n)
    }

    #[test]
    fn refraction_against_quadrature() {
        // At the refracted view, where the lobe peaks.
        let (mut sum, mut worst, mut count) = (0.0f64, 0.0f64, 0);
        for (ax, ay) in [(0.1, 0.1), (0.3, 0.3), (0.5, 0.5), (0.2, 0.5)] {
            for (index, cosine) in [(1.33f32, 1.0f32), (1.33, 0.5), (1.5, 0.8), (1.0 / 1.5, 0.8)] {
                let view = tilted(cosine, 0.4);
                let depth = (1.0 - (1.0 - cosine * cosine) / (index * index)).sqrt();
                let axis = Vec3::new(-view.x / index, -view.y / index, -depth);
                let exact = refracted_by_quadrature(view, (ax, ay), axis, 300.0, index);
                let local = FilteredView::refraction(view, ax, ay, index);
                let value =
                    f64::from(local.transmitted_2024(axis, 300.0, index) * lobe::integral(300.0));
                let error = (value / exact - 1.0).abs();
                sum += error;
                worst = worst.max(error);
                count += 1;
            }
        }
        let mean = sum / f64::from(count);
        assert!(mean < 0.27 && worst < 0.45, "{mean} {worst}");
    }

    #[test]
    fn extremes_are_finite() {
        for (ax, ay) in [
            (0.0, 1.0),
            (1e-4, 1e-4),
            (1e-4, 1.0),
            (0.3, 0.7),
            (1.0, 1.0),
        ] {
            for cosine in [-1.0, 0.0, 1e-6, 0.5, 1.0] {
                for k in [0.0, 1e-40, 1e-10, 1.0, 1e8, f32::MAX] {
                    for axis in [
                        Vec3::Z,
                        -Vec3::Z,
                        tilted(cosine, 0.0),
                        -tilted(cosine, 0.0),
                        tilted(1e-6, 1.0),
                    ] {
                        let view = FilteredView::reflection(tilted(cosine, 0.0), ax, ay);
                        let value = view.masked(axis, k, k);
                        assert!(
                            value.is_finite() && value >= 0.0,
                            "{ax} {ay} {cosine} {k} {axis}"
                        );
                        for index in [0.5, 1.0, 1.000_1, 1.5] {
                            let view = FilteredView::refraction(tilted(cosine, 0.0), ax, ay, index);
                            let value = view.transmitted_2024(axis, k, index);
                            assert!(
                                value.is_finite() && value >= 0.0,
                                "{ax} {ay} {cosine} {k} {axis} {index}"
                            );
                        }
                    }
                }
            }
        }
    }
}
