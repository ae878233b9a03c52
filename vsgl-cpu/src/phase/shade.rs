//! Light to the eye, all samples, in blocks of sixteen.

use super::band;
use super::block::{self, LANES, Receivers, Sums};
use super::occlusion::{self, Lanes};
use super::sampled::{self, ColorLanes, Contributions};
use crate::CpuBackend;
use glam::Vec3;
use multiversion::multiversion;
use rayon::prelude::*;
use std::iter::StepBy;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use vsgl_core::backend::{Senders, ShadeInputs};
use vsgl_core::data::{
    GBuffer, LightRecord, NO_TRIANGLE, Occlusion, Radiance, Rsm, SampleSums, SceneData, Target,
    Vsgls, map_kind,
};
use vsgl_core::geom::{Opaque, any_hit_block};
use vsgl_core::phase::direct;
use vsgl_core::phase::facing::{geometric_normal, lift};
use vsgl_core::phase::interleave::Shares;
use vsgl_core::phase::mask::Masked;
use vsgl_core::phase::reconstruct::lit;
use vsgl_core::phase::sampled::offset;
use vsgl_core::phase::shade::{Colors, PointSender, Receiver};
use vsgl_core::plan::ShadePlan;
use vsgl_core::render::{Observer, Phase};
use vsgl_core::settings::OcclusionMethod;
use vsgl_core::{Error, Result};

/// Blocks between two reports to the observer.
const BLOCKS_A_REPORT: usize = 64;
/// Blocks that are held before they become columns.
const BLOCKS_A_BAND: usize = band::SAMPLES / LANES;

pub(crate) fn run(
    inputs: &ShadeInputs<'_, CpuBackend>,
    plan: &ShadePlan,
    observer: &dyn Observer,
) -> Result<Radiance> {
    let ShadeInputs {
        scene,
        gbuffer,
        view,
        lights,
        senders,
        occlusion,
    } = inputs;
    if plan.occlusion.has_maps() && matches!(senders, Senders::Vsgls(_)) && occlusion.is_none() {
        return Err(Error::setting(
            "occlusion",
            format!("`{}` without its shadow maps", plan.occlusion),
            "give what `Backend::occlusion` made",
        ));
    }
    let points = if let Senders::Vpls(rsm) = senders {
        point_senders(rsm, plan)
    } else {
        Vec::new()
    };
    let indirect = match senders {
        Senders::None => Indirect::None,
        Senders::Vsgls(vsgls) => Indirect::Vsgls(vsgls),
        Senders::Vpls(rsm) => Indirect::Vpls(&points, rsm),
    };
    // Those that shine by themselves are the last.
    let emitters = match senders {
        _ if !plan.emitters => usize::MAX,
        Senders::None => usize::MAX,
        Senders::Vsgls(vsgls) => vsgls.first_emitter(),
        Senders::Vpls(rsm) => points
            .partition_point(|(texel, _)| rsm.map_of(*texel as usize).kind != map_kind::EMITTERS),
    };
    let lights: Vec<LightRecord> = lights.iter().map(LightRecord::from).collect();
    let shares = Shares {
        side: if plan.leaves_sums() {
            plan.interleave
        } else {
            1
        },
        width: gbuffer.width,
        height: gbuffer.height,
    };
    let shader = Shader {
        shares,
        scene,
        gbuffer,
        eye: view.camera.eye,
        occlusion: occlusion.map(|maps| &**maps),
        lights: &lights,
        indirect,
        emitters,
        plan,
    };
    let blocks = (shares.indices() as usize).div_ceil(LANES);
    let done = AtomicUsize::new(0);
    let shade = |index: usize| {
        if observer.cancelled() {
            return Err(Error::Cancelled(Phase::Shade));
        }
        let block = shader.block(index * LANES);
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        if done.is_multiple_of(BLOCKS_A_REPORT) {
            observer.advanced(Phase::Shade, done as f32 / blocks as f32);
        }
        Ok(block)
    };
    let count = gbuffer.triangle.len();
    let mut radiance = Radiance {
        width: gbuffer.width,
        height: gbuffer.height,
        ..Radiance::default()
    };
    if plan.leaves_sums() {
        radiance.direct = vec![[0.0; 3]; count];
        radiance.sums = vec![SampleSums::default(); count];
        radiance.emitted = vec![SampleSums::default(); if plan.emitters { count } else { 0 }];
    }
    for first in (0..blocks).step_by(BLOCKS_A_BAND) {
        let band = first..blocks.min(first + BLOCKS_A_BAND);
        let band: Vec<Block> = band.into_par_iter().map(shade).collect::<Result<_>>()?;
        if plan.leaves_sums() {
            scatter(&mut radiance, &band, first, &shares);
        } else {
            let left = count - first * LANES;
            radiance.append(&columns(&band, left, plan), count);
        }
    }
    Ok(radiance)
}

