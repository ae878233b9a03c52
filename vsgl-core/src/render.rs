//! The order of the phases, once for all backends.

use crate::backend::{Backend, PdfInputs, Senders, ShadeInputs};
use crate::data::{GBuffer, Image, Occlusion, Pdf, Radiance, Rsm, SceneData, Vsgls};
use crate::error::{Error, Result};
use crate::plan::Plan;
use crate::scene::{Camera, Light};
use crate::trace::Paths;
use std::fmt;
use std::time::{Duration, Instant};

/// Camera, size and samples of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The camera.
    pub camera: Camera,
    /// Width of the full picture in pixels.
    pub width: u32,
    /// Height of the full picture in pixels.
    pub height: u32,
    /// Samples along each side of a pixel, on a regular grid.
    pub aa: u32,
    /// Every which pixel of the full picture is rendered, along both sides, beginning with the first.
    pub stride: u32,
}

impl View {
    /// Most samples of one picture: rendering them takes at most about 8 GB.
    pub const SAMPLES_MAX: u64 = 1 << 25;

    /// One sample a pixel, every pixel.
    ///
    /// # Errors
    /// As [`View::checked`].
    pub fn new(camera: Camera, width: u32, height: u32) -> Result<Self> {
        Self {
            camera,
            width,
            height,
            aa: 1,
            stride: 1,
        }
        .checked()
    }

    /// The view, if its sizes can be rendered.
    ///
    /// # Errors
    /// [`Error::Setting`] for an empty or too large picture.
    pub fn checked(self) -> Result<Self> {
        for (name, value) in [
            ("size", self.width),
            ("size", self.height),
            ("aa", self.aa),
            ("stride", self.stride),
        ] {
            if value == 0 {
                return Err(Error::setting(name, "0", "give at least 1"));
            }
        }
        let (width, height) = self.pixels();
        let samples = (u64::from(width) * u64::from(height))
            .saturating_mul(u64::from(self.aa).saturating_mul(u64::from(self.aa)));
        if samples > Self::SAMPLES_MAX {
            return Err(Error::setting(
                "size",
                format!(
                    "{width}x{height} pixels with --aa {} are {samples} samples",
                    self.aa
                ),
                format!(
                    "at most {} fit; make the picture or --aa smaller",
                    Self::SAMPLES_MAX
                ),
            ));
        }
        Ok(self)
    }

    /// Width and height in pixels of what is rendered.
    pub fn pixels(&self) -> (u32, u32) {
        (
            self.width.div_ceil(self.stride),
            self.height.div_ceil(self.stride),
        )
    }

    /// Width and height in samples of what is rendered.
    pub fn samples(&self) -> (u32, u32) {
        let (width, height) = self.pixels();
        (width * self.aa, height * self.aa)
    }
}

/// A phase of the pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Phase {
    /// What the lights see.
    Rsm,
    /// The density on it.
    Pdf,
    /// Virtual lights from it.
    Cluster,
    /// What blocks their light.
    Occlusion,
    /// What the camera sees.
    GBuffer,
    /// Light to the eye.
    Shade,
    /// From shares of the virtual lights to all of them.
    Reconstruct,
    /// Paths of light.
    Trace,
    /// Samples to pixels.
    Resolve,
}

impl fmt::Display for Phase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Rsm => "rsm",
            Self::Pdf => "pdf",
            Self::Cluster => "cluster",
            Self::Occlusion => "occlusion",
            Self::GBuffer => "gbuffer",
            Self::Shade => "shade",
            Self::Reconstruct => "reconstruct",
            Self::Trace => "trace",
            Self::Resolve => "resolve",
        })
    }
}

