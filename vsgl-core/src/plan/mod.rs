//! What will run, decided once from the scene's facts and the settings, with a reason for each decision.

use self::reasons::Reasons;
use self::surfaces::surfaces;
use crate::error::{Error, Result};
use crate::scene::SceneFacts;
use crate::settings::{
    Clustering, Emission, Method, OcclusionMethod, PdfMethod, Primary, Settings,
};

mod importance;
mod parts;
mod paths;
mod reasons;
mod surfaces;

pub use parts::{
    BouncePlan, ClusterPlan, GBufferPlan, ImportancePlan, OcclusionPlan, PathPlan, PdfPlan,
    ReconstructPlan, RsmPlan, ShadePlan, SurfacePlan,
};

/// The phases that run and their parameters. Nothing that is not in here runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Whether materials are glossy as the camera sees them: the specular columns of the G-buffer.
    pub gbuffer: GBufferPlan,
    /// Indirect light.
    pub bounce: Option<BouncePlan>,
    /// Shading.
    pub shade: ShadePlan,
    /// From shares of the virtual lights to all of them.
    pub reconstruct: Option<ReconstructPlan>,
    /// Paths instead of all the rest.
    pub path: Option<PathPlan>,
    /// Why, a line for each decision.
    pub reasons: Vec<Reason>,
}

/// One decision of the plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reason {
    /// What was decided about.
    pub topic: &'static str,
    /// Whether it runs.
    pub runs: bool,
    /// Why.
    pub why: String,
}

