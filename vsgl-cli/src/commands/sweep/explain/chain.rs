//! The pictures from the tested one to the truth, at the points that are looked at.

use super::points::Points;
use crate::exit::{Failure, Result};
use crate::job::Job;
use crate::progress::Progress;
use std::sync::Arc;
use std::time::Instant;
use vsgl_core::backend::{Backend, PdfInputs, Senders, ShadeInputs};
use vsgl_core::data::{GBuffer, Radiance, Rsm, SceneData, Vsgls};
use vsgl_core::explain::{Cause, Picture};
use vsgl_core::math::sobol;
use vsgl_core::metrics::luminance;
use vsgl_core::plan::{BouncePlan, OcclusionPlan, PathPlan, Plan, RsmPlan, SurfacePlan};
use vsgl_core::render::{Observer, Phase};
use vsgl_core::settings::{Clustering, Method, OcclusionMethod, Settings};
use vsgl_cpu::CpuBackend;
use vsgl_cpu::explain::{self, Asked, Places, Sets, gathered};

/// How often the texels of the finer maps are as many as those of the given ones, along a side.
pub(super) const FINER: u32 = 4;
/// How many times the lights of the row about their number are.
pub(super) const MORE: u32 = 4;
/// Processor seconds that the points may take, by the estimates below, which are on the careful side: less than a minute on two
/// cores.
const SECONDS: f64 = 120.0;
/// Most pixels.
const PIXELS_MAX: usize = 8192;
/// Paths through each pixel, both halves together, unless `--spp` says otherwise.
const PATHS: u32 = 8192;
/// With `--quick`: how many times less of both.
const QUICK: u32 = 4;
/// Texels' light and rays that a core finds in a second, for the estimate of how many points there is time for.
const TEXELS_A_SECOND: f64 = 50e6;
const RAYS_A_SECOND: f64 = 2e6;
const PATHS_A_SECOND: f64 = 1.2e6;
/// Most texels of all larger shadow maps together.
const MAP_TEXELS_MAX: u64 = 1 << 26;

/// What two pictures of the chain differ by.
pub(super) struct Link {
    pub(super) cause: Cause,
    /// The picture that has the cause, and the one that has not.
    pub(super) from: String,
    pub(super) to: String,
    /// Why there is nothing to take away, if so.
    pub(super) none: Option<&'static str>,
    pub(super) step: Picture,
    /// The step where visibility comes after emission and integral.
    pub(super) other: Option<Picture>,
}

/// The chain.
pub(super) struct Chain {
    pub(super) points: Points,
    pub(super) links: Vec<Link>,
    pub(super) tested: Picture,
    pub(super) truth: Picture,
    /// Clusters against their texels, with the lights given and with more; or why there is no such pair.
    pub(super) lights: std::result::Result<Lights, &'static str>,
    /// Texels along a side of the given maps.
    pub(super) rsm: u32,
    pub(super) paths: u32,
}

/// What the number of virtual lights does.
pub(super) struct Lights {
    /// Virtual lights as given, and more.
    pub(super) count: [u32; 2],
    /// What clusters differ by from their texels.
    pub(super) step: [Picture; 2],
}

/// Everything that the pictures are made from.
struct Stage<'a> {
    backend: &'a CpuBackend,
    scene: &'a Arc<SceneData>,
    job: &'a Job,
    progress: &'a Progress,
    /// What the camera sees at every sample, and at those of the points alone.
    gbuffer: Arc<GBuffer>,
    chosen: Arc<GBuffer>,
    points: Points,
    /// Columns and rows of the samples of each pixel.
    samples: Vec<(u32, u32)>,
}

