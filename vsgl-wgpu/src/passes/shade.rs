//! Light to the eye.

use super::flag;
use super::sampled::{self, Sampled};
use crate::backend::WgpuBackend;
use crate::context::{Context, is_software};
use crate::kernel::{Constant, Kernel, KernelId};
use crate::pool::Pooled;
use crate::recorder::{Binding, Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use std::ops::Range;
use std::sync::Arc;
use vsgl_core::Result;
use vsgl_core::backend::{Senders, ShadeInputs};
use vsgl_core::data::{LightRecord, Radiance};
use vsgl_core::geom::LEAF;
use vsgl_core::phase::interleave::Shares;
use vsgl_core::plan::ShadePlan;
use vsgl_core::settings::{DiffuseForm, Emission, GlossyForm, OcclusionMethod};

/// Pairs of sample and light in one dispatch, about: so much a GPU does in a tenth of a second or less, which no watchdog
/// minds; and so much a software driver does in a few seconds, so that a user can stop it.
const PAIRS_GPU: u64 = 1 << 30;
const PAIRS_SOFTWARE: u64 = 1 << 23;
/// What a pair costs with a ray, in pairs without.
const RAY_COST: u64 = 8;
/// Lights in one dispatch.
const LIGHTS_GPU: u32 = 1 << 16;
pub(super) const LIGHTS_SOFTWARE: u32 = 1 << 14;
/// Lavapipe leaves a shader's loops after so many rounds in all, those of rays through the hierarchy included, without a
/// word.
pub(super) const ROUNDS_SOFTWARE: u64 = 65_535;
/// Lights in one dispatch with rays through a hierarchy of any size: a ray may take eight thousand rounds.
const LIGHTS_SOFTWARE_RAYS: u64 = 1 << 3;

/// Lights in one dispatch on a software driver where each takes a ray through so many nodes: a ray that visits all of them
/// ends before the driver leaves the loop. Few dispatches are better: for each, lavapipe keeps the private memory of all
/// invocations until the process ends.
fn lights_software_rays(nodes: u64) -> u32 {
    let most = u64::from(LIGHTS_SOFTWARE);
    rays_in(ROUNDS_SOFTWARE, nodes).clamp(LIGHTS_SOFTWARE_RAYS, most) as u32
}

/// Rays that end within so many rounds, whatever they meet.
pub(super) fn rays_in(rounds: u64, nodes: u64) -> u64 {
    rounds / (4 + nodes * (1 + LEAF as u64))
}

/// Twin of `Params` in `entry/shade.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Params {
    pub(super) eye: [f32; 3],
    pub(super) lift: f32,
    pub(super) count: u32,
    pub(super) first: u32,
    pub(super) end: u32,
    pub(super) nodes: u32,
    pub(super) lights: u32,
    pub(super) first_light: u32,
    pub(super) end_light: u32,
    pub(super) first_emitter: u32,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) side: u32,
    pub(super) map_side: u32,
}

/// Twin of `Params` in `entry/senders.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct SenderParams {
    map_texels: u32,
    count: u32,
}

/// Who submits what is recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Submits {
    /// We do, each band for itself, and may be stopped between them.
    Bands,
    /// A host, all at once. Software drivers have no watchdog: fewer dispatches are better there.
    Host,
}

/// Shading that is recorded band by band.
#[derive(Debug)]
pub(crate) struct Shading {
    radiance: WgpuRes<Radiance>,
    params: Params,
    direct: Arc<Kernel>,
    direct_lights: Pooled,
    bounce: Option<Bounce>,
    /// Samples of a band.
    band: u32,
    /// Direct lights, and lights of a bounce, in one dispatch.
    groups: [u32; 2],
    /// Sums between dispatches, unless they are columns of the result.
    waiting: Option<Pooled>,
    /// Samples in the order of shares.
    indices: u32,
    sampled: Option<Sampled>,
}

/// The indirect part.
#[derive(Debug)]
struct Bounce {
    kernel: Arc<Kernel>,
    /// Lights, or room for them.
    lights: u32,
    /// Point lights from the texels, and the kernel that makes them.
    senders: Option<(Pooled, Arc<Kernel>, SenderParams)>,
}

