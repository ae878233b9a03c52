//! The parts of a plan: one for each phase.

use crate::phase::reconstruct::FILTER;
use crate::scene::EMITTER_POINTS;
use crate::settings::{
    Clustering, DiffuseForm, Emission, GlossyForm, LightSampling, OcclusionMethod, PdfMethod,
    Primary, SharpnessFit, Variance,
};

/// The G-buffer phase.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GBufferPlan {
    /// Write the specular columns.
    pub glossy: bool,
    /// What is read of surfaces.
    pub surface: SurfacePlan,
    /// What decides which triangle a sample sees.
    pub primary: Primary,
}

/// What is read of a surface besides position, normal and factors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SurfacePlan {
    /// Textures of colours and factors.
    pub textures: bool,
    /// Normal maps.
    pub normal_maps: bool,
    /// Colours of vertices.
    pub colors: bool,
    /// Whether it is one that reflects nothing.
    pub unlit: bool,
    /// Tangents and the second roughness, into their column.
    pub anisotropy: bool,
    /// What it sends by itself, into the column of the G-buffer.
    pub emission: bool,
    /// Whether rays pass where an alpha mask leaves it out.
    pub masks: bool,
}

/// The way of the light from the maps to the lights that shade.
#[derive(Clone, Debug, PartialEq)]
pub struct BouncePlan {
    /// The maps.
    pub rsm: RsmPlan,
    /// The density, for clusterings that sample.
    pub pdf: Option<PdfPlan>,
    /// The clusters; none with the method `vpl`, which shades from the texels themselves.
    pub cluster: Option<ClusterPlan>,
    /// Shadow maps of the clusters.
    pub occlusion: Option<OcclusionPlan>,
}

/// The reflective shadow maps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RsmPlan {
    /// Maps of the lights.
    pub lights: bool,
    /// A map of the surfaces that shine.
    pub emitters: bool,
    /// Texels along a side.
    pub size: u32,
    /// Write the specular columns.
    pub glossy: bool,
    /// What is read of surfaces.
    pub surface: SurfacePlan,
}

impl RsmPlan {
    /// Most texels of several maps together: so many cost about as much as four maps of the default size, and their columns
    /// are within the smallest buffers that GPUs promise.
    pub const TEXELS_MAX: u64 = 1 << 20;
    /// Side of a map that holds all points of the surfaces that shine.
    pub const EMITTERS_SIDE: u32 = EMITTER_POINTS.isqrt() as u32;
}

/// The density on the texels.
#[derive(Clone, Debug, PartialEq)]
pub struct PdfPlan {
    /// Which density.
    pub method: PdfMethod,
    /// Clusters to share out between the maps.
    pub count: u32,
    /// What [`PdfMethod::Brsm`] takes, and no other.
    pub importance: Option<ImportancePlan>,
}

/// How much texels matter to what the camera sees.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportancePlan {
    /// Virtual lights from what the camera sees.
    pub cluster: ClusterPlan,
    /// What texels reflect of their light.
    pub shade: ShadePlan,
}

/// The clusters.
#[derive(Clone, Debug, PartialEq)]
pub struct ClusterPlan {
    /// Clusters wanted; there are never more than texels with flux. Of whole maps their number.
    pub count: u32,
    /// How texels become clusters.
    pub method: Clustering,
    /// Share of the density a kernel holds, times `count`.
    pub kernel: f32,
    /// Steps of the bisection.
    pub bisections: u32,
    /// Shape of the light sent.
    pub emission: Emission,
    /// Mean length to sharpness.
    pub sharpness: SharpnessFit,
    /// Convention of the variance.
    pub variance: Variance,
    /// Make specular lights.
    pub glossy: bool,
    /// Give them two roughnesses.
    pub anisotropic: bool,
    /// With emission `sg`: each part at its own mean position, not both at the common one.
    pub apart: bool,
}

/// Paths of light from the eye.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathPlan {
    /// Paths through each pixel.
    pub samples: u32,
    /// Longest paths.
    pub max_depth: u32,
    /// What random numbers depend on, besides pixel and sample.
    pub seed: u32,
    /// Surfaces have specular parts.
    pub glossy: bool,
    /// Points of surfaces that shine are drawn.
    pub emitters: bool,
    /// Which of them and of the lights.
    pub light_sampling: LightSampling,
    /// What is read of surfaces.
    pub surface: SurfacePlan,
}

impl PathPlan {
    /// Paths that are added up in one piece, in f32; pieces are added up without rounding ([`crate::trace::Sums`]), so that the sum
    /// does not depend on how the work was shared out.
    pub const PIECE: u32 = 8;
}

/// Shadow maps of the clusters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OcclusionPlan {
    /// Texels along a side of a map.
    pub side: u32,
    /// Draws of points or of triangles for each map.
    pub points: u32,
    /// Triangles are cut into pieces of about a texel, instead of points drawn on them.
    pub tessellated: bool,
    /// Points in the holes of alpha masks are none.
    pub masks: bool,
}

impl OcclusionPlan {
    /// Most texels of all maps together: 64 MB.
    pub const TEXELS_MAX: u64 = 1 << 24;
    /// Most points of all maps together.
    pub const POINTS_MAX: u64 = 1 << 26;
}

/// Shading.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShadePlan {
    /// Light of virtual lights.
    pub bounce: bool,
    /// Some of them are surfaces that shine: their light is direct.
    pub emitters: bool,
    /// The receivers' specular part, for direct and indirect light.
    pub glossy_receivers: bool,
    /// The senders' specular part.
    pub glossy_senders: bool,
    /// Two roughnesses of the receivers' specular part.
    pub anisotropic_receivers: bool,
    /// Two roughnesses of the senders' specular part.
    pub anisotropic_senders: bool,
    /// Shape of the light sent.
    pub emission: Emission,
    /// The receivers' Lambert integral.
    pub diffuse: DiffuseForm,
    /// The receivers' specular integral.
    pub glossy: GlossyForm,
    /// Blocking of indirect light.
    pub occlusion: OcclusionMethod,
    /// Rays from each sample, where they are drawn.
    pub rays: u32,
    /// Side of the square of samples that share out the virtual lights.
    pub interleave: u32,
    /// Shadow rays pass where alpha masks leave surfaces out.
    pub masks: bool,
}

impl ShadePlan {
    /// No light at all.
    pub(super) fn none() -> Self {
        Self {
            bounce: false,
            emitters: false,
            glossy_receivers: false,
            glossy_senders: false,
            anisotropic_receivers: false,
            anisotropic_senders: false,
            emission: Emission::Cosine,
            diffuse: DiffuseForm::V13,
            glossy: GlossyForm::NdfFilter,
            occlusion: OcclusionMethod::None,
            masks: false,
            interleave: 1,
            rays: 0,
        }
    }

    /// Whether shading leaves sums for reconstruction instead of light to the eye.
    pub fn leaves_sums(&self) -> bool {
        self.bounce && (self.interleave > 1 || self.occlusion == OcclusionMethod::Sampled)
    }
}

/// Reconstruction from shares of the virtual lights.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReconstructPlan {
    /// Side of the square of samples that share out the virtual lights.
    pub interleave: u32,
    /// The receivers' specular part.
    pub glossy: bool,
    /// Light of surfaces that shine.
    pub emitters: bool,
    /// Visibility from rays that were drawn.
    pub sampled: bool,
}

impl ReconstructPlan {
    /// Side of the square over which visibility is taken together.
    pub fn filter(&self) -> u32 {
        self.interleave.max(FILTER)
    }
}