/// Makes all pictures.
///
/// # Errors
/// [`Failure::Usage`] for settings whose error cannot be split, [`Failure::Interrupted`] if asked to stop.
pub(super) fn chain(
    backend: &CpuBackend,
    scene: &Arc<SceneData>,
    job: &Job,
    quick: bool,
    progress: &Progress,
) -> Result<Chain> {
    let bounce = splittable(job)?;
    let rsm = backend.rsm(scene, &job.lights, &bounce.rsm)?;
    let gbuffer = backend.gbuffer(scene, &job.view, &job.plan.gbuffer)?;
    let vsgls = clusters(backend, scene, job, &rsm, &gbuffer, bounce)?;
    let of_rays = plan_with(job, |s| {
        s.interleave = 1;
        s.occlusion = OcclusionMethod::Rays;
    })?;
    let glossy = of_rays.shade.glossy_senders;
    let labels = Sets::labels(&rsm, &vsgls);
    // The clusters of surfaces that shine are the last; their light is not indirect.
    let count = vsgls.first_emitter() as u32;
    let squares = squares(&rsm);
    let of = |texel: usize| match &labels {
        Some(labels) => Some(labels[texel]).filter(|&l| l != u32::MAX),
        None => Some(squares.of(texel)),
    };
    let sets_of = |rsm: &Rsm| {
        let count = labels.as_ref().map_or(squares.count, |_| count);
        Sets::new(backend, scene, rsm, glossy, count, &of)
    };
    let sets = sets_of(&rsm);
    let less = if quick { QUICK } else { 1 };
    let paths = match job.settings.spp {
        spp if spp == Settings::default().spp => PATHS / less,
        spp => spp.max(2),
    };
    let most = affordable(&sets, vsgls.count, paths, job.view.aa) / less as usize;
    let (width, height) = job.view.pixels();
    let seed = sobol::combine(job.seed as u32, (job.seed >> 32) as u32);
    let stage = Stage::new(
        (backend, scene, job, progress),
        gbuffer,
        Points::of(width, height, most, seed),
    );

    // From the truth's side: what the texels send, by their own visibility.
    let asked = Asked {
        scene,
        gbuffer: &stage.chosen,
        eye: job.view.camera.eye,
        sets: &sets,
        vsgls: labels.as_ref().map(|_| &*vsgls),
        plan: &of_rays.shade,
        rays: explain::RAYS,
        seed: sobol::combine(seed, 3),
    };
    let sums = stage.timed(Phase::Shade, || explain::sums(backend, &asked, progress))?;
    let exact = |sum: Vec<f64>| Picture::exact(stage.pixels(&sum));
    let drawn = |halves: [Vec<f64>; 2]| Picture {
        halves: halves.map(|half| stage.pixels(&half)),
    };
    let by_rays = if labels.is_some() {
        exact(sums.model)
    } else {
        exact(stage.shaded(&of_rays, &vsgls)?)
    };
    let texels = drawn(sums.exact_seen);

    let mut links = Vec::new();
    let tested = stage.before_rays(&vsgls, &by_rays, &mut links)?;
    if labels.is_some() {
        let (seen, strength) = (drawn(sums.model_seen), drawn(sums.strength_seen));
        let (open, own) = (exact(sums.strength), exact(sums.exact));
        let steps = [
            (Cause::Visibility, by_rays.minus(&seen), own.minus(&texels)),
            (Cause::Emission, seen.minus(&strength), by_rays.minus(&open)),
            (Cause::Integral, strength.minus(&texels), open.minus(&own)),
        ];
        let names = [
            "a ray to one texel of each cluster",
            "a share of each cluster's texels seen",
            "radiant intensity of the texels",
            "every texel a light",
        ];
        for (index, (cause, step, other)) in steps.into_iter().enumerate() {
            links.push(Link {
                cause,
                from: names[index].into(),
                to: names[index + 1].into(),
                none: None,
                step,
                other: Some(other),
            });
        }
    } else {
        links.push(Link {
            cause: Cause::Clusters,
            from: "kernels, which share texels".into(),
            to: "every texel a light".into(),
            none: None,
            step: by_rays.minus(&texels),
            other: None,
        });
    }

    let finer = stage.finer(&sets_of, &bounce.rsm, &of_rays, seed)?;
    let at_samples = stage.truth(&Places::at_samples(&job.view, &stage.samples), paths, true)?;
    let truth = stage.truth(
        &Places::pixels(&job.view, &stage.points.pixels),
        paths,
        false,
    )?;
    let side = bounce.rsm.size;
    let name = |side: u32| format!("texels of maps of {side}²");
    links.push(Link {
        cause: Cause::Rsm,
        from: name(side),
        to: format!("{}, one in {} drawn", name(side * FINER), FINER * FINER),
        none: None,
        step: texels.minus(&finer),
        other: None,
    });
    links.push(Link {
        cause: Cause::Rest,
        from: name(side * FINER),
        to: "paths through the samples".into(),
        none: None,
        step: finer.minus(&at_samples),
        other: None,
    });
    links.push(Link {
        cause: Cause::Pixels,
        from: format!("samples a pixel: {}", job.view.aa * job.view.aa),
        to: "paths through the whole pixel".into(),
        none: None,
        step: at_samples.minus(&truth),
        other: None,
    });
    let lights = stage.more_lights(&rsm, vsgls.count, &by_rays, &texels)?;
    Ok(Chain {
        points: stage.points,
        links,
        tested,
        truth,
        lights,
        rsm: side,
        paths,
    })
}

