//! Light along paths from the eye.

use super::{flag, scene_columns, surface_constants};
use crate::context::{Context, is_software};
use crate::kernel::{Constant, Kernel, KernelId};
use crate::params::View;
use crate::pool::Pooled;
use crate::recorder::{Binding, Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use std::ops::Range;
use std::sync::Arc;
use vsgl_core::Result;
use vsgl_core::data::{Radiance, SceneData};
use vsgl_core::phase::draw;
use vsgl_core::plan::PathPlan;
use vsgl_core::scene::Light;
use vsgl_core::settings::LightSampling;

/// Paths of one dispatch, about: what a GPU does in less than a tenth of a second, and a software driver in a second or so.
const PATHS_GPU: u32 = 1 << 22;
const PATHS_SOFTWARE: u32 = 1 << 16;

/// Twin of `Params` in `entry/path.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    view: View,
    lift: f32,
    nodes: u32,
    lights: u32,
    lamps: u32,
    max_depth: u32,
    seed: u32,
    first_sample: u32,
    end_sample: u32,
    begins: u32,
    first: u32,
    end: u32,
    padding: u32,
}

fn constants(plan: &PathPlan, textures: bool) -> Vec<Constant> {
    let mut constants = surface_constants(&plan.surface, textures).to_vec();
    constants.push(("GLOSSY", flag(plan.glossy)));
    constants.push(("MASKS", flag(plan.surface.masks)));
    constants.push(("EMISSION", flag(plan.surface.emission)));
    constants.push(("EMITTERS", flag(plan.emitters)));
    let by_power = plan.light_sampling == LightSampling::Power;
    constants.push(("BY_POWER", flag(by_power)));
    constants
}

/// The pipelines that a plan needs.
pub(crate) fn kernels(plan: &PathPlan) -> Vec<KernelId> {
    vec![KernelId::new("entry/path", "trace", &constants(plan, true))]
}

/// Paths that are recorded a dispatch at a time.
#[derive(Debug)]
pub(crate) struct Tracing {
    radiance: WgpuRes<Radiance>,
    kernel: Arc<Kernel>,
    lights: Pooled,
    params: Params,
    samples: Range<u32>,
    pixels: u32,
    paths: u32,
    /// Samples of one dispatch.
    at_once: u32,
}

impl Tracing {
    /// Takes memory and the pipeline.
    pub(crate) fn new(
        context: &Context,
        scene: &WgpuRes<SceneData>,
        lights: &[Light],
        view: &vsgl_core::render::View,
        plan: &PathPlan,
        samples: Range<u32>,
    ) -> Result<Self> {
        let (width, height) = view.samples();
        let pixels = width * height;
        let count = u64::from(pixels);
        let radiance = WgpuRes::<Radiance>::new(
            context,
            vec![width, height],
            &[
                ("direct", 12, count),
                ("indirect_diffuse", 12, count),
                ("indirect_glossy", 12, count),
                ("sums", 48, 0),
                ("emitted", 48, 0),
            ],
        )?;
        let bounds = SceneData::bounds_of(&scene.head);
        let records = draw::lights(lights, bounds, plan.light_sampling);
        let bytes = bytemuck::cast_slice(&records);
        let lights = context.buffer("the lights", bytes.len() as u64)?;
        if !bytes.is_empty() {
            context.queue().write_buffer(&lights, 0, bytes);
        }
        let software = is_software(context.info());
        let constants = constants(plan, scene.len("texture") > 0);
        Ok(Self {
            radiance,
            kernel: context.kernel("entry/path", "trace", &constants)?,
            lights,
            params: Params {
                view: View::from(view),
                lift: f32::from_bits(scene.head[0]),
                nodes: scene.len("node") as u32,
                lights: records.len() as u32,
                lamps: scene.len("lamp") as u32,
                max_depth: plan.max_depth,
                seed: plan.seed,
                first_sample: 0,
                end_sample: 0,
                begins: 0,
                first: 0,
                end: 0,
                padding: 0,
            },
            samples,
            pixels,
            paths: if software { PATHS_SOFTWARE } else { PATHS_GPU },
            // Lavapipe leaves a shader's loops after 65,535 rounds in all.
            at_once: if software { 1 } else { PathPlan::PIECE },
        })
    }

    /// What is recorded at once: pixels and samples.
    pub(crate) fn dispatches(&self) -> Vec<(Range<u32>, Range<u32>)> {
        let band = (self.paths / self.at_once).max(1);
        let bands = (0..self.pixels).step_by(band as usize);
        let bands = bands.map(|first| first..first.saturating_add(band).min(self.pixels));
        let samples = self.samples.clone().step_by(self.at_once as usize);
        let samples = samples.map(|first| first..(first + self.at_once).min(self.samples.end));
        bands
            .flat_map(|band| samples.clone().map(move |samples| (band.clone(), samples)))
            .collect()
    }

    /// Records one of them; those of the same pixels in the order of samples.
    pub(crate) fn record(
        &self,
        recorder: &mut Recorder<'_>,
        scene: &WgpuRes<SceneData>,
        (pixels, samples): (Range<u32>, Range<u32>),
    ) -> Result<()> {
        let params = Params {
            first_sample: samples.start,
            end_sample: samples.end,
            begins: u32::from(samples.start == self.samples.start),
            first: pixels.start,
            end: pixels.end,
            ..self.params
        };
        let mut bound = scene_columns(scene);
        bound.extend([
            ("direct_light", Binding::Buffer(&self.lights)),
            ("lamp", scene.bind("lamp")),
            ("radiance_out", self.radiance.bind("direct")),
        ]);
        let items = Groups::Items(u64::from(pixels.end - pixels.start));
        recorder.dispatch(&self.kernel, &params, &bound, items)
    }

    /// The sums, once all is recorded.
    pub(crate) fn finish(self) -> WgpuRes<Radiance> {
        self.radiance
    }
}

#[cfg(test)]
mod tests {
    use super::Params;
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/path",
            "Params",
            Params {
                view,
                lift,
                nodes,
                lights,
                lamps,
                max_depth,
                seed,
                first_sample,
                end_sample,
                begins,
                first,
                end
            }
        );
    }
}
