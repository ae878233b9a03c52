//! From texels to virtual spherical Gaussian lights.

use super::{filtered, nearest, partition, whole};
use rayon::prelude::*;
use vsgl_core::data::{MapRecord, Pdf, Rsm, SceneData, Vsgls};
use vsgl_core::phase::cluster::{Sum, lights, stretched, target};
use vsgl_core::plan::ClusterPlan;
use vsgl_core::settings::Clustering;

/// A cluster before it becomes a light.
#[derive(Clone, Debug)]
pub(crate) struct Cluster {
    pub(crate) sum: Sum,
    /// The texel that stands for it.
    pub(crate) texel: u32,
}

pub(crate) fn run(scene: &SceneData, rsm: &Rsm, pdf: Option<&Pdf>, plan: &ClusterPlan) -> Vsgls {
    let (clusters, label, kernel) = match pdf {
        Some(pdf) if plan.method.has_kernels() => {
            let (clusters, kernel) = filtered::run(rsm, pdf, plan);
            (clusters, Vec::new(), kernel)
        }
        Some(pdf) if plan.method == Clustering::NearestWorld => {
            let (clusters, label) = nearest::run(rsm, pdf, plan);
            (clusters, label, Vec::new())
        }
        _ if plan.method == Clustering::Whole => (whole::run(rsm, plan), Vec::new(), Vec::new()),
        _ => {
            let (clusters, label) = partition::run(rsm, plan);
            (clusters, label, Vec::new())
        }
    };
    Vsgls {
        label,
        kernel,
        ..gather(scene, rsm, &clusters, plan)
    }
}

fn gather(scene: &SceneData, rsm: &Rsm, clusters: &[Cluster], plan: &ClusterPlan) -> Vsgls {
    let map = |c: &Cluster| -> &MapRecord { rsm.map_of(c.texel as usize) };
    let made: Vec<_> = clusters
        .par_iter()
        .map(|c| {
            let (diffuse, specular) = lights(&c.sum, map(c), plan);
            if plan.anisotropic {
                (diffuse, stretched(specular, rsm, c.texel))
            } else {
                (diffuse, specular)
            }
        })
        .collect();
    let targets = clusters
        .iter()
        .map(|c| target(scene, rsm, c.texel))
        .collect();
    Vsgls::from_lights(
        &made,
        plan.glossy,
        targets,
        clusters.iter().map(|c| c.texel).collect(),
    )
}
