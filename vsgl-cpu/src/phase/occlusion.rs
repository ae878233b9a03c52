//! Shadow maps of the clusters.

use super::block::{LANES, Vec3Lanes};
use glam::Vec3;
use multiversion::multiversion;
use rayon::prelude::*;
use vsgl_core::data::{Occlusion, SceneData, Target, Vsgls};
use vsgl_core::phase::facet::{self, Facet};
use vsgl_core::phase::occlusion::{self, MapFrame, OPEN, Probe};
use vsgl_core::phase::run::{self, Run};
use vsgl_core::phase::splat::{self, Point, Splat};
use vsgl_core::phase::{fill, mask};
use vsgl_core::plan::OcclusionPlan;

pub(crate) fn run(scene: &SceneData, vsgls: &Vsgls, plan: &OcclusionPlan) -> Occlusion {
    let side = plan.side;
    let texels = side as usize * side as usize;
    let stride = splat::stride(plan.points);
    let run = |index| Run::new(&scene.share, &scene.corner, index, plan.points, stride);
    let runs: Vec<Run> = (0..plan.points).into_par_iter().map(run).collect();
    let step = 2.0 / side as f32;
    let direction = |i| occlusion::direction(i % side, i / side, step);
    let directions: Vec<Vec3> = (0..side * side).map(direction).collect();
    let mut depth = vec![OPEN; texels * vsgls.target.len()];
    depth
        .par_chunks_mut(texels)
        .zip(&vsgls.target)
        .enumerate()
        .for_each(|(index, (depth, target))| {
            let map = Map {
                scene,
                plan,
                index: index as u32,
                frame: MapFrame::new(target, scene.lift()),
                runs: &runs,
                directions: &directions,
            };
            draw(&map, depth);
            fill_holes(depth, side);
        });
    Occlusion {
        maps: vsgls.target.len() as u32,
        side,
        depth,
    }
}

struct Map<'a> {
    scene: &'a SceneData,
    plan: &'a OcclusionPlan,
    index: u32,
    frame: MapFrame,
    runs: &'a [Run],
    /// Directions of the middles of the texels.
    directions: &'a [Vec3],
}

/// What a map holds before its holes are filled.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn draw(map: &Map<'_>, depth: &mut [f32]) {
    let mut apart = vec![false; map.runs.len()];
    for (run, apart) in map.runs.iter().zip(&mut apart) {
        *apart = run.is_apart(&map.frame, map.plan.side);
        if *apart {
            map.triangles(depth, run);
        }
    }
    map.points(depth, &apart);
}

impl Map<'_> {
    #[inline(always)]
    fn points(&self, depth: &mut [f32], apart: &[bool]) {
        let (share, map) = (&self.scene.share, self.index);
        let stride = splat::stride(self.plan.points);
        let mut triangle = 0;
        for index in 0..self.plan.points {
            let draw = splat::draw(map, index, stride);
            // Draws ascend: what `splat::find` would find is not before the last.
            triangle = find_from(share, triangle, draw);
            if triangle == share.len() {
                break;
            }
            let low = if triangle == 0 {
                0
            } else {
                share[triangle - 1]
            };
            let high = share[triangle];
            if !run::wide(low, high, stride)
                && apart[run::of(low, stride, self.plan.points) as usize]
            {
                continue;
            }
            let corners = splat::corners(&self.frame, &self.scene.corner[triangle]);
            if self.plan.tessellated {
                let side = self.plan.side;
                let slot = splat::slot(map, index, low, high, stride, &corners, side);
                let pieces = slot.cuts * slot.cuts;
                for piece in (slot.first..pieces).step_by(slot.slots as usize) {
                    let point = splat::piece(&slot, piece);
                    self.point(depth, triangle, &corners, &point);
                }
            } else {
                let point = splat::random_point(map, index, draw, low, high, stride);
                self.point(depth, triangle, &corners, &point);
            }
        }
    }

    #[inline(always)]
    fn triangles(&self, depth: &mut [f32], run: &Run) {
        for i in 0..run.count {
            let triangle = (run.first + i * run.every) as usize;
            let corners = splat::corners(&self.frame, &self.scene.corner[triangle]);
            if run.every > 1 {
                self.point(depth, triangle, &corners, &splat::middle(run.every));
            } else {
                self.facet(depth, triangle, &corners);
            }
        }
    }

    #[inline(always)]
    fn facet(&self, depth: &mut [f32], triangle: usize, corners: &[Vec3; 3]) {
        let side = self.plan.side;
        let bounds = facet::bounds(corners, side);
        if bounds.left == bounds.right || bounds.top == bounds.bottom {
            return;
        }
        let facet = Facet::new(corners);
        for row in bounds.top..bounds.bottom {
            for column in bounds.left..bounds.right {
                let at = (row * side + column) as usize;
                let met = facet.meet(self.directions[at]);
                let there = |met: &facet::Meeting| {
                    !self.plan.masks || mask::covers(self.scene, triangle as u32, met.u, met.v)
                };
                if met.depth < depth[at] && there(&met) {
                    depth[at] = met.depth;
                }
            }
        }
    }

    #[inline(always)]
    fn point(&self, depth: &mut [f32], triangle: usize, corners: &[Vec3; 3], point: &Point) {
        let side = self.plan.side;
        let splat = Splat::new(corners, point, side);
        if !splat.above {
            return;
        }
        if self.plan.masks && !mask::covers(self.scene, triangle as u32, point.u, point.v) {
            return;
        }
        let step = 2.0 / side as f32;
        let ([left, right], [top, bottom]) = (splat.range(0, side), splat.range(1, side));
        for row in top..bottom {
            for column in left..right {
                let texel = &mut depth[(row * side + column) as usize];
                *texel = texel.min(splat.depth(column, row, step));
            }
        }
    }
}

