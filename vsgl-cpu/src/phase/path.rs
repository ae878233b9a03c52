//! Paths of light, all pixels.

use rayon::prelude::*;
use std::ops::Range;
use vsgl_core::data::{LightRecord, Radiance, SceneData};
use vsgl_core::phase::path::{Light, World, sample};
use vsgl_core::plan::PathPlan;
use vsgl_core::render::{Observer, Phase, View};
use vsgl_core::{Error, Result};

pub(crate) fn run(
    scene: &SceneData,
    lights: &[LightRecord],
    view: &View,
    plan: &PathPlan,
    samples: Range<u32>,
    observer: &dyn Observer,
) -> Result<Radiance> {
    let (width, height) = view.samples();
    let world = World {
        scene,
        lights,
        plan,
    };
    let pixel = |x: u32, y: u32| {
        let mut sum = Light::default();
        for index in samples.clone() {
            let more = sample(&world, view, x, y, index);
            sum.direct += more.direct;
            sum.indirect_diffuse += more.indirect_diffuse;
            sum.indirect_glossy += more.indirect_glossy;
        }
        sum
    };
    let row = |y: u32| {
        if observer.cancelled() {
            return Err(Error::Cancelled(Phase::Trace));
        }
        Ok((0..width).map(|x| pixel(x, y)).collect())
    };
    let rows: Vec<Vec<Light>> = (0..height)
        .into_par_iter()
        .map(row)
        .collect::<Result<_>>()?;
    let layer = |f: fn(&Light) -> [f32; 3]| rows.iter().flatten().map(f).collect();
    Ok(Radiance {
        width,
        height,
        direct: layer(|l| l.direct.to_array()),
        indirect_diffuse: layer(|l| l.indirect_diffuse.to_array()),
        indirect_glossy: layer(|l| l.indirect_glossy.to_array()),
        ..Radiance::default()
    })
}
