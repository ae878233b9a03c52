//! What a device goes through: the same frame again and again, its loss, pipelines made beforehand.

use std::time::Instant;
use vsgl_core::backend::Backend;
use vsgl_core::data::SceneData;
use vsgl_core::render::{Phase, render};
use vsgl_core::{Error, Result};
use vsgl_tests::gpu::any;
use vsgl_tests::render::Shot;
use vsgl_wgpu::{Clock, Context, WgpuBackend, WgpuOptions, is_software};

fn frame(gpu: &WgpuBackend, shot: &Shot) -> Result<Vec<[f32; 3]>> {
    let scene = gpu.upload(SceneData::new(&shot.scene))?;
    let made = render(gpu, &scene, &shot.lights, &shot.view, &shot.plan(), &())?;
    Ok(gpu.download(&made.image)?.beauty())
}

#[test]
fn a_steady_frame_makes_no_buffer_and_the_same_picture() {
    let Some(gpu) = any(false, "steady frames") else {
        return;
    };
    for settings in [
        "lights=16",
        "lights=16 clustering=filtered",
        "clustering=whole",
        "method=vpl rsm=4",
        "lights=16 interleave=2 occlusion=sampled",
    ] {
        let shot = Shot::sample("cornell").with(settings);
        let first = frame(&gpu, &shot).expect("a frame");
        let made = gpu.context().buffers_made();
        for _ in 0..3 {
            assert_eq!(frame(&gpu, &shot).expect("a frame"), first, "{settings}");
        }
        assert_eq!(gpu.context().buffers_made(), made, "{settings}");
    }
}

#[test]
fn a_lost_device_is_an_error() {
    let Some(_others) = any(false, "a lost device") else {
        return;
    };
    let gpu = WgpuBackend::headless(&WgpuOptions::default()).expect("an adapter was found");
    let shot = Shot::sample("cornell").with("lights=16");
    frame(&gpu, &shot).expect("a frame");
    gpu.context().device().destroy();
    for _ in 0..2 {
        let error = frame(&gpu, &shot).expect_err("the device is gone");
        assert!(matches!(error, Error::Device { .. }), "{error}");
    }
}

#[test]
fn pipelines_can_be_made_beforehand() {
    let Some(_others) = any(false, "pipelines") else {
        return;
    };
    let gpu = WgpuBackend::headless(&WgpuOptions::default()).expect("an adapter was found");
    let shot = Shot::sample("columns").with("lights=16");
    gpu.context().prepare(&shot.plan()).expect("pipelines");
    let pipelines = gpu.context().pipelines_made();
    assert!(pipelines > 4);
    frame(&gpu, &shot).expect("a frame");
    assert_eq!(
        gpu.context().pipelines_made(),
        pipelines,
        "a frame made pipelines that the plan did not name"
    );
}

#[test]
fn phases_are_timed_and_the_clock_is_named() {
    let Some(_others) = any(false, "timing") else {
        return;
    };
    let options = WgpuOptions {
        timing: true,
        ..WgpuOptions::default()
    };
    let gpu = WgpuBackend::headless(&options).expect("an adapter was found");
    let start = Instant::now();
    frame(&gpu, &Shot::sample("cornell").with("lights=16")).expect("a frame");
    let timings = gpu
        .timings()
        .expect("the device lives")
        .expect("timing was asked for");
    let wall = start.elapsed();
    let phases: Vec<Phase> = timings.phases.iter().map(|(phase, _)| *phase).collect();
    assert_eq!(
        phases,
        [
            Phase::Rsm,
            Phase::GBuffer,
            Phase::Cluster,
            Phase::Shade,
            Phase::Resolve
        ]
    );
    let sum: std::time::Duration = timings.phases.iter().map(|(_, time)| *time).sum();
    assert!(
        sum <= wall && !sum.is_zero(),
        "{sum:?} of {wall:?}, {:?}",
        timings.clock
    );
    // Both software drivers have the device's clock, and so has every GPU of the last ten years.
    assert_eq!(timings.clock, Clock::Device, "{:?}", gpu.context().info());
    let again = gpu
        .timings()
        .expect("the device lives")
        .expect("timing was asked for");
    assert!(again.phases.is_empty(), "times are told once");
}

#[test]
fn an_adapter_that_is_not_there_is_named_with_those_that_are() {
    let Some(gpu) = any(false, "adapters") else {
        return;
    };
    let options = WgpuOptions {
        adapter: Some("no such adapter".into()),
        ..WgpuOptions::default()
    };
    let error = Context::headless(&options).expect_err("no adapter of that name");
    assert!(matches!(error, Error::NoAdapter { .. }), "{error}");
    assert!(
        error.to_string().contains(&gpu.context().info().name),
        "{error}"
    );
    if is_software(gpu.context().info()) {
        assert!(
            gpu.context().info().name.contains("llvmpipe")
                || gpu.context().info().name.contains("SwiftShader")
        );
    }
}