/// Is told how far a picture is, and may stop it.
pub trait Observer: Sync {
    /// A phase begins.
    fn started(&self, _phase: Phase) {}
    /// A share of the current phase is done, 0..=1. May be called from any thread.
    fn advanced(&self, _phase: Phase, _share: f32) {}
    /// A phase has ended.
    fn finished(&self, _phase: Phase, _wall: Duration) {}
    /// Asked between phases and inside long ones.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Nobody watches.
impl Observer for () {}

/// Everything that a picture was made of, where the backend keeps it.
#[derive(Debug)]
pub struct Frame<B: Backend> {
    /// What the lights see.
    pub rsm: Option<B::Res<Rsm>>,
    /// The density on it.
    pub pdf: Option<B::Res<Pdf>>,
    /// Virtual lights.
    pub vsgls: Option<B::Res<Vsgls>>,
    /// Their shadow maps.
    pub occlusion: Option<B::Res<Occlusion>>,
    /// What the camera sees.
    pub gbuffer: B::Res<GBuffer>,
    /// Light to the eye, a sample.
    pub radiance: B::Res<Radiance>,
    /// The picture.
    pub image: B::Res<Image>,
}

/// Renders a picture: RSM → G-buffer → PDF → cluster → occlusion → shade → reconstruct → resolve, as far as the plan wants them; or paths,
/// with the method `path`.
///
/// # Errors
/// [`Error::Cancelled`] if the observer says so, and what the backend's phases return.
pub fn render<B: Backend>(
    backend: &B,
    scene: &B::Res<SceneData>,
    lights: &[Light],
    view: &View,
    plan: &Plan,
    observer: &dyn Observer,
) -> Result<Frame<B>> {
    if plan.path.is_some() {
        let paths = Paths {
            backend,
            scene,
            lights,
            view,
            plan,
        };
        return paths.frame(observer);
    }
    let bounce = plan.bounce.as_ref();
    let rsm = bounce
        .map(|p| run(observer, Phase::Rsm, || backend.rsm(scene, lights, &p.rsm)))
        .transpose()?;
    let gbuffer = run(observer, Phase::GBuffer, || {
        backend.gbuffer(scene, view, &plan.gbuffer)
    })?;
    let pdf = match (&rsm, bounce.and_then(|p| p.pdf.as_ref())) {
        (Some(rsm), Some(p)) => {
            let inputs = PdfInputs {
                scene,
                rsm,
                gbuffer: &gbuffer,
                view,
            };
            Some(run(observer, Phase::Pdf, || backend.pdf(&inputs, p))?)
        }
        _ => None,
    };
    let vsgls = match (&rsm, bounce.and_then(|p| p.cluster.as_ref())) {
        (Some(rsm), Some(p)) => Some(run(observer, Phase::Cluster, || {
            backend.cluster(scene, rsm, pdf.as_ref(), p)
        })?),
        _ => None,
    };
    let occlusion = match (&vsgls, bounce.and_then(|p| p.occlusion.as_ref())) {
        (Some(vsgls), Some(p)) => Some(run(observer, Phase::Occlusion, || {
            backend.occlusion(scene, vsgls, p)
        })?),
        _ => None,
    };
    let senders = match (&vsgls, &rsm) {
        (Some(vsgls), _) => Senders::Vsgls(vsgls),
        (None, Some(rsm)) => Senders::Vpls(rsm),
        (None, None) => Senders::None,
    };
    let inputs = ShadeInputs {
        scene,
        gbuffer: &gbuffer,
        view,
        lights,
        senders,
        occlusion: occlusion.as_ref(),
    };
    let radiance = run(observer, Phase::Shade, || {
        backend.shade(&inputs, &plan.shade, observer)
    })?;
    let radiance = match &plan.reconstruct {
        Some(plan) => run(observer, Phase::Reconstruct, || {
            backend.reconstruct(&gbuffer, &radiance, plan)
        })?,
        None => radiance,
    };
    let image = run(observer, Phase::Resolve, || {
        backend.resolve(&gbuffer, &radiance, view)
    })?;
    Ok(Frame {
        rsm,
        pdf,
        vsgls,
        occlusion,
        gbuffer,
        radiance,
        image,
    })
}

pub(crate) fn run<T>(
    observer: &dyn Observer,
    phase: Phase,
    work: impl FnOnce() -> Result<T>,
) -> Result<T> {
    if observer.cancelled() {
        return Err(Error::Cancelled(phase));
    }
    observer.started(phase);
    let start = Instant::now();
    let result = work();
    observer.finished(phase, start.elapsed());
    result
}
