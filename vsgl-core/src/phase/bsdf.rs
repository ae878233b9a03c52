//! What a surface scatters, and drawing a direction from it.
//!
//! The glTF material: a Lambert part under a dielectric layer and a GGX part, as [`super::shade`] has them for a light of one
//! direction. Directions are drawn from a mixture of the two parts' own densities.
//!
//! Source: glTF 2.0, appendix B (the material); Heitz 2018, "Sampling the GGX Distribution of Visible Normals"; Dupuy and
//! Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".

use super::surface::Surface;
use crate::brdf::fresnel::{half_cosine, schlick_weight};
use crate::brdf::ggx_local;
use crate::brdf::roughness::Roughness;
use crate::math::elementary::sin_cos_turns;
use crate::math::vec::{luminance, normalize, orthonormal_basis, reflect};
use crate::sg::anisotropic::Frame;
use glam::Vec3;
use std::f32::consts::FRAC_1_PI;

/// Least chance that either part is drawn, where there are both.
pub const CHANCE_MIN: f32 = 0.1;

/// A surface seen from one direction.
#[derive(Clone, Copy, Debug)]
pub struct Bsdf {
    frame: Frame,
    /// Unit direction to the viewer, in the frame.
    view: Vec3,
    roughness: Roughness,
    albedo: Vec3,
    /// Of the dielectric layer over the Lambert part: reflectance at normal and at grazing incidence.
    layer: [f32; 2],
    f0: Vec3,
    f90: f32,
    /// Chance that the specular part is drawn.
    chance: f32,
}

/// Reflectance times the cosine to the light, by both parts \[1/sr\].
#[derive(Clone, Copy, Debug, Default)]
pub struct Scattered {
    /// By the Lambert part.
    pub diffuse: Vec3,
    /// By the specular part.
    pub specular: Vec3,
}

impl Bsdf {
    /// A surface that a ray along the unit vector `-view` has hit. Without `glossy` its specular part is left out; without
    /// `anisotropic` it has one roughness.
    #[must_use]
    pub fn new(surface: &Surface, view: Vec3, glossy: bool, anisotropic: bool) -> Self {
        let normal = surface.normal;
        let frame = if anisotropic {
            Frame::new(normal, surface.tangent)
        } else {
            let (tangent, bitangent) = orthonormal_basis(normal);
            Frame {
                tangent,
                bitangent,
                normal,
            }
        };
        let roughness = if anisotropic {
            Roughness::aligned(surface.alpha, surface.across)
        } else {
            Roughness::isotropic(surface.alpha)
        };
        let albedo = Vec3::from_array(surface.diffuse);
        let (f0, f90) = if glossy {
            (Vec3::from_array(surface.f0), surface.f90)
        } else {
            (Vec3::ZERO, 0.0)
        };
        let view = frame.local(view);
        let mirrored = f0 + (Vec3::splat(f90) - f0) * schlick_weight(view.z);
        Self {
            frame,
            view,
            roughness,
            albedo,
            layer: [surface.dielectric_f0, surface.dielectric_f90],
            f0,
            f90,
            chance: chance(luminance(albedo), luminance(mirrored)),
        }
    }

    /// Reflectance times cosine towards the unit vector `light` in world space.
    #[must_use]
    pub fn evaluate(&self, light: Vec3) -> Scattered {
        self.evaluate_local(self.frame.local(light))
    }

    fn evaluate_local(&self, light: Vec3) -> Scattered {
        let cosine = light.z.max(0.0);
        let weight = schlick_weight(half_cosine(self.view, light));
        let [near, grazing] = self.layer;
        let through = 1.0 - (near + (grazing - near) * weight);
        let fresnel = self.f0 + (Vec3::splat(self.f90) - self.f0) * weight;
        Scattered {
            diffuse: self.albedo * (FRAC_1_PI * through * cosine),
            specular: fresnel * (ggx_local::reflectance(self.view, light, self.roughness) * cosine),
        }
    }

    /// Density \[1/sr\] of [`Bsdf::sample`] at the unit vector `light` in world space.
    #[must_use]
    pub fn density(&self, light: Vec3) -> f32 {
        self.density_local(self.frame.local(light))
    }

    fn density_local(&self, light: Vec3) -> f32 {
        let diffuse = light.z.max(0.0) * FRAC_1_PI;
        let specular = ggx_local::reflected_density(self.view, light, self.roughness);
        diffuse + (specular - diffuse) * self.chance
    }