/// The columns of blocks, of which at most `left` samples are in the picture.
fn columns(blocks: &[Block], left: usize, plan: &ShadePlan) -> Radiance {
    let column = |wanted: bool, f: fn(&Block) -> &[[f32; 3]; LANES]| -> Vec<[f32; 3]> {
        let blocks = if wanted { blocks } else { &[] };
        let samples = blocks.iter().flat_map(|b| f(b).iter().copied());
        samples.take(left).collect()
    };
    let bounce = plan.bounce;
    Radiance {
        direct: column(true, |b| &b.direct),
        indirect_diffuse: column(bounce, |b| &b.indirect_diffuse),
        indirect_glossy: column(bounce && plan.glossy_receivers, |b| &b.indirect_glossy),
        ..Radiance::default()
    }
}

/// Puts blocks, the first of them number `first`, where their samples are.
fn scatter(radiance: &mut Radiance, blocks: &[Block], first: usize, shares: &Shares) {
    for (block, number) in blocks.iter().zip(first..) {
        for lane in 0..LANES {
            let index = (number * LANES + lane) as u32;
            let (x, y) = shares.sample(index);
            if index >= shares.indices() || x >= shares.width || y >= shares.height {
                continue;
            }
            let at = y as usize * shares.width as usize + x as usize;
            radiance.direct[at] = block.direct[lane];
            radiance.sums[at] = block.sums[lane];
            if let Some(emitted) = radiance.emitted.get_mut(at) {
                *emitted = block.emitted[lane];
            }
        }
    }
}

/// Texels with flux as point lights.
fn point_senders(rsm: &Rsm, plan: &ShadePlan) -> Vec<(u32, PointSender)> {
    let sender = |texel: usize| {
        PointSender::of(rsm, texel, plan.glossy_senders).map(|point| (texel as u32, point))
    };
    (0..rsm.position.len())
        .into_par_iter()
        .filter_map(sender)
        .collect()
}

/// Light to the eye from sixteen samples.
#[derive(Clone, Copy, Debug, Default)]
struct Block {
    direct: [[f32; 3]; LANES],
    indirect_diffuse: [[f32; 3]; LANES],
    indirect_glossy: [[f32; 3]; LANES],
    sums: [SampleSums; LANES],
    emitted: [SampleSums; LANES],
}

enum Indirect<'a> {
    None,
    Vsgls(&'a Vsgls),
    Vpls(&'a [(u32, PointSender)], &'a Rsm),
}

struct Shader<'a> {
    shares: Shares,
    scene: &'a SceneData,
    occlusion: Option<&'a Occlusion>,
    gbuffer: &'a GBuffer,
    eye: Vec3,
    lights: &'a [LightRecord],
    indirect: Indirect<'a>,
    /// Number of the first virtual light that shines by itself.
    emitters: usize,
    plan: &'a ShadePlan,
}

/// Where shadow rays of a block start, and which lanes hold a surface.
pub(crate) struct Origins {
    pub(crate) position: [[f32; LANES]; 3],
    /// Geometric normals, turned to the eye.
    pub(crate) facing: [[f32; LANES]; 3],
    pub(crate) hit: [bool; LANES],
}

