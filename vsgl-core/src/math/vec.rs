//! Vectors: what the lighting formulas need beyond [`glam::Vec3`].

use glam::Vec3;

/// Weights of [`luminance`].
const LUMINANCE_RED: f32 = 0.2126;
const LUMINANCE_GREEN: f32 = 0.7152;
const LUMINANCE_BLUE: f32 = 0.0722;

crate::constants::shared!(
    scalars: [LUMINANCE_RED, LUMINANCE_GREEN, LUMINANCE_BLUE],
    polynomials: []
);

/// Unit vector along `v`; `+z` for the zero vector.
///
/// For lengths within 1.1e-19 … 1.8e19, where the square neither underflows nor overflows; shorter vectors count as
/// zero. Never NaN.
#[inline(always)]
#[must_use]
pub fn normalize(v: Vec3) -> Vec3 {
    let squared = v.dot(v);
    let zero = squared < f32::MIN_POSITIVE;
    let inverse = 1.0 / (if zero { 1.0 } else { squared }).sqrt();
    let unit = v * inverse;
    if zero { Vec3::Z } else { unit }
}

/// `1 − a·b` of unit vectors as `|a − b|²/2`.
///
/// The difference of axes keeps the digits that `1 − a·b` loses below an angle of 3e-4: with a sharpness of 1e8 that is
/// the whole lobe.
#[inline(always)]
#[must_use]
pub fn one_minus_cos(a: Vec3, b: Vec3) -> f32 {
    let apart = a - b;
    0.5 * apart.dot(apart)
}

/// `direction` mirrored about the unit vector `normal`, both pointing away from the surface: `2 (n·d) n − d`.
#[inline(always)]
#[must_use]
pub fn reflect(direction: Vec3, normal: Vec3) -> Vec3 {
    normal * (2.0 * normal.dot(direction)) - direction
}

/// Two unit vectors that make a right-handed frame with the unit vector `z`.
///
/// Continuous except where `z` crosses the plane `z.z = 0`; without a branch.
/// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
#[inline(always)]
#[must_use]
pub fn orthonormal_basis(z: Vec3) -> (Vec3, Vec3) {
    let sign = if z.z < 0.0 { -1.0 } else { 1.0 };
    let a = -1.0 / (sign + z.z);
    let b = z.x * z.y * a;
    let x = Vec3::new(sign * (z.x * z.x * a) + 1.0, sign * b, -sign * z.x);
    let y = Vec3::new(b, z.y * z.y * a + sign, -z.y);
    (x, y)
}

/// Relative luminance of linear Rec. 709 colour: `0.2126 r + 0.7152 g + 0.0722 b`.
#[inline(always)]
#[must_use]
pub fn luminance(rgb: Vec3) -> f32 {
    rgb.dot(Vec3::new(LUMINANCE_RED, LUMINANCE_GREEN, LUMINANCE_BLUE))
}

/// A unit vector at `cosine` to +z, turned by `turn` \[rad\] about it, for tests.
#[cfg(test)]
pub(crate) fn tilted(cosine: f32, turn: f32) -> Vec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    Vec3::new(sine * turn.cos(), sine * turn.sin(), cosine)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normalize_edges() {
        assert_eq!(normalize(Vec3::ZERO), Vec3::Z);
        assert_eq!(normalize(Vec3::splat(1e-30)), Vec3::Z);
        assert!((normalize(Vec3::new(1e-18, 0.0, 1e-18)).length() - 1.0).abs() < 2e-7);
        assert!((normalize(Vec3::splat(1e18)).length() - 1.0).abs() < 2e-7);
    }

    #[test]
    fn one_minus_cos_keeps_small_angles() {
        let angle = 1e-5f32;
        let value = one_minus_cos(Vec3::Z, Vec3::new(angle, 0.0, 1.0));
        assert!((value / (0.5 * angle * angle) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn basis_is_orthonormal_and_right_handed() {
        for i in 0..1000 {
            let height = 1.0 - 2.0 * (i as f32 + 0.5) / 1000.0;
            let turn = i as f32 * 2.399_963;
            let ring = (1.0 - height * height).sqrt();
            let z = Vec3::new(ring * turn.cos(), ring * turn.sin(), height);
            let (x, y) = orthonormal_basis(z);
            assert!(x.dot(y).abs() < 1e-6 && x.dot(z).abs() < 1e-6 && y.dot(z).abs() < 1e-6);
            assert!((x.cross(y) - z).length() < 1e-6);
        }
        for z in [Vec3::Z, -Vec3::Z, Vec3::X, Vec3::new(0.0, 1.0, -0.0)] {
            let (x, y) = orthonormal_basis(z);
            assert!((x.cross(y) - z).length() < 1e-6);
        }
    }

    #[test]
    fn reflection_keeps_length_and_cosine() {
        let r = reflect(Vec3::new(0.6, 0.0, 0.8), Vec3::Z);
        assert!((r - Vec3::new(-0.6, 0.0, 0.8)).length() < 1e-6);
    }
}
