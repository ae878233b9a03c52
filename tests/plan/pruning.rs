//! Leaving out changes no bit, and saves what it should.

use vsgl_core::data::Columns;
use vsgl_core::glam::Vec3;
use vsgl_core::plan::Plan;
use vsgl_core::scene::{Light, Material};
use vsgl_tests::render::Shot;

/// A matte scene.
fn matte(settings: &str) -> Shot {
    let mut shot = Shot::sample("cornell").with(settings);
    for material in &mut shot.scene.materials {
        *material = Material::lambert("matte", [0.6, 0.5, 0.4]);
    }
    shot
}

/// The plan with every specular column, needed or not.
fn glossy(shot: &Shot) -> Plan {
    let mut plan = shot.plan();
    plan.gbuffer.glossy = true;
    (plan.shade.glossy_receivers, plan.shade.glossy_senders) = (true, true);
    let bounce = plan.bounce.as_mut().expect("a bounce");
    bounce.rsm.glossy = true;
    if let Some(cluster) = &mut bounce.cluster {
        cluster.glossy = true;
    }
    plan
}

fn bytes<T: Columns>(resource: &T) -> usize {
    resource.columns().iter().map(|c| c.bytes.len()).sum()
}

#[test]
fn specular_columns_of_a_matte_scene_change_nothing() {
    for settings in [
        "",
        "clustering=filtered",
        "clustering=whole",
        "clustering=whole emission=sg diffuse=sg-2015",
        "clustering=filtered-box",
        "clustering=nearest-world",
        "emission=sg diffuse=constant",
        "method=vpl rsm=32",
    ] {
        let shot = matte(settings);
        let (pruned, full) = (shot.frame(), shot.frame_by(&glossy(&shot)));
        assert!(
            pruned.image.indirect_diffuse == full.image.indirect_diffuse,
            "{settings}"
        );
        assert!(pruned.image.direct == full.image.direct, "{settings}");
        let dark = |layer: &[[f32; 3]]| layer.iter().all(|c| *c == [0.0; 3]);
        assert!(
            dark(&full.image.indirect_glossy) && dark(&pruned.image.indirect_glossy),
            "{settings}"
        );
        assert!(!dark(&pruned.image.indirect_diffuse), "{settings}");
    }
}

#[test]
fn leaving_out_pays() {
    let shot = matte("");
    let (pruned, full) = (shot.frame(), shot.frame_by(&glossy(&shot)));
    let (few, all) = (pruned.rsm.expect("maps"), full.rsm.expect("maps"));
    // Position, normal and Lambert flux stay; two of five columns of four numbers go.
    assert!(
        5 * bytes(&*few) <= 4 * bytes(&*all),
        "{} of {} bytes",
        bytes(&*few),
        bytes(&*all)
    );
    let (few, all) = (
        pruned.vsgls.expect("clusters"),
        full.vsgls.expect("clusters"),
    );
    assert_eq!(
        (few.diffuse.len(), few.specular.len()),
        (all.diffuse.len(), 0)
    );
    assert_eq!(all.specular.len(), all.diffuse.len());
    assert!(bytes(&*pruned.gbuffer) < bytes(&*full.gbuffer));
    assert!(bytes(&*pruned.radiance) < bytes(&*full.radiance));
}

/// A matte scene with one metal wall that the spot, made narrow, cannot reach.
fn metal_in_the_dark() -> Shot {
    let shots = (0..5).map(|material| {
        let mut shot = matte("");
        for light in &mut shot.lights {
            let Light::Spot(spot) = light else {
                panic!("a light of another kind")
            };
            spot.axis = Vec3::NEG_X;
            (spot.inner, spot.outer) = (0.1, 0.2);
        }
        shot.scene.materials[material] = Material::metal("metal", [0.9; 3], 0.3);
        shot
    });
    let dark = |shot: &Shot| shot.facts().glossy_receivers && !shot.facts().glossy_senders;
    let found = shots.into_iter().find(dark);
    found.expect("a wall that is certainly not lit")
}

#[test]
fn glossy_receivers_under_matte_senders() {
    // Only the lobes of the lights are left out: receivers keep their highlights.
    let shot = metal_in_the_dark();
    let plan = shot.plan();
    assert!(plan.shade.glossy_receivers && plan.gbuffer.glossy);
    assert!(!plan.shade.glossy_senders && !plan.bounce.as_ref().expect("a bounce").rsm.glossy);
    let (pruned, full) = (shot.frame(), shot.frame_by(&glossy(&shot)));
    assert!(pruned.vsgls.expect("clusters").specular.is_empty());
    let lit = |c: &[f32; 3]| c[0] > 0.0;
    assert!(
        pruned.image.indirect_glossy.iter().any(lit),
        "no highlights"
    );
    assert!(pruned.image.indirect_glossy == full.image.indirect_glossy);
    assert!(pruned.image.indirect_diffuse == full.image.indirect_diffuse);
}
