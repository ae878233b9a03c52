//! All forms that go together, on one scene with everything in it.

use crate::rooms::sample;
use vsgl_core::plan::Plan;
use vsgl_core::settings::{
    Clustering, DiffuseForm, Emission, GlossyForm, Settings, SharpnessFit, Variance,
};
use vsgl_tests::measure::fault;

#[test]
fn every_combination_makes_light() {
    let base = sample("cornell")
        .size(24, 14)
        .with("lights=16 occlusion=none");
    let facts = base.facts();
    let (mut rendered, mut refused) = (0, 0);
    for &clustering in Clustering::ALL {
        for &emission in Emission::ALL {
            for &sharpness in SharpnessFit::ALL {
                for &variance in Variance::ALL {
                    for &diffuse in DiffuseForm::ALL {
                        for &glossy in GlossyForm::ALL {
                            let mut shot = base.clone();
                            shot.settings = Settings {
                                clustering,
                                emission,
                                sharpness,
                                variance,
                                diffuse,
                                glossy,
                                ..base.settings.clone()
                            };
                            if Plan::new(&facts, &shot.settings).is_err() {
                                refused += 1;
                                continue;
                            }
                            let image = shot.image();
                            let words = format!(
                                "{clustering} {emission} {sharpness} {variance} {diffuse} {glossy}"
                            );
                            assert_eq!(fault(&image), None, "{words}");
                            assert!(
                                image.indirect().iter().any(|c| c[0] > 0.0),
                                "{words} is dark"
                            );
                            rendered += 1;
                        }
                    }
                }
            }
        }
    }
    println!("{rendered} rendered, {refused} refused");
    assert!(rendered > refused);
}
