//! Light summed up texel by texel, beside that of clusters: each cause of error is found where there is one, and nowhere else.

use super::furnace::sphere;
use std::sync::Arc;
use vsgl_core::backend::Backend;
use vsgl_core::data::{Rsm, SceneData};
use vsgl_core::metrics::luminance;
use vsgl_cpu::CpuBackend;
use vsgl_cpu::explain::{Asked, Places, RAYS, Sets, Sums, drawn_texels, gathered, sums, truth};
use vsgl_tests::render::Shot;

/// Indirect light at every sample, as the pipeline finds it.
fn pipeline(shot: &Shot) -> Vec<f64> {
    shot.image().indirect().into_iter().map(luminance).collect()
}

/// Sums at every sample.
fn found(shot: &Shot) -> Sums {
    let plan = shot.plan();
    let frame = shot.frame();
    let backend = CpuBackend::new(shot.threads).expect("threads");
    let scene: Arc<SceneData> = backend.upload(SceneData::new(&shot.scene)).expect("room");
    let (rsm, vsgls) = (frame.rsm.expect("texels"), frame.vsgls.expect("clusters"));
    let labels = Sets::labels(&rsm, &vsgls).expect("a partition");
    let of = |texel: usize| Some(labels[texel]).filter(|&l| l != u32::MAX);
    let glossy = plan.shade.glossy_senders;
    let sets = Sets::new(&backend, &scene, &rsm, glossy, vsgls.count, &of);
    let asked = Asked {
        scene: &scene,
        gbuffer: &frame.gbuffer,
        eye: shot.view.camera.eye,
        sets: &sets,
        vsgls: Some(&vsgls),
        plan: &plan.shade,
        rays: RAYS,
        seed: 1,
    };
    sums(&backend, &asked, &()).expect("sums")
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Mean difference in units of the mean of the second.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let differences: Vec<f64> = a.iter().zip(b).map(|(a, b)| (a - b).abs()).collect();
    mean(&differences) / mean(b)
}

fn middle([a, b]: &[Vec<f64>; 2]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect()
}

#[test]
fn both_ends_are_what_the_pipeline_finds() {
    for scene in ["cornell", "glossy-floor", "columns"] {
        let shot = Shot::sample(scene).size(32, 18).with("rsm=48 lights=48");
        let found = found(&shot);
        let model = apart(&found.model, &pipeline(&shot));
        assert!(model < 1e-5, "{scene}: clusters differ by {model}");
        // Two rays to each range of texels: noise.
        let texels = pipeline(&shot.clone().with("method=vpl"));
        let exact = middle(&found.exact_seen);
        let noise = 0.5 * apart(&found.exact_seen[0], &found.exact_seen[1]);
        let (all, one) = (mean(&exact) / mean(&texels) - 1.0, apart(&exact, &texels));
        assert!(all.abs() < 0.01, "{scene}: texels differ by {all} in all");
        assert!(
            one < 2.0 * noise + 1e-4,
            "{scene}: texels differ by {one}, noise {noise}"
        );
    }
}

#[test]
fn without_shadows_all_is_seen() {
    let shot = Shot::of(sphere()).with("rsm=32 lights=64");
    let found = found(&shot);
    for (name, open, seen) in [
        ("model", &found.model, &found.model_seen),
        ("strength", &found.strength, &found.strength_seen),
        ("exact", &found.exact, &found.exact_seen),
    ] {
        for half in seen {
            let apart = apart(half, open);
            assert!(apart < 1e-9, "{name}: {apart} by visibility");
        }
    }
    // And what the lobes cost there is found.
    assert!(apart(&found.model, &found.exact) > 1e-4);
}

#[test]
fn clusters_of_one_texel_are_their_texels() {
    let one = Shot::sample("columns")
        .size(32, 18)
        .with("rsm=64 lights=65536");
    let few = one.clone().with("lights=8");
    let errors = |shot: &Shot| {
        let found = found(shot);
        let light = mean(&found.exact);
        [
            apart(&found.exact, &middle(&found.exact_seen)),
            apart(&found.model, &found.strength) * mean(&found.strength) / light,
            apart(&found.strength, &found.exact),
        ]
    };
    let ([seen, emission, integral], many) = (errors(&one), errors(&few));
    // One ray or another to the same texel.
    assert!(seen < 1e-9, "visibility {seen}");
    assert!(many[0] > 0.01, "visibility of few {}", many[0]);
    // A texel has an extent, which a point has not: large texels close by are what is left.
    assert!(
        emission < 0.3 * many[1],
        "emission {emission} of {}",
        many[1]
    );
    assert!(
        integral < 0.3 * many[2],
        "integral {integral} of {}",
        many[2]
    );
}

#[test]
fn drawn_texels_hold_the_flux_of_all() {
    let shot = Shot::sample("glossy-floor").with("rsm=48");
    let plan = shot.plan().bounce.expect("a bounce").rsm;
    let backend = CpuBackend::new(1).expect("threads");
    let scene: Arc<SceneData> = backend.upload(SceneData::new(&shot.scene)).expect("room");
    let flux = |rsm: &Rsm| {
        (0..rsm.position.len())
            .map(|t| f64::from(rsm.weight(t)))
            .sum::<f64>()
    };
    let coarse = flux(&backend.rsm(&scene, &shot.lights, &plan).expect("texels"));
    for seed in 0..4 {
        let drawn = drawn_texels(&backend, &scene, &shot.lights, &plan, 4, seed);
        let ratio = flux(&drawn) / coarse;
        assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    }
    let same = drawn_texels(&backend, &scene, &shot.lights, &plan, 1, 7);
    assert_eq!(flux(&same), coarse);
}

#[test]
fn paths_through_chosen_pixels_are_those_of_the_picture() {
    let shot = Shot::sample("cornell")
        .size(16, 9)
        .with("method=path spp=64 max_depth=3");
    let plan = shot.plan().path.expect("paths");
    let backend = CpuBackend::new(1).expect("threads");
    let scene: Arc<SceneData> = backend.upload(SceneData::new(&shot.scene)).expect("room");
    let all: Vec<(u32, u32)> = (0..9).flat_map(|y| (0..16).map(move |x| (x, y))).collect();
    let places = Places::pixels(&shot.view, &all);
    let pixels = truth(&backend, &scene, &shot.lights, &places, &plan, &()).expect("paths");
    let picture = pipeline(&shot);
    let differ = apart(&pixels, &picture);
    assert!(differ < 1e-5, "{differ}");
    let some: Vec<usize> = (0..40).map(|i| (i * 7) % 144).collect();
    let frame = shot.clone().with("method=vsgl").frame();
    let chosen = gathered(&frame.gbuffer, &some);
    for (at, &sample) in some.iter().enumerate() {
        assert_eq!(chosen.position[at], frame.gbuffer.position[sample]);
    }
}