impl Shading {
    /// Takes memory and pipelines for shading.
    pub(crate) fn new(
        context: &Context,
        inputs: &ShadeInputs<'_, WgpuBackend>,
        plan: &ShadePlan,
        submits: Submits,
    ) -> Result<Self> {
        let gbuffer = inputs.gbuffer;
        let count = gbuffer.len("triangle");
        let bounce = Bounce::new(context, &inputs.senders, plan)?;
        let leaves_sums = plan.leaves_sums();
        let (diffuse, glossy) = match plan.bounce && !leaves_sums {
            false => (0, 0),
            true if plan.glossy_receivers => (count, count),
            true => (count, 0),
        };
        let sums = if leaves_sums { count } else { 0 };
        let emitted = if plan.emitters { sums } else { 0 };
        let radiance = WgpuRes::<Radiance>::new(
            context,
            gbuffer.head.clone(),
            &[
                ("direct", 12, count),
                ("indirect_diffuse", 12, diffuse),
                ("indirect_glossy", 12, glossy),
                ("sums", 48, sums),
                ("emitted", 48, emitted),
            ],
        )?;
        let lights: Vec<LightRecord> = inputs.lights.iter().map(LightRecord::from).collect();
        let bytes = bytemuck::cast_slice(&lights);
        let direct_lights = context.buffer("the lights", bytes.len() as u64)?;
        if !bytes.is_empty() {
            context.queue().write_buffer(&direct_lights, 0, bytes);
        }
        let cost = match plan.occlusion {
            // Every light is looked at twice.
            OcclusionMethod::Sampled => 2,
            OcclusionMethod::Rays => RAY_COST,
            _ => 1,
        };
        let software = is_software(context.info());
        let pairs = if software { PAIRS_SOFTWARE } else { PAIRS_GPU };
        let shares = Shares {
            side: if leaves_sums { plan.interleave } else { 1 },
            width: gbuffer.head[0],
            height: gbuffer.head[1],
        };
        let stride = shares.count();
        let lights_each = bounce.as_ref().map_or(0, |b| b.lights.div_ceil(stride));
        let rays_each = if plan.occlusion == OcclusionMethod::Sampled {
            u64::from(plan.rays) * RAY_COST
        } else {
            0
        };
        let lights_all = u64::from(lights_each) + lights.len() as u64 + rays_each;
        let least = match submits {
            Submits::Host if software => count.max(1),
            _ => 1 << 12,
        };
        let band = (pairs / (cost * lights_all.max(1))).clamp(least, count.max(least));
        let group = |rays: bool| match (software, rays) {
            (false, _) => LIGHTS_GPU,
            (true, false) => LIGHTS_SOFTWARE,
            (true, true) => lights_software_rays(inputs.scene.len("node")),
        };
        let many = group(plan.occlusion == OcclusionMethod::Rays);
        let groups = [group(true), many.saturating_mul(stride)];
        let waits = bounce.as_ref().is_some_and(|b| b.lights > groups[1]);
        let waiting = if leaves_sums {
            None
        } else {
            Some(context.buffer("sums of a band", if waits { 48 * band } else { 48 })?)
        };
        let sampled = (leaves_sums && plan.occlusion == OcclusionMethod::Sampled)
            .then(|| Sampled::new(context, inputs.scene.len("node"), plan, software))
            .transpose()?;
        Ok(Self {
            indices: shares.indices(),
            sampled,
            radiance,
            params: Params {
                eye: inputs.view.camera.eye.to_array(),
                lift: f32::from_bits(inputs.scene.head[0]),
                count: count as u32,
                first: 0,
                end: 0,
                nodes: inputs.scene.len("node") as u32,
                lights: lights.len() as u32,
                first_light: 0,
                end_light: 0,
                first_emitter: first_emitter(&inputs.senders, plan),
                width: shares.width,
                height: shares.height,
                side: shares.side,
                map_side: inputs.occlusion.map_or(0, |maps| maps.head[1]),
            },
            direct: context.kernel("entry/shade", "direct", &direct_constants(plan))?,
            direct_lights,
            bounce,
            band: band as u32,
            groups,
            waiting,
        })
    }

    /// Samples that are recorded at once, with the share that is done before them.
    pub(crate) fn bands(&self) -> Vec<(f32, Range<u32>)> {
        let (count, band) = (self.indices, self.band as usize);
        (0..count)
            .step_by(band)
            .map(|first| {
                let end = first.saturating_add(self.band).min(count);
                (first as f32 / count as f32, first..end)
            })
            .collect()
    }

