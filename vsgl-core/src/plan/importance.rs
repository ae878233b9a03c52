//! The density that asks what the camera sees.

use super::{ClusterPlan, ImportancePlan, ShadePlan};
use crate::settings::{Clustering, OcclusionMethod, Settings};

impl ImportancePlan {
    /// In the forms of this library whatever the settings' forms are: the way of light from the camera to the texels, with
    /// senders and receivers changed round.
    pub(super) fn new(settings: &Settings, shade: &ShadePlan) -> Self {
        let forms = Settings::default();
        Self {
            cluster: ClusterPlan {
                count: settings.camera_lights,
                method: Clustering::Partition,
                kernel: forms.kernel,
                bisections: forms.bisections,
                emission: forms.emission,
                sharpness: forms.sharpness,
                variance: forms.variance,
                glossy: shade.glossy_receivers,
                anisotropic: shade.anisotropic_receivers,
                apart: false,
            },
            shade: ShadePlan {
                emitters: false,
                glossy_receivers: shade.glossy_senders,
                glossy_senders: shade.glossy_receivers,
                anisotropic_receivers: shade.anisotropic_senders,
                anisotropic_senders: shade.anisotropic_receivers,
                emission: forms.emission,
                diffuse: forms.diffuse,
                glossy: forms.glossy,
                occlusion: OcclusionMethod::None,
                interleave: 1,
                ..shade.clone()
            },
        }
    }
}
