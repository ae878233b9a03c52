//! All forms that go together, on one scene with everything in it.

use crate::rooms::sample;
use vsgl_core::settings::{
    Clustering, DiffuseForm, Emission, GlossyForm, Settings, SharpnessFit, Variance,
};
use vsgl_tests::measure::fault;

/// Renders cornell with all of these settings.
fn light(all: impl IntoIterator<Item = Settings>) {
    let base = sample("cornell").size(24, 14);
    for settings in all {
        let mut shot = base.clone();
        shot.settings = settings;
        let words = format!("{:?}", shot.settings);
        let image = shot.image();
        assert_eq!(fault(&image), None, "{words}");
        assert!(
            image.indirect().iter().any(|c| c[0] > 0.0),
            "{words} is dark"
        );
    }
}

fn base() -> Settings {
    sample("cornell").with("lights=16 occlusion=none").settings
}

#[test]
fn every_way_to_lights() {
    let mut all = Vec::new();
    for &clustering in Clustering::ALL {
        for &emission in Emission::ALL {
            for &sharpness in SharpnessFit::ALL {
                for &variance in Variance::ALL {
                    all.push(Settings {
                        clustering,
                        emission,
                        sharpness,
                        variance,
                        ..base()
                    });
                }
            }
        }
    }
    light(all);
}

#[test]
fn every_form_of_shading() {
    let mut all = Vec::new();
    for clustering in [Clustering::Partition, Clustering::Whole] {
        for &emission in Emission::ALL {
            for &diffuse in DiffuseForm::ALL {
                for &glossy in GlossyForm::ALL {
                    all.push(Settings {
                        clustering,
                        emission,
                        diffuse,
                        glossy,
                        ..base()
                    });
                }
            }
        }
    }
    light(all);
}
