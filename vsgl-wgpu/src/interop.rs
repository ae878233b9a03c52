//! Indirect light inside a renderer that owns its device, queue, encoder and textures.
//!
//! A host makes a [`Context`] on its device, brings in what it has drawn already ([`Context::import_gbuffer`],
//! [`Context::import_rsm`]), asks for the light of one bounce ([`Context::indirect`]) and has it written into a texture of its
//! own ([`Context::export`]). Everything is recorded into the host's encoder by the same passes that [`crate::WgpuBackend`]
//! runs. Nothing is submitted and nothing waits; `docs/embedding.md` in the repository says what a host must see to.
//!
//! The host's world is the scene: right-handed or left-handed, in metres, with the eye and the lights where the matrices say.

mod textures;

pub use textures::{Colors, HostGBuffer, HostMap, Materials, Normals, Place};

use crate::backend::WgpuBackend;
use crate::context::Context;
use crate::kernel::KernelId;
use crate::passes;
use crate::passes::shade::Submits;
use crate::recorder::Recorder;
use crate::res::WgpuRes;
use textures::check;
use vsgl_core::backend::{PdfInputs, Senders, ShadeInputs};
use vsgl_core::data::{GBuffer, Radiance, Rsm, SceneData};
use vsgl_core::glam::Vec3;
use vsgl_core::plan::Plan;
use vsgl_core::render::{Phase, View};
use vsgl_core::scene::{Camera, Light, SceneFacts, SurfaceFacts};
use vsgl_core::settings::{Method, OcclusionMethod, Settings};
use vsgl_core::{Error, Result};
use wgpu::{CommandEncoder, TextureView};

/// How light gets into a host's texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Export {
    /// By a compute shader, alpha 1: `Rgba16Float` or `Rgba32Float`, with the usage `STORAGE_BINDING`.
    Store,
    /// By a render pass that replaces what is there, alpha 1: any float format that can be drawn to, with `RENDER_ATTACHMENT`.
    Draw,
    /// By a render pass that adds to what is there, one to alpha likewise: a format that can be blended.
    Add,
}

/// The inputs of [`Context::indirect`].
#[derive(Clone, Copy, Debug)]
pub struct Bounce<'a> {
    /// What the camera sees.
    pub gbuffer: &'a WgpuRes<GBuffer>,
    /// What the lights see.
    pub rsm: &'a WgpuRes<Rsm>,
    /// Triangles that block light; without them light passes through walls.
    pub scene: Option<&'a WgpuRes<SceneData>>,
    /// The eye in the world \[m\].
    pub eye: Vec3,
}

/// The kernels that a host's calls may need beside those of its plan, for any of its textures.
pub fn kernels() -> Vec<KernelId> {
    let mut kernels = passes::import::kernels();
    kernels.extend(passes::export::kernels());
    kernels
}

/// A plan for a host, which knows its scene better than we do: `glossy` says whether any surface reflects by a specular lobe.
///
/// # Errors
/// [`Error::Setting`] where settings contradict each other.
pub fn host_plan(settings: &Settings, lights: usize, glossy: bool) -> Result<Plan> {
    if settings.method == Method::Path {
        return Err(Error::setting(
            "method",
            "paths need materials, which hosts do not bring",
            "render the scene by `render`, or take the method `vsgl`",
        ));
    }
    // What hosts import has one roughness.
    let surfaces = SurfaceFacts {
        anisotropy: false,
        ..SurfaceFacts::ALL
    };
    let facts = SceneFacts {
        triangles: 1,
        lights,
        maps: 1,
        emitters: 0,
        glossy_senders: glossy,
        reflecting_senders: true,
        glossy_receivers: glossy,
        seen: surfaces,
        sent: surfaces,
        any: surfaces,
        glossy,
        masks: true,
        bounds: (Vec3::ZERO, Vec3::ZERO),
    };
    Plan::new(&facts, settings)
}

