//! Paths of light from the eye: the truth that the rest approximates.
//!
//! At each surface that a path meets, one of the lights and one point of the surfaces that shine are asked for their light, and
//! the path goes on in a direction drawn from what the surface scatters. Surfaces that shine are found in both ways, each
//! weighed by how likely the other was. The mean over many paths has no error but noise.
//!
//! A path of depth 1 is light that comes straight from a surface that shines, 2 is direct light, 3 is one bounce.
//!
//! Source: Kajiya 1986, "The Rendering Equation"; Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation",
//! chapters 8 (connecting to lights) and 9 (the power heuristic), section 10.4.1 (roulette).

use super::bsdf::Bsdf;
use super::direct;
use super::draw;
use super::facing::{geometric_normal, lift};
use super::footprint::Place;
use super::mask::{any_hit, closest_hit, covers};
use super::surface::{self, Surface};
use crate::data::{LightRecord, NO_TRIANGLE, SceneData, UNLIT};
use crate::geom::{Hit, Ray};
use crate::math::sobol;
use crate::math::vec::{luminance, normalize};
use crate::plan::PathPlan;
use crate::render::View;
use glam::Vec3;

/// Depth from which paths end by chance.
pub const ROULETTE_DEPTH: u32 = 4;
/// Least and greatest chance to go on.
pub const GO_ON: [f32; 2] = [0.05, 0.95];
/// Pairs of numbers that a surface asks for.
pub const PAIRS: u32 = 4;

/// Light along paths through one pixel, kept apart by what the first surface did \[W/(m² sr)\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Light {
    /// Paths of depth 1 and 2.
    pub direct: Vec3,
    /// Longer ones, by the Lambert part of the first surface.
    pub indirect_diffuse: Vec3,
    /// Longer ones, by its specular part.
    pub indirect_glossy: Vec3,
}

/// What paths go through.
#[derive(Clone, Copy, Debug)]
pub struct World<'a> {
    /// The scene.
    pub scene: &'a SceneData,
    /// Its lights, with the shares that they are drawn by; see [`draw::lights`].
    pub lights: &'a [LightRecord],
    /// What is looked for.
    pub plan: &'a PathPlan,
}

/// Stream of random numbers of a pixel.
pub fn stream(plan: &PathPlan, x: u32, y: u32) -> u32 {
    sobol::combine(sobol::combine(plan.seed, x), y)
}

/// Ray through a point of the pixel in column `x` and row `y`, given as a fraction of its sides; unit direction.
pub fn camera_ray(view: &View, x: u32, y: u32, [u, v]: [f32; 2]) -> Ray {
    let camera = &view.camera;
    let scale = 2.0 * camera.tan_half_fov / view.height as f32;
    let across = (((x * view.stride) as f32 + u) - 0.5 * view.width as f32) * scale;
    let upwards = (0.5 * view.height as f32 - ((y * view.stride) as f32 + v)) * scale;
    let direction = (camera.forward + camera.right * across) + camera.up * upwards;
    Ray::new(camera.eye, normalize(direction))
}

/// The path of sample `index` through the pixel in column `x` and row `y`.
pub fn sample(world: &World<'_>, view: &View, x: u32, y: u32, index: u32) -> Light {
    let stream = stream(world.plan, x, y);
    let mut numbers = Numbers {
        index,
        stream,
        pair: 0,
    };
    let mut walk = Walk::default();
    let mut ray = camera_ray(view, x, y, numbers.next());
    for depth in 1..=world.plan.max_depth {
        let hit = closest_hit(world.scene, &ray, f32::MAX, world.plan.surface.masks);
        if hit.triangle == NO_TRIANGLE {
            break;
        }
        let met = world.meet(&hit, &ray);
        walk.shine(world, depth, &met, &ray);
        if depth == world.plan.max_depth {
            break;
        }
        let numbers = numbers.surface(depth);
        let Some(next) = walk.scatter(world, depth, &met, numbers) else {
            break;
        };
        ray = next;
    }
    walk.light
}

/// The pairs of random numbers of a sample, one after the other.
#[derive(Clone, Copy, Debug)]
struct Numbers {
    index: u32,
    stream: u32,
    pair: u32,
}

impl Numbers {
    fn next(&mut self) -> [f32; 2] {
        let point = sobol::point(self.index, self.pair, self.stream);
        self.pair += 1;
        point
    }

    /// Those of a surface, the same whatever surfaces before it took.
    fn surface(&self, depth: u32) -> Self {
        Self {
            pair: 1 + PAIRS * (depth - 1),
            ..*self
        }
    }
}

