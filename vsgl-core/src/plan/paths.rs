//! Paths of light instead of the pipeline.

use super::reasons::Reasons;
use super::{GBufferPlan, PathPlan, Plan, ShadePlan, SurfacePlan};
use crate::scene::{SceneFacts, SurfaceFacts};
use crate::settings::{LightSampling, OcclusionMethod, Primary, Settings};

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
        let sources = facts.lights + if emitters { facts.emitters } else { 0 };
        reasons.decide(
            "lights by power",
            &[
                (sources > 0, "there is no light"),
                (sources > 1, "there is one light alone"),
                (
                    settings.light_sampling == LightSampling::Power,
                    "each is drawn with the same chance, as asked",
                ),
            ],
            "more paths go to lights that send more",
        );
        reasons.not_for_paths(settings);
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
                light_sampling: settings.light_sampling,
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

impl Reasons {
    /// Says which settings ask for something that paths do not need.
    fn not_for_paths(&mut self, settings: &Settings) {
        let why = "not needed with the method `path`, which draws paths to all lights itself";
        if settings.interleave > 1 {
            self.no("interleaved shading", why);
        }
        if settings.occlusion.has_maps() {
            self.no(
                "shadow maps",
                "not needed with the method `path`: rays say what blocks light",
            );
        }
        if settings.occlusion == OcclusionMethod::Sampled {
            self.no("sampled occlusion", why);
        }
        if settings.occlusion == OcclusionMethod::None {
            self.no(
                "light through walls",
                "not with the method `path`: what blocks light blocks it",
            );
        }
        if settings.primary == Primary::Raster {
            self.no(
                "raster",
                "not needed with the method `path`: paths begin with rays",
            );
        }
    }
}
