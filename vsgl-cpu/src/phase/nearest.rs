//! Clusters of the texels nearest to centres: the loops of `vsgl_core::phase::nearest`.

use super::cluster::Cluster;
use super::partition::clusters;
use rayon::prelude::*;
use std::ops::Range;
use vsgl_core::data::{Pdf, Rsm};
use vsgl_core::glam::Vec3;
use vsgl_core::phase::nearest::{Centre, Centres, FAR, centres, drawn, key};
use vsgl_core::plan::ClusterPlan;

/// Clusters in the order in which their centres were drawn, and the cluster of each texel.
pub(crate) fn run(rsm: &Rsm, pdf: &Pdf, plan: &ClusterPlan) -> (Vec<Cluster>, Vec<u32>) {
    let found = Found::new(rsm, pdf);
    let count = (rsm.size * rsm.size) as usize;
    let nearest = |texel: usize| {
        if rsm.weight(texel) > 0.0 {
            found.nearest(pdf, rsm, texel / count, texel)
        } else {
            u32::MAX
        }
    };
    let mut label: Vec<u32> = (0..rsm.position.len())
        .into_par_iter()
        .map(nearest)
        .collect();
    let (list, ends) = sorted(&label, found.keys.len());
    let mut sets: Vec<&[u32]> = Vec::new();
    let mut start = 0;
    for end in ends {
        let set = &list[start..end];
        if !set.is_empty() {
            for &texel in set {
                label[texel as usize] = sets.len() as u32;
            }
            sets.push(set);
        }
        start = end;
    }
    (clusters(rsm, &sets, plan), label)
}

/// Texels with a label by label, and in ascending order where that is equal; where those of each label end.
fn sorted(label: &[u32], labels: usize) -> (Vec<u32>, Vec<usize>) {
    let mut ends = vec![0; labels];
    for &l in label.iter().filter(|l| **l != u32::MAX) {
        ends[l as usize] += 1;
    }
    let mut lit = 0;
    for end in &mut ends {
        let count = *end;
        *end = lit;
        lit += count;
    }
    let mut list = vec![0; lit];
    for (texel, &l) in label.iter().enumerate().filter(|(_, l)| **l != u32::MAX) {
        list[ends[l as usize]] = texel as u32;
        ends[l as usize] += 1;
    }
    (list, ends)
}

/// Centres that were drawn, in the order of their keys.
struct Found {
    centres: Centres,
    keys: Vec<u32>,
    /// Centres of each map.
    ranges: Vec<Range<usize>>,
}

impl Found {
    fn new(rsm: &Rsm, pdf: &Pdf) -> Self {
        let mut ranges = Vec::new();
        let mut passed = 0;
        let mut draws = Vec::new();
        for map in 0..pdf.maps {
            let count = centres(pdf, map);
            ranges.push(passed..passed + count as usize);
            passed += count as usize;
            draws.extend((0..count).map(|index| (map, index, count)));
        }
        let draw = |(number, &(map, index, count)): (usize, &(u32, u32, u32))| {
            let (x, y) = drawn(pdf, map, rsm.size, index, count);
            let texel = ((map * rsm.size + y) * rsm.size + x) as usize;
            let [px, py, pz, _] = rsm.position[texel];
            let position = if rsm.weight(texel) > 0.0 {
                Vec3::new(px, py, pz)
            } else {
                Vec3::splat(FAR)
            };
            let number = number as u32;
            (key(map, pdf.size, x, y), Centre { position, number })
        };
        let mut list: Vec<(u32, Centre)> = draws.par_iter().enumerate().map(draw).collect();
        list.sort_by_key(|&(key, _)| key);
        let (keys, list) = list.into_iter().unzip();
        Self {
            centres: Centres::new(list),
            keys,
            ranges,
        }
    }

    fn nearest(&self, pdf: &Pdf, rsm: &Rsm, map: usize, texel: usize) -> u32 {
        let range = self.ranges[map].clone();
        if range.is_empty() {
            return u32::MAX;
        }
        let side = rsm.size as usize;
        let (x, y) = (texel % side, texel / side % side);
        let own = key(map as u32, pdf.size, x as u32, y as u32);
        let past = self.keys[range.clone()].partition_point(|&key| key < own);
        let near = (range.start + past).min(range.end - 1);
        let [x, y, z, _] = rsm.position[texel];
        self.centres.nearest(range, near, Vec3::new(x, y, z))
    }
}
