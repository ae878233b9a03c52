//! Sizes and counts at their ends, on both backends.

use crate::agree;
use vsgl_core::Error;
use vsgl_core::backend::Backend;
use vsgl_core::data::SceneData;
use vsgl_core::glam::{Quat, Vec3};
use vsgl_core::render::View;
use vsgl_core::scene::{Mesh, Scene};
use vsgl_tests::gpu::Tier;
use vsgl_tests::render::Shot;
use vsgl_wgpu::{WgpuBackend, WgpuOptions};

fn both(name: &str, shot: &Shot) {
    agree(name, shot, Tier::Lavapipe, true);
}

#[test]
fn one_pixel() {
    both("1x1", &Shot::sample("cornell").size(1, 1));
}

#[test]
fn one_column() {
    both(
        "1x4096",
        &Shot::sample("cornell").size(1, 4096).with("lights=16"),
    );
}

const CLUSTERINGS: [&str; 6] = [
    "partition",
    "filtered",
    "filtered-box",
    "filtered-original",
    "nearest-world",
    "whole",
];

#[test]
fn one_light() {
    for clustering in CLUSTERINGS {
        let shot = Shot::sample("cornell").with(&format!("lights=1 clustering={clustering}"));
        both(&format!("one light, {clustering}"), &shot);
    }
}

#[test]
fn as_many_lights_as_there_may_be() {
    for clustering in ["partition", "filtered"] {
        let settings = format!("lights=65536 rsm=300 occlusion=none clustering={clustering}");
        let shot = Shot::sample("cornell").size(16, 9).with(&settings);
        both(&format!("65536 lights, {clustering}"), &shot);
    }
}

/// Lavapipe leaves a shader's loops after 65,535 rounds in all: lights times the steps of their rays must not come near.
#[test]
fn many_lights_with_rays() {
    let shot = Shot::sample("columns")
        .size(32, 18)
        .with("lights=4096 rsm=128");
    both("4096 lights with rays", &shot);
}

#[test]
fn maps_of_one_texel_and_of_odd_sizes() {
    for size in [1, 2, 3, 17] {
        for clustering in CLUSTERINGS {
            let settings = format!("rsm={size} lights=32 clustering={clustering}");
            let shot = Shot::sample("cornell").size(32, 18).with(&settings);
            both(&format!("a map of {size} texels, {clustering}"), &shot);
        }
    }
}

#[test]
fn an_empty_scene() {
    let full = Shot::sample("cornell");
    let mut empty = full.clone();
    empty.scene = Scene {
        mesh: Mesh::default(),
        ..full.scene
    };
    both("nothing to see", &empty);
    let mut dark = Shot::sample("cornell");
    dark.lights.clear();
    both("no light", &dark);
}

#[test]
fn far_away_and_of_any_size() {
    for (scale, offset) in [(1e-3f32, 0.0f32), (1e6, 0.0), (1.0, 3e4)] {
        for clustering in ["partition", "filtered-box", "nearest-world"] {
            let settings = format!("lights=32 clustering={clustering}");
            let shot = Shot::sample("columns").size(32, 18).with(&settings);
            let shot = shot.placed(Quat::IDENTITY, scale, Vec3::splat(offset));
            both(
                &format!("{clustering}, scaled by {scale}, moved by {offset}"),
                &shot,
            );
        }
    }
}

#[test]
fn too_large_pictures_are_refused_in_words() {
    let scene = Shot::sample("cornell");
    let camera = scene.view.camera;
    let refused = View::new(camera, 8192, 8192).expect_err("too many samples for any backend");
    assert!(matches!(refused, Error::Setting { .. }), "{refused}");

    // Within what the CPU takes, but not within one binding of the least limits.
    let options = WgpuOptions {
        least_limits: true,
        ..WgpuOptions::default()
    };
    let gpu = match WgpuBackend::headless(&options) {
        Ok(gpu) => gpu,
        Err(error) => {
            assert!(
                std::env::var_os("VSGL_GPU").is_some_and(|v| v == "off"),
                "{error}"
            );
            return;
        }
    };
    let data = gpu
        .upload(SceneData::new(&scene.scene))
        .expect("a small scene");
    let view = View::new(camera, 4096, 4096).expect("a size that fits");
    let error = gpu
        .gbuffer(&data, &view, &scene.plan().gbuffer)
        .expect_err("256 MiB in a binding");
    let words = error.to_string();
    assert!(matches!(error, Error::Device { .. }), "{words}");
    assert!(
        words.contains("gbuffer") && words.contains("--backend cpu"),
        "{words}"
    );
    // The device is as good as before.
    let view = View::new(camera, 8, 8).expect("a size that fits");
    let small = gpu
        .gbuffer(&data, &view, &scene.plan().gbuffer)
        .expect("a small picture");
    assert_eq!(gpu.download(&small).expect("a download").triangle.len(), 64);
}
