//! Clusters of virtual point lights: their sums, and the virtual spherical Gaussian lights that stand for them.
//!
//! Weights are luminances of reflected flux. Lambert and specular part are kept apart, each with its own position.

use super::facing::geometric_normal;
use crate::data::{
    DiffuseVsgl, MapRecord, NO_TRIANGLE, Rsm, SceneData, SpecularVsgl, Target, Vsgls, map_kind,
};
use crate::math::fold::{halve, lanes};
use crate::math::moments::{Moments, Scatter};
use crate::math::vec::{luminance, normalize, reflect};
use crate::plan::ClusterPlan;
use crate::settings::{Emission, SharpnessFit, Variance};
use crate::sg::anisotropic::turn_of;
use crate::sg::{cosine, lobe, vmf};
use glam::Vec3;

/// Texels of a block of a cluster: its texels in their order, so many at a time.
pub const BLOCK: usize = 32;
/// Lanes that the sums of blocks are merged on.
pub const LANES: usize = 32;

/// Sums over the texels of a cluster. Every field adds up, or merges without cancellation.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sum {
    /// The Lambert part.
    pub diffuse: Part,
    /// The specular part; zero without glossy senders.
    pub specular: Part,
    /// Flux reflected by the Lambert part \[W\].
    pub power: Vec3,
    /// Arriving flux times `F0` \[W\].
    pub f0: Vec3,
    /// Arriving flux times `F90` \[W\].
    pub f90: Vec3,
    /// Weighted dielectric reflectances of the Lambert part, at normal and grazing incidence.
    pub dielectric: [f32; 2],
    /// Weighted square of `alpha`.
    pub alpha2: f32,
    /// Mirrored directions of the light, by specular weight.
    pub mirror: Moments,
    /// Mirrored directions, each shortened by the lobe of its surface, by specular weight.
    pub lobe: Vec3,
}

/// Where one part of a cluster's light starts, and which way its surfaces face.
#[derive(Clone, Copy, Debug, Default)]
pub struct Part {
    /// Sum of weights \[W\].
    pub weight: f32,
    /// Positions \[m\].
    pub position: Scatter,
    /// Unit normals.
    pub normal: Moments,
    /// Sum of `weight · (normal − its mean)·(position − its mean)` \[W m\].
    pub bulge: f32,
    /// Weighted texel area \[W m²\].
    pub area: f32,
}

impl Part {
    fn texel(weight: f32, position: Vec3, normal: Vec3, area: f32) -> Self {
        let (position, normal) = (Scatter::point(position), Moments::point(normal));
        Self {
            weight,
            position,
            normal,
            bulge: 0.0,
            area: weight * area,
        }
    }

    fn merge(self, other: Self) -> Self {
        let weight = self.weight + other.weight;
        let share = self.weight * (other.weight / weight.max(f32::MIN_POSITIVE));
        let apart = other.position.mean - self.position.mean;
        let turned = other.normal.mean - self.normal.mean;
        Self {
            weight,
            bulge: self.bulge + other.bulge + apart.dot(turned) * share,
            position: self
                .position
                .merge(self.weight, other.position, other.weight),
            normal: self.normal.merge(self.weight, other.normal, other.weight),
            area: self.area + other.area,
        }
    }

    fn scaled(self, factor: f32) -> Self {
        Self {
            weight: self.weight * factor,
            position: self.position.scaled(factor),
            normal: self.normal.scaled(factor),
            bulge: self.bulge * factor,
            area: self.area * factor,
        }
    }

    /// Mean normal: unit direction, and mean length with its complement.
    fn facing(&self) -> (Vec3, vmf::MeanLength) {
        facing(&self.normal, self.weight)
    }
}