impl Context {
    /// Triangles of a scene for shadow rays, and for [`Context::trace_rsm`].
    ///
    /// What a host writes comes before all that is submitted after it: call this while nothing that was recorded waits to be
    /// submitted.
    ///
    /// # Errors
    /// [`Error::Device`] if the device has no room.
    pub fn scene(&self, scene: &SceneData) -> Result<WgpuRes<SceneData>> {
        WgpuRes::upload(self, scene)
    }

    /// Records the import of what the camera sees.
    ///
    /// With a `scene` shadow rays can start at the surfaces; those that lie on no triangle of it are left out, since they are
    /// not where the scene is.
    ///
    /// # Errors
    /// [`Error::Setting`] for textures of other formats or sizes; [`Error::Device`] if the device has no room.
    pub fn import_gbuffer(
        &self,
        encoder: &mut CommandEncoder,
        from: &HostGBuffer<'_>,
        scene: Option<&WgpuRes<SceneData>>,
        plan: &Plan,
    ) -> Result<WgpuRes<GBuffer>> {
        check(&from.place, &from.normals, from.base_color, &from.materials)?;
        let (rays, scene) = (scene.is_some(), self.scene_or_none(scene)?);
        let mut recorder = Recorder::new(self, encoder, Phase::GBuffer);
        passes::import::gbuffer(&mut recorder, from, scene, rays, &plan.gbuffer)
    }

