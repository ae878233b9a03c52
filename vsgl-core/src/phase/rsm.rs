//! What a light sees through one texel of its map.

use super::emit;
use super::facing::geometric_normal;
use super::footprint::Place;
use super::mask::closest_hit;
use super::surface;
use crate::brdf::albedo::ggx_albedo;
use crate::data::{ALL_AROUND, LightRecord, MapRecord, NO_TRIANGLE, Rsm, SceneData, map_kind};
use crate::geom::Ray;
use crate::math::vec::{luminance, orthonormal_basis};
use crate::plan::RsmPlan;
use crate::scene::light::window;
use crate::scene::{DirectionalLight, Light, SpotLight};
use glam::Vec3;

/// Smallest cosine that a texel's footprint is divided by: beyond, its area would grow without bound.
pub const FOOTPRINT_COSINE_MIN: f32 = 0.05;

/// Share of a scene's diagonal by which the rays of a parallel map start outside it, and the least half side of the map.
const MARGIN: f32 = 1e-3;

/// The frames of all maps of a plan: those of the lights, and that of the emitters last. `bounds` are those of the scene.
pub fn planned(lights: &[Light], plan: &RsmPlan, bounds: (Vec3, Vec3)) -> Vec<MapRecord> {
    let lights = if plan.lights { lights } else { &[] };
    let mut maps = maps(lights, plan.size, bounds);
    if plan.emitters {
        maps.push(emit::map());
    }
    maps
}

/// The frames of the maps of all lights, `size²` texels each. `bounds` are those of the scene.
pub fn maps(lights: &[Light], size: u32, bounds: (Vec3, Vec3)) -> Vec<MapRecord> {
    let of = |light: &Light| match light {
        Light::Spot(spot) if light.maps() > 1 => {
            // The face behind the cone would be dark.
            let faces = cube(spot.axis, orthonormal_basis(spot.axis));
            faces[..5]
                .iter()
                .map(|frame| face(light, frame, size))
                .collect()
        }
        Light::Spot(spot) => vec![cone(light, spot.outer.tan(), size)],
        Light::Point(_) => {
            let faces = cube(Vec3::Z, (Vec3::X, Vec3::Y));
            faces.iter().map(|frame| face(light, frame, size)).collect()
        }
        Light::Directional(sun) => vec![parallel(sun, size, bounds)],
    };
    lights.iter().flat_map(of).collect()
}

/// The frame of a perspective map of a light that somebody else drew, from the light's position in any direction.
pub fn around(light: &Light, size: u32) -> MapRecord {
    match light {
        Light::Spot(spot) if light.maps() == 1 => cone(light, spot.outer.tan(), size),
        _ => cone(light, 1.0, size),
    }
}

/// Axis, right and up of a map.
type Frame = [Vec3; 3];

/// The faces of a cube, that around `axis` first and the opposite one last.
fn cube(axis: Vec3, (right, up): (Vec3, Vec3)) -> [Frame; 6] {
    [
        [axis, right, up],
        [right, up, axis],
        [-right, axis, up],
        [up, axis, right],
        [-up, right, axis],
        [-axis, up, right],
    ]
}

/// A perspective map around the axis of a light's cone.
fn cone(light: &Light, tan_half_fov: f32, size: u32) -> MapRecord {
    let axis = Vec3::from_array(LightRecord::from(light).axis);
    let (right, up) = orthonormal_basis(axis);
    perspective(light, &[axis, right, up], tan_half_fov, size)
}

fn perspective(light: &Light, frame: &Frame, tan_half_fov: f32, size: u32) -> MapRecord {
    let record = LightRecord::from(light);
    let [axis, right, up] = frame.map(|v| v.to_array());
    let side = 2.0 * tan_half_fov / size as f32;
    MapRecord {
        position: record.position,
        tan_half_fov,
        axis,
        cos_inner: record.cos_inner,
        right,
        cos_outer: record.cos_outer,
        up,
        solid_angle: side * side,
        intensity: record.intensity,
        kind: map_kind::CONE,
        cone: record.axis,
        inverse_range2: record.inverse_range2,
    }
}

