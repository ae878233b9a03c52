//! Weighted mean and variance of points, merged without cancellation.

use glam::Vec3;

/// Mean of weighted points and the sum of their squared deviations from it. The weight is kept by the owner.
///
/// `E|x|² − |E x|²` loses all digits for a small cluster far from the origin; merged central moments lose none, all
/// terms being positive.
///
/// Source: Chan, Golub and LeVeque 1979, "Updating Formulae and a Pairwise Algorithm for Computing Sample Variances",
/// equation 2.1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// Weighted mean.
    pub mean: Vec3,
    /// Sum of `weight · |x − mean|²`.
    pub spread: f32,
}

impl Moments {
    /// A single point.
    #[inline(always)]
    pub fn point(x: Vec3) -> Self {
        Self {
            mean: x,
            spread: 0.0,
        }
    }

    /// Moments of two sets together; weights at least 0. The mean of no weight is that of the first set.
    #[inline(always)]
    pub fn merge(self, weight: f32, other: Self, other_weight: f32) -> Self {
        let total = (weight + other_weight).max(f32::MIN_POSITIVE);
        let share = other_weight / total;
        let apart = other.mean - self.mean;
        Self {
            mean: self.mean + apart * share,
            spread: self.spread + other.spread + apart.dot(apart) * (weight * share),
        }
    }

    /// The same points with their weights multiplied.
    #[inline(always)]
    pub fn scaled(self, factor: f32) -> Self {
        Self {
            mean: self.mean,
            spread: self.spread * factor,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_centimetre_cluster_thirty_kilometres_out_keeps_its_variance() {
        let centre = Vec3::new(30_000.0, -7.0, 11_000.0);
        let mut merged = Moments::default();
        let mut weight = 0.0;
        let mut exact = 0.0f64;
        for i in 0..256 {
            // Offsets that are exact in f32 at this distance.
            let offset = Vec3::new(
                ((i % 16) as f32 - 7.5) / 256.0,
                0.0,
                ((i / 16) as f32 - 7.5) / 256.0,
            );
            merged = merged.merge(weight, Moments::point(centre + offset), 1.0);
            weight += 1.0;
            exact += f64::from(offset.length_squared());
        }
        assert!(
            (f64::from(merged.spread) / exact - 1.0).abs() < 0.02,
            "{} {exact}",
            merged.spread
        );
    }

    #[test]
    fn no_weight_is_no_trouble() {
        let merged = Moments::default().merge(0.0, Moments::point(Vec3::ONE), 0.0);
        assert_eq!(merged, Moments::default());
        let merged = merged.merge(0.0, Moments::point(Vec3::ONE), 2.0);
        assert_eq!(merged, Moments::point(Vec3::ONE));
    }
}
