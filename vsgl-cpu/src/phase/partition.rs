//! Clusters by exact partition: the loops of `vsgl_core::phase::partition`.
//!
//! Small sets run side by side, large ones are cut into pieces that do.

use super::cluster::Cluster;
use multiversion::multiversion;
use rayon::prelude::*;
use std::ops::Range;
use vsgl_core::data::Rsm;
use vsgl_core::math::fold;
use vsgl_core::phase::cluster::{self, Sum, draw};
use vsgl_core::phase::partition::{BLOCK, FEATURES, Features, LANES, Statistics, nodes, rounds};
use vsgl_core::phase::pdf::{GOLDEN_TURN, unit};
use vsgl_core::plan::ClusterPlan;

/// Position, weight and normal of a texel.
type Texel = [f32; FEATURES];

/// Texels of a set that is worth cutting into pieces of so many.
const PIECE: usize = 16 * BLOCK;

/// Clusters in order of their texels, and the cluster of each texel.
pub(crate) fn run(rsm: &Rsm, plan: &ClusterPlan) -> (Vec<Cluster>, Vec<u32>) {
    let texel = |i: usize| {
        let ([x, y, z, _], [nx, ny, nz, _]) = (rsm.position[i], rsm.normal[i]);
        [x, y, z, rsm.weight(i), nx, ny, nz, 0.0]
    };
    let texels: Vec<Texel> = (0..rsm.position.len()).into_par_iter().map(texel).collect();
    let mut tree = Tree::new(&texels, rsm);
    let lit = tree.nodes.iter().filter(|n| !n.range.is_empty()).count();
    let splits = (plan.count as usize).saturating_sub(lit);
    let most = nodes(plan.count, rsm.maps) as usize;
    for _ in 0..rounds(plan.count) {
        if !tree.round(&texels, splits, most) {
            break;
        }
    }
    let sets = tree.sets(rsm.maps, splits);
    let mut label = vec![u32::MAX; rsm.position.len()];
    for (cluster, set) in sets.iter().enumerate() {
        for &texel in *set {
            label[texel as usize] = cluster as u32;
        }
    }
    (clusters(rsm, &sets, plan), label)
}

/// Sums of the sets, and the texels that stand for them.
pub(crate) fn clusters(rsm: &Rsm, sets: &[&[u32]], plan: &ClusterPlan) -> Vec<Cluster> {
    let blocks: Vec<&[u32]> = sets
        .iter()
        .flat_map(|set| set.chunks(cluster::BLOCK))
        .collect();
    let sums: Vec<Sum> = blocks
        .par_iter()
        .map(|texels| Sum::of_texels(rsm, texels, plan))
        .collect();
    let mut first = 0;
    let ranges: Vec<(usize, Range<usize>)> = sets
        .iter()
        .enumerate()
        .map(|(index, set)| {
            let start = first;
            first += set.len().div_ceil(cluster::BLOCK);
            (index, start..first)
        })
        .collect();
    let cluster = |(index, range): (usize, Range<usize>)| {
        let blocks = &sums[range];
        // A golden-ratio sequence over the clusters: no two neighbours take the same place of their sums.
        let u = unit((index as u32).wrapping_mul(GOLDEN_TURN));
        Cluster {
            sum: Sum::of_blocks(blocks),
            texel: draw(rsm, sets[index], blocks, u),
        }
    };
    ranges.into_par_iter().map(cluster).collect()
}

/// Features of a range of the list.
fn features(texels: &[Texel], set: &[u32]) -> Features {
    let all = if set.len() < PIECE {
        fold::lanes::<LANES, _>(
            set.chunks(BLOCK).map(|b| features_of_block(texels, b)),
            Features::merge,
        )
    } else {
        let blocks: Vec<Features> = set
            .par_chunks(BLOCK)
            .map(|b| features_of_block(texels, b))
            .collect();
        fold::lanes::<LANES, _>(blocks, Features::merge)
    };
    all.unwrap_or_default()
}

#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn features_of_block(texels: &[Texel], block: &[u32]) -> Features {
    // The first halving while texels are fetched.
    let mut half = [Features::default(); BLOCK / 2];
    let count = block.len().next_power_of_two() / 2;
    let (low, high) = block.split_at(count);
    for (i, &texel) in low.iter().enumerate() {
        half[i] = Features::texel(&texels[texel as usize]);
        if let Some(&texel) = high.get(i) {
            half[i] = half[i].merge(Features::texel(&texels[texel as usize]));
        }
    }
    if count == 0 {
        return block.first().map_or_else(Features::default, |&texel| {
            Features::texel(&texels[texel as usize])
        });
    }
    fold::halve(&mut half[..count], |a, b| a.merge(b)).unwrap_or_default()
}

/// Brings the texels up to the threshold to the front and returns their number; both kinds keep their order.
fn partition(texels: &[Texel], set: &mut [u32], at: &Statistics, spare: &mut Vec<u32>) -> usize {
    spare.resize(set.len(), 0);
    let (mut first, mut second) = (0, 0);
    for i in 0..set.len() {
        let texel = set[i];
        let goes_first = texels[texel as usize][at.axis] <= at.threshold;
        // Both are written, only one counts: no branch to guess.
        set[first] = texel;
        spare[second] = texel;
        first += usize::from(goes_first);
        second += usize::from(!goes_first);
    }
    set[first..].copy_from_slice(&spare[..second]);
    first
}

