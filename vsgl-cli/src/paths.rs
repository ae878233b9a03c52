//! A picture of paths on its way: piece by piece, from what there was to what is wanted.

use crate::device::Host;
use crate::exit::{Failure, Result};
use crate::fingerprint;
use crate::part::{About, Part, Ranges, misfit};
use std::ops::Range;
use std::time::Instant;
use vsgl_core::Error;
use vsgl_core::data::Image;
use vsgl_core::render::{Observer, Phase};
use vsgl_core::trace::{Paths, Sums, pieces};

/// A picture of paths on its way.
pub struct Course<'a, B: Host> {
    paths: Paths<'a, B>,
    wanted: Range<u32>,
    about: About,
    sums: Sums,
    /// What is not light.
    layers: Image,
    /// The picture, where it came from a file without sums.
    whole: Option<Image>,
}

impl<'a, B: Host> Course<'a, B> {
    /// No sample yet of those that are `wanted`. `scene` is the scene's fingerprint, `command` makes the whole picture.
    ///
    /// # Errors
    /// [`Failure::Usage`] for a range that cannot be rendered; what the backend returns.
    pub fn new(
        paths: Paths<'a, B>,
        wanted: Range<u32>,
        scene: &str,
        command: String,
        observer: &dyn Observer,
    ) -> Result<Self> {
        let of = paths.plan.path.as_ref().map_or(0, |path| path.samples);
        drop(pieces(wanted.clone(), of)?);
        let device = identity(paths.backend);
        let print = fingerprint::of_paths(scene, paths.lights, paths.view, paths.plan, &device);
        Ok(Self {
            wanted,
            about: About {
                samples: Ranges::default(),
                of,
                fingerprint: print.unwrap_or_default(),
                command,
            },
            sums: paths.sums(),
            layers: paths.layers(observer)?.image,
            whole: None,
            paths,
        })
    }

    /// Takes the samples of a file for done.
    ///
    /// # Errors
    /// [`Failure::Parts`] if they are of another picture, or not among those that are wanted.
    pub fn take(&mut self, part: Part) -> Result<()> {
        let remedy = "remove it, or give another name";
        let fail = |problem: String| Err(misfit(&part.path, problem, remedy));
        part.check_version()?;
        if part.about.fingerprint != self.about.fingerprint {
            return fail(
                "a picture by another scene, light, camera, size, setting, seed or backend".into(),
            );
        }
        let held = &part.about.samples;
        let Range { start, end } = self.wanted;
        if held.common(&Ranges::of(start..end)) != *held {
            return fail(format!(
                "holds samples {held}, where {start}:{end} are wanted"
            ));
        }
        match part.sums {
            Some(_) if held.iter().any(|r| pieces(r, self.about.of).is_err()) => {
                return fail(format!("its samples {held} end within a block of 8"));
            }
            Some(sums) => self.sums = sums,
            None if part.about.of == self.about.of => self.whole = Some(part.image),
            None => {
                return fail(format!(
                    "a whole picture of {} samples, without sums to go on from",
                    part.about.of
                ));
            }
        }
        self.about.samples = part.about.samples;
        Ok(())
    }

    /// Takes the wanted samples that are not there, until they are or `stop` says so. After each block `done` is called.
    ///
    /// # Errors
    /// What the backend and `done` return.
    pub fn run(
        &mut self,
        observer: &dyn Observer,
        stop: impl Fn() -> bool,
        mut done: impl FnMut(&Self) -> Result<()>,
    ) -> Result<()> {
        let left = self.left();
        let all = left.count();
        let mut taken = 0;
        let start = Instant::now();
        observer.started(Phase::Trace);
        for range in left.iter() {
            for piece in pieces(range, self.about.of)? {
                if stop() {
                    break;
                }
                observer.advanced(Phase::Trace, taken as f32 / all as f32);
                self.paths
                    .add(piece.clone(), &mut self.sums, &WholePieces(observer))?;
                taken += piece.end - piece.start;
                let joined = self.about.samples.joined(&Ranges::of(piece));
                self.about.samples =
                    joined.ok_or_else(|| Failure::Internal("a sample was taken twice".into()))?;
                done(self)?;
            }
        }
        observer.finished(Phase::Trace, start.elapsed());
        if self.about.samples.is_empty() {
            return Err(Error::Cancelled(Phase::Trace).into());
        }
        Ok(())
    }

    /// Wanted samples that are not there.
    #[must_use]
    pub fn left(&self) -> Ranges {
        self.about.samples.rest(self.wanted.clone())
    }

    /// Which samples are there.
    #[must_use]
    pub fn about(&self) -> &About {
        &self.about
    }

    /// Their sums; none of a whole picture that was there.
    #[must_use]
    pub fn sums(&self) -> Option<&Sums> {
        match self.whole {
            Some(_) => None,
            None => Some(&self.sums),
        }
    }

    /// The picture of the samples that are there.
    #[must_use]
    pub fn image(&self) -> Image {
        match &self.whole {
            Some(image) => image.clone(),
            None => self.sums.mean(self.layers.clone()),
        }
    }
}

/// What computes, as far as it decides bits: the CPU gives the same on every machine.
fn identity<B: Host>(backend: &B) -> String {
    match backend.adapter() {
        Some(_) => format!("{} {}", backend.name(), backend.device()),
        None => backend.name().to_owned(),
    }
}

/// Passes everything on but the wish to stop: a block of samples is finished.
struct WholePieces<'a>(&'a dyn Observer);

impl Observer for WholePieces<'_> {
    fn started(&self, phase: Phase) {
        self.0.started(phase);
    }

    fn advanced(&self, phase: Phase, share: f32) {
        self.0.advanced(phase, share);
    }
}
