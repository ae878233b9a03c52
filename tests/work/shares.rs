//! What shares of the lights cost and save, counted: work, not seconds of a machine that others use too.

use std::sync::{Arc, Mutex};
use std::time::Duration;
use vsgl_core::backend::{Backend, Senders, ShadeInputs};
use vsgl_core::data::{GBuffer, NO_TRIANGLE, Radiance, Vsgls};
use vsgl_core::phase::shade::Receiver;
use vsgl_core::plan::Plan;
use vsgl_core::render::{Observer, Phase, render};
use vsgl_cpu::CpuBackend;
use vsgl_cpu::block::{LANES, Receivers, vsgl};
use vsgl_tests::render::Shot;
use vsgl_tests::usage::computed;

/// One test at a time.
static ALONE: Mutex<()> = Mutex::new(());

/// What shading of a shot takes, and leaves.
struct Shaded {
    plan: Plan,
    gbuffer: Arc<GBuffer>,
    vsgls: Arc<Vsgls>,
    radiance: Arc<Radiance>,
    /// Time of all threads for shading and reconstruction, the least of several runs \[s\].
    seconds: Option<f64>,
}

fn shade(shot: &Shot, runs: usize) -> Shaded {
    let plan = shot.plan();
    let cpu = CpuBackend::new(1).expect("threads");
    let scene = cpu
        .upload(vsgl_core::data::SceneData::new(&shot.scene))
        .expect("room");
    let bounce = plan.bounce.as_ref().expect("a bounce");
    let rsm = cpu.rsm(&scene, &shot.lights, &bounce.rsm).expect("maps");
    let cluster = bounce.cluster.as_ref().expect("clusters");
    let vsgls = cpu.cluster(&scene, &rsm, None, cluster).expect("clusters");
    let gbuffer = cpu
        .gbuffer(&scene, &shot.view, &plan.gbuffer)
        .expect("receivers");
    let inputs = ShadeInputs {
        scene: &scene,
        gbuffer: &gbuffer,
        view: &shot.view,
        lights: &shot.lights,
        senders: Senders::Vsgls(&vsgls),
        occlusion: None,
    };
    let mut seconds = None;
    let mut radiance = None;
    for _ in 0..runs {
        let start = computed();
        let made = cpu.shade(&inputs, &plan.shade, &()).expect("light");
        if let Some(plan) = &plan.reconstruct {
            cpu.reconstruct(&gbuffer, &made, plan).expect("light");
        }
        if let (Some(start), Some(end)) = (start, computed()) {
            let taken = end - start;
            seconds = Some(seconds.map_or(taken, |s: f64| s.min(taken)));
        }
        radiance = Some(made);
    }
    Shaded {
        radiance: radiance.expect("a run"),
        plan,
        gbuffer,
        vsgls,
        seconds,
    }
}

/// Pairs of a sample and a light that brings anything to it: exact rays ask once for each.
fn pairs_with_light(shaded: &Shaded, shot: &Shot) -> u64 {
    let gbuffer = &shaded.gbuffer;
    let hits: Vec<usize> = (0..gbuffer.triangle.len())
        .filter(|&i| gbuffer.triangle[i] != NO_TRIANGLE)
        .collect();
    let mut pairs = 0;
    for samples in hits.chunks(LANES) {
        let receivers: [Receiver; LANES] = std::array::from_fn(|lane| {
            let sample = samples.get(lane).unwrap_or(&samples[0]);
            Receiver::of(gbuffer, *sample, shot.view.camera.eye)
        });
        let receivers = Receivers::new(&receivers);
        for (j, diffuse) in shaded.vsgls.diffuse.iter().enumerate() {
            let specular = shaded.vsgls.specular.get(j);
            let sums = vsgl(diffuse, specular, &receivers, &shaded.plan.shade);
            pairs += (0..samples.len()).filter(|&lane| sums.lit(lane)).count() as u64;
        }
    }
    pairs
}

#[test]
fn eight_rays_are_less_than_a_tenth_of_all() {
    let _alone = ALONE.lock();
    for name in ["cornell", "columns", "glossy-floor"] {
        let shot = Shot::sample(name)
            .size(64, 36)
            .with("lights=1024 rsm=128 occlusion=sampled");
        let shaded = shade(&shot, 1);
        let drawn: f64 = shaded
            .radiance
            .sums
            .iter()
            .map(|s| f64::from(s.asked))
            .sum();
        let exact = pairs_with_light(&shaded, &shot) as f64;
        println!(
            "{name}: {drawn} rays drawn, {exact} pairs with light: {:.2} %",
            100.0 * drawn / exact
        );
        assert!(drawn > 0.0 && drawn < 0.1 * exact, "{name}");
    }
}

#[test]
fn shares_of_four_by_four_save_nine_tenths_of_the_shading() {
    let _alone = ALONE.lock();
    if cfg!(debug_assertions) {
        println!("skipped 1 test: speed is judged with optimisation");
        return;
    }
    for occlusion in ["none", "rays"] {
        let shot = |side: u32| {
            let words = format!("lights=1024 rsm=128 occlusion={occlusion} interleave={side}");
            Shot::sample("cornell").size(160, 90).with(&words)
        };
        let (all, shares) = (shade(&shot(1), 2).seconds, shade(&shot(4), 5).seconds);
        let (Some(all), Some(shares)) = (all, shares) else {
            println!("skipped 1 test: the system does not tell what was computed");
            return;
        };
        println!(
            "occlusion {occlusion}: {all:.2} s and {shares:.2} s, {:.1} times",
            all / shares
        );
        assert!(
            all > 10.0 * shares,
            "{occlusion}: only {:.1} times",
            all / shares
        );
    }
}

/// What each phase computes.
#[derive(Default)]
struct Watch {
    begun: Mutex<f64>,
    phases: Mutex<Vec<(Phase, f64)>>,
}

impl Observer for Watch {
    fn started(&self, _: Phase) {
        *self.begun.lock().expect("no panic") = computed().unwrap_or_default();
    }

    fn finished(&self, phase: Phase, _: Duration) {
        let begun = *self.begun.lock().expect("no panic");
        let taken = computed().unwrap_or_default() - begun;
        self.phases.lock().expect("no panic").push((phase, taken));
    }
}

/// Two cores have four seconds of computing in two. All phases but the reading of the scene share their work out evenly.
#[test]
fn a_frame_of_a_thousand_lights_takes_two_seconds_of_two_cores() {
    let _alone = ALONE.lock();
    if cfg!(debug_assertions) || computed().is_none() {
        println!("skipped 1 test: no optimisation, or the system does not tell what was computed");
        return;
    }
    for name in ["cornell", "columns"] {
        let words = "lights=1024 rsm=512 occlusion=sampled interleave=4";
        let shot = Shot::sample(name).size(640, 360).with(words);
        let cpu = CpuBackend::new(2).expect("threads");
        let scene = cpu
            .upload(vsgl_core::data::SceneData::new(&shot.scene))
            .expect("room");
        let watch = Watch::default();
        render(&cpu, &scene, &shot.lights, &shot.view, &shot.plan(), &watch).expect("a picture");
        let phases = watch.phases.into_inner().expect("no panic");
        let all: f64 = phases.iter().map(|(_, seconds)| seconds).sum();
        for (phase, seconds) in &phases {
            println!("{name} {phase}: {seconds:.2} s");
        }
        println!("{name} together: {all:.2} s of one core");
        assert!(all < 4.0, "{name}: {all:.2} s of one core");
    }
}