/// One face of a cube around a light, a square pyramid of 90 degrees.
fn face(light: &Light, frame: &Frame, size: u32) -> MapRecord {
    let map = perspective(light, frame, 1.0, size);
    MapRecord {
        kind: map_kind::FACE,
        solid_angle: map.solid_angle * face_correction(size),
        ..map
    }
}

/// What the solid angles of a face's texels, taken at their centres, are multiplied by to add up to a sixth of the sphere.
///
/// One to within 1e-7 from 2¹¹ texels a side on, where it is not worth adding them up.
fn face_correction(size: u32) -> f32 {
    if size >= 1 << 11 {
        return 1.0;
    }
    let side = 2.0 / f64::from(size);
    let centre = |i: u32| (f64::from(i) + 0.5) * side - 1.0;
    let texel = |x: u32, y: u32| {
        let (x, y) = (centre(x), centre(y));
        let length2 = 1.0 + x * x + y * y;
        side * side / (length2 * length2.sqrt())
    };
    // A quarter of the face; the middle row and column of an odd number of texels count once.
    let times = |i: u32| f64::from(1 + u32::from(2 * i + 1 != size));
    let half = size.div_ceil(2);
    let row = |y: u32| (0..half).map(|x| times(x) * texel(x, y)).sum::<f64>();
    let sum: f64 = (0..half).map(|y| times(y) * row(y)).sum();
    (4.0 * std::f64::consts::PI / 6.0 / sum) as f32
}

/// The map of a parallel light: a rectangle across it, as wide as the scene seen from there, before the whole scene.
fn parallel(sun: &DirectionalLight, size: u32, (low, high): (Vec3, Vec3)) -> MapRecord {
    let axis = sun.axis;
    let (right, up) = orthonormal_basis(axis);
    let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
    let margin = MARGIN * half.length() + 1e-18;
    // A box reaches as far along a direction as the sum of its half sides along it.
    let reach = |direction: Vec3| half.dot(direction.abs()) + margin;
    let (width, height) = (reach(right), reach(up));
    let [cos_inner, cos_outer] = ALL_AROUND;
    MapRecord {
        position: (centre - axis * reach(axis)).to_array(),
        tan_half_fov: 1.0,
        axis: axis.to_array(),
        cos_inner,
        right: (right * width).to_array(),
        cos_outer,
        up: (up * height).to_array(),
        solid_angle: (2.0 * width / size as f32) * (2.0 * height / size as f32),
        intensity: sun.irradiance,
        kind: map_kind::PARALLEL,
        cone: axis.to_array(),
        inverse_range2: 0.0,
    }
}

/// Ray through a texel, and the flux that leaves the light through it \[W\]. The direction has length 1 along the axis.
pub fn ray(map: &MapRecord, size: u32, x: u32, y: u32) -> (Ray, Vec3) {
    let side = 2.0 * map.tan_half_fov / size as f32;
    let across = (x as f32 + 0.5) * side - map.tan_half_fov;
    let upwards = map.tan_half_fov - (y as f32 + 0.5) * side;
    let position = Vec3::from_array(map.position);
    let axis = Vec3::from_array(map.axis);
    let right = Vec3::from_array(map.right) * across;
    let up = Vec3::from_array(map.up) * upwards;
    if map.kind == map_kind::PARALLEL {
        let flux = Vec3::from_array(map.intensity) * map.solid_angle;
        return (Ray::new((position + right) + up, axis), flux);
    }
    let direction = (axis + right) + up;
    let cosine = 1.0 / ((1.0 + across * across) + upwards * upwards).sqrt();
    let from_cone = if map.kind == map_kind::FACE {
        direction.dot(Vec3::from_array(map.cone)) * cosine
    } else {
        cosine
    };
    let falloff = SpotLight::falloff(from_cone, map.cos_inner, map.cos_outer);
    let solid_angle = map.solid_angle * (cosine * cosine * cosine);
    let flux = Vec3::from_array(map.intensity) * (falloff * solid_angle);
    (Ray::new(position, direction), flux)
}