/// The way of the light, if the settings are of the method whose error is split.
fn splittable(job: &Job) -> Result<&BouncePlan> {
    if job.settings.method != Method::Vsgl {
        return Err(Failure::Usage(format!(
            "--explain splits the error of the method `vsgl`, not of `{}`; leave --method away",
            job.settings.method
        )));
    }
    if job.view.stride != 1 {
        return Err(Failure::Usage(
            "--explain chooses its own pixels; leave --stride away".into(),
        ));
    }
    let bounce = job.plan.bounce.as_ref();
    bounce.filter(|b| b.rsm.lights).ok_or_else(|| {
        Failure::Usage(format!(
            "{}: no indirect light, so no error to split; see `vsgl info` for the reason",
            job.name
        ))
    })
}

/// The plan of other settings.
fn plan_with(job: &Job, change: impl FnOnce(&mut Settings)) -> Result<Plan> {
    let mut settings = job.settings.clone();
    change(&mut settings);
    Ok(Plan::new(&job.facts, &settings)?)
}

fn clusters(
    backend: &CpuBackend,
    scene: &Arc<SceneData>,
    job: &Job,
    rsm: &Arc<Rsm>,
    gbuffer: &Arc<GBuffer>,
    plan: &BouncePlan,
) -> Result<Arc<Vsgls>> {
    let inputs = PdfInputs {
        scene,
        rsm,
        gbuffer,
        view: &job.view,
    };
    let pdf = plan.pdf.as_ref();
    let pdf = pdf.map(|p| backend.pdf(&inputs, p)).transpose()?;
    let plan = plan.cluster.as_ref();
    let plan = plan.ok_or_else(|| Failure::Internal("no clusters".into()))?;
    Ok(backend.cluster(scene, rsm, pdf.as_ref(), plan)?)
}

/// Squares of 16 by 16 texels: where clusters overlap, rays are drawn among the texels of these.
struct Squares {
    size: usize,
    count: u32,
}

const SQUARE: usize = 16;

fn squares(rsm: &Rsm) -> Squares {
    let size = rsm.size as usize;
    let across = size.div_ceil(SQUARE);
    Squares {
        size,
        count: (across * across * rsm.maps as usize) as u32,
    }
}

impl Squares {
    fn of(&self, texel: usize) -> u32 {
        let across = self.size.div_ceil(SQUARE);
        let (row, column) = (texel / self.size, texel % self.size);
        let (map, row) = (row / self.size, row % self.size);
        ((map * across + row / SQUARE) * across + column / SQUARE) as u32
    }
}

/// Pixels that there is time for.
fn affordable(sets: &Sets, lights: u32, paths: u32, aa: u32) -> usize {
    let (texels, ranges) = (sets.texels() as f64, sets.ranges() as f64);
    let rays = f64::from(2 * explain::RAYS + 4);
    let sample = 4.0 * texels / TEXELS_A_SECOND
        + (rays * ranges + f64::from((1 + MORE) * lights)) / RAYS_A_SECOND;
    let pixel = f64::from(aa * aa) * sample + 2.0 * f64::from(paths) / PATHS_A_SECOND;
    ((SECONDS / pixel) as usize).clamp(512, PIXELS_MAX)
}

type Hosts<'a> = (&'a CpuBackend, &'a Arc<SceneData>, &'a Job, &'a Progress);

impl<'a> Stage<'a> {
    fn new(
        (backend, scene, job, progress): Hosts<'a>,
        gbuffer: Arc<GBuffer>,
        points: Points,
    ) -> Self {
        let aa = job.view.aa;
        let within = |&(x, y): &(u32, u32)| {
            let (x, y) = (x * aa, y * aa);
            (0..aa * aa).map(move |i| (x + i % aa, y + i / aa))
        };
        let samples: Vec<(u32, u32)> = points.pixels.iter().flat_map(within).collect();
        let width = gbuffer.width as usize;
        let index = |&(x, y): &(u32, u32)| y as usize * width + x as usize;
        let indices: Vec<usize> = samples.iter().map(index).collect();
        Self {
            backend,
            scene,
            job,
            progress,
            chosen: Arc::new(gathered(&gbuffer, &indices)),
            gbuffer,
            points,
            samples,
        }
    }

    fn timed<T>(&self, phase: Phase, work: impl FnOnce() -> vsgl_core::Result<T>) -> Result<T> {
        self.progress.started(phase);
        let start = Instant::now();
        let done = work()?;
        self.progress.finished(phase, start.elapsed());
        Ok(done)
    }

