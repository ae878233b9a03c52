//! The CPU backend of vsgl: loops over the texts of `vsgl-core`, on all cores.
//!
//! Work is cut into pieces of fixed size, and sums over them are taken in a fixed order, so that a picture has the same
//! bits for any number of threads.
//!
//! ```
//! use vsgl_core::backend::Backend;
//! use vsgl_core::data::SceneData;
//! use vsgl_core::plan::Plan;
//! use vsgl_core::render::{View, render};
//! use vsgl_core::scene::{SceneFacts, samples};
//! use vsgl_core::settings::Settings;
//! use vsgl_cpu::CpuBackend;
//!
//! # fn main() -> vsgl_core::Result<()> {
//! let scene = samples::by_name("cornell")?;
//! let view = View::new(scene.cameras[0].1, 32, 18)?;
//! let facts = SceneFacts::new(&scene, &scene.lights, &view.camera);
//! let plan = Plan::new(&facts, &Settings { lights: 64, rsm: 64, ..Settings::default() })?;
//!
//! let backend = CpuBackend::new(0)?;
//! let data = backend.upload(SceneData::new(&scene))?;
//! let frame = render(&backend, &data, &scene.lights, &view, &plan, &())?;
//! let image = backend.download(&frame.image)?;
//! assert_eq!(image.beauty().len(), 32 * 18);
//! # Ok(())
//! # }
//! ```

pub mod explain;
mod phase;

use std::ops::Range;
use std::sync::Arc;
use vsgl_core::backend::{Backend, PdfInputs, ShadeInputs};
use vsgl_core::data::{Columns, GBuffer, Image, Occlusion, Pdf, Radiance, Rsm, SceneData, Vsgls};
use vsgl_core::phase::draw;
use vsgl_core::plan::{
    ClusterPlan, GBufferPlan, OcclusionPlan, PathPlan, PdfPlan, ReconstructPlan, RsmPlan, ShadePlan,
};
use vsgl_core::render::{Observer, View};
use vsgl_core::scene::Light;
use vsgl_core::settings::Primary;
use vsgl_core::{Error, Result};

pub use phase::block;

/// Renders on the processor's cores. Resources are shared host memory.
#[derive(Debug)]
pub struct CpuBackend {
    pool: rayon::ThreadPool,
}

impl CpuBackend {
    /// Most threads.
    pub const THREADS_MAX: usize = 1024;

    /// A backend with its own threads; 0 takes one for each core.
    ///
    /// # Errors
    /// [`Error::Setting`] if there are more than [`CpuBackend::THREADS_MAX`], or the system refuses them.
    pub fn new(threads: usize) -> Result<Self> {
        let remedy = format!("give 0 for all cores, or at most {}", Self::THREADS_MAX);
        if threads > Self::THREADS_MAX {
            return Err(Error::setting("threads", threads.to_string(), remedy));
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map(|pool| Self { pool })
            .map_err(|e| Error::setting("threads", e.to_string(), remedy))
    }

    /// Number of threads at work.
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }
}

impl Backend for CpuBackend {
    type Res<T: Columns> = Arc<T>;

    fn name(&self) -> &'static str {
        "cpu"
    }

    fn upload<T: Columns>(&self, value: T) -> Result<Arc<T>> {
        Ok(Arc::new(value))
    }

    fn download<T: Columns>(&self, resource: &Arc<T>) -> Result<T> {
        Ok(T::clone(resource))
    }

    fn finish(&self) -> Result<()> {
        Ok(())
    }

    fn gbuffer(
        &self,
        scene: &Arc<SceneData>,
        view: &View,
        plan: &GBufferPlan,
    ) -> Result<Arc<GBuffer>> {
        if plan.primary == Primary::Raster {
            return Err(Error::setting(
                "primary",
                "the backend cpu has no rasteriser",
                "take `--backend wgpu`, or `--primary rays`",
            ));
        }
        Ok(Arc::new(
            self.pool.install(|| phase::gbuffer::run(scene, view, plan)),
        ))
    }

    fn rsm(&self, scene: &Arc<SceneData>, lights: &[Light], plan: &RsmPlan) -> Result<Arc<Rsm>> {
        Ok(Arc::new(
            self.pool.install(|| phase::rsm::run(scene, lights, plan)),
        ))
    }

    fn pdf(&self, inputs: &PdfInputs<'_, Self>, plan: &PdfPlan) -> Result<Arc<Pdf>> {
        Ok(Arc::new(
            self.pool.install(|| phase::pdf::run(inputs, plan)),
        ))
    }

    fn cluster(
        &self,
        scene: &Arc<SceneData>,
        rsm: &Arc<Rsm>,
        pdf: Option<&Arc<Pdf>>,
        plan: &ClusterPlan,
    ) -> Result<Arc<Vsgls>> {
        Ok(Arc::new(self.pool.install(|| {
            phase::cluster::run(scene, rsm, pdf.map(|p| &**p), plan)
        })))
    }

    fn occlusion(
        &self,
        scene: &Arc<SceneData>,
        vsgls: &Arc<Vsgls>,
        plan: &OcclusionPlan,
    ) -> Result<Arc<Occlusion>> {
        Ok(Arc::new(
            self.pool
                .install(|| phase::occlusion::run(scene, vsgls, plan)),
        ))
    }

    fn shade(
        &self,
        inputs: &ShadeInputs<'_, Self>,
        plan: &ShadePlan,
        observer: &dyn Observer,
    ) -> Result<Arc<Radiance>> {
        self.pool
            .install(|| phase::shade::run(inputs, plan, observer))
            .map(Arc::new)
    }

    fn reconstruct(
        &self,
        gbuffer: &Arc<GBuffer>,
        radiance: &Arc<Radiance>,
        plan: &ReconstructPlan,
    ) -> Result<Arc<Radiance>> {
        Ok(Arc::new(self.pool.install(|| {
            phase::reconstruct::run(gbuffer, radiance, plan)
        })))
    }

    fn trace(
        &self,
        scene: &Arc<SceneData>,
        lights: &[Light],
        view: &View,
        plan: &PathPlan,
        samples: Range<u32>,
        observer: &dyn Observer,
    ) -> Result<Arc<Radiance>> {
        let lights = draw::lights(lights, scene.bounds(), plan.light_sampling);
        self.pool
            .install(|| phase::path::run(scene, &lights, view, plan, samples, observer))
            .map(Arc::new)
    }

    fn resolve(
        &self,
        gbuffer: &Arc<GBuffer>,
        radiance: &Arc<Radiance>,
        view: &View,
    ) -> Result<Arc<Image>> {
        Ok(Arc::new(
            self.pool
                .install(|| phase::resolve::run(gbuffer, radiance, view)),
        ))
    }
}
