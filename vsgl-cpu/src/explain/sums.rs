//! Sixteen samples against every texel of every cluster, and against the cluster.

use super::Sets;
use crate::CpuBackend;
use crate::phase::block::{self, LANES, Receivers, Vec3Lanes};
use crate::phase::sampled::{ColorLanes, Contributions, draw};
use crate::phase::shade::{Origins, lanes_open, surfaces};
use glam::Vec3;
use multiversion::multiversion;
use rayon::prelude::*;
use std::array::from_fn;
use std::sync::atomic::{AtomicUsize, Ordering};
use vsgl_core::data::{GBuffer, NO_TRIANGLE, SceneData, Vsgls};
use vsgl_core::math::sobol;
use vsgl_core::phase::shade::{Colors, PointSender, Receiver};
use vsgl_core::plan::ShadePlan;
use vsgl_core::render::{Observer, Phase};
use vsgl_core::{Error, Result};

/// Rays to each range of texels, for each of the two halves.
pub const RAYS: u32 = 2;
/// Most of them.
pub const RAYS_MAX: u32 = 64;

/// What is asked.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// The scene, for shadow rays.
    pub scene: &'a SceneData,
    /// The samples.
    pub gbuffer: &'a GBuffer,
    /// The eye that they are seen from \[m\].
    pub eye: Vec3,
    /// The texels, by cluster.
    pub sets: &'a Sets,
    /// The clusters, in the order of the sets; without them only the texels' own light is found.
    pub vsgls: Option<&'a Vsgls>,
    /// How they are shaded. Its `occlusion` does not matter: rays decide.
    pub plan: &'a ShadePlan,
    /// Shadow rays to each range of texels, for each half: 1 ..= [`RAYS_MAX`].
    pub rays: u32,
    /// What random numbers depend on.
    pub seed: u32,
}

/// Sums over all lights at each sample. Where there are two, they are of independent rays, each right in the mean.
///
/// With the model's light of a cluster at the sample `M`, its lobe with the texels' own strength `H`, the texels' own light `E`, the
/// answer of the one ray to the cluster `V`, and the share of `E` that its texels' own rays let pass `W`. Where `E` is zero `W` is
/// `V`.
#[derive(Clone, Debug, Default)]
pub struct Sums {
    /// `Σ M V`: what the method with `occlusion` = `rays` finds.
    pub model: Vec<f64>,
    /// `Σ M W`.
    pub model_seen: [Vec<f64>; 2],
    /// `Σ H V`.
    pub strength: Vec<f64>,
    /// `Σ H W`.
    pub strength_seen: [Vec<f64>; 2],
    /// `Σ E V`.
    pub exact: Vec<f64>,
    /// `Σ E W`: what the method `vpl` finds.
    pub exact_seen: [Vec<f64>; 2],
}

impl Sums {
    /// Columns from blocks, of which `count` samples count.
    fn of(blocks: &[[[f64; LANES]; SUMS]], count: usize) -> Self {
        let column = |sum: usize| -> Vec<f64> {
            let lanes = blocks.iter().flat_map(|b| b[sum].iter().copied());
            lanes.take(count).collect()
        };
        Self {
            model: column(0),
            strength: column(1),
            exact: column(2),
            model_seen: [column(3), column(4)],
            strength_seen: [column(5), column(6)],
            exact_seen: [column(7), column(8)],
        }
    }
}

const SUMS: usize = 9;

/// Sums up every texel at every sample.
///
/// # Errors
/// [`Error::Setting`] for no rays or too many; [`Error::Cancelled`] if the observer says so.
pub fn sums(backend: &CpuBackend, asked: &Asked<'_>, observer: &dyn Observer) -> Result<Sums> {
    if !(1..=RAYS_MAX).contains(&asked.rays) {
        let remedy = format!("give 1 to {RAYS_MAX}");
        return Err(Error::setting("rays", asked.rays.to_string(), remedy));
    }
    let count = asked.gbuffer.triangle.len();
    let blocks = count.div_ceil(LANES);
    let done = AtomicUsize::new(0);
    let one = |index: usize| {
        let sums = asked.block(index * LANES, observer)?;
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        observer.advanced(Phase::Shade, done as f32 / blocks as f32);
        Ok(sums)
    };
    let blocks: Vec<_> = backend
        .pool
        .install(|| (0..blocks).into_par_iter().map(one).collect::<Result<_>>())?;
    Ok(Sums::of(&blocks, count))
}

/// Sixteen samples.
struct Seen {
    receivers: Receivers,
    colors: ColorLanes,
    origins: Origins,
    first: usize,
}

/// Exact light of a set at sixteen samples.
#[derive(Default)]
struct Exact {
    /// Strength of what arrives by the Lambert and by the specular part \[W/m²\].
    strength: [Vec3Lanes; 2],
    /// Luminance to the eye if nothing is in the way.
    light: [f64; LANES],
    /// What of it rays let pass, by each half of them.
    seen: [[f64; LANES]; 2],
}