    /// Records all kernels for a band; the first band must come first.
    pub(crate) fn record(
        &self,
        recorder: &mut Recorder<'_>,
        inputs: &ShadeInputs<'_, WgpuBackend>,
        band: Range<u32>,
    ) -> Result<()> {
        let indices = Groups::Items(u64::from(band.end - band.start));
        let params = Params {
            first: band.start,
            end: band.end,
            ..self.params
        };
        let (scene, gbuffer) = (inputs.scene, inputs.gbuffer);
        let mut bound = vec![
            ("node", scene.bind("node")),
            ("corner", scene.bind("corner")),
            ("texels", scene.bind("texel")),
            ("columns", scene.layout()),
            ("triangle", gbuffer.bind("triangle")),
            ("receiver", gbuffer.bind("position")),
            ("grazing", gbuffer.bind("grazing")),
            ("direct_light", Binding::Buffer(&self.direct_lights)),
            ("radiance_out", self.radiance.bind("direct")),
            (
                "waiting",
                match &self.waiting {
                    Some(buffer) => Binding::Buffer(buffer),
                    None => self.radiance.bind("sums"),
                },
            ),
        ];
        // There are as many indices as samples, or more.
        let rows = Params {
            end: band.end.min(params.count),
            ..params
        };
        if rows.first < rows.end {
            let samples = Groups::Items(u64::from(rows.end - rows.first));
            for params in by_lights(rows, self.groups[0]) {
                recorder.dispatch(&self.direct, &params, &bound, samples)?;
            }
        }
        let Some(bounce) = &self.bounce else {
            return Ok(());
        };
        match (&inputs.senders, &bounce.senders) {
            (Senders::Vsgls(vsgls), _) => {
                bound.push(("lights", vsgls.bind("diffuse")));
                bound.push(("clusters", Binding::Buffer(vsgls.count_buffer())));
                if let Some(maps) = inputs.occlusion {
                    bound.push(("depth", maps.bind("depth")));
                }
            }
            (Senders::Vpls(rsm), Some((buffer, kernel, sender_params))) => {
                if band.start == 0 {
                    let texels = [
                        ("corner", scene.bind("corner")),
                        ("map", rsm.bind("map")),
                        ("triangle", rsm.bind("triangle")),
                        ("texel", rsm.bind("position")),
                        ("sender_out", Binding::Buffer(buffer)),
                    ];
                    let items = Groups::Items(u64::from(bounce.lights));
                    recorder.dispatch(kernel, sender_params, &texels, items)?;
                }
                bound.push(("sender", Binding::Buffer(buffer)));
            }
            _ => {}
        }
        let params = Params {
            lights: bounce.lights,
            ..params
        };
        for params in by_lights(params, self.groups[1]) {
            recorder.dispatch(&bounce.kernel, &params, &bound, indices)?;
        }
        if let Some(sampled) = &self.sampled {
            sampled.record(recorder, &params, &bound, indices)?;
        }
        Ok(())
    }

    /// The result, once all bands are recorded.
    pub(crate) fn finish(self) -> WgpuRes<Radiance> {
        self.radiance
    }
}

/// The parameters of each group of lights: one at least, which writes the result.
fn by_lights(params: Params, group: u32) -> impl Iterator<Item = Params> {
    let groups = params.lights.div_ceil(group).max(1);
    (0..groups).map(move |i| Params {
        first_light: i * group,
        end_light: ((i + 1).saturating_mul(group)).min(params.lights),
        ..params
    })
}

impl Bounce {
    fn new(
        context: &Context,
        senders: &Senders<'_, WgpuBackend>,
        plan: &ShadePlan,
    ) -> Result<Option<Self>> {
        Ok(match senders {
            Senders::None => None,
            Senders::Vsgls(vsgls) => Some(Self {
                kernel: context.kernel("entry/shade", clusters_entry(plan), &constants(plan))?,
                lights: vsgls.len("diffuse") as u32,
                senders: None,
            }),
            Senders::Vpls(rsm) => {
                let texels = rsm.len("triangle");
                let size = u64::from(rsm.head[0]);
                let buffer = context.buffer("the point lights", 7 * 16 * texels)?;
                let glossy = plan.glossy_senders && rsm.len("specular") > 0;
                let made = sender_constants(glossy, plan.anisotropic_senders);
                let params = SenderParams {
                    map_texels: (size * size) as u32,
                    count: texels as u32,
                };
                Some(Self {
                    kernel: context.kernel("entry/shade", "vpls", &constants(plan))?,
                    lights: texels as u32,
                    senders: Some((
                        buffer,
                        context.kernel("entry/senders", "senders", &made)?,
                        params,
                    )),
                })
            }
        })
    }
}

