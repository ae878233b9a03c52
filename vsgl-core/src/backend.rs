//! What a backend must be able to do: one method a phase.

use crate::data::{Columns, GBuffer, Image, Occlusion, Pdf, Radiance, Rsm, SceneData, Vsgls};
use crate::error::Result;
use crate::plan::{
    ClusterPlan, GBufferPlan, OcclusionPlan, PathPlan, PdfPlan, ReconstructPlan, RsmPlan, ShadePlan,
};
use crate::render::{Observer, View};
use crate::scene::Light;
use std::ops::Range;

/// The phases, on data that the backend keeps where it likes.
///
/// Every resource can be brought to the host and taken from it, so any phase can be run on any other backend's input.
pub trait Backend: Sized {
    /// This backend's own storage of a resource.
    type Res<T: Columns>;

    /// Name as on the command line.
    fn name(&self) -> &'static str;
    /// Takes a resource from the host.
    ///
    /// # Errors
    /// If the device has no room for it.
    fn upload<T: Columns>(&self, value: T) -> Result<Self::Res<T>>;
    /// Brings a resource to the host.
    ///
    /// # Errors
    /// If the device failed.
    fn download<T: Columns>(&self, resource: &Self::Res<T>) -> Result<T>;

    /// Waits until all that was asked for has been done: a phase may return before.
    ///
    /// # Errors
    /// If the device failed.
    fn finish(&self) -> Result<()>;

    /// What the camera sees through each sample of the picture.
    ///
    /// # Errors
    /// If the device failed; likewise for all phases.
    fn gbuffer(
        &self,
        scene: &Self::Res<SceneData>,
        view: &View,
        plan: &GBufferPlan,
    ) -> Result<Self::Res<GBuffer>>;
    /// What the lights see.
    ///
    /// # Errors
    /// If the device failed.
    fn rsm(
        &self,
        scene: &Self::Res<SceneData>,
        lights: &[Light],
        plan: &RsmPlan,
    ) -> Result<Self::Res<Rsm>>;
    /// The density that clusters are drawn from.
    ///
    /// # Errors
    /// If the device failed.
    fn pdf(&self, inputs: &PdfInputs<'_, Self>, plan: &PdfPlan) -> Result<Self::Res<Pdf>>;
    /// Virtual spherical Gaussian lights from the texels.
    ///
    /// # Errors
    /// If the device failed.
    fn cluster(
        &self,
        scene: &Self::Res<SceneData>,
        rsm: &Self::Res<Rsm>,
        pdf: Option<&Self::Res<Pdf>>,
        plan: &ClusterPlan,
    ) -> Result<Self::Res<Vsgls>>;
    /// Shadow maps of the virtual lights.
    ///
    /// # Errors
    /// If the device failed.
    fn occlusion(
        &self,
        scene: &Self::Res<SceneData>,
        vsgls: &Self::Res<Vsgls>,
        plan: &OcclusionPlan,
    ) -> Result<Self::Res<Occlusion>>;
    /// Light to the eye from every sample. Tells the observer how far it is, and asks whether to go on.
    ///
    /// # Errors
    /// If the device failed; [`crate::Error::Cancelled`] if the observer says so.
    fn shade(
        &self,
        inputs: &ShadeInputs<'_, Self>,
        plan: &ShadePlan,
        observer: &dyn Observer,
    ) -> Result<Self::Res<Radiance>>;
    /// Light to the eye from the sums that shading left, if the plan says so.
    ///
    /// # Errors
    /// If the device failed.
    fn reconstruct(
        &self,
        gbuffer: &Self::Res<GBuffer>,
        radiance: &Self::Res<Radiance>,
        plan: &ReconstructPlan,
    ) -> Result<Self::Res<Radiance>>;
    /// Light along the paths of some samples through each pixel, added up: at most [`PathPlan::PIECE`] samples, in their order.
    ///
    /// # Errors
    /// If the device failed; [`crate::Error::Cancelled`] if the observer says so.
    fn trace(
        &self,
        scene: &Self::Res<SceneData>,
        lights: &[Light],
        view: &View,
        plan: &PathPlan,
        samples: Range<u32>,
        observer: &dyn Observer,
    ) -> Result<Self::Res<Radiance>>;
    /// The mean over the samples of each pixel.
    ///
    /// # Errors
    /// If the device failed.
    fn resolve(
        &self,
        gbuffer: &Self::Res<GBuffer>,
        radiance: &Self::Res<Radiance>,
        view: &View,
    ) -> Result<Self::Res<Image>>;
}

/// What the density is made from.
pub struct PdfInputs<'a, B: Backend> {
    /// The scene.
    pub scene: &'a B::Res<SceneData>,
    /// The texels.
    pub rsm: &'a B::Res<Rsm>,
    /// What the camera sees. Read only where the plan asks for importance, like all below.
    pub gbuffer: &'a B::Res<GBuffer>,
    /// The view that it was seen through.
    pub view: &'a View,
}

/// What shading reads.
pub struct ShadeInputs<'a, B: Backend> {
    /// The scene, for shadow rays.
    pub scene: &'a B::Res<SceneData>,
    /// The receivers.
    pub gbuffer: &'a B::Res<GBuffer>,
    /// The view that they were seen through.
    pub view: &'a View,
    /// Lights that shine on them directly.
    pub lights: &'a [Light],
    /// Lights that shine on them by one bounce.
    pub senders: Senders<'a, B>,
    /// Shadow maps of the clusters, where the plan has them.
    pub occlusion: Option<&'a B::Res<Occlusion>>,
}

/// Where indirect light comes from.
#[derive(Debug)]
pub enum Senders<'a, B: Backend> {
    /// There is none.
    None,
    /// Clusters.
    Vsgls(&'a B::Res<Vsgls>),
    /// Every texel.
    Vpls(&'a B::Res<Rsm>),
}