/// Sixteen samples of a G-buffer as receivers, and where their shadow rays start. Lanes that are no `hit` must name a sample
/// that is one.
pub(crate) fn surfaces(
    scene: &SceneData,
    gbuffer: &GBuffer,
    eye: Vec3,
    samples: &[usize; LANES],
    hit: [bool; LANES],
) -> ([Receiver; LANES], Origins) {
    let single = samples.map(|sample| Receiver::of(gbuffer, sample, eye));
    let mut origins = Origins {
        position: [[0.0; LANES]; 3],
        facing: [[0.0; LANES]; 3],
        hit,
    };
    for (lane, receiver) in single.iter().enumerate() {
        let triangle = gbuffer.triangle[samples[lane]];
        let facing = geometric_normal(scene, triangle, eye - receiver.position);
        let origin = receiver.position + facing * lift(scene.lift(), receiver.position);
        for channel in 0..3 {
            origins.position[channel][lane] = origin[channel];
            origins.facing[channel][lane] = facing[channel];
        }
    }
    (single, origins)
}

impl Shader<'_> {
    fn block(&self, start: usize) -> Block {
        let mut block = Block::default();
        let shares = &self.shares;
        let places: [(u32, u32); LANES] =
            std::array::from_fn(|lane| shares.sample((start + lane) as u32));
        let at = |lane: usize| {
            let (x, y) = places[lane];
            let inside = x < shares.width && y < shares.height;
            inside.then_some(y as usize * shares.width as usize + x as usize)
        };
        let hit: [bool; LANES] = std::array::from_fn(|lane| {
            at(lane).is_some_and(|at| self.gbuffer.triangle[at] != NO_TRIANGLE)
        });
        let Some(some) = hit.iter().position(|&h| h) else {
            return block;
        };
        // Lanes without a surface repeat one that has: the same work, thrown away.
        let index = |lane: usize| {
            at(if hit[lane] { lane } else { some }).expect("a sample that hit something is inside")
        };
        let (single, origins) = surfaces(
            self.scene,
            self.gbuffer,
            self.eye,
            &std::array::from_fn(index),
            hit,
        );
        for lane in (0..LANES).filter(|&lane| hit[lane]) {
            let facing = Vec3::from_array(origins.facing.map(|c| c[lane]));
            let colors = Colors::of(self.gbuffer, index(lane));
            let one = |light| {
                let receiver = &single[lane];
                direct::radiance(self.scene, light, receiver, facing, &colors, self.plan)
            };
            let sum = self
                .lights
                .iter()
                .map(one)
                .fold(Vec3::ZERO, |sum, more| sum + more);
            block.direct[lane] = sum.to_array();
        }
        if matches!(self.indirect, Indirect::None) {
            return block;
        }
        let receivers = Receivers::new(&single);
        let colors: [Colors; LANES] =
            std::array::from_fn(|lane| Colors::of(self.gbuffer, index(lane)));
        if self.plan.leaves_sums() {
            let (x, y) = places[some];
            let seen = Seen {
                receivers,
                colors: ColorLanes::new(&colors),
                origins,
                share: shares.share(x, y) as usize,
                offsets: std::array::from_fn(|lane| {
                    let (x, y) = places[if hit[lane] { lane } else { some }];
                    offset(shares, x, y)
                }),
            };
            block.sums = self.share(0..self.emitters, &seen);
            if self.emitters < usize::MAX {
                block.emitted = self.share(self.emitters..usize::MAX, &seen);
            }
            return block;
        }
        let lane_sums = |sums: &Sums, lane: usize| {
            [&sums.diffuse, &sums.near, &sums.grazing]
                .map(|sum| Vec3::from_array(sum.map(|c| c[lane])))
        };
        let indirect = self.sum(0..self.emitters, &receivers, &origins);
        for lane in (0..LANES).filter(|&lane| hit[lane]) {
            let [diffuse, near, grazing] = lane_sums(&indirect, lane);
            block.indirect_diffuse[lane] = colors[lane].diffuse(diffuse).to_array();
            block.indirect_glossy[lane] = colors[lane].glossy(near, grazing).to_array();
        }
        if self.emitters < usize::MAX {
            let emitted = self.sum(self.emitters..usize::MAX, &receivers, &origins);
            for lane in (0..LANES).filter(|&lane| hit[lane]) {
                let [diffuse, near, grazing] = lane_sums(&emitted, lane);
                let before = Vec3::from_array(block.direct[lane]);
                let lambert = colors[lane].diffuse(diffuse);
                let specular = colors[lane].glossy(near, grazing);
                block.direct[lane] = ((before + lambert) + specular).to_array();
            }
        }
        block
    }

    /// Sums over a share of some of the virtual lights, with the rays that were drawn.
    fn share(&self, lights: Range<usize>, seen: &Seen) -> [SampleSums; LANES] {
        let Indirect::Vsgls(vsgls) = &self.indirect else {
            return [SampleSums::default(); LANES];
        };
        let count = vsgls.diffuse.len();
        let (first, end) = (lights.start.min(count), lights.end.min(count));
        let stride = self.shares.count() as usize;
        // The first of the share that is not before the range.
        let first = first + (seen.share + stride - first % stride) % stride;
        let lights = (first..end.max(first)).step_by(stride);
        let mut total = [0.0; LANES];
        let [mut opened, mut asked] = [[0.0; LANES]; 2];
        let sums = if self.plan.occlusion == OcclusionMethod::Sampled {
            let (sums, contributions) =
                sum_sampled(vsgls, lights, &seen.receivers, &seen.colors, self.plan);
            total = contributions.total;
            [opened, asked] = sampled::draw(
                self.scene,
                &contributions,
                |light| &vsgls.target[first + light * stride],
                &seen.origins,
                &seen.offsets,
                self.plan.rays,
                self.plan.masks,
            );
            sums
        } else {
            let (receivers, origins) = (&seen.receivers, &seen.origins);
            let from = Inputs {
                scene: self.scene,
                vsgls,
                occlusion: self.occlusion,
            };
            sum_vsgls(&from, lights, receivers, origins, self.plan)
        };
        std::array::from_fn(|lane| {
            if !seen.origins.hit[lane] {
                return SampleSums::default();
            }
            SampleSums {
                diffuse: lit(sums.diffuse.map(|c| c[lane])),
                total: total[lane],
                near: lit(sums.near.map(|c| c[lane])),
                open: opened[lane],
                grazing: lit(sums.grazing.map(|c| c[lane])),
                asked: asked[lane],
            }
        })
    }

    /// Sums over some of the virtual lights; those beyond the last are none.
    fn sum(&self, lights: Range<usize>, receivers: &Receivers, origins: &Origins) -> Sums {
        let within = |count: usize| lights.start.min(count)..lights.end.min(count);
        match &self.indirect {
            Indirect::None => Sums::default(),
            Indirect::Vsgls(vsgls) => {
                let lights = within(vsgls.diffuse.len()).step_by(1);
                let from = Inputs {
                    scene: self.scene,
                    vsgls,
                    occlusion: self.occlusion,
                };
                sum_vsgls(&from, lights, receivers, origins, self.plan)
            }
            Indirect::Vpls(points, rsm) => {
                let points = &points[within(points.len())];
                sum_vpls(self.scene, points, rsm, receivers, origins, self.plan)
            }
        }
    }
}

