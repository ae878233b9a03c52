//! Roughness matrices: anisotropic roughness, also where it does not lie along the tangents.

/// Least determinant, so that quotients stay finite.
const DETERMINANT_MIN: f32 = 1.175_494_4e-38;

crate::constants::shared!(scalars: [DETERMINANT_MIN], polynomials: []);

/// A symmetric positive roughness matrix `A` in the tangent plane; `diag(α_x², α_y²)` along its own axes.
///
/// Slopes of the microsurface have covariance `A/2` (Beckmann) or scale like `A^{1/2}` (GGX). Directions below are in a
/// tangent frame with the normal at `+z`.
///
/// Source: Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", section 5.3 (stretching);
/// Tokuyoshi and Kaplanyan 2021, "Stable Geometric Specular Antialiasing with Projected-Space NDF Filtering" (matrices).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// First diagonal entry.
    pub xx: f32,
    /// Off-diagonal entry.
    pub xy: f32,
    /// Second diagonal entry.
    pub yy: f32,
    /// Determinant. Held beside the entries, which lose it when one roughness is much larger than the other.
    pub determinant: f32,
}

impl Roughness {
    /// Isotropic roughness α.
    #[inline(always)]
    #[must_use]
    pub fn isotropic(alpha: f32) -> Self {
        Self::aligned(alpha, alpha)
    }

    /// Roughness `alpha_x` along the first and `alpha_y` along the second tangent.
    #[inline(always)]
    #[must_use]
    pub fn aligned(alpha_x: f32, alpha_y: f32) -> Self {
        let root = alpha_x * alpha_y;
        Self {
            xx: alpha_x * alpha_x,
            xy: 0.0,
            yy: alpha_y * alpha_y,
            determinant: (root * root).max(DETERMINANT_MIN),
        }
    }

    /// Roughness `alpha_x` along the tangent direction `(cos, sin)`, a unit vector, and `alpha_y` across it.
    #[inline(always)]
    #[must_use]
    pub fn rotated(alpha_x: f32, alpha_y: f32, cos: f32, sin: f32) -> Self {
        let (x2, y2) = (alpha_x * alpha_x, alpha_y * alpha_y);
        let root = alpha_x * alpha_y;
        Self {
            xx: x2 * (cos * cos) + y2 * (sin * sin),
            xy: (alpha_x - alpha_y) * (alpha_x + alpha_y) * (cos * sin),
            yy: x2 * (sin * sin) + y2 * (cos * cos),
            determinant: (root * root).max(DETERMINANT_MIN),
        }
    }

    /// From the entries of the matrix; the determinant has their rounding error.
    #[inline(always)]
    #[must_use]
    pub fn from_entries(xx: f32, xy: f32, yy: f32) -> Self {
        Self {
            xx,
            xy,
            yy,
            determinant: (xx * yy - xy * xy).max(DETERMINANT_MIN),
        }
    }

    /// `wᵀ A w` for a tangential vector.
    #[inline(always)]
    #[must_use]
    pub fn form(self, x: f32, y: f32) -> f32 {
        // Completed square: no cancellation beyond that of the inner sum.
        let xx = self.xx.max(f32::MIN_POSITIVE);
        let inner = x + (self.xy / xx) * y;
        inner * inner * xx + (self.determinant / xx) * (y * y)
    }

    /// `wᵀ A⁻¹ w` for a tangential vector.
    #[inline(always)]
    #[must_use]
    pub fn inverse_form(self, x: f32, y: f32) -> f32 {
        let xx = self.xx.max(f32::MIN_POSITIVE);
        let inner = y - (self.xy / xx) * x;
        x * x / xx + inner * inner * (xx / self.determinant)
    }

    /// Lower triangular `L` with `L Lᵀ = A`, as `(xx, yx, yy)`: maps unit roughness to this one.
    #[inline(always)]
    #[must_use]
    pub fn factor(self) -> (f32, f32, f32) {
        let root = self.xx.max(f32::MIN_POSITIVE).sqrt();
        (root, self.xy / root, self.determinant.sqrt() / root)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_agree_with_the_axes() {
        let (ax, ay) = (0.6f32, 0.01f32);
        let (cos, sin) = (0.8f32, 0.6f32);
        let r = Roughness::rotated(ax, ay, cos, sin);
        // Along the first axis the form is α_x², and its inverse 1/α_x²; across, α_y.
        assert!((r.form(cos, sin) / (ax * ax) - 1.0).abs() < 1e-5);
        assert!((r.inverse_form(cos, sin) * (ax * ax) - 1.0).abs() < 1e-3);
        assert!((r.inverse_form(-sin, cos) * (ay * ay) - 1.0).abs() < 1e-4);
        let (a, b, c) = r.factor();
        assert!((a * a / r.xx - 1.0).abs() < 1e-6 && (a * b / r.xy - 1.0).abs() < 1e-6);
        assert!(((b * b + c * c) / r.yy - 1.0).abs() < 1e-5);
    }
}