    /// A direction drawn with [`Bsdf::density`] from a uniform point of the unit square and another uniform number; it may lie
    /// below the surface, where nothing is reflected.
    ///
    /// Unit vector in world space, what is scattered there, and the density.
    #[must_use]
    pub fn sample(&self, point: [f32; 2], part: f32) -> (Vec3, Scattered, f32) {
        let [u, v] = point;
        let light = if part < self.chance {
            let half = ggx_local::sample_visible_normal(self.view, self.roughness, u, v);
            normalize(reflect(self.view, half))
        } else {
            let ring = u.sqrt();
            let (sin, cos) = sin_cos_turns(v);
            Vec3::new(ring * cos, ring * sin, (1.0 - u).sqrt())
        };
        let frame = &self.frame;
        let world = (frame.tangent * light.x + frame.bitangent * light.y) + frame.normal * light.z;
        (world, self.evaluate_local(light), self.density_local(light))
    }

    /// Whether anything is reflected at all.
    #[must_use]
    pub fn is_black(&self) -> bool {
        luminance(self.albedo) + (luminance(self.f0) + self.f90) <= 0.0
    }
}

/// Chance of the specular part from the luminances of both.
fn chance(diffuse: f32, specular: f32) -> f32 {
    let share = specular / (diffuse + specular).max(f32::MIN_POSITIVE);
    let within = share.clamp(CHANCE_MIN, 1.0 - CHANCE_MIN);
    let glossy = if specular > 0.0 { within } else { 0.0 };
    if diffuse > 0.0 { glossy } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::sobol::point;
    use crate::math::vec::tilted;

    fn surface(albedo: f32, f0: f32, alpha: f32, across: f32) -> Surface {
        Surface {
            normal: Vec3::Z,
            diffuse: [albedo; 3],
            dielectric_f0: 0.04,
            dielectric_f90: 1.0,
            f0: [f0; 3],
            f90: 1.0,
            alpha,
            tangent: Vec3::X,
            across,
            ..Surface::default()
        }
    }

    /// Sums over drawn directions agree with sums over even ones, part by part.
    #[test]
    fn drawn_directions_integrate_what_is_scattered() {
        for (albedo, f0, alpha, across, cosine) in [
            (0.8, 0.04, 0.3, 0.3, 0.7),
            (0.0, 0.9, 0.2, 0.6, 0.4),
            (0.5, 0.0, 1.0, 1.0, 1.0),
        ] {
            let bsdf = Bsdf::new(
                &surface(albedo, f0, alpha, across),
                tilted(cosine, 0.3),
                true,
                true,
            );
            let n = 1 << 16;
            let (mut drawn, mut even) = ([0.0f64; 2], [0.0f64; 2]);
            for i in 0..n {
                let [part, _] = point(i, 1, 5);
                let (light, scattered, density) = bsdf.sample(point(i, 0, 5), part);
                assert!((light.length() - 1.0).abs() < 1e-5);
                let by = |c: Vec3| f64::from(c.x / density);
                drawn[0] += by(scattered.diffuse);
                drawn[1] += by(scattered.specular);
                let [u, v] = point(i, 2, 5);
                let light = tilted(u, v * std::f32::consts::TAU);
                let scattered = bsdf.evaluate(light);
                even[0] += f64::from(scattered.diffuse.x * std::f32::consts::TAU);
                even[1] += f64::from(scattered.specular.x * std::f32::consts::TAU);
            }
            for part in 0..2 {
                let (a, b) = (drawn[part] / f64::from(n), even[part] / f64::from(n));
                assert!((a - b).abs() < 5e-3 * b.max(0.1), "{part}: {a} {b}");
            }
        }
    }

    #[test]
    fn density_integrates_to_one() {
        for (albedo, f0, alpha) in [(0.8, 0.04, 0.4), (0.2, 0.9, 0.3)] {
            let bsdf = Bsdf::new(
                &surface(albedo, f0, alpha, alpha),
                tilted(0.6, 1.0),
                true,
                false,
            );
            let n = 1 << 16;
            let mut sum = 0.0f64;
            for i in 0..n {
                // The whole sphere: reflections of the specular part may lie below the surface.
                let [u, v] = point(i, 0, 9);
                let light = tilted(2.0 * u - 1.0, v * std::f32::consts::TAU);
                sum += f64::from(bsdf.density(light) * 2.0 * std::f32::consts::TAU);
            }
            let mean = sum / f64::from(n);
            assert!((mean - 1.0).abs() < 5e-3, "{mean}");
        }
    }

    #[test]
    fn nothing_black_is_drawn() {
        let black = surface(0.0, 0.0, 0.3, 0.3);
        assert!(Bsdf::new(&black, Vec3::Z, false, false).is_black());
        assert!(!Bsdf::new(&black, Vec3::Z, true, false).is_black());
        let mirror = Bsdf::new(
            &surface(0.0, 1.0, 1e-3, 1e-3),
            tilted(1e-3, 0.0),
            true,
            false,
        );
        let (_, scattered, density) = mirror.sample([0.999_999_9, 0.3], 0.0);
        assert!(scattered.specular.is_finite() && density.is_finite());
    }
}