/// Sixteen receivers of one share.
struct Seen {
    receivers: Receivers,
    colors: ColorLanes,
    origins: Origins,
    share: usize,
    offsets: [f32; LANES],
}

/// 1 for each lane that light reaches from a target, else 0. Lanes without light are not asked.
#[inline(always)]
fn open(
    scene: &SceneData,
    target: &Target,
    origins: &Origins,
    sums: &Sums,
    masks: bool,
) -> [f32; LANES] {
    let lift = lift(scene.lift(), Vec3::from_array(target.position));
    let end = Vec3::from_array(target.position) + Vec3::from_array(target.normal) * lift;
    let mut direction = [[0.0; LANES]; 3];
    let mut asked = [false; LANES];
    for lane in 0..LANES {
        for channel in 0..3 {
            direction[channel][lane] = end[channel] - origins.position[channel][lane];
        }
        asked[lane] = origins.hit[lane] & sums.lit(lane);
    }
    walk(scene, origins, &direction, &asked, masks)
}

/// The same with a target for each lane; lanes without one are not asked.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
pub(crate) fn lanes_open(
    scene: &SceneData,
    targets: &[Option<&Target>; LANES],
    origins: &Origins,
    masks: bool,
) -> [f32; LANES] {
    let mut direction = [[0.0; LANES]; 3];
    for (lane, target) in targets.iter().enumerate() {
        let Some(target) = target else { continue };
        let lift = lift(scene.lift(), Vec3::from_array(target.position));
        let end = Vec3::from_array(target.position) + Vec3::from_array(target.normal) * lift;
        for channel in 0..3 {
            direction[channel][lane] = end[channel] - origins.position[channel][lane];
        }
    }
    walk(
        scene,
        origins,
        &direction,
        &targets.map(|t| t.is_some()),
        masks,
    )
}

