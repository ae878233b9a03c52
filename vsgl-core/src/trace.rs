//! Paths of light, piece by piece, to a picture.

use crate::backend::Backend;
use crate::data::{Image, Radiance, SceneData};
use crate::error::{Error, Result};
use crate::plan::{PathPlan, Plan};
use crate::render::{Frame, Observer, Phase, View, run};
use crate::scene::Light;

/// Light of all paths so far, in f64: pieces are added in the order of their samples.
#[derive(Clone, Debug, Default)]
struct Totals {
    direct: Vec<[f64; 3]>,
    indirect_diffuse: Vec<[f64; 3]>,
    indirect_glossy: Vec<[f64; 3]>,
}

impl Totals {
    fn add(&mut self, piece: &Radiance) {
        let layers = [
            (&mut self.direct, &piece.direct),
            (&mut self.indirect_diffuse, &piece.indirect_diffuse),
            (&mut self.indirect_glossy, &piece.indirect_glossy),
        ];
        for (total, piece) in layers {
            total.resize(piece.len(), [0.0; 3]);
            for (total, more) in total.iter_mut().zip(piece) {
                for channel in 0..3 {
                    total[channel] += f64::from(more[channel]);
                }
            }
        }
    }

    /// Means over so many samples, as layers of a picture.
    fn mean(self, samples: u32, image: Image) -> Image {
        let share = 1.0 / f64::from(samples);
        let layer = |total: Vec<[f64; 3]>| {
            total
                .iter()
                .map(|t| t.map(|c| (c * share) as f32))
                .collect()
        };
        Image {
            direct: layer(self.direct),
            indirect_diffuse: layer(self.indirect_diffuse),
            indirect_glossy: layer(self.indirect_glossy),
            ..image
        }
    }
}

/// The picture of all paths that the plan wants; what is not light comes from what the camera sees at each pixel's centre.
///
/// # Errors
/// [`Error::Setting`] for more than one sample a pixel in `view`; [`Error::Cancelled`] if the observer says so; what the backend
/// returns.
pub(crate) fn frame<B: Backend>(
    backend: &B,
    scene: &B::Res<SceneData>,
    lights: &[Light],
    view: &View,
    plan: &Plan,
    observer: &dyn Observer,
) -> Result<Frame<B>> {
    if view.aa != 1 {
        return Err(Error::setting(
            "aa",
            view.aa.to_string(),
            "paths are spread over each pixel anyway: leave it out, and choose their number by `spp`",
        ));
    }
    let gbuffer = run(observer, Phase::GBuffer, || {
        backend.gbuffer(scene, view, &plan.gbuffer)
    })?;
    let (samples, totals) = match &plan.path {
        Some(path) => run(observer, Phase::Trace, || {
            let totals = trace(backend, scene, lights, view, path, observer)?;
            Ok((path.samples, totals))
        })?,
        None => (1, Totals::default()),
    };
    run(observer, Phase::Resolve, || {
        let (width, height) = view.samples();
        let radiance = backend.upload(Radiance {
            width,
            height,
            direct: vec![[0.0; 3]; width as usize * height as usize],
            ..Radiance::default()
        })?;
        let image = backend.download(&backend.resolve(&gbuffer, &radiance, view)?)?;
        let image = backend.upload(totals.mean(samples, image))?;
        Ok(Frame {
            rsm: None,
            pdf: None,
            vsgls: None,
            occlusion: None,
            gbuffer,
            radiance,
            image,
        })
    })
}

/// Adds up all paths, a piece at a time.
fn trace<B: Backend>(
    backend: &B,
    scene: &B::Res<SceneData>,
    lights: &[Light],
    view: &View,
    plan: &PathPlan,
    observer: &dyn Observer,
) -> Result<Totals> {
    let mut totals = Totals::default();
    let mut first = 0;
    while first < plan.samples {
        if observer.cancelled() {
            return Err(Error::Cancelled(Phase::Trace));
        }
        observer.advanced(Phase::Trace, first as f32 / plan.samples as f32);
        let end = (first + PathPlan::PIECE).min(plan.samples);
        let piece = backend.trace(scene, lights, view, plan, first..end, observer)?;
        totals.add(&backend.download(&piece)?);
        first = end;
    }
    Ok(totals)
}
