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

/// Mean of weighted points and their full scatter matrix about it. The weight is kept by the owner.
///
/// As [`Moments`], with all six entries instead of their trace.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scatter {
    /// Weighted mean.
    pub mean: Vec3,
    /// Sum of `weight · (x − mean)(x − mean)ᵀ`: xx, yy, zz.
    pub diagonal: Vec3,
    /// The same: xy, xz, yz.
    pub rest: Vec3,
}

impl Scatter {
    /// A single point.
    #[inline(always)]
    pub fn point(x: Vec3) -> Self {
        Self {
            mean: x,
            ..Self::default()
        }
    }

    /// Scatter of two sets together; weights at least 0. The mean of no weight is that of the first set.
    #[inline(always)]
    pub fn merge(self, weight: f32, other: Self, other_weight: f32) -> Self {
        let total = (weight + other_weight).max(f32::MIN_POSITIVE);
        let share = other_weight / total;
        let apart = other.mean - self.mean;
        let factor = weight * share;
        let crossed = Vec3::new(apart.x * apart.y, apart.x * apart.z, apart.y * apart.z);
        Self {
            mean: self.mean + apart * share,
            diagonal: self.diagonal + other.diagonal + (apart * apart) * factor,
            rest: self.rest + other.rest + crossed * factor,
        }
    }

    /// The same points with their weights multiplied.
    #[inline(always)]
    pub fn scaled(self, factor: f32) -> Self {
        Self {
            mean: self.mean,
            diagonal: self.diagonal * factor,
            rest: self.rest * factor,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Merges points of weight 1 pairwise, as the phases do.
    fn merged(points: &[Vec3]) -> Moments {
        if let [one] = points {
            return Moments::point(*one);
        }
        let (first, second) = points.split_at(points.len() / 2);
        let weights = (first.len() as f32, second.len() as f32);
        merged(first).merge(weights.0, merged(second), weights.1)
    }

    #[test]
    fn a_small_cluster_far_out_keeps_its_variance() {
        // Offsets of 1/32 that are exact in f32 at this distance; |x|² has 2⁻⁴ between neighbouring values.
        let centre = Vec3::new(1000.0, -7.0, 730.0);
        let offset =
            |i: usize| Vec3::new((i % 16) as f32 - 7.5, 0.0, (i / 16) as f32 - 7.5) / 512.0;
        let points: Vec<Vec3> = (0..256).map(|i| centre + offset(i)).collect();
        let exact: f64 = (0..256)
            .map(|i| f64::from(offset(i).length_squared()))
            .sum();
        let spread = merged(&points).spread;
        assert!(
            (f64::from(spread) / exact - 1.0).abs() < 1e-3,
            "{spread} {exact}"
        );
        let mean = points.iter().sum::<Vec3>() / 256.0;
        let squares = points.iter().map(|p| p.length_squared()).sum::<f32>();
        let published = squares - 256.0 * mean.length_squared();
        assert!(
            (f64::from(published) / exact - 1.0).abs() > 1.0,
            "no cancellation left to avoid"
        );
    }

    #[test]
    fn scatter_and_moments_agree() {
        let point = |i: usize| Vec3::new((i % 5) as f32, (i * i % 7) as f32, (i % 3) as f32 - 4.0);
        let mut all = (0.0, Scatter::default(), Moments::default());
        for i in 0..50 {
            let weight = (i % 4) as f32;
            let (scatter, moments) = (Scatter::point(point(i)), Moments::point(point(i)));
            all = (
                all.0 + weight,
                all.1.merge(all.0, scatter, weight),
                all.2.merge(all.0, moments, weight),
            );
        }
        let trace = all.1.diagonal.x + all.1.diagonal.y + all.1.diagonal.z;
        assert!((trace / all.2.spread - 1.0).abs() < 1e-5);
        let product: f32 = (0..50)
            .map(|i| (i % 4) as f32 * (point(i) - all.1.mean).x * (point(i) - all.1.mean).y)
            .sum();
        assert!((product - all.1.rest.x).abs() < 1e-2);
    }

    #[test]
    fn no_weight_is_no_trouble() {
        let merged = Moments::default().merge(0.0, Moments::point(Vec3::ONE), 0.0);
        assert_eq!(merged, Moments::default());
        let merged = merged.merge(0.0, Moments::point(Vec3::ONE), 2.0);
        assert_eq!(merged, Moments::point(Vec3::ONE));
    }
}