    /// Means over the samples of each pixel.
    fn pixels(&self, samples: &[f64]) -> Vec<f64> {
        let each = (self.job.view.aa * self.job.view.aa) as usize;
        let mean = |s: &[f64]| s.iter().sum::<f64>() / each as f64;
        samples.chunks(each).map(mean).collect()
    }

    /// Indirect light at the samples as the pipeline finds it.
    fn shaded(&self, plan: &Plan, vsgls: &Arc<Vsgls>) -> Result<Vec<f64>> {
        let maps = plan.bounce.as_ref().and_then(|b| b.occlusion.as_ref());
        self.shaded_by_maps(plan, vsgls, maps)
    }

    /// As [`Stage::shaded`], with other shadow maps.
    fn shaded_by_maps(
        &self,
        plan: &Plan,
        vsgls: &Arc<Vsgls>,
        maps: Option<&OcclusionPlan>,
    ) -> Result<Vec<f64>> {
        let backend = self.backend;
        let maps = maps
            .map(|p| self.timed(Phase::Occlusion, || backend.occlusion(self.scene, vsgls, p)))
            .transpose()?;
        // Reconstruction asks neighbours, so the whole picture is needed.
        let whole = plan.reconstruct.is_some();
        let gbuffer = if whole { &self.gbuffer } else { &self.chosen };
        let inputs = ShadeInputs {
            scene: self.scene,
            gbuffer,
            view: &self.job.view,
            lights: &[],
            senders: Senders::Vsgls(vsgls),
            occlusion: maps.as_ref(),
        };
        let mut radiance = self.timed(Phase::Shade, || {
            backend.shade(&inputs, &plan.shade, self.progress)
        })?;
        if let Some(plan) = &plan.reconstruct {
            radiance = backend.reconstruct(gbuffer, &radiance, plan)?;
        }
        let width = gbuffer.width as usize;
        let one = |(index, &(x, y)): (usize, &(u32, u32))| {
            let at = if whole {
                y as usize * width + x as usize
            } else {
                index
            };
            indirect(&radiance, at)
        };
        Ok(self.samples.iter().enumerate().map(one).collect())
    }

    /// The links before rays, and the tested picture.
    fn before_rays(
        &self,
        vsgls: &Arc<Vsgls>,
        by_rays: &Picture,
        links: &mut Vec<Link>,
    ) -> Result<Picture> {
        let settings = &self.job.settings;
        let picture = |samples: Vec<f64>| Picture::exact(self.pixels(&samples));
        let rays = settings.occlusion == OcclusionMethod::Rays;
        let shares = self.job.plan.shade.interleave;
        let own = plan_with(self.job, |s| s.interleave = 1)?;
        let occluded = if rays {
            by_rays.clone()
        } else {
            picture(self.shaded(&own, vsgls)?)
        };
        let tested = if shares > 1 {
            picture(self.shaded(&self.job.plan, vsgls)?)
        } else {
            occluded.clone()
        };
        links.push(Link {
            cause: Cause::Interleaving,
            from: format!("shares of {shares}x{shares} samples"),
            to: "all lights for every sample".into(),
            none: (shares == 1).then_some("every sample takes all virtual lights"),
            step: tested.minus(&occluded),
            other: None,
        });
        let maps = own.bounce.as_ref().and_then(|b| b.occlusion.as_ref());
        let larger = match maps {
            Some(maps) => {
                let plan = larger(maps, vsgls.count);
                let found = picture(self.shaded_by_maps(&own, vsgls, Some(&plan))?);
                let name = |p: &OcclusionPlan| format!("maps of {}², {} points", p.side, p.points);
                links.push(Link {
                    cause: Cause::MapSize,
                    from: name(maps),
                    to: name(&plan),
                    none: None,
                    step: occluded.minus(&found),
                    other: None,
                });
                found
            }
            None => occluded,
        };
        links.push(Link {
            cause: Cause::Occlusion,
            from: format!("occlusion `{}`", settings.occlusion),
            to: "a ray to one texel of each cluster".into(),
            none: rays.then_some("a ray from each sample to each cluster already"),
            step: larger.minus(by_rays),
            other: None,
        });
        Ok(tested)
    }