/// By how much rays differ from one texel to the next where they have the parameter `t`, along columns and rows \[m\].
pub fn steps(map: &MapRecord, size: u32, t: f32) -> [Vec3; 2] {
    let far = if map.kind == map_kind::PARALLEL {
        1.0
    } else {
        t
    };
    let step = 2.0 * map.tan_half_fov / size as f32 * far;
    [
        Vec3::from_array(map.right) * step,
        Vec3::from_array(map.up) * -step,
    ]
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
    /// xyz: unit tangent that `alpha` belongs to; w: `alpha` across it. Zero where the plan has no anisotropy.
    pub tangent: [f32; 4],
}

impl Texel {
    pub(super) const EMPTY: Self = Self {
        triangle: NO_TRIANGLE,
        position: [0.0; 4],
        normal: [0.0, 0.0, 1.0, 0.0],
        diffuse: [0.0; 4],
        specular: [0.0, 0.0, 0.0, 1.0],
        grazing: [0.0; 4],
        tangent: [0.0; 4],
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
    if map.kind == map_kind::EMITTERS {
        let (texels, points) = (size * size, scene.emitter.len() as u32);
        let found = emit::point(y * size + x, texels, points);
        return found.map_or(Texel::EMPTY, |p| {
            emit::texel(&scene.emitter[p as usize], texels, points)
        });
    }
    let (ray, flux) = ray(map, size, x, y);
    if flux == Vec3::ZERO {
        return Texel::EMPTY;
    }
    let hit = closest_hit(scene, &ray, f32::MAX, plan.surface.masks);
    if hit.triangle == NO_TRIANGLE {
        return Texel::EMPTY;
    }
    let steps = steps(map, size, hit.t);
    let place = Place::at_hit(scene, &hit, ray.direction, steps, &plan.surface);
    let surface = surface::at_hit(scene, &place, ray.direction, &plan.surface);
    let length = ray.direction.length();
    let light = ray.direction * (-1.0 / length);
    let facing = geometric_normal(scene, hit.triangle, light)
        .dot(light)
        .max(FOOTPRINT_COSINE_MIN);
    let distance = hit.t * length;
    let flux = flux * window(distance * distance, map.inverse_range2);
    // The texel's side at depth t, squared, over the cosines towards the map's axis and the surface.
    let side = 2.0 * map.tan_half_fov / size as f32 * hit.t;
    let (across, slant) = if map.kind == map_kind::PARALLEL {
        (map.solid_angle, facing)
    } else {
        (side * side, length * facing)
    };
    let area = across / slant;
    // Of two roughnesses their geometric mean.
    let alpha = if plan.surface.anisotropy {
        (surface.alpha * surface.across).sqrt()
    } else {
        surface.alpha
    };
    let albedo = ggx_albedo(surface.normal.dot(light), alpha);
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
        tangent: surface.tangent.extend(surface.across).to_array(),
    }
}

impl Rsm {
    /// Columns from texels, map after map; the specular columns only where the plan has them.
    pub fn from_texels(size: u32, map: Vec<MapRecord>, texels: &[Texel], plan: &RsmPlan) -> Self {
        let (glossy, anisotropy) = (plan.glossy, plan.surface.anisotropy);
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
            tangent: if anisotropy {
                column(|t| t.tangent)
            } else {
                Vec::new()
            },
        }
    }

    /// The map that a texel lies in.
    pub fn map_of(&self, texel: usize) -> &MapRecord {
        &self.map[texel / (self.size as usize * self.size as usize)]
    }

    /// The side of a texel's surface that its light leaves: a direction of any length.
    pub fn lit_side(&self, texel: usize) -> Vec3 {
        let map = self.map_of(texel);
        if map.kind == map_kind::EMITTERS {
            let [x, y, z, _] = self.normal[texel];
            return Vec3::new(x, y, z);
        }
        let [x, y, z, _] = self.position[texel];
        map.to_light(Vec3::new(x, y, z))
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