/// Direction and mean length of unit vectors from their moments. `1 − r² = spread/weight` for unit vectors, which keeps
/// the digits of nearly equal ones.
fn facing(directions: &Moments, weight: f32) -> (Vec3, vmf::MeanLength) {
    let scatter = (directions.spread / weight.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
    let length = (1.0 - scatter).sqrt();
    (
        normalize(directions.mean),
        vmf::MeanLength {
            length,
            complement: scatter / (1.0 + length),
        },
    )
}

impl Sum {
    /// The sum of one texel.
    pub fn texel(rsm: &Rsm, index: usize, plan: &ClusterPlan) -> Self {
        let (diffuse, specular) = rsm.weights(index);
        let [x, y, z, area] = rsm.position[index];
        let position = Vec3::new(x, y, z);
        let [nx, ny, nz, f90_dielectric] = rsm.normal[index];
        let normal = Vec3::new(nx, ny, nz);
        let [r, g, b, f0_dielectric] = rsm.diffuse[index];
        let mut sum = Self {
            diffuse: Part::texel(diffuse, position, normal, area),
            power: Vec3::new(r, g, b),
            dielectric: [diffuse * f0_dielectric, diffuse * f90_dielectric],
            ..Self::default()
        };
        if plan.glossy {
            let [r, g, b, along] = rsm.specular[index];
            // Of two roughnesses their geometric mean.
            let alpha = if plan.anisotropic {
                (along * rsm.tangent[index][3]).sqrt()
            } else {
                along
            };
            let [r90, g90, b90, _] = rsm.grazing[index];
            let light = normalize(rsm.map_of(index).to_light(position));
            let mirror = normalize(reflect(light, normal));
            sum.specular = Part::texel(specular, position, normal, area);
            sum.f0 = Vec3::new(r, g, b);
            sum.f90 = Vec3::new(r90, g90, b90);
            sum.alpha2 = specular * (alpha * alpha);
            sum.mirror = Moments::point(mirror);
            sum.lobe = mirror * (specular * lobe_length(alpha, mirror.dot(normal), plan.sharpness));
        }
        sum
    }

    /// The sum of two sets of texels together.
    pub fn merge(self, other: Self) -> Self {
        Self {
            diffuse: self.diffuse.merge(other.diffuse),
            specular: self.specular.merge(other.specular),
            power: self.power + other.power,
            f0: self.f0 + other.f0,
            f90: self.f90 + other.f90,
            dielectric: [
                self.dielectric[0] + other.dielectric[0],
                self.dielectric[1] + other.dielectric[1],
            ],
            alpha2: self.alpha2 + other.alpha2,
            mirror: self
                .mirror
                .merge(self.specular.weight, other.mirror, other.specular.weight),
            lobe: self.lobe + other.lobe,
        }
    }

    /// The same texels, each with its flux multiplied.
    pub fn scaled(self, factor: f32) -> Self {
        Self {
            diffuse: self.diffuse.scaled(factor),
            specular: self.specular.scaled(factor),
            power: self.power * factor,
            f0: self.f0 * factor,
            f90: self.f90 * factor,
            dielectric: self.dielectric.map(|d| d * factor),
            alpha2: self.alpha2 * factor,
            mirror: self.mirror.scaled(factor),
            lobe: self.lobe * factor,
        }
    }

    /// The sum of at most [`BLOCK`] texels, merged by halving; zero for none.
    pub fn of_texels(rsm: &Rsm, texels: &[u32], plan: &ClusterPlan) -> Self {
        let mut sums = [Self::default(); BLOCK];
        for (sum, &texel) in sums.iter_mut().zip(texels) {
            *sum = Self::texel(rsm, texel as usize, plan);
        }
        halve(&mut sums[..texels.len()], Self::merge).unwrap_or_default()
    }

    /// The sum of a cluster from those of its blocks, merged on [`LANES`] lanes; zero for none.
    pub fn of_blocks(blocks: &[Self]) -> Self {
        lanes::<LANES, _>(blocks.iter().copied(), Self::merge).unwrap_or_default()
    }

    /// Weight of both parts \[W\].
    pub fn weight(&self) -> f32 {
        self.diffuse.weight + self.specular.weight
    }
}

/// Mean length of the lobe that a surface of roughness `alpha` reflects at `cosine` to its normal.
///
/// Source: Tokuyoshi 2016, "Modified Filtered Importance Sampling for Virtual Spherical Gaussian Lights", supplement,
/// section A.1: a half-vector lobe of sharpness `2/alpha²`, a quarter of that over the cosine after reflection.
fn lobe_length(alpha: f32, cosine: f32, fit: SharpnessFit) -> f32 {
    let sharpness = 0.5 / ((alpha * alpha) * cosine.abs().max(1e-4));
    match fit {
        SharpnessFit::Banerjee => vmf::mean_banerjee_2005(sharpness).length,
        SharpnessFit::Toksvig => vmf::mean_toksvig_2005(sharpness).length,
    }
}

fn sharpness_of(mean: vmf::MeanLength, fit: SharpnessFit) -> f32 {
    match fit {
        SharpnessFit::Banerjee => vmf::sharpness_banerjee_2005(mean),
        SharpnessFit::Toksvig => vmf::sharpness_toksvig_2005(mean),
    }
}

/// Extent of a part: variance along one axis in its surface \[m²\], and covariance, xx yy zz xy xz yz.
///
/// Both hold the extent of the texels themselves, squares of which each has a twelfth of its area along either side.
fn extent_of(part: &Part, axis: Vec3, convention: Variance) -> (f32, [f32; 6]) {
    let scale = 1.0 / part.weight.max(f32::MIN_POSITIVE);
    let texel = part.area * scale * (1.0 / 12.0);
    let flat = (Vec3::ONE - axis * axis) * texel;
    let tilt = Vec3::new(axis.x * axis.y, axis.x * axis.z, axis.y * axis.z) * texel;
    let diagonal = part.position.diagonal * scale + flat;
    let rest = part.position.rest * scale - tilt;
    let trace = diagonal.x + diagonal.y + diagonal.z;
    let variance = match convention {
        Variance::PerAxis => 0.5 * trace,
        Variance::Trace => trace,
    };
    (
        variance,
        [diagonal.x, diagonal.y, diagonal.z, rest.x, rest.y, rest.z],
    )
}

/// Height above the mean position, along the mean normal, at which a point lies in the surfaces' planes in the mean \[m\].
///
/// `E[n·(x − y)] = r ν·(x − μ) − E[δn·δy]`, so the planes' height is the covariance of normal and position over `r`.
/// Bounded by the cluster's size, for clusters that face all ways round.
fn bulge_of(part: &Part, mean_length: f32, variance: f32) -> f32 {
    let size = 2.0 * variance.sqrt();
    (part.bulge / (part.weight * mean_length).max(f32::MIN_POSITIVE)).clamp(-size, size)
}

/// The lights that stand for a cluster under the light of `map`.
pub fn lights(sum: &Sum, map: &MapRecord, plan: &ClusterPlan) -> (DiffuseVsgl, SpecularVsgl) {
    match plan.emission {
        Emission::Cosine => (
            diffuse_cosine(sum, map, plan),
            specular_cosine(sum, map, plan),
        ),
        Emission::Sg => lights_sg(sum, map, plan),
    }
}

fn to_light(map: &MapRecord, position: Vec3) -> [f32; 3] {
    map.light(position).to_array()
}

/// Where a cluster without light has its light: zero for emitters, so that all of these are known by it.
fn unlit(map: &MapRecord) -> [f32; 3] {
    if map.kind == map_kind::EMITTERS {
        [0.0; 3]
    } else {
        [0.0, 0.0, 1.0]
    }
}

fn diffuse_cosine(sum: &Sum, map: &MapRecord, plan: &ClusterPlan) -> DiffuseVsgl {
    let part = &sum.diffuse;
    if part.weight <= 0.0 {
        return DiffuseVsgl {
            axis: [0.0, 0.0, 1.0],
            light: unlit(map),
            ..DiffuseVsgl::default()
        };
    }
    let (axis, mean) = part.facing();
    let (variance, covariance) = extent_of(part, axis, plan.variance);
    DiffuseVsgl {
        position: part.position.mean.to_array(),
        variance,
        axis: axis.to_array(),
        sharpness: sharpness_of(mean, plan.sharpness),
        intensity: (sum.power * std::f32::consts::FRAC_1_PI).to_array(),
        covariance,
        light: to_light(map, part.position.mean),
        complement: mean.complement,
        f0: sum.dielectric[0] / part.weight,
        f90: sum.dielectric[1] / part.weight,
        bulge: bulge_of(part, mean.length, variance),
    }
}

fn specular_cosine(sum: &Sum, map: &MapRecord, plan: &ClusterPlan) -> SpecularVsgl {
    let part = &sum.specular;
    if part.weight <= 0.0 {
        let z = [0.0, 0.0, 1.0];
        return SpecularVsgl {
            axis: z,
            mirror: z,
            light: z,
            alpha: 1.0,
            ..SpecularVsgl::default()
        };
    }
    let (axis, mean) = part.facing();
    let (mirror, mean_mirror) = facing(&sum.mirror, part.weight);
    let lobe = vmf::MeanLength::from_length(sum.lobe.length() / part.weight);
    let (variance, covariance) = extent_of(part, axis, plan.variance);
    SpecularVsgl {
        position: part.position.mean.to_array(),
        variance,
        axis: axis.to_array(),
        complement: mean.complement,
        mirror: mirror.to_array(),
        complement_mirror: mean_mirror.complement,
        light: to_light(map, part.position.mean),
        sharpness_lobe: sharpness_of(lobe, plan.sharpness),
        f0: sum.f0.to_array(),
        alpha: (sum.alpha2 / part.weight).sqrt(),
        f90: sum.f90.to_array(),
        bulge: bulge_of(part, mean.length, variance),
        covariance,
        across: 0.0,
        turn: 0.0,
    }
}

/// Gives a specular light the tangent of the texel that stands for its cluster, and the ratio of its roughnesses; their
/// geometric mean stays the cluster's.
///
/// One texel, not a mean: so lights of isotropic scenes are made from the same sums. In clusters whose tangents differ the
/// light is stretched more than it should be.
pub fn stretched(light: SpecularVsgl, rsm: &Rsm, texel: u32) -> SpecularVsgl {
    let [x, y, z, across] = rsm.tangent[texel as usize];
    let ratio = rsm.specular[texel as usize][3] / across.max(f32::MIN_POSITIVE);
    let root = ratio.clamp(1e-6, 1e6).sqrt();
    SpecularVsgl {
        alpha: (light.alpha * root).min(1.0),
        across: (light.alpha / root).min(1.0),
        turn: turn_of(Vec3::from_array(light.axis), Vec3::new(x, y, z)),
        ..light
    }
}

/// One spherical Gaussian for each part, both at the common mean position, or each at its own.
///
/// Source: Tokuyoshi 2016, supplement, sections A and B; Tokuyoshi 2015, "Fast Indirect Illumination Using Two Virtual
/// Spherical Gaussian Lights", supplement, section 2.2 (each at its own).
fn lights_sg(sum: &Sum, map: &MapRecord, plan: &ClusterPlan) -> (DiffuseVsgl, SpecularVsgl) {
    let both = sum.diffuse.merge(sum.specular);
    let of = |own: &Part| if plan.apart { *own } else { both };
    let of = [of(&sum.diffuse), of(&sum.specular)];
    let places = of.map(|part| {
        let (variance, _) = extent_of(&part, part.facing().0, plan.variance);
        (part.position.mean, variance)
    });

    let lambert_length = match plan.sharpness {
        SharpnessFit::Banerjee => vmf::mean_banerjee_2005(cosine::COSINE_SHARPNESS).length,
        SharpnessFit::Toksvig => vmf::mean_toksvig_2005(cosine::COSINE_SHARPNESS_2015).length,
    };
    let (axis, mean) = sum.diffuse.facing();
    let mean = vmf::MeanLength::from_length(mean.length * lambert_length);
    let sharpness = sharpness_of(mean, plan.sharpness);
    let (position, variance) = places[0];
    let diffuse = DiffuseVsgl {
        position: position.to_array(),
        variance,
        axis: axis.to_array(),
        sharpness,
        intensity: (sum.power / lobe::integral(sharpness)).to_array(),
        light: to_light(map, position),
        ..DiffuseVsgl::default()
    };

    let weight = sum.specular.weight.max(f32::MIN_POSITIVE);
    let mean = vmf::MeanLength::from_length(sum.lobe.length() / weight);
    let sharpness = sharpness_of(mean, plan.sharpness);
    // The flux that the specular part reflects in the mean, spread like F0.
    let (position, variance) = places[1];
    let specular = SpecularVsgl {
        position: position.to_array(),
        variance,
        mirror: normalize(sum.lobe).to_array(),
        sharpness_lobe: sharpness,
        f0: (specular_power(sum) / lobe::integral(sharpness)).to_array(),
        axis: sum.specular.facing().0.to_array(),
        light: to_light(map, position),
        alpha: (sum.alpha2 / weight).sqrt(),
        ..SpecularVsgl::default()
    };
    (diffuse, specular)
}

/// Flux reflected by the specular part \[W\]: the colour of `F0`, or of `F90` where that is black, with the luminance that
/// is the weight of the part.
fn specular_power(sum: &Sum) -> Vec3 {
    let color = if luminance(sum.f0) > 0.0 {
        sum.f0
    } else {
        sum.f90
    };
    color * (sum.specular.weight / luminance(color).max(f32::MIN_POSITIVE))
}

impl Vsgls {
    /// Columns from lights and the texels that stand for them.
    pub fn from_lights(
        lights: &[(DiffuseVsgl, SpecularVsgl)],
        glossy: bool,
        target: Vec<Target>,
        texel: Vec<u32>,
    ) -> Self {
        Self {
            count: lights.len() as u32,
            diffuse: lights.iter().map(|l| l.0).collect(),
            specular: if glossy {
                lights.iter().map(|l| l.1).collect()
            } else {
                Vec::new()
            },
            target,
            texel,
            label: Vec::new(),
            kernel: Vec::new(),
        }
    }
}

/// The point that stands for a cluster in visibility: the surface at one of its texels.
pub fn target(scene: &SceneData, rsm: &Rsm, texel: u32) -> Target {
    let [x, y, z, _] = rsm.position[texel as usize];
    let position = Vec3::new(x, y, z);
    let light = rsm.lit_side(texel as usize);
    let triangle = rsm.triangle[texel as usize];
    let normal = if triangle == NO_TRIANGLE {
        Vec3::Z
    } else {
        geometric_normal(scene, triangle, light)
    };
    Target {
        position: position.to_array(),
        normal: normal.to_array(),
        ..Target::default()
    }
}

/// The entry of a list at which the running sum of weights passes `wanted`, and how much of `wanted` is left before it.
///
/// The texel that stands for a cluster is found twice so: `u` times the weight of all blocks picks a block, what is left
/// picks a texel of it. Never an entry without weight, unless all are; the first of an empty list.
pub fn pick(weights: impl Iterator<Item = f32>, wanted: f32) -> (usize, f32) {
    let mut passed = 0.0;
    let mut picked = (0, 0.0);
    for (index, weight) in weights.enumerate() {
        // The last with weight is kept where rounding lets the sum fall short.
        if weight > 0.0 && passed <= wanted {
            picked = (index, wanted - passed);
        }
        passed += weight;
    }
    picked
}

/// The texel of a cluster that its light's shadow ray ends at: drawn by weight, `u` in 0 ≤ u < 1.
pub fn draw(rsm: &Rsm, texels: &[u32], blocks: &[Sum], u: f32) -> u32 {
    let total = blocks.iter().fold(0.0, |total, b| total + b.weight());
    let (block, rest) = pick(blocks.iter().map(Sum::weight), u * total);
    let texels = texels.chunks(BLOCK).nth(block).unwrap_or_default();
    let (texel, _) = pick(texels.iter().map(|&t| rsm.weight(t as usize)), rest);
    texels.get(texel).copied().unwrap_or_default()
}