    /// Records the import of what the lights see, a map each.
    ///
    /// # Errors
    /// [`Error::Setting`] for textures of other formats or sizes, and for a matrix that is no perspective projection from the
    /// light; [`Error::Device`] if the device has no room.
    pub fn import_rsm(
        &self,
        encoder: &mut CommandEncoder,
        from: &[HostMap<'_>],
        scene: Option<&WgpuRes<SceneData>>,
        plan: &Plan,
    ) -> Result<WgpuRes<Rsm>> {
        for map in from {
            let (Colors::Base(colors) | Colors::Flux(colors)) = map.colors;
            check(&map.place, &map.normals, colors, &map.materials)?;
            let texture = map.place.texture().texture();
            if texture.width() != texture.height() || map.size() != from[0].size() {
                return Err(Error::setting(
                    "rsm",
                    format!("a map of {}x{} texels", texture.width(), texture.height()),
                    "give square maps of one size",
                ));
            }
        }
        let Some(bounce) = &plan.bounce else {
            return Err(no_bounce());
        };
        let (rays, scene) = (scene.is_some(), self.scene_or_none(scene)?);
        let mut recorder = Recorder::new(self, encoder, Phase::Rsm);
        passes::import::rsm(&mut recorder, from, scene, rays, &bounce.rsm)
    }

    /// Records reflective shadow maps by our own rays, for a host that has none.
    ///
    /// # Errors
    /// [`Error::Setting`] for a plan without a bounce; [`Error::Device`] if the device has no room.
    pub fn trace_rsm(
        &self,
        encoder: &mut CommandEncoder,
        scene: &WgpuRes<SceneData>,
        lights: &[Light],
        plan: &Plan,
    ) -> Result<WgpuRes<Rsm>> {
        let Some(bounce) = &plan.bounce else {
            return Err(no_bounce());
        };
        let mut recorder = Recorder::new(self, encoder, Phase::Rsm);
        passes::rsm::record(&mut recorder, scene, lights, &bounce.rsm)
    }

    /// Records everything from the maps to the radiance of one bounce.
    ///
    /// # Errors
    /// [`Error::Setting`] for a plan without a bounce, with rays but no scene, or another than that of the inputs;
    /// [`Error::Device`] if the device has no room.
    pub fn indirect(
        &self,
        encoder: &mut CommandEncoder,
        inputs: &Bounce<'_>,
        plan: &Plan,
    ) -> Result<WgpuRes<Radiance>> {
        let Some(bounce) = &plan.bounce else {
            return Err(no_bounce());
        };
        if plan.shade.occlusion != OcclusionMethod::None && inputs.scene.is_none() {
            return Err(Error::setting(
                "occlusion",
                format!(
                    "`{}` needs the triangles of the scene",
                    plan.shade.occlusion
                ),
                "give the scene, or set `occlusion` to `none`",
            ));
        }
        let missing = plan.shade.glossy_receivers && inputs.gbuffer.len("specular") == 0
            || plan.shade.glossy_senders && inputs.rsm.len("specular") == 0;
        if missing {
            return Err(Error::setting(
                "plan",
                "the inputs were made by another plan, without specular columns",
                "make them by the same plan",
            ));
        }
        let scene = self.scene_or_none(inputs.scene)?;
        let rsm = inputs.rsm;
        let view = View {
            // Which way it looks says the G-buffer; that it sees a radian is near enough for how much texels matter.
            camera: Camera::look_at(inputs.eye, inputs.eye + Vec3::NEG_Z, 1.0),
            width: inputs.gbuffer.head[0],
            height: inputs.gbuffer.head[1],
            aa: 1,
            stride: 1,
        };
        let mut pdf = None;
        if let Some(plan) = &bounce.pdf {
            let mut recorder = Recorder::new(self, encoder, Phase::Pdf);
            let inputs = PdfInputs::<WgpuBackend> {
                scene,
                rsm,
                gbuffer: inputs.gbuffer,
                view: &view,
            };
            pdf = Some(passes::pdf::record(&mut recorder, &inputs, plan)?);
        }
        let mut vsgls = None;
        if let Some(plan) = &bounce.cluster {
            let mut recorder = Recorder::new(self, encoder, Phase::Cluster);
            let made = passes::cluster::record(&mut recorder, scene, rsm, pdf.as_ref(), plan)?;
            vsgls = Some(made);
        }
        let mut maps = None;
        if let (Some(plan), Some(vsgls)) = (&bounce.occlusion, &vsgls) {
            let mut recorder = Recorder::new(self, encoder, Phase::Occlusion);
            maps = Some(passes::occlusion::record(
                &mut recorder,
                scene,
                vsgls,
                plan,
            )?);
        }
        let shaded = ShadeInputs::<WgpuBackend> {
            scene,
            gbuffer: inputs.gbuffer,
            view: &view,
            lights: &[],
            occlusion: maps.as_ref(),
            senders: vsgls.as_ref().map_or(Senders::Vpls(rsm), Senders::Vsgls),
        };
        let shading = passes::shade::Shading::new(self, &shaded, &plan.shade, Submits::Host)?;
        let mut recorder = Recorder::new(self, encoder, Phase::Shade);
        for (_, band) in shading.bands() {
            shading.record(&mut recorder, &shaded, band)?;
        }
        let radiance = shading.finish();
        let Some(plan) = &plan.reconstruct else {
            return Ok(radiance);
        };
        drop(recorder);
        let mut recorder = Recorder::new(self, encoder, Phase::Reconstruct);
        passes::reconstruct::record(&mut recorder, inputs.gbuffer, &radiance, plan)
    }

    /// Records the way of the light into a texture of the host: level 0, of the size of the G-buffer.
    ///
    /// # Errors
    /// [`Error::Setting`] if its size or its format does not fit.
    pub fn export(
        &self,
        encoder: &mut CommandEncoder,
        radiance: &WgpuRes<Radiance>,
        target: &TextureView,
        how: Export,
    ) -> Result<()> {
        let mut recorder = Recorder::new(self, encoder, Phase::Resolve);
        passes::export::record(&mut recorder, radiance, target, how)
    }

    /// The host's scene, or one that blocks nothing.
    fn scene_or_none<'a>(
        &'a self,
        scene: Option<&'a WgpuRes<SceneData>>,
    ) -> Result<&'a WgpuRes<SceneData>> {
        match scene {
            Some(scene) => Ok(scene),
            None => self.nothing(),
        }
    }
}

fn no_bounce() -> Error {
    Error::setting(
        "plan",
        "a plan without a bounce has no indirect light",
        "make one with lights and with surfaces that reflect, such as by `host_plan`",
    )
}