impl Plan {
    /// Decides.
    ///
    /// # Errors
    /// [`Error::Setting`] where settings contradict each other.
    pub fn new(facts: &SceneFacts, settings: &Settings) -> Result<Self> {
        if settings.method == Method::Path {
            return Ok(Self::of_paths(facts, settings));
        }
        let mut reasons = Reasons::default();
        let shines = facts.emitters > 0;
        let lit = reasons.decide(
            "bounce",
            &[
                (facts.triangles > 0, "the scene has no triangles"),
                (facts.lights > 0 || shines, "the scene has no lights"),
                (
                    facts.reflecting_senders || shines,
                    "no surface that the lights may reach reflects anything",
                ),
            ],
            if facts.reflecting_senders {
                "lights reach surfaces that reflect"
            } else {
                "surfaces shine"
            },
        );
        let shines = lit
            && reasons.decide(
                "light of surfaces",
                &[(shines, "no surface shines")],
                "surfaces shine, each point of them a virtual light",
            );
        let reflected = lit && facts.reflecting_senders;
        let maps = if reflected { facts.maps } else { 0 };
        let rsm = lit.then(|| reasons.map_size(maps, shines, settings.rsm));
        let senders = lit
            && reasons.decide(
                "specular lobes of the lights",
                &[(
                    facts.glossy_senders,
                    "no glossy surface within reach of the lights",
                )],
                "glossy surfaces within reach of the lights",
            );
        let receivers = reasons.decide(
            "specular term of the receivers",
            &[(
                facts.glossy_receivers,
                "no glossy surface in front of the camera",
            )],
            "glossy surfaces in front of the camera",
        );
        let stretched = receivers
            && reasons.decide(
                "two roughnesses of the receivers",
                &[
                    (
                        facts.seen.anisotropy,
                        "no anisotropic surface in front of the camera",
                    ),
                    (
                        settings.glossy.two_roughnesses() || settings.method == Method::Vpl,
                        "the form of the specular part knows one roughness",
                    ),
                ],
                "anisotropic surfaces in front of the camera",
            );
        let stretching = senders
            && reasons.decide(
                "two roughnesses of the lights",
                &[
                    (
                        facts.sent.anisotropy,
                        "no anisotropic surface within reach of the lights",
                    ),
                    (
                        settings.emission == Emission::Cosine || settings.method == Method::Vpl,
                        "one spherical Gaussian a light has one sharpness",
                    ),
                ],
                "anisotropic surfaces within reach of the lights",
            );
        let (mut seen, mut sent) = surfaces(facts, lit, &mut reasons);
        (seen.anisotropy, sent.anisotropy) = (stretched, stretching);
        if settings.method == Method::Vpl {
            texels_are_the_reference(settings)?;
        }
        let clusters = lit && settings.method == Method::Vsgl;
        if lit && !clusters {
            reasons.no("clusters", "the method `vpl` takes every texel for a light");
        }
        let whole = settings.clustering == Clustering::Whole;
        if clusters && whole {
            reasons.no(
                "number of lights",
                "each map is one cluster, however many lights are asked for",
            );
        }
        let samples = clusters
            && reasons.decide(
                "pdf",
                &[
                    (!whole, "whole maps are not sampled"),
                    (
                        settings.clustering.draws(),
                        "an exact partition draws no samples",
                    ),
                ],
                "cluster centres are drawn from a density",
            );
        if samples {
            reasons.decide(
                "search for kernel sizes",
                &[
                    (
                        settings.clustering != Clustering::NearestWorld,
                        "every texel goes to the nearest centre",
                    ),
                    (
                        settings.clustering != Clustering::FilteredOriginal,
                        "a kernel's size follows from the density at its centre",
                    ),
                ],
                "each is as large as it must be to hold its share",
            );
        }
        let occluded = lit
            && reasons.decide(
                "occlusion",
                &[(
                    settings.occlusion != OcclusionMethod::None,
                    "switched off: indirect light passes through walls",
                )],
                match settings.occlusion {
                    OcclusionMethod::Sampled => {
                        "a few rays from each pixel, to virtual lights chosen by what they bring"
                    }
                    OcclusionMethod::Ism => "a shadow map of points for each virtual light",
                    OcclusionMethod::IsmTessellated => {
                        "a shadow map of pieces of triangles for each virtual light"
                    }
                    _ => "one ray from each pixel to each virtual light",
                },
            );
        let important = samples
            && reasons.decide(
                "importance",
                &[(
                    settings.pdf == PdfMethod::Brsm,
                    "the density asks only what the lights see",
                )],
                "virtual lights from what the camera sees say which texels matter to it",
            );
        let shadows = clusters
            && occluded
            && reasons.decide(
                "shadow maps",
                &[(
                    settings.occlusion.has_maps(),
                    "rays say what blocks indirect light",
                )],
                "a map above each virtual light says what blocks its light",
            );
        let lights = if whole {
            maps.saturating_add(u32::from(shines))
        } else {
            settings.lights
        };
        let interleave = if lit {
            reasons.interleave(settings.interleave, lights)
        } else {
            1
        };
        let shadows = shadows.then(|| reasons.shadow_maps(settings, lights, facts.masks));
        let shade = ShadePlan {
            bounce: lit,
            emitters: shines,
            glossy_receivers: receivers,
            glossy_senders: senders,
            anisotropic_receivers: stretched,
            anisotropic_senders: stretching,
            emission: settings.emission,
            diffuse: settings.diffuse,
            glossy: settings.glossy,
            occlusion: if occluded {
                settings.occlusion
            } else {
                OcclusionMethod::None
            },
            rays: settings.rays,
            interleave,
            masks: seen.masks,
        };
        let importance = important.then(|| ImportancePlan::new(settings, &shade));
        let bounce = rsm.map(|size| BouncePlan {
            rsm: RsmPlan {
                lights: reflected,
                emitters: shines,
                size,
                glossy: senders,
                surface: sent,
            },
            pdf: samples.then_some(PdfPlan {
                method: settings.pdf,
                count: settings.lights,
                importance,
            }),
            cluster: clusters.then_some(ClusterPlan {
                count: lights,
                method: settings.clustering,
                kernel: settings.kernel,
                bisections: settings.bisections,
                emission: settings.emission,
                sharpness: settings.sharpness,
                variance: settings.variance,
                glossy: senders,
                anisotropic: stretching,
                apart: whole,
            }),
            occlusion: shadows,
        });
        let sampled = shade.occlusion == OcclusionMethod::Sampled;
        let reconstruct = lit
            && reasons.decide(
                "reconstruction",
                &[(
                    shade.leaves_sums(),
                    "every sample takes all virtual lights, and its own visibility",
                )],
                if sampled {
                    "visibility is taken together over neighbouring samples"
                } else {
                    "neighbouring samples hold the other virtual lights"
                },
            );
        let reconstruct = reconstruct.then_some(ReconstructPlan {
            interleave,
            glossy: receivers,
            emitters: shines,
            sampled,
        });
        let raster = reasons.decide(
            "raster",
            &[
                (
                    settings.primary == Primary::Raster,
                    "the camera's rays say which triangle is seen",
                ),
                (
                    !seen.masks,
                    "rays see through alpha masks, where a rasteriser would draw other edges",
                ),
            ],
            "the GPU draws triangle ids, which may differ from those of rays along edges",
        );
        let gbuffer = GBufferPlan {
            glossy: receivers,
            surface: seen,
            primary: if raster {
                Primary::Raster
            } else {
                Primary::Rays
            },
        };
        Ok(Self {
            gbuffer,
            bounce,
            shade,
            reconstruct,
            path: None,
            reasons: reasons.0,
        })
    }
}

/// Every texel from every pixel, or an error: what the method `vpl` is for.
fn texels_are_the_reference(settings: &Settings) -> Result<()> {
    let remedy = |word: &str| format!("set `{word}`, or `method` to `vsgl`");
    if settings.interleave > 1 {
        return Err(Error::setting(
            "interleave",
            "the method `vpl` is the reference, and takes every texel for every pixel",
            remedy("interleave` to `1"),
        ));
    }
    if settings.occlusion == OcclusionMethod::Sampled {
        return Err(Error::setting(
            "occlusion",
            "`sampled` chooses among virtual lights, and the method `vpl` has none but texels",
            remedy("occlusion` to `rays"),
        ));
    }
    if settings.occlusion.has_maps() {
        return Err(Error::setting(
            "occlusion",
            format!(
                "`{}` has a map for each virtual light, and the method `vpl` has none but texels",
                settings.occlusion
            ),
            remedy("occlusion` to `rays"),
        ));
    }
    Ok(())
}