/// First entry at or after `from` that is greater than `wanted`.
fn find_from(share: &[u32], from: usize, wanted: u32) -> usize {
    let mut step = 1;
    let mut low = from;
    while low + step < share.len() && share[low + step - 1] <= wanted {
        low += step;
        step *= 2;
    }
    let end = (low + step).min(share.len());
    low + share[low..end].partition_point(|&s| s <= wanted)
}

fn fill_holes(depth: &mut [f32], side: u32) {
    let mut above: Vec<Vec<f32>> = Vec::new();
    for level in 1..=fill::LEVELS {
        let (from, to) = (fill::side(side, level - 1), fill::side(side, level));
        let below: &[f32] = above.last().map_or(&*depth, |l| l);
        let at = |x: u32, y: u32| {
            if x < from && y < from {
                below[(y * from + x) as usize]
            } else {
                OPEN
            }
        };
        let texel = |i: u32| {
            let (x, y) = (2 * (i % to), 2 * (i / to));
            fill::pull([at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)])
        };
        let made = (0..to * to).map(texel).collect();
        above.push(made);
    }
    for level in (0..fill::LEVELS as usize).rev() {
        let (own, parent) = (
            fill::side(side, level as u32),
            fill::side(side, level as u32 + 1),
        );
        let (below, upper) = above.split_at_mut(level);
        let texels = below.last_mut().map_or(&mut *depth, |l| l);
        for (i, texel) in texels.iter_mut().enumerate() {
            let (x, y) = (i as u32 % own / 2, i as u32 / own / 2);
            *texel = fill::push(*texel, upper[0][(y * parent + x) as usize]);
        }
    }
}

/// Share of the light of a cluster that reaches each lane, by its map; 0 for lanes that are not asked.
///
/// What is computed of a lane runs in vectors; the texels are fetched one by one.
#[inline(always)]
pub(crate) fn open(
    scene: &SceneData,
    target: &Target,
    depth: &[f32],
    side: u32,
    at: &Lanes<'_>,
    asked: &[bool; LANES],
) -> [f32; LANES] {
    let frame = MapFrame::new(target, scene.lift());
    let get = |v: &Vec3Lanes, lane: usize| Vec3::new(v[0][lane], v[1][lane], v[2][lane]);
    let mut probes = [Probe::default(); LANES];
    for (lane, probe) in probes.iter_mut().enumerate() {
        let (position, facing) = (get(at.position, lane), get(at.facing, lane));
        *probe = occlusion::probe(&frame, position, facing, side);
    }
    let mut open = [0.0; LANES];
    for lane in 0..LANES {
        let probe = &probes[lane];
        if asked[lane] && !probe.hidden {
            let first = probe.first[1] * side + probe.first[0];
            let texel = |i: u32, j: u32| depth[(first + (j * side + i) * probe.next) as usize];
            let four = [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)];
            open[lane] = occlusion::open(probe, four);
        }
    }
    open
}

/// Where receivers are, and which way their triangles face.
pub(crate) struct Lanes<'a> {
    pub(crate) position: &'a Vec3Lanes,
    pub(crate) facing: &'a Vec3Lanes,
}
