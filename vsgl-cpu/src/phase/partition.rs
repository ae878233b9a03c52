//! Clusters by exact partition.
//!
//! Greedy best-first splitting takes the sets of greatest priority, where a set counts at most as much as those that it
//! came from. So the same sets can be found in rounds: split every set that is still among the best, all at once, until
//! none is left that would be taken. Rounds run in parallel and give the same sets as taking them one by one.

use super::cluster::Cluster;
use rayon::prelude::*;
use vsgl_core::data::Rsm;
use vsgl_core::math::moments::Moments;
use vsgl_core::phase::cluster::{Sum, draw};
use vsgl_core::phase::partition::{FEATURES, LANES, Statistics, add_lanes, features};
use vsgl_core::phase::pdf::unit;
use vsgl_core::plan::ClusterPlan;

/// Clusters in order of the tree, and the cluster of each texel.
pub(crate) fn run(rsm: &Rsm, plan: &ClusterPlan) -> (Vec<Cluster>, Vec<u32>) {
    let mut tree = Tree {
        nodes: (0..rsm.maps).filter_map(|map| root(rsm, map)).collect(),
    };
    let roots = tree.nodes.len();
    let splits = (plan.count as usize).saturating_sub(roots);
    while tree.round(splits) {}
    let sets = tree.sets(roots, splits);
    let mut label = vec![u32::MAX; rsm.position.len()];
    for (cluster, set) in sets.iter().enumerate() {
        for &texel in set {
            label[texel as usize] = cluster as u32;
        }
    }
    let cluster = |(index, set): (usize, &Vec<u32>)| {
        let weights = set.iter().map(|&texel| {
            let (diffuse, specular) = rsm.weights(texel as usize);
            (texel, diffuse + specular)
        });
        // A golden-ratio sequence over the clusters: no two neighbours take the same place of their sums.
        let texel = draw(weights, unit((index as u32).wrapping_mul(2_654_435_769)));
        Cluster {
            sum: Sum::of(rsm, set, plan),
            texel,
        }
    };
    (sets.par_iter().enumerate().map(cluster).collect(), label)
}

/// Texels of a set, side by side, in ascending order.
#[derive(Clone, Debug, Default)]
struct Set {
    texel: Vec<u32>,
    weight: Vec<f32>,
    feature: [Vec<f32>; FEATURES],
}

impl Set {
    fn statistics(&self) -> Statistics {
        let total = sum(&self.weight, |i| self.weight[i]);
        let scale = 1.0 / total.max(f32::MIN_POSITIVE);
        let mean: [f32; FEATURES] = std::array::from_fn(|f| {
            let feature = &self.feature[f];
            sum(&self.weight, |i| self.weight[i] * feature[i]) * scale
        });
        let deviation: [f32; FEATURES] = std::array::from_fn(|f| {
            let feature = &self.feature[f];
            sum(&self.weight, |i| {
                let apart = feature[i] - mean[f];
                self.weight[i] * (apart * apart)
            })
        });
        Statistics::new(total, &mean, &deviation)
    }

    /// Texels at most at the threshold, and the others; nothing if either would be empty.
    fn split(&self, at: &Statistics) -> Option<[Self; 2]> {
        let feature = &self.feature[at.axis];
        let first = feature.iter().filter(|&&x| x <= at.threshold).count();
        if first == 0 || first == feature.len() {
            return None;
        }
        let side = |wanted: bool, count: usize| {
            fn keep<T: Copy>(
                from: &[T],
                feature: &[f32],
                at: f32,
                wanted: bool,
                count: usize,
            ) -> Vec<T> {
                let mut kept = Vec::with_capacity(count);
                kept.extend(
                    from.iter()
                        .zip(feature)
                        .filter(|(_, x)| (**x <= at) == wanted)
                        .map(|(v, _)| *v),
                );
                kept
            }
            Self {
                texel: keep(&self.texel, feature, at.threshold, wanted, count),
                weight: keep(&self.weight, feature, at.threshold, wanted, count),
                feature: std::array::from_fn(|f| {
                    keep(&self.feature[f], feature, at.threshold, wanted, count)
                }),
            }
        };
        Some([side(true, first), side(false, feature.len() - first)])
    }
}

/// Sum over a set in the order that the text of the phase fixes.
fn sum(weight: &[f32], term: impl Fn(usize) -> f32) -> f32 {
    let mut lanes = [0.0; LANES];
    let whole = weight.len() / LANES * LANES;
    let mut start = 0;
    while start < whole {
        for (lane, sum) in lanes.iter_mut().enumerate() {
            *sum += term(start + lane);
        }
        start += LANES;
    }
    for (lane, sum) in lanes.iter_mut().enumerate().take(weight.len() - whole) {
        *sum += term(whole + lane);
    }
    add_lanes(&lanes)
}

