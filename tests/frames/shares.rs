//! Shares of the virtual lights, rays to some of them, and what is reconstructed from both, on both backends.

use crate::{agree, shining};
use vsgl_tests::gpu::Tier;
use vsgl_tests::render::Shot;
use vsgl_tests::surfaces::everything;

/// Both paths of the software driver.
fn both(name: &str, shot: &Shot) {
    agree(name, shot, Tier::Lavapipe, true);
    agree(name, shot, Tier::Lavapipe, false);
}

#[test]
fn every_side_and_every_occlusion() {
    for (side, occlusion) in [
        (1, "sampled"),
        (2, "rays"),
        (4, "none"),
        (4, "sampled"),
        (8, "rays"),
        (2, "ism map_size=16 map_points=512"),
        (4, "ism-tessellated map_size=16 map_points=512"),
    ] {
        let choice = format!("lights=70 rsm=32 interleave={side} occlusion={occlusion}");
        let shot = Shot::sample("cornell").with(&choice);
        assert!(shot.plan().reconstruct.is_some());
        agree(&choice, &shot, Tier::Lavapipe, true);
        if side == 4 {
            agree(&choice, &shot, Tier::Lavapipe, false);
        }
    }
}

#[test]
fn any_number_of_rays() {
    for rays in [1, 5, 64] {
        let choice = format!("lights=70 rsm=32 interleave=2 occlusion=sampled rays={rays}");
        let shot = Shot::sample("columns").size(32, 18).with(&choice);
        agree(&choice, &shot, Tier::Lavapipe, true);
    }
}

/// More lights than one dispatch takes, with rays to each and to some.
#[test]
fn many_lights() {
    for (size, choice) in [
        ((32, 18), "lights=4096 rsm=128 interleave=2"),
        ((8, 4), "lights=20000 rsm=256 occlusion=sampled"),
        (
            (16, 9),
            "lights=4096 rsm=128 interleave=4 occlusion=sampled",
        ),
    ] {
        let shot = Shot::sample("columns").size(size.0, size.1).with(choice);
        agree(choice, &shot, Tier::Lavapipe, true);
    }
}

#[test]
fn surfaces_that_shine() {
    for choice in [
        "lights=64 rsm=32 interleave=4",
        "lights=64 rsm=32 interleave=2 occlusion=sampled",
        "lights=40 rsm=32 interleave=2 clustering=filtered",
        "lights=40 rsm=32 interleave=2 occlusion=ism map_size=16 map_points=512",
    ] {
        let mut shot = shining(choice);
        both(&format!("shining, {choice}"), &shot);
        shot.lights.clear();
        agree(
            &format!("shining alone, {choice}"),
            &shot,
            Tier::Lavapipe,
            true,
        );
    }
}

#[test]
fn everything_that_a_surface_can_be() {
    for aa in [1, 2] {
        let choice = "lights=64 rsm=64 interleave=4 occlusion=sampled";
        let mut shot = Shot::of(everything(true, 4.0)).size(48, 27).with(choice);
        shot.view.aa = aa;
        agree(&format!("everything, aa {aa}"), &shot, Tier::Lavapipe, true);
        agree(
            &format!("everything, aa {aa}"),
            &shot,
            Tier::SwiftShader,
            true,
        );
        agree(
            &format!("everything, aa {aa}"),
            &shot,
            Tier::Hardware,
            false,
        );
    }
}

/// Sizes below a tile, and pictures narrower than a square of shares.
#[test]
fn sizes_at_their_ends() {
    for (width, height) in [(1, 1), (1, 70), (33, 17)] {
        for choice in [
            "interleave=8",
            "interleave=4 occlusion=sampled",
            "occlusion=sampled",
        ] {
            let shot = Shot::sample("cornell")
                .size(width, height)
                .with("lights=64 rsm=16")
                .with(choice);
            agree(
                &format!("{width}x{height} {choice}"),
                &shot,
                Tier::Lavapipe,
                true,
            );
        }
    }
}