/// The first texel of the map of emitters, where texels are lights; there is none otherwise.
fn first_emitter(senders: &Senders<'_, WgpuBackend>, plan: &ShadePlan) -> u32 {
    match senders {
        Senders::Vpls(rsm) if plan.emitters => {
            let (side, maps) = (rsm.head[0], rsm.head[1]);
            (maps.max(1) - 1) * side * side
        }
        _ => u32::MAX,
    }
}

fn direct_constants(plan: &ShadePlan) -> [Constant; 3] {
    [
        ("MASKS", flag(plan.masks)),
        ("GLOSSY_RECEIVERS", flag(plan.glossy_receivers)),
        ("ANISOTROPIC_RECEIVERS", flag(plan.anisotropic_receivers)),
    ]
}

/// The kernel that shades by clusters.
fn clusters_entry(plan: &ShadePlan) -> &'static str {
    if plan.occlusion.has_maps() {
        "vsgls_with_maps"
    } else {
        "vsgls"
    }
}

fn sender_constants(glossy: bool, anisotropic: bool) -> [Constant; 2] {
    [
        ("GLOSSY_SENDERS", flag(glossy)),
        ("ANISOTROPIC_SENDERS", flag(glossy && anisotropic)),
    ]
}

/// The pipelines that a plan needs; `clusters` where lights are clusters, not texels.
pub(crate) fn kernels(plan: &ShadePlan, clusters: bool) -> Vec<KernelId> {
    let shade = |entry, constants: &[Constant]| KernelId::new("entry/shade", entry, constants);
    let mut kernels = vec![shade("direct", &direct_constants(plan))];
    if plan.bounce && clusters {
        kernels.push(shade(clusters_entry(plan), &constants(plan)));
        if plan.occlusion == OcclusionMethod::Sampled {
            kernels.push(sampled::kernel(plan));
        }
    } else if plan.bounce {
        let made = sender_constants(plan.glossy_senders, plan.anisotropic_senders);
        kernels.push(KernelId::new("entry/senders", "senders", &made));
        kernels.push(shade("vpls", &constants(plan)));
    }
    kernels
}

/// The constants of the kernels that shade by virtual lights.
fn constants(plan: &ShadePlan) -> Vec<Constant> {
    let mut constants = form_constants(plan).to_vec();
    constants.extend([
        ("EMITTERS", flag(plan.emitters)),
        ("RAYS", flag(plan.occlusion == OcclusionMethod::Rays)),
        ("MASKS", flag(plan.masks)),
        ("LEAVES_SUMS", flag(plan.leaves_sums())),
        ("SAMPLED", flag(plan.occlusion == OcclusionMethod::Sampled)),
    ]);
    constants
}

/// Those of what receivers reflect of a light; numbers as in `phase/reflect.wgsl`.
pub(super) fn form_constants(plan: &ShadePlan) -> [Constant; 7] {
    let emission = match plan.emission {
        Emission::Cosine => 0.0,
        Emission::Sg => 1.0,
    };
    let diffuse = match plan.diffuse {
        DiffuseForm::V13 => 0.0,
        DiffuseForm::V14 => 1.0,
        DiffuseForm::Tokuyoshi2024 => 2.0,
        DiffuseForm::Tokuyoshi2022 => 3.0,
        DiffuseForm::MederBruederlin2018 => 4.0,
        DiffuseForm::Sg2015 => 5.0,
        DiffuseForm::SgProduct => 6.0,
        DiffuseForm::Constant => 7.0,
    };
    let glossy = match plan.glossy {
        GlossyForm::NdfFilter => 0.0,
        GlossyForm::NdfFilter2024 => 1.0,
        GlossyForm::Asg2013 => 2.0,
        GlossyForm::Asg2015 => 3.0,
        GlossyForm::Sg => 4.0,
        GlossyForm::Blend => 5.0,
    };
    [
        ("GLOSSY_RECEIVERS", flag(plan.glossy_receivers)),
        ("GLOSSY_SENDERS", flag(plan.glossy_senders)),
        ("ANISOTROPIC_RECEIVERS", flag(plan.anisotropic_receivers)),
        ("ANISOTROPIC_SENDERS", flag(plan.anisotropic_senders)),
        ("EMISSION", emission),
        ("DIFFUSE", diffuse),
        ("GLOSSY", glossy),
    ]
}

#[cfg(test)]
mod tests {
    use super::{Params, SenderParams};
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/shade",
            "Params",
            Params {
                eye,
                lift,
                count,
                first,
                end,
                nodes,
                lights,
                first_light,
                end_light,
                first_emitter,
                width,
                height,
                side,
                map_side
            }
        );
        twins!(
            "entry/senders",
            "Params",
            SenderParams { map_texels, count }
        );
    }
}