/// All texels of a map that have weight; nothing if none has.
fn root(rsm: &Rsm, map: u32) -> Option<Node> {
    let count = rsm.size * rsm.size;
    let weight_of = |texel: u32| {
        let (diffuse, specular) = rsm.weights(texel as usize);
        diffuse + specular
    };
    let texels = (map * count..(map + 1) * count).map(|texel| (texel, weight_of(texel)));
    let (texel, weight): (Vec<u32>, Vec<f32>) = texels.filter(|&(_, weight)| weight > 0.0).unzip();
    if texel.is_empty() {
        return None;
    }
    let (centre, spread) = extent(rsm, &texel, &weight);
    let all: Vec<[f32; FEATURES]> = texel
        .par_iter()
        .map(|&t| features(rsm, t as usize, centre, spread))
        .collect();
    let feature = std::array::from_fn(|f| all.iter().map(|x| x[f]).collect());
    Some(Node::new(
        Set {
            texel,
            weight,
            feature,
        },
        f32::INFINITY,
    ))
}

/// Weighted mean of the positions of a map, and the root of their variance \[m\].
fn extent(rsm: &Rsm, texel: &[u32], weight: &[f32]) -> ([f32; 3], f32) {
    fn merge(rsm: &Rsm, texel: &[u32], weight: &[f32]) -> (f32, Moments) {
        if let ([texel], [weight]) = (texel, weight) {
            let [x, y, z, _] = rsm.position[*texel as usize];
            return (*weight, Moments::point([x, y, z].into()));
        }
        let middle = texel.len() / 2;
        let (a, first) = merge(rsm, &texel[..middle], &weight[..middle]);
        let (b, second) = merge(rsm, &texel[middle..], &weight[middle..]);
        (a + b, first.merge(a, second, b))
    }
    let (total, moments) = merge(rsm, texel, weight);
    (moments.mean.to_array(), (moments.spread / total).sqrt())
}

#[derive(Debug)]
struct Node {
    at: Statistics,
    /// Own priority, or that of the least node above, which must be taken first.
    rank: f32,
    /// Texels, until the node is split.
    set: Set,
    /// Index of the first of two children.
    children: Option<usize>,
    /// Cannot be split: all texels agree in the widest feature.
    whole: bool,
}

impl Node {
    fn new(set: Set, above: f32) -> Self {
        let at = set.statistics();
        Self {
            at,
            rank: at.priority.min(above),
            set,
            children: None,
            whole: false,
        }
    }
}

struct Tree {
    nodes: Vec<Node>,
}

impl Tree {
    /// Indices of the nodes that best-first splitting would split first, at most `splits`.
    fn best(&self, splits: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.nodes.len())
            .filter(|&i| self.nodes[i].rank > 0.0 && !self.nodes[i].whole)
            .collect();
        // Parents have lower indices than their children, so equal ranks keep them first.
        order.sort_by(|&a, &b| {
            self.nodes[b]
                .rank
                .total_cmp(&self.nodes[a].rank)
                .then(a.cmp(&b))
        });
        order.truncate(splits);
        order
    }

    /// Splits every set among the best that is not split yet; false if there was none.
    fn round(&mut self, splits: usize) -> bool {
        let mut open = self.best(splits);
        open.retain(|&i| self.nodes[i].children.is_none());
        open.sort_unstable();
        let nodes = &self.nodes;
        let halves: Vec<Option<[Node; 2]>> = open
            .par_iter()
            .map(|&i| {
                let node = &nodes[i];
                node.set
                    .split(&node.at)
                    .map(|sets| sets.map(|set| Node::new(set, node.rank)))
            })
            .collect();
        for (&i, halves) in open.iter().zip(halves) {
            match halves {
                Some(halves) => {
                    self.nodes[i].children = Some(self.nodes.len());
                    self.nodes[i].set = Set::default();
                    self.nodes.extend(halves);
                }
                None => self.nodes[i].whole = true,
            }
        }
        !open.is_empty()
    }

    /// Texels of the clusters, in order of the tree, once no round splits any more.
    fn sets(&self, roots: usize, splits: usize) -> Vec<Vec<u32>> {
        let mut taken = vec![false; self.nodes.len()];
        for node in self.best(splits) {
            taken[node] = true;
        }
        let mut sets = Vec::new();
        let mut open: Vec<usize> = (0..roots).rev().collect();
        while let Some(index) = open.pop() {
            match self.nodes[index].children {
                Some(first) if taken[index] => open.extend([first + 1, first]),
                _ => sets.push(self.texels(index)),
            }
        }
        sets
    }

    /// All texels below a node, ascending.
    fn texels(&self, index: usize) -> Vec<u32> {
        let mut texels = Vec::new();
        let mut open = vec![index];
        while let Some(index) = open.pop() {
            let node = &self.nodes[index];
            texels.extend_from_slice(&node.set.texel);
            open.extend(
                node.children
                    .map(|first| [first, first + 1])
                    .into_iter()
                    .flatten(),
            );
        }
        texels.sort_unstable();
        texels
    }
}
