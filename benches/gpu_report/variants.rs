//! What is measured: the setting of Tokuyoshi 2016, and what changes if one choice is another.

use vsgl_core::settings::{Clustering, OcclusionMethod, PdfMethod, Preset, Settings};

/// One row of the page.
#[derive(Clone, Debug)]
pub(crate) struct Variant {
    /// What distinguishes it.
    pub(crate) what: String,
    pub(crate) settings: Settings,
    /// Whether every sample meets every light, and nothing else is in the time of shading.
    pub(crate) every_pair: bool,
}

/// Pixels along a side of a block that shares the lights out among them; without, each meets all.
const SHARES: [u32; 3] = [2, 4, 8];

/// All of them, the published setting first. Every word of clustering, density and occlusion is among them, and none twice.
pub(crate) fn all(quick: bool) -> Vec<Variant> {
    // As in the paper: 1024 lights from maps of 512² texels, drawn from the density that the camera gives by 2048 lights of its
    // own, and shadow maps of 64² texels for each light.
    let occlusion = OcclusionMethod::from_word("ism").unwrap_or(OcclusionMethod::None);
    let of = |forms: Settings| Settings {
        clustering: Clustering::Filtered,
        pdf: PdfMethod::Brsm,
        occlusion,
        lights: if quick { 64 } else { 1024 },
        rsm: if quick { 64 } else { 512 },
        camera_lights: if quick { 128 } else { 2048 },
        ..forms
    };
    let base = of(Settings::default());
    let variant = |what: String, settings: Settings| Variant {
        every_pair: settings.occlusion == OcclusionMethod::None
            && settings.interleave == 1
            && settings.clustering != Clustering::Whole,
        what,
        settings,
    };
    let mut all = vec![
        variant(
            "as published: 19.3 ms on a GTX 970".into(),
            of(Preset::Paper2016.settings()),
        ),
        variant(
            format!("our forms: filtered, brsm, occlusion {occlusion}"),
            base.clone(),
        ),
    ];
    for &clustering in Clustering::ALL {
        let settings = Settings {
            clustering,
            ..base.clone()
        };
        all.push(variant(format!("clustering {clustering}"), settings));
    }
    for &pdf in PdfMethod::ALL {
        let settings = Settings {
            pdf,
            ..base.clone()
        };
        all.push(variant(format!("density {pdf}"), settings));
    }
    for &occlusion in OcclusionMethod::ALL {
        let settings = Settings {
            occlusion,
            ..base.clone()
        };
        all.push(variant(format!("occlusion {occlusion}"), settings));
    }
    for interleave in SHARES {
        for occlusion in [occlusion, OcclusionMethod::Sampled] {
            let settings = Settings {
                interleave,
                occlusion,
                ..base.clone()
            };
            let what = format!("interleave {interleave}, occlusion {occlusion}");
            all.push(variant(what, settings));
        }
    }
    let mut seen = Vec::new();
    all.retain(|variant| {
        let new = !seen.contains(&variant.settings);
        seen.push(variant.settings.clone());
        new
    });
    all
}
