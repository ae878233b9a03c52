//! All phases on two backends, each from the reference's input.

use super::compare::{Origin, Side, agreement, compare};
use super::tolerance::Tolerance;
use super::verdict::Comparison;
use crate::backend::{Backend, PdfInputs, Senders, ShadeInputs};
use crate::data::{Columns, GBuffer, Image, Occlusion, Pdf, Rsm, SceneData, Vsgls};
use crate::error::{Error, Result};
use crate::plan::{PathPlan, Plan};
use crate::render::{Observer, Phase, View, render};
use crate::scene::Light;
use std::fmt;
use std::time::Instant;

/// A backend and how to call it.
#[derive(Debug)]
pub struct Party<'a, B> {
    /// The backend.
    pub backend: &'a B,
    /// What reports say about where its results came from.
    pub origin: Origin,
}

/// What is rendered.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// The scene.
    pub scene: &'a SceneData,
    /// The lights that shine.
    pub lights: &'a [Light],
    /// Camera and size.
    pub view: &'a View,
    /// What runs.
    pub plan: &'a Plan,
}

/// What was compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// One phase, from the input that the reference made.
    Phase(Phase),
    /// The whole pipeline, each backend from its own results.
    Frame,
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Phase(phase) => phase.fmt(f),
            Self::Frame => f.pad("frame"),
        }
    }
}

/// One comparison of the chain.
#[derive(Clone, Debug)]
pub struct Step {
    /// What was compared.
    pub stage: Stage,
    /// What was found.
    pub comparison: Comparison,
}

/// Compares two backends phase by phase, then as a whole.
///
/// Each phase of the tested backend gets the reference's input, so that a decision that one phase makes otherwise does
/// not show up in all after it. Whole pictures are judged where both cameras see the same triangles.
///
/// # Errors
/// What the backends return; [`Error::Comparison`] for a backend and itself; [`Error::Cancelled`] if the observer says so.
pub fn chain<R: Backend, T: Backend>(
    reference: &Party<'_, R>,
    tested: &Party<'_, T>,
    subject: &Subject<'_>,
    tolerance: &Tolerance,
    observer: &dyn Observer,
) -> Result<Vec<Step>> {
    let tolerance = match &subject.plan.path {
        Some(_) => tolerance.of_paths(),
        None => *tolerance,
    };
    let mut run = Run {
        reference,
        tested,
        tolerance: &tolerance,
        observer,
        steps: Vec::new(),
    };
    let (lights, view, plan) = (subject.lights, subject.view, subject.plan);
    let (r, t) = (reference.backend, tested.backend);
    let scene = Twin::new(r, t, subject.scene.clone())?;

    let gbuffer = run.phase(
        Phase::GBuffer,
        || r.gbuffer(&scene.reference, view, &plan.gbuffer),
        || t.gbuffer(&scene.tested, view, &plan.gbuffer),
    )?;
    if let Some(path) = &plan.path {
        let samples = 0..path.samples.min(PathPlan::PIECE);
        run.phase(
            Phase::Trace,
            || {
                r.trace(
                    &scene.reference,
                    lights,
                    view,
                    path,
                    samples.clone(),
                    observer,
                )
            },
            || t.trace(&scene.tested, lights, view, path, samples.clone(), observer),
        )?;
        drop(gbuffer);
        run.frame(&scene, subject)?;
        return Ok(run.steps);
    }
    let senders = run.senders(&scene, &gbuffer, subject)?;
    let maps = run.maps(&scene, &senders, plan)?;
    let inputs = ShadeInputs {
        scene: &scene.reference,
        gbuffer: &gbuffer.reference,
        view,
        lights,
        senders: senders.reference(),
        occlusion: maps.as_ref().map(|maps| &maps.reference),
    };
    let tested_inputs = ShadeInputs {
        scene: &scene.tested,
        gbuffer: &gbuffer.tested,
        view,
        lights,
        senders: senders.tested(),
        occlusion: maps.as_ref().map(|maps| &maps.tested),
    };
    let radiance = run.phase(
        Phase::Shade,
        || r.shade(&inputs, &plan.shade, observer),
        || t.shade(&tested_inputs, &plan.shade, observer),
    )?;
    let radiance = match &plan.reconstruct {
        Some(plan) => run.phase(
            Phase::Reconstruct,
            || r.reconstruct(&gbuffer.reference, &radiance.reference, plan),
            || t.reconstruct(&gbuffer.tested, &radiance.tested, plan),
        )?,
        None => radiance,
    };
    run.phase(
        Phase::Resolve,
        || r.resolve(&gbuffer.reference, &radiance.reference, view),
        || t.resolve(&gbuffer.tested, &radiance.tested, view),
    )?;
    // Room for the frames.
    drop((senders, maps, gbuffer, radiance));
    run.frame(&scene, subject)?;
    Ok(run.steps)
}

/// One resource where both backends keep it.
struct Twin<R: Backend, T: Backend, C: Columns> {
    reference: R::Res<C>,
    tested: T::Res<C>,
}

impl<R: Backend, T: Backend, C: Columns> Twin<R, T, C> {
    fn new(reference: &R, tested: &T, value: C) -> Result<Self> {
        Ok(Self {
            reference: reference.upload(value.clone())?,
            tested: tested.upload(value)?,
        })
    }
}

/// Where indirect light comes from, on both backends.
enum Twins<R: Backend, T: Backend> {
    None,
    Vsgls(Twin<R, T, Vsgls>),
    Vpls(Twin<R, T, Rsm>),
}

