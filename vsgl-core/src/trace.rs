//! Paths of light, piece by piece, to a picture.
//!
//! [`crate::render::render`] does it all at once. A program that wants to stop on the way, go on later, or make a picture on
//! several machines, does the same by itself: [`Paths::layers`] for what is not light, [`Paths::add`] for each of [`pieces`], and
//! [`Sums::mean`] whenever it wants to see what there is. Sums that were made apart are put together by [`Sums::merge`];
//! whichever way the samples went, the picture has the same bits.

mod sums;

pub use sums::{Sum, Sums};

use crate::backend::Backend;
use crate::data::{GBuffer, Image, Radiance, SceneData};
use crate::error::{Error, Result};
use crate::plan::{PathPlan, Plan};
use crate::render::{Frame, Observer, Phase, View, run};
use crate::scene::Light;
use std::ops::Range;

/// The pieces of a range of samples, in order.
///
/// # Errors
/// [`Error::Setting`] for a range that is empty or goes beyond `samples`, or whose ends lie within a piece: samples of a piece are
/// added up in f32, all or none. The end of all samples may.
///
/// ```
/// use vsgl_core::trace::pieces;
/// assert_eq!(pieces(8..20, 20).expect("whole pieces").collect::<Vec<_>>(), [8..16, 16..20]);
/// assert!(pieces(8..20, 24).is_err());
/// ```
pub fn pieces(range: Range<u32>, samples: u32) -> Result<impl Iterator<Item = Range<u32>>> {
    let Range { start, end } = range;
    let step = PathPlan::PIECE;
    let whole = start.is_multiple_of(step) && (end.is_multiple_of(step) || end == samples);
    if start >= end || end > samples || !whole {
        return Err(Error::setting(
            "samples",
            format!("`{start}:{end}` of {samples} does not fit"),
            format!(
                "give a range within 0:{samples} whose ends are multiples of {step}, or the end of all"
            ),
        ));
    }
    let piece = move |first: u32| first..first.saturating_add(step).min(end);
    Ok((start..end).step_by(step as usize).map(piece))
}

/// What paths go through, on a backend.
#[derive(Debug)]
pub struct Paths<'a, B: Backend> {
    /// The backend.
    pub backend: &'a B,
    /// The scene on it.
    pub scene: &'a B::Res<SceneData>,
    /// Lights that shine.
    pub lights: &'a [Light],
    /// Camera and size.
    pub view: &'a View,
    /// A plan of paths.
    pub plan: &'a Plan,
}

impl<B: Backend> Clone for Paths<'_, B> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<B: Backend> Copy for Paths<'_, B> {}

impl<B: Backend> Paths<'_, B> {
    /// Sums for this view, without paths yet.
    #[must_use]
    pub fn sums(&self) -> Sums {
        let (width, height) = self.view.samples();
        Sums::new(width, height)
    }

    /// Adds the light of a piece of samples; [`pieces`] says which there are. Nothing with a plan that has no paths.
    ///
    /// # Errors
    /// [`Error::Cancelled`] if the observer says so; what the backend returns. The sums are unchanged then.
    pub fn add(&self, piece: Range<u32>, sums: &mut Sums, observer: &dyn Observer) -> Result<()> {
        let Some(plan) = &self.plan.path else {
            return Ok(());
        };
        let Self {
            backend,
            scene,
            lights,
            view,
            ..
        } = *self;
        let light = backend.trace(scene, lights, view, plan, piece.clone(), observer)?;
        sums.add(&backend.download(&light)?, &piece)
    }

    /// What the picture holds beside light: what the camera sees at each pixel's centre.
    ///
    /// # Errors
    /// [`Error::Setting`] for more than one sample a pixel in the view; [`Error::Cancelled`] if the observer says so; what the
    /// backend returns.
    pub fn layers(&self, observer: &dyn Observer) -> Result<Layers<B>> {
        let Self { backend, view, .. } = *self;
        if view.aa != 1 {
            return Err(Error::setting(
                "aa",
                view.aa.to_string(),
                "paths are spread over each pixel anyway: leave it out, and choose their number by `spp`",
            ));
        }
        let gbuffer = run(observer, Phase::GBuffer, || {
            backend.gbuffer(self.scene, view, &self.plan.gbuffer)
        })?;
        run(observer, Phase::Resolve, || {
            let (width, height) = view.samples();
            let radiance = backend.upload(Radiance {
                width,
                height,
                direct: vec![[0.0; 3]; width as usize * height as usize],
                ..Radiance::default()
            })?;
            let image = backend.download(&backend.resolve(&gbuffer, &radiance, view)?)?;
            Ok(Layers {
                gbuffer,
                radiance,
                image,
            })
        })
    }

    /// The picture of all paths that the plan wants.
    ///
    /// # Errors
    /// As [`Paths::layers`].
    pub(crate) fn frame(&self, observer: &dyn Observer) -> Result<Frame<B>> {
        let layers = self.layers(observer)?;
        let mut sums = self.sums();
        let samples = self.plan.path.as_ref().map_or(0, |path| path.samples);
        run(observer, Phase::Trace, || {
            for piece in pieces(0..samples, samples)? {
                if observer.cancelled() {
                    return Err(Error::Cancelled(Phase::Trace));
                }
                observer.advanced(Phase::Trace, piece.start as f32 / samples as f32);
                self.add(piece, &mut sums, observer)?;
            }
            Ok(())
        })?;
        Ok(Frame {
            rsm: None,
            pdf: None,
            vsgls: None,
            occlusion: None,
            gbuffer: layers.gbuffer,
            radiance: layers.radiance,
            image: self.backend.upload(sums.mean(layers.image))?,
        })
    }
}

/// What a picture of paths holds beside light.
#[derive(Debug)]
pub struct Layers<B: Backend> {
    /// What the camera sees.
    pub gbuffer: B::Res<GBuffer>,
    /// No light.
    pub radiance: B::Res<Radiance>,
    /// The picture without light, ready for [`Sums::mean`].
    pub image: Image,
}
