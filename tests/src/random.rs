//! Numbers that look random and are the same in every run.

use vsgl_core::glam::Vec3;

/// A generator of numbers.
///
/// Source: Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators" (`SplitMix64`).
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in 0..1.
    pub fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1u64 << 24) as f32
    }

    /// Uniform between two bounds.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// Uniform in the cube of half side `half`.
    pub fn point(&mut self, half: f32) -> Vec3 {
        Vec3::new(
            self.between(-half, half),
            self.between(-half, half),
            self.between(-half, half),
        )
    }

    /// Uniform on the sphere.
    pub fn direction(&mut self) -> Vec3 {
        let z = self.between(-1.0, 1.0);
        let (sin, cos) = (std::f32::consts::TAU * self.unit()).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        Vec3::new(radius * cos, radius * sin, z).normalize()
    }

    /// One of a list.
    pub fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[(self.bits() % list.len() as u64) as usize]
    }
}

/// Point `i` of `count` spread evenly over the unit sphere.
///
/// Source: Marques et al. 2013, "Spherical Fibonacci Point Sets for Illumination Integrals".
pub fn sphere_point(i: usize, count: usize) -> Vec3 {
    let z = 1.0 - (2.0 * i as f64 + 1.0) / count as f64;
    let turn = i as f64 * (0.5 * (5f64.sqrt() - 1.0));
    let (sin, cos) = (std::f64::consts::TAU * turn.fract()).sin_cos();
    let radius = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new((radius * cos) as f32, (radius * sin) as f32, z as f32)
}