/// A surface that a path has met.
#[derive(Clone, Copy, Debug)]
struct Met {
    hit: Hit,
    surface: Surface,
    bsdf: Bsdf,
    /// Geometric normal on the side that the path came from.
    facing: Vec3,
    /// Where paths go on.
    origin: Vec3,
}

impl Met {
    /// What is reflected to where the path came from, of light from a direction; nothing from below the surface.
    fn reflected(&self, direction: Vec3, strength: Vec3) -> Vec3 {
        let scattered = self.bsdf.evaluate(direction);
        if direction.dot(self.facing) > 0.0 {
            (scattered.diffuse + scattered.specular) * strength
        } else {
            Vec3::ZERO
        }
    }
}

impl World<'_> {
    fn meet(&self, hit: &Hit, ray: &Ray) -> Met {
        let place = Place::point(hit);
        let plan = self.plan;
        let surface = surface::at_hit(self.scene, &place, ray.direction, &plan.surface);
        let view = -ray.direction;
        let facing = geometric_normal(self.scene, hit.triangle, view);
        Met {
            hit: *hit,
            surface,
            bsdf: Bsdf::new(&surface, view, plan.glossy, plan.surface.anisotropy),
            facing,
            origin: surface.position + facing * lift(self.scene.lift(), surface.position),
        }
    }

    /// Share of a lamp and all before it.
    fn lamp_passed(&self, index: usize) -> u32 {
        draw::lamp_passed(&self.scene.lamp[index], self.plan.light_sampling)
    }

    /// Chance, per area of a triangle \[1/m²\], that the point drawn from the surfaces that shine lies there; 0 where it never does.
    fn emitter_density(&self, triangle: u32, area: f32) -> f32 {
        let lamps = &self.scene.lamp;
        if !self.plan.emitters {
            return 0.0;
        }
        let index = lamps.partition_point(|lamp| lamp.triangle < triangle);
        if index == lamps.len() || lamps[index].triangle != triangle {
            return 0.0;
        }
        draw::chance(|i| self.lamp_passed(i), index) / area.max(f32::MIN_POSITIVE)
    }
}

/// Twice the area of a triangle along its geometric normal.
fn area_vector(scene: &SceneData, triangle: u32) -> Vec3 {
    let (_, ab, ac) = surface::corners(&scene.corner[triangle as usize]);
    ab.cross(ac)
}

/// Weight of one of two ways to draw the same, whose densities are as 1 to `other`: the power heuristic.
pub fn heuristic(other: f32) -> f32 {
    let ratio = other.min(1e18);
    1.0 / (1.0 + ratio * ratio)
}

/// A path on its way.
#[derive(Clone, Copy, Debug)]
struct Walk {
    light: Light,
    /// What is left of light from further on, by the first surface's Lambert part and by its specular part.
    diffuse: Vec3,
    glossy: Vec3,
    /// Density of the last direction \[1/sr\].
    density: f32,
}

impl Default for Walk {
    fn default() -> Self {
        Self {
            light: Light::default(),
            diffuse: Vec3::ONE,
            glossy: Vec3::ZERO,
            density: 0.0,
        }
    }
}

impl Walk {
    /// Adds light that a path of a depth brings.
    fn add(&mut self, depth: u32, light: Vec3) {
        let (diffuse, glossy) = (self.diffuse * light, self.glossy * light);
        if depth < 3 {
            self.light.direct += diffuse + glossy;
        } else {
            self.light.indirect_diffuse += diffuse;
            self.light.indirect_glossy += glossy;
        }
    }

    /// Light that the surface sends by itself.
    fn shine(&mut self, world: &World<'_>, depth: u32, met: &Met, ray: &Ray) {
        let emission = Vec3::from_array(met.surface.emission);
        if emission == Vec3::ZERO {
            return;
        }
        if depth == 1 {
            self.add(depth, emission);
            return;
        }
        let scene = world.scene;
        let material = scene.triangle_material[met.hit.triangle as usize] as usize;
        if scene.material[material].flags & UNLIT != 0 {
            return;
        }
        let twice = area_vector(scene, met.hit.triangle);
        let area = 0.5 * twice.dot(twice).sqrt();
        let cosine = met.facing.dot(-ray.direction).abs().max(f32::MIN_POSITIVE);
        let drawn = world.emitter_density(met.hit.triangle, area);
        let distance2 = (met.hit.t * met.hit.t).min(1e18);
        let other = drawn * (distance2 / cosine) / self.density.max(f32::MIN_POSITIVE);
        self.add(depth, emission * heuristic(other));
    }