/// Rays of a block through the scene.
#[inline(always)]
fn walk(
    scene: &SceneData,
    origins: &Origins,
    direction: &[[f32; LANES]; 3],
    asked: &[bool; LANES],
    masks: bool,
) -> [f32; LANES] {
    let (nodes, corners, from) = (&scene.node, &scene.corner, &origins.position);
    let blocked = if masks {
        any_hit_block(nodes, corners, from, direction, asked, &Masked(scene))
    } else {
        any_hit_block(nodes, corners, from, direction, asked, &Opaque)
    };
    blocked.map(|b| 1.0 - b as f32)
}

/// What clusters are shaded from.
struct Inputs<'a> {
    scene: &'a SceneData,
    vsgls: &'a Vsgls,
    occlusion: Option<&'a Occlusion>,
}

#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn sum_vsgls(
    from: &Inputs<'_>,
    lights: StepBy<Range<usize>>,
    receivers: &Receivers,
    origins: &Origins,
    plan: &ShadePlan,
) -> Sums {
    let mut total = Sums::default();
    let receivers = *receivers;
    let (scene, vsgls) = (from.scene, from.vsgls);
    for j in lights {
        let specular = if plan.glossy_senders {
            vsgls.specular.get(j)
        } else {
            None
        };
        let sums = block::vsgl(&vsgls.diffuse[j], specular, &receivers, plan);
        let open = match plan.occlusion {
            OcclusionMethod::None | OcclusionMethod::Sampled => [1.0; LANES],
            OcclusionMethod::Rays => open(scene, &vsgls.target[j], origins, &sums, plan.masks),
            OcclusionMethod::Ism | OcclusionMethod::IsmTessellated => {
                let maps = from.occlusion.expect("`run` asks for them");
                let texels = maps.side as usize * maps.side as usize;
                let depth = &maps.depth[j * texels..(j + 1) * texels];
                let at = Lanes {
                    position: receivers.position(),
                    facing: &origins.facing,
                };
                let asked = std::array::from_fn(|lane| origins.hit[lane] & sums.lit(lane));
                occlusion::open(scene, &vsgls.target[j], depth, maps.side, &at, &asked)
            }
        };
        total.add_open(&sums, &open);
    }
    total
}

/// Sums without shadows, and what each light brings.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn sum_sampled(
    vsgls: &Vsgls,
    lights: StepBy<Range<usize>>,
    receivers: &Receivers,
    colors: &ColorLanes,
    plan: &ShadePlan,
) -> (Sums, Contributions) {
    let mut total = Sums::default();
    let mut contributions = Contributions::default();
    let receivers = *receivers;
    for j in lights {
        let specular = if plan.glossy_senders {
            vsgls.specular.get(j)
        } else {
            None
        };
        let sums = block::vsgl(&vsgls.diffuse[j], specular, &receivers, plan);
        contributions.add(&sums, colors);
        total.add_open(&sums, &[1.0; LANES]);
    }
    (total, contributions)
}

#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn sum_vpls(
    scene: &SceneData,
    points: &[(u32, PointSender)],
    rsm: &Rsm,
    receivers: &Receivers,
    origins: &Origins,
    plan: &ShadePlan,
) -> Sums {
    let mut total = Sums::default();
    let receivers = *receivers;
    for (texel, point) in points {
        let sums = block::vpl(point, &receivers, plan);
        let open = match plan.occlusion {
            OcclusionMethod::None | OcclusionMethod::Sampled => [1.0; LANES],
            _ => open(
                scene,
                &vsgl_core::phase::cluster::target(scene, rsm, *texel),
                origins,
                &sums,
                plan.masks,
            ),
        };
        total.add_open(&sums, &open);
    }
    total
}
