//! Imperfect shadow maps: the maps themselves, and pictures by them.

use super::{agree, shining};
use vsgl_tests::gpu::Tier;
use vsgl_tests::render::Shot;
use vsgl_tests::surfaces::everything;

const KINDS: [&str; 2] = ["ism", "ism-tessellated"];

#[test]
fn shadow_maps_of_both_kinds() {
    for kind in KINDS {
        for (scene, settings) in [
            ("cornell", "lights=24 rsm=64 map_points=1024"),
            ("columns", "lights=17 rsm=64 map_size=17 map_points=300"),
            // Runs of triangles, and runs of so many that some stand for others.
            ("columns", "lights=9 rsm=64 map_size=16 map_points=200"),
            ("columns", "lights=8 rsm=64 map_size=32 map_points=3"),
            ("glossy-floor", "lights=8 rsm=32 map_size=8 map_points=1"),
        ] {
            let shot = Shot::sample(scene).with(&format!("{settings} occlusion={kind}"));
            let name = format!("{scene}, {kind}, {settings}");
            agree(&name, &shot, Tier::Lavapipe, true);
            agree(&name, &shot, Tier::SwiftShader, true);
            agree(&name, &shot, Tier::Hardware, false);
        }
    }
}

/// Masks, which points fall through; surfaces that shine, whose lights have maps too; kernels, of which there may be fewer than
/// there is room for.
#[test]
fn shadow_maps_of_all_sorts_of_surfaces() {
    for kind in KINDS {
        let settings = format!("lights=16 rsm=32 map_size=16 map_points=512 occlusion={kind}");
        let mut masked = Shot::of(everything(true, 4.0)).with(&settings);
        let plan = masked.plan();
        assert!(
            plan.bounce
                .and_then(|b| b.occlusion)
                .is_some_and(|o| o.masks)
        );
        agree(
            &format!("everything, {kind}"),
            &masked,
            Tier::Lavapipe,
            true,
        );
        agree(
            &format!("surfaces that shine, {kind}"),
            &shining(&settings),
            Tier::Lavapipe,
            true,
        );
        masked = Shot::sample("cornell")
            .with(&settings)
            .with("clustering=filtered emission=sg");
        agree(&format!("kernels, {kind}"), &masked, Tier::Lavapipe, true);
    }
}

#[test]
fn shadow_maps_as_users_run_them() {
    for kind in KINDS {
        let settings = format!("lights=16 rsm=64 map_size=32 map_points=1024 occlusion={kind}");
        let shot = Shot::sample("columns").with(&settings);
        agree(&format!("columns, {kind}"), &shot, Tier::Lavapipe, false);
    }
}