    /// Light of a light and of a surface that shines by way of this surface, and the way on; none where the path ends.
    fn scatter(
        &mut self,
        world: &World<'_>,
        depth: u32,
        met: &Met,
        mut numbers: Numbers,
    ) -> Option<Ray> {
        if met.bsdf.is_black() {
            return None;
        }
        let [which, part] = numbers.next();
        let on_emitter = numbers.next();
        let towards = numbers.next();
        let [roulette, emitter] = numbers.next();
        self.connect_light(world, depth, met, which);
        if world.plan.emitters {
            self.connect_emitter(world, depth, met, emitter, on_emitter);
        }
        // Beyond the last surface there is only what shines.
        if depth + 1 == world.plan.max_depth && !world.plan.surface.emission {
            return None;
        }
        let (direction, scattered, density) = met.bsdf.sample(towards, part);
        let both = scattered.diffuse + scattered.specular;
        if density <= 0.0 || both == Vec3::ZERO || direction.dot(met.facing) <= 0.0 {
            return None;
        }
        let share = 1.0 / density;
        (self.diffuse, self.glossy) = if depth == 1 {
            (scattered.diffuse * share, scattered.specular * share)
        } else {
            let through = both * share;
            (self.diffuse * through, self.glossy * through)
        };
        self.density = density;
        if depth + 1 >= ROULETTE_DEPTH {
            let left = luminance(self.diffuse + self.glossy);
            let chance = left.clamp(GO_ON[0], GO_ON[1]);
            if roulette >= chance {
                return None;
            }
            self.diffuse /= chance;
            self.glossy /= chance;
        }
        Some(Ray::new(met.origin, direction))
    }

    /// Light of one of the lights.
    fn connect_light(&mut self, world: &World<'_>, depth: u32, met: &Met, which: f32) {
        let passed = |i: usize| world.lights[i].passed;
        let Some((index, chance)) = draw::draw(world.lights.len(), passed, which) else {
            return;
        };
        let light = &world.lights[index];
        let incoming = direct::incoming(light, met.surface.position);
        let strength = incoming.strength / chance;
        let reflected = met.reflected(incoming.axis, strength);
        if reflected == Vec3::ZERO {
            return;
        }
        let (towards, end) = direct::way(light, &incoming, met.origin);
        let ray = Ray::new(met.origin, towards);
        if !any_hit(world.scene, &ray, end, world.plan.surface.masks) {
            self.add(depth + 1, reflected);
        }
    }

    /// Light of a point of the surfaces that shine.
    fn connect_emitter(
        &mut self,
        world: &World<'_>,
        depth: u32,
        met: &Met,
        which: f32,
        [u, v]: [f32; 2],
    ) {
        let scene = world.scene;
        let passed = |i: usize| world.lamp_passed(i);
        let Some((index, chance)) = draw::draw(scene.lamp.len(), passed, which) else {
            return;
        };
        let record = &scene.lamp[index];
        let root = u.sqrt();
        let hit = Hit {
            triangle: record.triangle,
            t: 0.0,
            u: root * (1.0 - v),
            v: root * v,
        };
        let place = Place::point(&hit);
        let corner = &scene.corner[record.triangle as usize];
        let position = surface::interpolate(corner, place.u, place.v);
        let apart = position - met.surface.position;
        let distance2 = apart.dot(apart).max(f32::MIN_POSITIVE);
        let direction = normalize(apart);
        let twice = area_vector(scene, record.triangle);
        let area = 0.5 * twice.dot(twice).sqrt();
        let side = normalize(twice);
        let cosine = side.dot(direction).abs();
        let drawn = chance / area.max(f32::MIN_POSITIVE);
        let density = drawn * (distance2 / cosine.max(1e-9));
        let masks = world.plan.surface.masks;
        if cosine <= 0.0
            || density <= 0.0
            || masks && !covers(scene, record.triangle, place.u, place.v)
        {
            return;
        }
        let material = &scene.material[scene.triangle_material[record.triangle as usize] as usize];
        let textures = world.plan.surface.textures && !scene.texture.is_empty();
        let emission = surface::emitted(scene, material, &place, direction, textures);
        let weight = heuristic(met.bsdf.density(direction) / density) / density;
        let strength = Vec3::from_array(emission) * weight;
        let reflected = met.reflected(direction, strength);
        if reflected == Vec3::ZERO {
            return;
        }
        let facing = if side.dot(direction) > 0.0 {
            -side
        } else {
            side
        };
        let end = position + facing * lift(scene.lift(), position);
        let ray = Ray::new(met.origin, end - met.origin);
        if !any_hit(scene, &ray, 1.0, masks) {
            self.add(depth + 1, reflected);
        }
    }
}
