//! What a light sees through one texel of its map.

use super::facing::geometric_normal;
use super::surface;
use crate::brdf::albedo::ggx_albedo;
use crate::data::{MapRecord, NO_TRIANGLE, Rsm, SceneData};
use crate::geom::{Ray, closest_hit};
use crate::math::vec::{luminance, orthonormal_basis};
use crate::plan::RsmPlan;
use crate::scene::{Light, SpotLight};
use glam::Vec3;

/// Smallest cosine that a texel's footprint is divided by: beyond, its area would grow without bound.
pub const FOOTPRINT_COSINE_MIN: f32 = 0.05;

/// The frame of a light's map of `size²` texels.
pub fn map(light: &Light, size: u32) -> MapRecord {
    let Light::Spot(SpotLight {
        position,
        axis,
        intensity,
        inner,
        outer,
    }) = *light;
    let (right, up) = orthonormal_basis(axis);
    let tan_half_fov = outer.tan();
    let side = 2.0 * tan_half_fov / size as f32;
    MapRecord {
        position: position.to_array(),
        tan_half_fov,
        axis: axis.to_array(),
        cos_inner: inner.cos(),
        right: right.to_array(),
        cos_outer: outer.cos(),
        up: up.to_array(),
        solid_angle: side * side,
        intensity,
        padding: 0.0,
    }
}

/// Ray through a texel, and the flux that leaves the light through it \[W\]. The direction has length 1 along the axis.
pub fn ray(map: &MapRecord, size: u32, x: u32, y: u32) -> (Ray, Vec3) {
    let side = 2.0 * map.tan_half_fov / size as f32;
    let across = (x as f32 + 0.5) * side - map.tan_half_fov;
    let upwards = map.tan_half_fov - (y as f32 + 0.5) * side;
    let right = Vec3::from_array(map.right) * across;
    let direction = (Vec3::from_array(map.axis) + right) + Vec3::from_array(map.up) * upwards;
    let cosine = 1.0 / ((1.0 + across * across) + upwards * upwards).sqrt();
    let falloff = SpotLight::falloff(cosine, map.cos_inner, map.cos_outer);
    let solid_angle = map.solid_angle * (cosine * cosine * cosine);
    let flux = Vec3::from_array(map.intensity) * (falloff * solid_angle);
    (Ray::new(Vec3::from_array(map.position), direction), flux)
}

/// One virtual point light.
#[derive(Clone, Copy, Debug)]
pub struct Texel {
    /// Id of the triangle, or [`NO_TRIANGLE`].
    pub triangle: u32,
    /// xyz: position \[m\]; w: area of the surface that the texel covers \[m²\].
    pub position: [f32; 4],
    /// xyz: unit shading normal, turned to the light; w: dielectric reflectance at grazing incidence.
    pub normal: [f32; 4],
    /// rgb: arriving flux times Lambert albedo \[W\]; w: dielectric reflectance at normal incidence.
    pub diffuse: [f32; 4],
    /// rgb: arriving flux times `F0` \[W\]; w: `alpha`.
    pub specular: [f32; 4],
    /// rgb: arriving flux times `F90` \[W\]; w: luminance of the flux that the specular part reflects \[W\].
    pub grazing: [f32; 4],
}

impl Texel {
    const EMPTY: Self = Self {
        triangle: NO_TRIANGLE,
        position: [0.0; 4],
        normal: [0.0, 0.0, 1.0, 0.0],
        diffuse: [0.0; 4],
        specular: [0.0, 0.0, 0.0, 1.0],
        grazing: [0.0; 4],
    };
}

/// What the light sees through one texel.
pub fn texel(
    scene: &SceneData,
    map: &MapRecord,
    size: u32,
    x: u32,
    y: u32,
    plan: &RsmPlan,
) -> Texel {
    let (ray, flux) = ray(map, size, x, y);
    if flux == Vec3::ZERO {
        return Texel::EMPTY;
    }
    let hit = closest_hit(&scene.node, &scene.corner, &ray, f32::MAX);
    if hit.triangle == NO_TRIANGLE {
        return Texel::EMPTY;
    }
    let surface = surface::at_hit(scene, &hit, ray.direction, plan.textures);
    let length = ray.direction.length();
    let light = ray.direction * (-1.0 / length);
    let facing = geometric_normal(scene, hit.triangle, light)
        .dot(light)
        .max(FOOTPRINT_COSINE_MIN);
    // The texel's side at depth t, squared, over the cosines towards the map's axis and the surface.
    let side = 2.0 * map.tan_half_fov / size as f32 * hit.t;
    let area = side * side / (length * facing);
    let albedo = ggx_albedo(surface.normal.dot(light), surface.alpha);
    let f0 = Vec3::from_array(surface.f0) * flux;
    let f90 = flux * surface.f90;
    Texel {
        triangle: hit.triangle,
        position: surface.position.extend(area).to_array(),
        normal: surface.normal.extend(surface.dielectric_f90).to_array(),
        diffuse: (Vec3::from_array(surface.diffuse) * flux)
            .extend(surface.dielectric_f0)
            .to_array(),
        specular: f0.extend(surface.alpha).to_array(),
        grazing: f90.extend(luminance(albedo.weigh(f0, f90))).to_array(),
    }
}

impl Rsm {
    /// Columns from texels, map after map; the specular columns only where the plan has them.
    pub fn from_texels(size: u32, map: Vec<MapRecord>, texels: &[Texel], glossy: bool) -> Self {
        let column = |f: fn(&Texel) -> [f32; 4]| texels.iter().map(f).collect::<Vec<_>>();
        let specular = |f: fn(&Texel) -> [f32; 4]| if glossy { column(f) } else { Vec::new() };
        Self {
            size,
            maps: map.len() as u32,
            map,
            triangle: texels.iter().map(|t| t.triangle).collect(),
            position: column(|t| t.position),
            normal: column(|t| t.normal),
            diffuse: column(|t| t.diffuse),
            specular: specular(|t| t.specular),
            grazing: specular(|t| t.grazing),
            tangent: Vec::new(),
        }
    }

    /// The map that a texel lies in.
    pub fn map_of(&self, texel: usize) -> &MapRecord {
        &self.map[texel / (self.size as usize * self.size as usize)]
    }

    /// Luminances of the flux that a texel reflects by its Lambert and by its specular part \[W\].
    pub fn weights(&self, texel: usize) -> (f32, f32) {
        let d = self.diffuse[texel];
        let specular = self.grazing.get(texel).map_or(0.0, |g| g[3]);
        (luminance(Vec3::new(d[0], d[1], d[2])), specular)
    }

    /// Luminance of the flux that a texel reflects \[W\].
    pub fn weight(&self, texel: usize) -> f32 {
        let (diffuse, specular) = self.weights(texel);
        diffuse + specular
    }
}
