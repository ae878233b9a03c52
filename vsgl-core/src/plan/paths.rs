//! Paths of light instead of the pipeline.

use super::reasons::Reasons;
use super::{GBufferPlan, PathPlan, Plan, ShadePlan, SurfacePlan};
use crate::scene::{SceneFacts, SurfaceFacts};
use crate::settings::{Primary, Settings};

impl Plan {
    /// Paths: what the camera sees is needed for the layers that are not light.
    pub(super) fn of_paths(facts: &SceneFacts, settings: &Settings) -> Self {
        let mut reasons = Reasons::default();
        reasons.no("clusters", "the method `path` draws paths from the eye");
        let glossy = reasons.decide(
            "specular parts",
            &[(facts.glossy, "no surface is glossy")],
            "some surface is glossy",
        );
        let emitters = reasons.decide(
            "light of surfaces",
            &[
                (facts.emitters > 0, "no surface shines"),
                (
                    settings.max_depth > 1,
                    "paths of depth 1 end at the first surface",
                ),
            ],
            "points of surfaces that shine are drawn",
        );
        let masks = facts.masks;
        let of = |facts: SurfaceFacts, anisotropy, emission| SurfacePlan {
            textures: facts.textures,
            normal_maps: facts.normal_maps,
            colors: facts.colors,
            unlit: facts.unlit,
            anisotropy,
            emission,
            masks,
        };
        Self {
            gbuffer: GBufferPlan {
                glossy: facts.glossy_receivers,
                surface: of(facts.seen, false, false),
                primary: Primary::Rays,
            },
            bounce: None,
            shade: ShadePlan::none(),
            reconstruct: None,
            path: Some(PathPlan {
                samples: settings.spp,
                max_depth: settings.max_depth,
                seed: 0,
                glossy,
                emitters,
                surface: of(
                    facts.any,
                    glossy && facts.any.anisotropy,
                    facts.any.emission || facts.any.unlit,
                ),
            }),
            reasons: reasons.0,
        }
    }
}
