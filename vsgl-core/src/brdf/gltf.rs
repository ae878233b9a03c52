//! The metallic-roughness reflectance of glTF 2.0, appendix B, with `KHR_materials_specular` and `KHR_materials_ior`.

use std::f32::consts::PI;

use glam::Vec3;

use super::fresnel::{half_cosine, schlick, schlick_weight};
use super::ggx;

/// A surface's parameters at one point, linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Base colour, 0 … 1.
    pub base_color: Vec3,
    /// 0 for a dielectric, 1 for a metal.
    pub metallic: f32,
    /// GGX roughness α: the square of the material's roughness.
    pub alpha: f32,
    /// Reflectance of the dielectric at normal incidence: 0.04 times specular weight and colour, unless the index says
    /// otherwise.
    pub dielectric_f0: Vec3,
    /// Reflectance of the dielectric at grazing incidence: the specular weight, 1 by default.
    pub dielectric_f90: f32,
}

impl Surface {
    /// Reflectance at normal incidence, dielectric and metal mixed.
    #[inline(always)]
    #[must_use]
    pub fn f0(&self) -> Vec3 {
        self.dielectric_f0 + (self.base_color - self.dielectric_f0) * self.metallic
    }

    /// Reflectance at grazing incidence, dielectric and metal mixed.
    #[inline(always)]
    #[must_use]
    pub fn f90(&self) -> Vec3 {
        Vec3::splat(self.dielectric_f90 + (1.0 - self.dielectric_f90) * self.metallic)
    }

    /// Albedo of the diffuse part before Fresnel: `(1 − metallic) base`.
    #[inline(always)]
    #[must_use]
    pub fn diffuse_albedo(&self) -> Vec3 {
        self.base_color * (1.0 - self.metallic)
    }

    /// What the dielectric's surface lets through to its diffuse part, `1 − max F`, at `cosine` to the half vector.
    #[inline(always)]
    #[must_use]
    pub fn diffuse_weight(&self, cosine: f32) -> f32 {
        let f0 = self
            .dielectric_f0
            .x
            .max(self.dielectric_f0.y)
            .max(self.dielectric_f0.z);
        1.0 - (f0 + (self.dielectric_f90 - f0) * schlick_weight(cosine))
    }

    /// Diffuse reflectance \[1/sr\], without the cosine of the light.
    #[inline(always)]
    #[must_use]
    pub fn diffuse(&self, view: Vec3, light: Vec3) -> Vec3 {
        self.diffuse_albedo() * (self.diffuse_weight(half_cosine(view, light)) * (1.0 / PI))
    }

    /// Specular reflectance \[1/sr\], without the cosine of the light; 0 for directions below the surface.
    #[inline(always)]
    #[must_use]
    pub fn specular(&self, view: Vec3, light: Vec3, normal: Vec3) -> Vec3 {
        schlick(self.f0(), self.f90(), half_cosine(view, light))
            * ggx::reflectance(view, light, normal, self.alpha)
    }

    /// Reflected radiance for unit radiance from `light`, per solid angle: `(diffuse + specular) · max(light·normal, 0)`.
    ///
    /// Directions are unit vectors away from the surface, `normal` on the side of `view`. Zero when `view` or `light` is
    /// below the surface.
    #[inline(always)]
    #[must_use]
    pub fn reflected(&self, view: Vec3, light: Vec3, normal: Vec3) -> Vec3 {
        let cosine = light.dot(normal).max(0.0);
        let seen = if view.dot(normal) > 0.0 { cosine } else { 0.0 };
        (self.diffuse(view, light) + self.specular(view, light, normal)) * seen
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLASTIC: Surface = Surface {
        base_color: Vec3::new(0.8, 0.4, 0.2),
        metallic: 0.0,
        alpha: 0.3,
        dielectric_f0: Vec3::splat(0.04),
        dielectric_f90: 1.0,
    };

    #[test]
    fn lambert_without_specular() {
        let chalk = Surface {
            dielectric_f0: Vec3::ZERO,
            dielectric_f90: 0.0,
            ..PLASTIC
        };
        let value = chalk.reflected(Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::Z);
        assert!((value - chalk.base_color * (0.8 / PI)).length() < 1e-6);
    }

    #[test]
    fn metal_has_no_diffuse_part() {
        let metal = Surface {
            metallic: 1.0,
            ..PLASTIC
        };
        assert_eq!(metal.diffuse(Vec3::Z, Vec3::Z), Vec3::ZERO);
        assert!((metal.f0() - metal.base_color).length() < 1e-6);
        assert_eq!(metal.f90(), Vec3::ONE);
    }

    #[test]
    fn nothing_from_below() {
        assert_eq!(PLASTIC.reflected(Vec3::Z, -Vec3::Z, Vec3::Z), Vec3::ZERO);
        assert_eq!(PLASTIC.reflected(-Vec3::Z, Vec3::Z, Vec3::Z), Vec3::ZERO);
    }
}