impl Asked<'_> {
    fn block(&self, first: usize, observer: &dyn Observer) -> Result<[[f64; LANES]; SUMS]> {
        let mut sums = [[0.0; LANES]; SUMS];
        let hit: [bool; LANES] = from_fn(|lane| {
            let triangle = self.gbuffer.triangle.get(first + lane);
            triangle.is_some_and(|&t| t != NO_TRIANGLE)
        });
        let Some(some) = hit.iter().position(|&h| h) else {
            return Ok(sums);
        };
        let samples: [usize; LANES] = from_fn(|lane| first + if hit[lane] { lane } else { some });
        let (single, origins): ([Receiver; LANES], _) =
            surfaces(self.scene, self.gbuffer, self.eye, &samples, hit);
        let colors = samples.map(|sample| Colors::of(self.gbuffer, sample));
        let seen = Seen {
            receivers: Receivers::new(&single),
            colors: ColorLanes::new(&colors),
            origins,
            first,
        };
        let mut contributions = Contributions::default();
        for set in 0..self.sets.count() {
            if observer.cancelled() {
                return Err(Error::Cancelled(Phase::Shade));
            }
            let exact = self.exact(set, &seen, &mut contributions);
            let [model, strength, open] = self.model(set, &seen, &exact);
            for lane in (0..LANES).filter(|&lane| hit[lane]) {
                let light = exact.light[lane];
                sums[0][lane] += model[lane] * open[lane];
                sums[1][lane] += strength[lane] * open[lane];
                sums[2][lane] += light * open[lane];
                for half in 0..2 {
                    let through = exact.seen[half][lane];
                    let share = if light > 0.0 {
                        through / light
                    } else {
                        open[lane]
                    };
                    sums[3 + half][lane] += model[lane] * share;
                    sums[5 + half][lane] += strength[lane] * share;
                    sums[7 + half][lane] += through;
                }
            }
        }
        Ok(sums)
    }

    /// The texels of a set.
    fn exact(&self, set: usize, seen: &Seen, contributions: &mut Contributions) -> Exact {
        let mut exact = Exact::default();
        let parts = self.vsgls.is_some();
        for stratum in self.sets.strata(set) {
            contributions.clear();
            let points = &self.sets.points[stratum.clone()];
            let strength = parts.then_some(&mut exact.strength);
            shine(points, seen, self.plan, strength, contributions);
            let total = contributions.total;
            if total.iter().all(|&t| t <= 0.0) {
                continue;
            }
            let stream = sobol::combine(self.seed, stratum.start as u32);
            for half in 0..2 {
                let offsets: [f32; LANES] = from_fn(|lane| {
                    let sample = 2 * (seen.first + lane) as u32 + half as u32;
                    sobol::fraction(sobol::combine(stream, sample))
                });
                let targets = &self.sets.targets[stratum.clone()];
                let [open, drawn] = draw(
                    self.scene,
                    contributions,
                    |texel| &targets[texel],
                    &seen.origins,
                    &offsets,
                    self.rays,
                    self.plan.masks,
                );
                for lane in 0..LANES {
                    let share = f64::from(open[lane]) / f64::from(drawn[lane]).max(1.0);
                    exact.seen[half][lane] += share * f64::from(total[lane]);
                }
            }
            for (light, more) in exact.light.iter_mut().zip(total) {
                *light += f64::from(more);
            }
        }
        exact
    }

    /// The cluster that stands for a set: its light, that of its lobe with the exact strength, and whether its ray passes.
    fn model(&self, set: usize, seen: &Seen, exact: &Exact) -> [[f64; LANES]; 3] {
        let none = [[0.0; LANES]; 3];
        let Some(vsgls) = self.vsgls.filter(|_| set + 1 < self.sets.count()) else {
            return none;
        };
        let (model, strength) = reflected(vsgls, set, &exact.strength, seen, self.plan);
        let asked = from_fn(|lane| {
            let lit = model[lane] > 0.0 || strength[lane] > 0.0 || exact.light[lane] > 0.0;
            (seen.origins.hit[lane] && lit).then_some(&vsgls.target[set])
        });
        if asked.iter().all(Option::is_none) {
            return none;
        }
        let open = lanes_open(self.scene, &asked, &seen.origins, self.plan.masks);
        [model, strength, open].map(|lanes| lanes.map(f64::from))
    }
}

/// What texels bring to sixteen samples, one after the other, and the strength of what arrives.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn shine(
    points: &[PointSender],
    seen: &Seen,
    plan: &ShadePlan,
    strength: Option<&mut [Vec3Lanes; 2]>,
    contributions: &mut Contributions,
) {
    let receivers = seen.receivers;
    for point in points {
        let sums = block::vpl(point, &receivers, plan);
        contributions.add(&sums, &seen.colors);
    }
    if let Some(strength) = strength {
        let mut sum = *strength;
        for point in points {
            block::add_vpl_strength(&mut sum, point, &receivers, plan);
        }
        *strength = sum;
    }
}

/// What the eye gets of a cluster, and of its lobe with another strength.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn reflected(
    vsgls: &Vsgls,
    cluster: usize,
    strength: &[Vec3Lanes; 2],
    seen: &Seen,
    plan: &ShadePlan,
) -> ([f32; LANES], [f32; LANES]) {
    let specular = if plan.glossy_senders {
        vsgls.specular.get(cluster)
    } else {
        None
    };
    let diffuse = &vsgls.diffuse[cluster];
    let receivers = seen.receivers;
    let model = block::vsgl(diffuse, specular, &receivers, plan);
    let own = block::vsgl_of_strength(diffuse, specular, strength, &receivers, plan);
    (seen.colors.luminance(&model), seen.colors.luminance(&own))
}
