//! The phases as a backend of core: each recorded, and submitted at once.

use crate::context::{Context, WgpuOptions};
use crate::passes;
use crate::passes::shade::Submits;
use crate::recorder::Recorder;
use crate::res::WgpuRes;
use crate::timing::{Clock, Timings};
use std::ops::Range;
use std::time::Instant;
use vsgl_core::backend::{Backend, PdfInputs, ShadeInputs};
use vsgl_core::data::{Columns, GBuffer, Image, Occlusion, Pdf, Radiance, Rsm, SceneData, Vsgls};
use vsgl_core::plan::{
    ClusterPlan, GBufferPlan, OcclusionPlan, PathPlan, PdfPlan, ReconstructPlan, RsmPlan, ShadePlan,
};
use vsgl_core::render::{Observer, Phase, View};
use vsgl_core::scene::Light;
use vsgl_core::{Error, Result};

/// Renders on a device that wgpu reaches. A phase is submitted and not waited for; only downloads wait.
#[derive(Debug)]
pub struct WgpuBackend {
    context: Context,
}

impl WgpuBackend {
    /// On a device of our own.
    ///
    /// # Errors
    /// As [`Context::headless`].
    pub fn headless(options: &WgpuOptions) -> Result<Self> {
        Context::headless(options).map(Self::from)
    }

    /// The device and what is made on it.
    pub fn context(&self) -> &Context {
        &self.context
    }

    /// Time of each phase since the last call, if [`WgpuOptions::timing`] asked for it. Waits for the device.
    ///
    /// # Errors
    /// [`Error::Device`] if it failed.
    pub fn timings(&self) -> Result<Option<Timings>> {
        self.context.timings()
    }

    /// Records and submits one phase.
    fn phase<T>(
        &self,
        phase: Phase,
        record: impl FnOnce(&mut Recorder<'_>) -> Result<T>,
    ) -> Result<T> {
        let start = Instant::now();
        let context = &self.context;
        let mut encoder = context.device().create_command_encoder(&Default::default());
        let mut recorder = Recorder::new(context, &mut encoder, phase);
        let made = record(&mut recorder)?;
        drop(recorder);
        context.queue().submit([encoder.finish()]);
        context.check()?;
        match context.timer() {
            Some(timer) if timer.clock() == Clock::Wall => {
                context.wait()?;
                timer.add_wall(phase, start.elapsed());
            }
            Some(_) => context.make_room_for_times()?,
            None => {}
        }
        Ok(made)
    }
}

impl From<Context> for WgpuBackend {
    fn from(context: Context) -> Self {
        Self { context }
    }
}

impl Backend for WgpuBackend {
    type Res<T: Columns> = WgpuRes<T>;

    fn name(&self) -> &'static str {
        "wgpu"
    }

    fn upload<T: Columns>(&self, value: T) -> Result<WgpuRes<T>> {
        WgpuRes::upload(&self.context, &value)
    }

    fn download<T: Columns>(&self, resource: &WgpuRes<T>) -> Result<T> {
        resource.download(&self.context)
    }

    fn finish(&self) -> Result<()> {
        self.context.wait()
    }

    fn gbuffer(
        &self,
        scene: &WgpuRes<SceneData>,
        view: &View,
        plan: &GBufferPlan,
    ) -> Result<WgpuRes<GBuffer>> {
        self.phase(Phase::GBuffer, |r| {
            passes::gbuffer::record(r, scene, view, plan)
        })
    }

    fn rsm(
        &self,
        scene: &WgpuRes<SceneData>,
        lights: &[Light],
        plan: &RsmPlan,
    ) -> Result<WgpuRes<Rsm>> {
        self.phase(Phase::Rsm, |r| passes::rsm::record(r, scene, lights, plan))
    }

    fn pdf(&self, inputs: &PdfInputs<'_, Self>, plan: &PdfPlan) -> Result<WgpuRes<Pdf>> {
        self.phase(Phase::Pdf, |r| passes::pdf::record(r, inputs, plan))
    }

    fn cluster(
        &self,
        scene: &WgpuRes<SceneData>,
        rsm: &WgpuRes<Rsm>,
        pdf: Option<&WgpuRes<Pdf>>,
        plan: &ClusterPlan,
    ) -> Result<WgpuRes<Vsgls>> {
        self.phase(Phase::Cluster, |r| {
            passes::cluster::record(r, scene, rsm, pdf, plan)
        })
    }

    fn occlusion(
        &self,
        scene: &WgpuRes<SceneData>,
        vsgls: &WgpuRes<Vsgls>,
        plan: &OcclusionPlan,
    ) -> Result<WgpuRes<Occlusion>> {
        self.phase(Phase::Occlusion, |r| {
            passes::occlusion::record(r, scene, vsgls, plan)
        })
    }

    fn shade(
        &self,
        inputs: &ShadeInputs<'_, Self>,
        plan: &ShadePlan,
        observer: &dyn Observer,
    ) -> Result<WgpuRes<Radiance>> {
        let shading = passes::shade::Shading::new(&self.context, inputs, plan, Submits::Bands)?;
        for (done, band) in shading.bands() {
            if observer.cancelled() {
                return Err(Error::Cancelled(Phase::Shade));
            }
            observer.advanced(Phase::Shade, done);
            self.phase(Phase::Shade, |r| shading.record(r, inputs, band))?;
            self.context.wait_but_one()?;
        }
        Ok(shading.finish())
    }

    fn reconstruct(
        &self,
        gbuffer: &WgpuRes<GBuffer>,
        radiance: &WgpuRes<Radiance>,
        plan: &ReconstructPlan,
    ) -> Result<WgpuRes<Radiance>> {
        self.phase(Phase::Reconstruct, |r| {
            passes::reconstruct::record(r, gbuffer, radiance, plan)
        })
    }

    fn trace(
        &self,
        scene: &WgpuRes<SceneData>,
        lights: &[Light],
        view: &View,
        plan: &PathPlan,
        samples: Range<u32>,
        observer: &dyn Observer,
    ) -> Result<WgpuRes<Radiance>> {
        let context = &self.context;
        let tracing = passes::path::Tracing::new(context, scene, lights, view, plan, samples)?;
        for dispatch in tracing.dispatches() {
            if observer.cancelled() {
                return Err(Error::Cancelled(Phase::Trace));
            }
            self.phase(Phase::Trace, |r| tracing.record(r, scene, dispatch))?;
            context.wait_but_one()?;
        }
        Ok(tracing.finish())
    }

    fn resolve(
        &self,
        gbuffer: &WgpuRes<GBuffer>,
        radiance: &WgpuRes<Radiance>,
        view: &View,
    ) -> Result<WgpuRes<Image>> {
        self.phase(Phase::Resolve, |r| {
            passes::resolve::record(r, gbuffer, radiance, view)
        })
    }
}
