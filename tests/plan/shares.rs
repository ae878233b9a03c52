//! Shares of the lights, and rays to some of them.

use vsgl_core::data::Columns;
use vsgl_core::plan::Plan;
use vsgl_core::settings::OcclusionMethod;
use vsgl_tests::render::Shot;

fn reason(plan: &Plan, topic: &str) -> (bool, String) {
    let found = plan.reasons.iter().find(|r| r.topic == topic);
    let found = found.unwrap_or_else(|| panic!("nothing is said about {topic}"));
    (found.runs, found.why.clone())
}

#[test]
fn nothing_is_reconstructed_where_every_sample_takes_all() {
    let shot = Shot::sample("cornell");
    let plan = shot.plan();
    assert!(plan.reconstruct.is_none() && !plan.shade.leaves_sums());
    for (topic, word) in [
        ("interleaved shading", "every"),
        ("reconstruction", "every"),
    ] {
        let (runs, why) = reason(&plan, topic);
        assert!(!runs && why.contains(word), "{topic}: {why}");
    }
    let columns: Vec<usize> = shot
        .frame()
        .radiance
        .columns()
        .iter()
        .map(|c| c.bytes.len())
        .collect();
    assert_eq!(columns[3..], [0, 0], "columns that nobody reads");
}

#[test]
fn shares_and_drawn_rays_are_reconstructed() {
    for (settings, sampled) in [("interleave=4", false), ("occlusion=sampled", true)] {
        let plan = Shot::sample("cornell").with(settings).plan();
        let made = plan.reconstruct.as_ref().expect(settings);
        assert!(plan.shade.leaves_sums() && made.glossy && !made.emitters);
        assert_eq!(made.sampled, sampled);
        assert!(reason(&plan, "reconstruction").0);
    }
    let plan = Shot::sample("cornell").with("occlusion=sampled").plan();
    assert_eq!(plan.shade.occlusion, OcclusionMethod::Sampled);
    assert!(reason(&plan, "occlusion").1.contains("a few rays"));
}

#[test]
fn shares_of_the_lights_read_their_shadow_maps() {
    for word in ["ism", "ism-tessellated"] {
        let settings = format!("interleave=4 occlusion={word}");
        let plan = Shot::sample("cornell").with(&settings).plan();
        assert!(plan.shade.leaves_sums() && plan.shade.occlusion.has_maps());
        let made = plan.reconstruct.as_ref().expect("shares");
        assert!(!made.sampled, "maps answer for every light of a share");
        assert!(plan.bounce.expect("light").occlusion.is_some());
    }
}

#[test]
fn a_share_has_a_light_at_least() {
    for (lights, wanted, side) in [(64, 8, 8), (63, 8, 4), (3, 8, 1), (16, 4, 4), (1, 2, 1)] {
        let words = format!("lights={lights} interleave={wanted}");
        let plan = Shot::sample("cornell").with(&words).plan();
        assert_eq!(plan.shade.interleave, side, "{words}");
        let (runs, why) = reason(&plan, "interleaved shading");
        assert_eq!(runs, side > 1);
        assert_eq!(why.contains("fewer"), side < wanted, "{why}");
    }
}

#[test]
fn without_a_bounce_there_is_nothing_to_share() {
    let mut dark = Shot::sample("cornell").with("interleave=4 occlusion=sampled");
    dark.lights.clear();
    let plan = dark.plan();
    assert!(plan.reconstruct.is_none() && !plan.shade.leaves_sums());
    assert!(!plan.reasons.iter().any(|r| r.topic == "reconstruction"));
    assert_eq!(dark.image().indirect_diffuse, vec![[0.0; 3]; 48 * 27]);
}

#[test]
fn every_texel_a_light_is_the_reference_and_takes_no_shares() {
    for (settings, words) in [
        ("method=vpl interleave=2", ["interleave", "vpl", "1"]),
        ("method=vpl occlusion=sampled", ["occlusion", "vpl", "rays"]),
    ] {
        let shot = Shot::sample("cornell").with(settings);
        let error = Plan::new(&shot.facts(), &shot.settings).expect_err(settings);
        for word in words {
            assert!(error.to_string().contains(word), "{error}");
        }
    }
}