/// As [`partition`], piece by piece.
fn partition_large(texels: &[Texel], set: &mut [u32], at: &Statistics) -> usize {
    let firsts: Vec<usize> = set
        .par_chunks_mut(PIECE)
        .map_init(Vec::new, |spare, piece| partition(texels, piece, at, spare))
        .collect();
    let mut sorted = Vec::with_capacity(set.len());
    for (piece, &first) in set.chunks(PIECE).zip(&firsts) {
        sorted.extend_from_slice(&piece[..first]);
    }
    let first = sorted.len();
    for (piece, &first) in set.chunks(PIECE).zip(&firsts) {
        sorted.extend_from_slice(&piece[first..]);
    }
    set.copy_from_slice(&sorted);
    first
}

/// A set of texels.
#[derive(Clone, Debug)]
struct Node {
    /// Its place in the list.
    range: Range<usize>,
    at: Statistics,
    /// Own priority, or that of the least node above, which must be taken first; 0 for sets that cannot be split.
    rank: f32,
    /// See [`Features::scale`].
    scale: f32,
    /// Index of the first of two children.
    children: Option<usize>,
}

impl Node {
    fn new(range: Range<usize>, at: Statistics, above: f32, scale: f32) -> Self {
        Self {
            range,
            at,
            rank: at.priority.min(above),
            scale,
            children: None,
        }
    }
}

struct Tree {
    nodes: Vec<Node>,
    /// Lit texels, in order of the tree.
    list: Vec<u32>,
}

impl Tree {
    fn new(texels: &[Texel], rsm: &Rsm) -> Self {
        let count = rsm.size * rsm.size;
        let mut list = Vec::new();
        let mut nodes = Vec::new();
        for map in 0..rsm.maps {
            let start = list.len();
            list.extend((map * count..(map + 1) * count).filter(|&t| texels[t as usize][3] > 0.0));
            let all = features(texels, &list[start..]);
            let scale = all.scale();
            let at = Statistics::new(&all, scale);
            nodes.push(Node::new(start..list.len(), at, f32::MAX, scale));
        }
        Self { nodes, list }
    }

    /// Indices of the nodes that best-first splitting would split first, at most `splits`; in no order.
    fn best(&self, splits: usize) -> Vec<usize> {
        let mut best: Vec<usize> = (0..self.nodes.len())
            .filter(|&i| self.nodes[i].rank > 0.0)
            .collect();
        if splits < best.len() {
            // Parents have lower indices than their children, so equal ranks keep them first.
            best.select_nth_unstable_by(splits, |&a, &b| {
                let by_rank = self.nodes[b].rank.total_cmp(&self.nodes[a].rank);
                by_rank.then(a.cmp(&b))
            });
            best.truncate(splits);
        }
        best
    }

    /// Splits every set among the best that is not split yet; false if there was none.
    fn round(&mut self, texels: &[Texel], splits: usize, most: usize) -> bool {
        let mut open = self.best(splits);
        open.retain(|&i| self.nodes[i].children.is_none());
        open.sort_unstable();
        open.truncate(most.saturating_sub(self.nodes.len()) / 2);
        // Ranges to write to, in order of the list.
        let mut sets: Vec<(usize, &mut [u32])> = Vec::with_capacity(open.len());
        let mut by_start = open.clone();
        by_start.sort_unstable_by_key(|&i| self.nodes[i].range.start);
        let (mut rest, mut passed) = (self.list.as_mut_slice(), 0);
        for &i in &by_start {
            let range = self.nodes[i].range.clone();
            let (set, after) = rest
                .split_at_mut(range.start - passed)
                .1
                .split_at_mut(range.len());
            (rest, passed) = (after, range.end);
            sets.push((i, set));
        }
        let nodes = &self.nodes;
        let mut halves: Vec<(usize, [Node; 2])> = sets
            .into_par_iter()
            .map_init(Vec::new, |spare, (i, set)| {
                let node = &nodes[i];
                let first = if set.len() < PIECE {
                    partition(texels, set, &node.at, spare)
                } else {
                    partition_large(texels, set, &node.at)
                };
                let middle = node.range.start + first;
                let (a, b) = set.split_at(first);
                let child = |range, set| {
                    let at = Statistics::new(&features(texels, set), node.scale);
                    Node::new(range, at, node.rank, node.scale)
                };
                let children = [
                    child(node.range.start..middle, a),
                    child(middle..node.range.end, b),
                ];
                (i, children)
            })
            .collect();
        halves.sort_unstable_by_key(|h| h.0);
        for (i, mut halves) in halves {
            if halves.iter().any(|half| half.range.is_empty()) {
                self.nodes[i].rank = 0.0;
                for half in &mut halves {
                    (half.range, half.rank) = (0..0, 0.0);
                }
            }
            self.nodes[i].children = Some(self.nodes.len());
            self.nodes.extend(halves);
        }
        !open.is_empty()
    }

    /// Texels of the clusters, in order of the list, once no round splits any more.
    fn sets(&self, maps: u32, splits: usize) -> Vec<&[u32]> {
        let mut taken = vec![false; self.nodes.len()];
        for node in self.best(splits) {
            taken[node] = true;
        }
        let mut sets = Vec::new();
        let mut open: Vec<usize> = (0..maps as usize).rev().collect();
        while let Some(index) = open.pop() {
            let node = &self.nodes[index];
            match node.children {
                Some(first) if taken[index] => open.extend([first + 1, first]),
                _ if node.range.is_empty() => {}
                _ => sets.push(&self.list[node.range.clone()]),
            }
        }
        sets
    }
}