    /// The texels of finer maps: two draws of them, each with rays of its own.
    fn finer(
        &self,
        sets_of: &dyn Fn(&Rsm) -> Sets,
        plan: &RsmPlan,
        of_rays: &Plan,
        seed: u32,
    ) -> Result<Picture> {
        let half = |half: u32| {
            let (backend, scene, lights) = (self.backend, self.scene, &self.job.lights);
            let seed = sobol::combine(seed, 4 + half);
            let rsm = self.timed(Phase::Rsm, || {
                Ok(explain::drawn_texels(
                    backend, scene, lights, plan, FINER, seed,
                ))
            })?;
            let sets = sets_of(&rsm);
            let asked = Asked {
                scene,
                gbuffer: &self.chosen,
                eye: self.job.view.camera.eye,
                sets: &sets,
                vsgls: None,
                plan: &of_rays.shade,
                rays: 1,
                seed,
            };
            let sums = self.timed(Phase::Shade, || {
                explain::sums(backend, &asked, self.progress)
            })?;
            let both = Picture {
                halves: sums.exact_seen,
            };
            Ok::<_, Failure>(self.pixels(&both.mean()))
        };
        Ok(Picture {
            halves: [half(0)?, half(1)?],
        })
    }

    /// One bounce of the lights along paths: `paths` through each pixel, in two halves.
    fn truth(&self, places: &Places, paths: u32, at_samples: bool) -> Result<Picture> {
        let plan = plan_with(self.job, |s| {
            s.method = Method::Path;
            s.max_depth = 3;
        })?;
        let path = plan
            .path
            .ok_or_else(|| Failure::Internal("no paths".into()))?;
        let each = if at_samples {
            self.job.view.aa * self.job.view.aa
        } else {
            1
        };
        let half = |half: u32| {
            let seed = self.job.seed as u32;
            let plan = PathPlan {
                samples: (paths / 2 / each).max(1),
                seed: sobol::combine(sobol::combine(seed, 6 + half), u32::from(at_samples)),
                // What surfaces send by themselves is direct light here.
                emitters: false,
                surface: SurfacePlan {
                    emission: false,
                    ..path.surface
                },
                ..path.clone()
            };
            let (scene, lights) = (self.scene, &self.job.lights);
            let found = self.timed(Phase::Trace, || {
                explain::truth(self.backend, scene, lights, places, &plan, self.progress)
            })?;
            Ok::<_, Failure>(if at_samples {
                self.pixels(&found)
            } else {
                found
            })
        };
        Ok(Picture {
            halves: [half(0)?, half(1)?],
        })
    }

    /// Clusters against texels with more lights.
    fn more_lights(
        &self,
        rsm: &Arc<Rsm>,
        count: u32,
        by_rays: &Picture,
        texels: &Picture,
    ) -> Result<std::result::Result<Lights, &'static str>> {
        let settings = &self.job.settings;
        if settings.clustering == Clustering::Whole {
            return Ok(Err(
                "whole maps are clusters, whatever the number of lights",
            ));
        }
        let more = settings
            .lights
            .saturating_mul(MORE)
            .min(Settings::LIGHTS_MAX);
        if more <= settings.lights {
            return Ok(Err("there are as many as there can be"));
        }
        let plan = plan_with(self.job, |s| {
            s.lights = more;
            s.interleave = 1;
            s.occlusion = OcclusionMethod::Rays;
        })?;
        let bounce = plan.bounce.as_ref();
        let bounce = bounce.ok_or_else(|| Failure::Internal("no bounce".into()))?;
        let (backend, scene) = (self.backend, self.scene);
        let vsgls = clusters(backend, scene, self.job, rsm, &self.gbuffer, bounce)?;
        let found = Picture::exact(self.pixels(&self.shaded(&plan, &vsgls)?));
        Ok(Ok(Lights {
            count: [count, vsgls.count],
            step: [by_rays.minus(texels), found.minus(texels)],
        }))
    }
}

/// Shadow maps with more texels and points, as far as there is room.
fn larger(plan: &OcclusionPlan, maps: u32) -> OcclusionPlan {
    let fits = |side: u32| u64::from(side) * u64::from(side) * u64::from(maps) <= MAP_TEXELS_MAX;
    let times = [4, 2].into_iter().find(|t| {
        let side = plan.side * t;
        side <= Settings::MAP_MAX && fits(side)
    });
    let times = times.unwrap_or(1);
    OcclusionPlan {
        side: plan.side * times,
        points: plan.points * 2 * times,
        ..plan.clone()
    }
}

/// Luminance of the indirect light at a sample.
fn indirect(radiance: &Radiance, at: usize) -> f64 {
    let of = |layer: &[[f32; 3]]| layer.get(at).copied().map_or(0.0, luminance);
    of(&radiance.indirect_diffuse) + of(&radiance.indirect_glossy)
}
