//! Texels of a reflective shadow map by the cluster that they are in.

use crate::CpuBackend;
use rayon::prelude::*;
use std::ops::Range;
use vsgl_core::data::{Rsm, SceneData, Target, Vsgls, map_kind};
use vsgl_core::phase::cluster::target;
use vsgl_core::phase::shade::PointSender;

/// Texels that reflect light, in sets: those of each cluster, and last those of none.
#[derive(Clone, Debug)]
pub struct Sets {
    /// The texels as point lights, set after set.
    pub(super) points: Vec<PointSender>,
    /// Where shadow rays to them end.
    pub(super) targets: Vec<Target>,
    /// Where the sets begin, and the end of the last.
    starts: Vec<usize>,
}

impl Sets {
    /// The sets of a partition: set `c` holds the texels that `set_of` gives `c`, the last set those that it gives none. Texels of
    /// surfaces that shine are left out: their light is direct.
    pub fn new(
        backend: &CpuBackend,
        scene: &SceneData,
        rsm: &Rsm,
        glossy: bool,
        count: u32,
        set_of: &(impl Fn(usize) -> Option<u32> + Sync),
    ) -> Self {
        backend.pool.install(|| {
            let one = |texel: usize| {
                if rsm.map_of(texel).kind == map_kind::EMITTERS {
                    return None;
                }
                let point = PointSender::of(rsm, texel, glossy)?;
                let set = set_of(texel).unwrap_or(count).min(count);
                Some((set, target(scene, rsm, texel as u32), point))
            };
            let texels = (0..rsm.position.len()).into_par_iter();
            let mut all: Vec<_> = texels.filter_map(one).collect();
            // Stable: texels of a set stay in the order of the map, neighbours beside each other.
            all.par_sort_by_key(|(set, _, _)| *set);
            let starts = (0..=count + 1)
                .map(|set| all.partition_point(|(of, _, _)| *of < set))
                .collect();
            Self {
                points: all.iter().map(|(_, _, point)| *point).collect(),
                targets: all.iter().map(|(_, target, _)| *target).collect(),
                starts,
            }
        })
    }

    /// The cluster of each texel of a map, if every texel is in one at most: what the partition and the nearest centres say, and of
    /// whole maps their only one. None for kernels, which overlap.
    pub fn labels(rsm: &Rsm, vsgls: &Vsgls) -> Option<Vec<u32>> {
        if !vsgls.label.is_empty() {
            return Some(vsgls.label.clone());
        }
        if !vsgls.kernel.is_empty() {
            return None;
        }
        let texels = rsm.size as usize * rsm.size as usize;
        let mut of_map = vec![u32::MAX; rsm.maps as usize];
        for (cluster, &texel) in vsgls.texel.iter().enumerate() {
            of_map[texel as usize / texels] = cluster as u32;
        }
        let label = |texel: usize| of_map[texel / texels];
        Some((0..rsm.position.len()).map(label).collect())
    }

    /// Number of sets, that of texels without a cluster included.
    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of texels.
    pub fn texels(&self) -> usize {
        self.points.len()
    }

    /// The texels of a set, as ranges of at most [`Sets::STRATUM`].
    pub(super) fn strata(&self, set: usize) -> impl Iterator<Item = Range<usize>> {
        let (start, end) = (self.starts[set], self.starts[set + 1]);
        (start..end)
            .step_by(Self::STRATUM)
            .map(move |first| first..end.min(first + Self::STRATUM))
    }

    /// Number of ranges of texels that rays are drawn to.
    pub fn ranges(&self) -> usize {
        let range = |s: &[usize]| (s[1] - s[0]).div_ceil(Self::STRATUM);
        self.starts.windows(2).map(range).sum()
    }

    /// Most texels that rays are drawn among at a time.
    pub const STRATUM: usize = 256;
}