impl<R: Backend, T: Backend> Twins<R, T> {
    fn reference(&self) -> Senders<'_, R> {
        match self {
            Self::None => Senders::None,
            Self::Vsgls(twin) => Senders::Vsgls(&twin.reference),
            Self::Vpls(twin) => Senders::Vpls(&twin.reference),
        }
    }

    fn tested(&self) -> Senders<'_, T> {
        match self {
            Self::None => Senders::None,
            Self::Vsgls(twin) => Senders::Vsgls(&twin.tested),
            Self::Vpls(twin) => Senders::Vpls(&twin.tested),
        }
    }
}

struct Run<'a, R, T> {
    reference: &'a Party<'a, R>,
    tested: &'a Party<'a, T>,
    tolerance: &'a Tolerance,
    observer: &'a dyn Observer,
    steps: Vec<Step>,
}

impl<R: Backend, T: Backend> Run<'_, R, T> {
    /// Runs a phase on both, compares, and puts the reference's result where both can read it.
    fn phase<C: Columns>(
        &mut self,
        phase: Phase,
        on_reference: impl FnOnce() -> Result<R::Res<C>>,
        on_tested: impl FnOnce() -> Result<T::Res<C>>,
    ) -> Result<Twin<R, T, C>> {
        if self.observer.cancelled() {
            return Err(Error::Cancelled(phase));
        }
        self.observer.started(phase);
        let start = Instant::now();
        let (reference, tested) = (self.reference.backend, self.tested.backend);
        let expected = on_reference()?;
        let value = reference.download(&expected)?;
        let found = tested.download(&on_tested()?)?;
        self.compare(Stage::Phase(phase), &found, &value, None)?;
        self.observer.finished(phase, start.elapsed());
        Ok(Twin {
            reference: expected,
            tested: tested.upload(value)?,
        })
    }

    fn compare<C: Columns>(
        &mut self,
        stage: Stage,
        tested: &C,
        reference: &C,
        agree: Option<&[bool]>,
    ) -> Result<()> {
        let tested = Side {
            origin: &self.tested.origin,
            value: tested,
        };
        let reference = Side {
            origin: &self.reference.origin,
            value: reference,
        };
        let comparison = compare(&tested, &reference, self.tolerance, agree)?;
        self.steps.push(Step { stage, comparison });
        Ok(())
    }

    /// The phases that make virtual lights, as far as the plan has them.
    fn senders(
        &mut self,
        scene: &Twin<R, T, SceneData>,
        gbuffer: &Twin<R, T, GBuffer>,
        subject: &Subject<'_>,
    ) -> Result<Twins<R, T>> {
        let (r, t) = (self.reference.backend, self.tested.backend);
        let Some(bounce) = &subject.plan.bounce else {
            return Ok(Twins::None);
        };
        let rsm = self.phase(
            Phase::Rsm,
            || r.rsm(&scene.reference, subject.lights, &bounce.rsm),
            || t.rsm(&scene.tested, subject.lights, &bounce.rsm),
        )?;
        let inputs = PdfInputs {
            scene: &scene.reference,
            rsm: &rsm.reference,
            gbuffer: &gbuffer.reference,
            view: subject.view,
        };
        let tested_inputs = PdfInputs {
            scene: &scene.tested,
            rsm: &rsm.tested,
            gbuffer: &gbuffer.tested,
            view: subject.view,
        };
        let pdf: Option<Twin<R, T, Pdf>> = match &bounce.pdf {
            Some(plan) => Some(self.phase(
                Phase::Pdf,
                || r.pdf(&inputs, plan),
                || t.pdf(&tested_inputs, plan),
            )?),
            None => None,
        };
        let Some(plan) = &bounce.cluster else {
            return Ok(Twins::Vpls(rsm));
        };
        let densities = (
            pdf.as_ref().map(|p| &p.reference),
            pdf.as_ref().map(|p| &p.tested),
        );
        let vsgls = self.phase(
            Phase::Cluster,
            || r.cluster(&scene.reference, &rsm.reference, densities.0, plan),
            || t.cluster(&scene.tested, &rsm.tested, densities.1, plan),
        )?;
        Ok(Twins::Vsgls(vsgls))
    }

    /// The shadow maps of the clusters, if the plan has them.
    fn maps(
        &mut self,
        scene: &Twin<R, T, SceneData>,
        senders: &Twins<R, T>,
        plan: &Plan,
    ) -> Result<Option<Twin<R, T, Occlusion>>> {
        let (r, t) = (self.reference.backend, self.tested.backend);
        let wanted = plan.bounce.as_ref().and_then(|b| b.occlusion.as_ref());
        let (Twins::Vsgls(vsgls), Some(plan)) = (senders, wanted) else {
            return Ok(None);
        };
        let maps = self.phase(
            Phase::Occlusion,
            || r.occlusion(&scene.reference, &vsgls.reference, plan),
            || t.occlusion(&scene.tested, &vsgls.tested, plan),
        )?;
        Ok(Some(maps))
    }

    /// The whole pipeline on both.
    fn frame(&mut self, scene: &Twin<R, T, SceneData>, subject: &Subject<'_>) -> Result<()> {
        let expected = picture(
            self.reference.backend,
            &scene.reference,
            subject,
            self.observer,
        )?;
        let found = picture(self.tested.backend, &scene.tested, subject, self.observer)?;
        let agree = agreement(&found.0, &expected.0, subject.view.aa);
        self.compare(Stage::Frame, &found.1, &expected.1, Some(&agree))
    }
}

/// What the camera sees, and the picture.
fn picture<B: Backend>(
    backend: &B,
    scene: &B::Res<SceneData>,
    subject: &Subject<'_>,
    observer: &dyn Observer,
) -> Result<(GBuffer, Image)> {
    let frame = render(
        backend,
        scene,
        subject.lights,
        subject.view,
        subject.plan,
        observer,
    )?;
    Ok((
        backend.download(&frame.gbuffer)?,
        backend.download(&frame.image)?,
    ))
}
