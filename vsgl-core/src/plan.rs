//! What will run, decided once from the scene's facts and the settings, with a reason for each decision.

use crate::error::{Error, Result};
use crate::phase::reconstruct::FILTER;
use crate::scene::{EMITTER_POINTS, SceneFacts, SurfaceFacts};
use crate::settings::{
    Clustering, DiffuseForm, Emission, GlossyForm, Method, OcclusionMethod, PdfMethod, Primary,
    Settings, SharpnessFit, Variance,
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
    /// What is read of surfaces.
    pub surface: SurfacePlan,
}

impl PathPlan {
    /// Paths that are added up in one piece, in f32; pieces are added up in f64 in the order of samples, so that the sum
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
    fn none() -> Self {
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
        if settings.interleave > 1 && settings.occlusion.has_maps() {
            return Err(Error::setting(
                "interleave",
                format!(
                    "shares of the lights do not read the maps of `{}` yet",
                    settings.occlusion
                ),
                "set `interleave` to `1`, or `occlusion` to `rays`, `sampled` or `none`",
            ));
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

    /// Paths: what the camera sees is needed for the layers that are not light.
    fn of_paths(facts: &SceneFacts, settings: &Settings) -> Self {
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

impl ImportancePlan {
    /// In the forms of this library whatever the settings' forms are: the way of light from the camera to the texels, with
    /// senders and receivers changed round.
    fn new(settings: &Settings, shade: &ShadePlan) -> Self {
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

/// What is read of the surfaces that the camera sees, and of those that the lights see.
fn surfaces(facts: &SceneFacts, lit: bool, reasons: &mut Reasons) -> (SurfacePlan, SurfacePlan) {
    let sent = if lit {
        facts.sent
    } else {
        SurfaceFacts::default()
    };
    let seen = facts.seen;
    let mut either = |topic, [seen, sent]: [bool; 2], without: &str, with: &str| {
        reasons.decide(topic, &[(seen || sent, without)], with);
        [seen, sent]
    };
    let textures = either(
        "texture reads",
        [seen.textures, sent.textures],
        "no surface that is seen or reflects light has a texture",
        "surfaces that are seen or reflect light have textures",
    );
    let normal_maps = either(
        "normal maps",
        [seen.normal_maps, sent.normal_maps],
        "no surface that is seen or reflects light has one",
        "surfaces that are seen or reflect light have them",
    );
    let colors = either(
        "vertex colours",
        [seen.colors, sent.colors],
        "no surface that is seen or reflects light has them",
        "surfaces that are seen or reflect light have them",
    );
    let unlit = either(
        "unlit surfaces",
        [seen.unlit, sent.unlit],
        "every surface that is seen or reflects light is lit",
        "they show their colour and reflect nothing",
    );
    let emission = either(
        "emission",
        [seen.emission || seen.unlit, false],
        "no surface in front of the camera shines by itself",
        "surfaces in front of the camera shine by themselves",
    );
    let masks = reasons.decide(
        "alpha masks",
        &[(facts.masks, "no surface has one")],
        "rays pass where surfaces are left out by their masks",
    );
    let plan = |i: usize| SurfacePlan {
        textures: textures[i],
        normal_maps: normal_maps[i],
        colors: colors[i],
        unlit: unlit[i],
        emission: emission[i],
        masks,
        ..SurfacePlan::default()
    };
    (plan(0), plan(1))
}

#[derive(Default)]
struct Reasons(Vec<Reason>);

impl Reasons {
    /// Runs only if every condition holds; the first that does not is the reason.
    fn decide(&mut self, topic: &'static str, needs: &[(bool, &str)], because: &str) -> bool {
        let missing = needs.iter().find(|(holds, _)| !holds);
        let why = missing.map_or(because, |(_, why)| why).to_owned();
        self.0.push(Reason {
            topic,
            runs: missing.is_none(),
            why,
        });
        missing.is_none()
    }

    /// Texels along a side of a map: as wanted, but halved until all maps together are within [`RsmPlan::TEXELS_MAX`].
    /// One map is as large as wanted; a map of emitters alone has no more texels than they have points.
    fn map_size(&mut self, of_lights: u32, emitters: bool, wanted: u32) -> u32 {
        let maps = of_lights.saturating_add(u32::from(emitters));
        if of_lights == 0 && wanted > RsmPlan::EMITTERS_SIDE {
            let side = RsmPlan::EMITTERS_SIDE;
            self.0.push(Reason {
                topic: "smaller maps",
                runs: true,
                why: format!("surfaces that shine have {side}² points in all"),
            });
            return side;
        }
        let texels = |side: u32| u64::from(maps) * u64::from(side) * u64::from(side);
        let mut side = wanted;
        while maps > 1 && side > 1 && texels(side) > RsmPlan::TEXELS_MAX {
            side /= 2;
        }
        let why = if side == wanted {
            format!("{maps} of {side}² texels, as wanted")
        } else {
            let most = RsmPlan::TEXELS_MAX;
            format!("{maps} of {wanted}² texels would have more than {most} in all: {side}² each")
        };
        self.0.push(Reason {
            topic: "smaller maps",
            runs: side != wanted,
            why,
        });
        side
    }

    /// Side of the square of samples that share out the lights: as wanted, but halved until every share has a light.
    fn interleave(&mut self, wanted: u32, lights: u32) -> u32 {
        let mut side = wanted;
        while side > 1 && side * side > lights {
            side /= 2;
        }
        let why = match (wanted, side) {
            (1, _) => "every sample takes every virtual light".to_owned(),
            _ if side < wanted => {
                format!("{lights} lights are fewer than {wanted}x{wanted} shares")
            }
            _ => format!("each sample of {side}x{side} takes its share of the virtual lights"),
        };
        self.0.push(Reason {
            topic: "interleaved shading",
            runs: side > 1,
            why,
        });
        side
    }

    /// Sides and points of the shadow maps: as wanted, but halved until all of them together are few enough.
    fn shadow_maps(&mut self, settings: &Settings, count: u32, masks: bool) -> OcclusionPlan {
        let maps = u64::from(count);
        let texels = |side: u32| maps * u64::from(side) * u64::from(side);
        let (mut side, mut points) = (settings.map_size, settings.map_points);
        while side > Settings::MAP_MIN && texels(side) > OcclusionPlan::TEXELS_MAX {
            side = (side / 2).max(Settings::MAP_MIN);
        }
        while points > 1 && maps * u64::from(points) > OcclusionPlan::POINTS_MAX {
            points /= 2;
        }
        let (wanted, of) = (settings.map_size, settings.map_points);
        let why = if (side, points) == (wanted, of) {
            format!("{maps} of {side}² texels and {points} points, as wanted")
        } else {
            format!(
                "{maps} of {wanted}² texels and {of} points would have more than {} or {} in all: {side}² and {points} each",
                OcclusionPlan::TEXELS_MAX,
                OcclusionPlan::POINTS_MAX
            )
        };
        self.0.push(Reason {
            topic: "smaller shadow maps",
            runs: (side, points) != (wanted, of),
            why,
        });
        OcclusionPlan {
            side,
            points,
            tessellated: settings.occlusion == OcclusionMethod::IsmTessellated,
            masks,
        }
    }

    fn no(&mut self, topic: &'static str, why: &str) {
        self.0.push(Reason {
            topic,
            runs: false,
            why: why.to_owned(),
        });
    }
}
