//! Paths of light on both backends.

use crate::{agree, kinds_of_lights, shining};
use vsgl_core::scene::Light;
use vsgl_tests::gpu::Tier;
use vsgl_tests::render::Shot;
use vsgl_tests::surfaces::everything;

fn all_tiers(name: &str, shot: &Shot) {
    agree(name, shot, Tier::Lavapipe, true);
    agree(name, shot, Tier::SwiftShader, true);
    agree(name, shot, Tier::Hardware, false);
}

#[test]
fn paths_under_all_kinds_of_lights() {
    for (name, lights) in kinds_of_lights() {
        let mut shot = Shot::sample("cornell")
            .size(48, 27)
            .with("method=path spp=11 max_depth=4");
        shot.lights = lights;
        all_tiers(&format!("paths under {name}"), &shot);
    }
}

#[test]
fn paths_among_surfaces_that_shine() {
    for depth in [1, 2, 3, 12] {
        let mut shot = shining("").size(48, 27);
        shot = shot.with(&format!("method=path spp=3 max_depth={depth}"));
        all_tiers(&format!("paths of depth {depth}"), &shot);
        shot.lights.clear();
        all_tiers(&format!("paths of depth {depth}, no lamp"), &shot);
    }
}

#[test]
fn paths_among_everything_that_a_surface_can_be() {
    let shot = Shot::of(everything(true, 4.0))
        .size(48, 27)
        .with("method=path spp=2");
    let plan = shot.plan().path.expect("paths");
    assert!(plan.glossy && plan.emitters && plan.surface.masks && plan.surface.anisotropy);
    all_tiers("paths among everything", &shot);
}

#[test]
fn paths_to_lights_drawn_evenly_and_by_power() {
    let mut shot = shining("").size(48, 27);
    let mut lights: Vec<_> = kinds_of_lights().into_iter().flat_map(|(_, l)| l).collect();
    for (index, light) in lights.iter_mut().enumerate() {
        if let Light::Point(point) = light {
            point.intensity = point.intensity.map(|i| i * index as f32);
        }
    }
    shot.lights = lights;
    for sampling in ["power", "uniform"] {
        let words = format!("method=path spp=3 light_sampling={sampling}");
        all_tiers(&format!("paths by {sampling}"), &shot.clone().with(&words));
    }
}

#[test]
fn paths_as_users_run_them() {
    for name in ["cornell", "glossy-floor"] {
        let shot = Shot::sample(name).size(64, 36).with("method=path spp=8");
        agree(name, &shot, Tier::Lavapipe, false);
    }
}
