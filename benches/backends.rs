//! Both backends on the same work, phase by phase and whole frames. See `benches/README.md`.

use criterion::measurement::WallTime;
use criterion::{
    BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main,
};
use std::hint::black_box;
use vsgl_core::backend::{Backend, PdfInputs, Senders, ShadeInputs};
use vsgl_core::data::SceneData;
use vsgl_core::plan::Plan;
use vsgl_core::render::{View, render};
use vsgl_core::scene::{Scene, SceneFacts, samples};
use vsgl_core::settings::{Clustering, OcclusionMethod, PdfMethod, Settings};
use vsgl_cpu::CpuBackend;
use vsgl_wgpu::{WgpuBackend, WgpuOptions};

/// Runs a group's work on the CPU, then on the best adapter, if there is one.
macro_rules! both {
    ($run:ident, $c:expr) => {{
        $run($c, &CpuBackend::new(0).expect("threads"), "cpu");
        match WgpuBackend::headless(&WgpuOptions::default()) {
            Ok(gpu) => {
                // The report reads the adapter's name from here.
                eprintln!("wgpu: {}", gpu.context().info().name);
                $run($c, &gpu, "wgpu");
            }
            Err(error) => eprintln!("only the CPU: {error}"),
        }
    }};
}

struct Set<B: Backend> {
    scene: Scene,
    data: B::Res<SceneData>,
    view: View,
    plan: Plan,
}

impl<B: Backend> Set<B> {
    fn new(backend: &B, (width, height): (u32, u32), settings: &Settings) -> Self {
        let scene = samples::by_name("cornell").expect("a sample");
        let data = backend.upload(SceneData::new(&scene)).expect("room");
        let view = View::new(scene.cameras[0].1, width, height).expect("a size that fits");
        let facts = SceneFacts::new(&scene, &scene.lights, &view.camera);
        let plan = Plan::new(&facts, settings).expect("settings that fit together");
        Self {
            scene,
            data,
            view,
            plan,
        }
    }
}

/// Small pictures for a software driver; the trend is what counts.
const SIZES: [(u32, u32); 3] = [(80, 45), (160, 90), (320, 180)];

fn id(backend: &str, (width, height): (u32, u32)) -> BenchmarkId {
    BenchmarkId::new(backend, format!("{width}x{height}"))
}

fn group<'a>(c: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = c.benchmark_group(name);
    group.sample_size(10);
    group
}

fn visibility_on<B: Backend>(c: &mut Criterion, backend: &B, name: &str) {
    let mut gbuffer = group(c, "gbuffer");
    for size in SIZES {
        let set = Set::new(backend, size, &Settings::default());
        gbuffer.throughput(Throughput::Elements(u64::from(size.0 * size.1)));
        gbuffer.bench_function(id(name, size), |b| {
            b.iter(|| {
                let made = backend.gbuffer(&set.data, black_box(&set.view), &set.plan.gbuffer);
                backend.finish().expect("a device");
                made.expect("a phase")
            });
        });
    }
    gbuffer.finish();
    let mut maps = group(c, "rsm");
    for texels in [128, 512] {
        let settings = Settings {
            rsm: texels,
            ..Settings::default()
        };
        let set = Set::new(backend, SIZES[0], &settings);
        let plan = &set.plan.bounce.as_ref().expect("a lit scene").rsm;
        maps.throughput(Throughput::Elements(u64::from(texels * texels)));
        maps.bench_function(id(name, (texels, texels)), |b| {
            b.iter(|| {
                let made = backend.rsm(&set.data, black_box(&set.scene.lights), plan);
                backend.finish().expect("a device");
                made.expect("a phase")
            });
        });
    }
    maps.finish();
}

fn cluster_on<B: Backend>(c: &mut Criterion, backend: &B, name: &str) {
    for clustering in [
        Clustering::Partition,
        Clustering::Filtered,
        Clustering::Whole,
        Clustering::FilteredBox,
        Clustering::NearestWorld,
    ] {
        let mut group = group(c, &format!("cluster 512x512 texels, {clustering}"));
        for lights in [64, 1024] {
            if clustering == Clustering::Whole && lights > 64 {
                continue;
            }
            let settings = Settings {
                clustering,
                lights,
                ..Settings::default()
            };
            let set = Set::new(backend, SIZES[0], &settings);
            let bounce = set.plan.bounce.as_ref().expect("a lit scene");
            let plan = bounce.cluster.as_ref().expect("method vsgl");
            let rsm = backend
                .rsm(&set.data, &set.scene.lights, &bounce.rsm)
                .expect("a phase");
            let gbuffer = backend
                .gbuffer(&set.data, &set.view, &set.plan.gbuffer)
                .expect("a phase");
            let inputs = PdfInputs {
                scene: &set.data,
                rsm: &rsm,
                gbuffer: &gbuffer,
                view: &set.view,
            };
            group.bench_function(BenchmarkId::new(name, format!("{lights} lights")), |b| {
                b.iter(|| {
                    let pdf = bounce
                        .pdf
                        .as_ref()
                        .map(|p| backend.pdf(&inputs, p).expect("a phase"));
                    let made = backend.cluster(&set.data, black_box(&rsm), pdf.as_ref(), plan);
                    backend.finish().expect("a device");
                    made.expect("a phase")
                });
            });
        }
        group.finish();
    }
}

fn pdf_on<B: Backend>(c: &mut Criterion, backend: &B, name: &str) {
    let mut group = group(c, "pdf 512x512 texels");
    for &pdf in PdfMethod::ALL {
        let settings = Settings {
            clustering: Clustering::Filtered,
            pdf,
            ..Settings::default()
        };
        let set = Set::new(backend, SIZES[2], &settings);
        let bounce = set.plan.bounce.as_ref().expect("a lit scene");
        let plan = bounce.pdf.as_ref().expect("kernels are drawn");
        let rsm = backend
            .rsm(&set.data, &set.scene.lights, &bounce.rsm)
            .expect("a phase");
        let gbuffer = backend
            .gbuffer(&set.data, &set.view, &set.plan.gbuffer)
            .expect("a phase");
        group.bench_function(BenchmarkId::new(name, pdf), |b| {
            b.iter(|| {
                let inputs = PdfInputs {
                    scene: &set.data,
                    rsm: black_box(&rsm),
                    gbuffer: &gbuffer,
                    view: &set.view,
                };
                let made = backend.pdf(&inputs, plan);
                backend.finish().expect("a device");
                made.expect("a phase")
            });
        });
    }
    group.finish();
}

/// Throughput is pairs of a sample and a virtual light.
fn shade_on<B: Backend>(c: &mut Criterion, backend: &B, name: &str) {
    let cases = [
        (SIZES[0], 64, OcclusionMethod::None),
        (SIZES[1], 64, OcclusionMethod::None),
        (SIZES[1], 16, OcclusionMethod::None),
        (SIZES[1], 256, OcclusionMethod::None),
        (SIZES[1], 64, OcclusionMethod::Rays),
    ];
    for (size, lights, occlusion) in cases {
        let settings = Settings {
            lights,
            occlusion,
            rsm: 128,
            ..Settings::default()
        };
        let set = Set::new(backend, size, &settings);
        let bounce = set.plan.bounce.as_ref().expect("a lit scene");
        let cluster = bounce.cluster.as_ref().expect("method vsgl");
        let rsm = backend
            .rsm(&set.data, &set.scene.lights, &bounce.rsm)
            .expect("a phase");
        let vsgls = backend
            .cluster(&set.data, &rsm, None, cluster)
            .expect("a phase");
        let gbuffer = backend
            .gbuffer(&set.data, &set.view, &set.plan.gbuffer)
            .expect("a phase");
        let mut group = group(c, &format!("shade {lights} lights, occlusion {occlusion}"));
        group.throughput(Throughput::Elements(u64::from(size.0 * size.1 * lights)));
        group.bench_function(id(name, size), |b| {
            b.iter(|| {
                let inputs = ShadeInputs {
                    scene: &set.data,
                    gbuffer: &gbuffer,
                    view: &set.view,
                    lights: &set.scene.lights,
                    senders: Senders::Vsgls(&vsgls),
                    occlusion: None,
                };
                let made = backend.shade(black_box(&inputs), &set.plan.shade, &());
                backend.finish().expect("a device");
                made.expect("a phase")
            });
        });
        group.finish();
    }
}

fn frame_on<B: Backend>(c: &mut Criterion, backend: &B, name: &str) {
    let mut group = group(c, "frame 64 lights");
    for size in SIZES {
        let settings = Settings {
            lights: 64,
            rsm: 128,
            ..Settings::default()
        };
        let set = Set::new(backend, size, &settings);
        group.bench_function(id(name, size), |b| {
            b.iter(|| {
                let (lights, view) = (&set.scene.lights, black_box(&set.view));
                let made = render(backend, &set.data, lights, view, &set.plan, &());
                backend.finish().expect("a device");
                made.expect("a picture")
            });
        });
    }
    group.finish();
}

fn visibility(c: &mut Criterion) {
    both!(visibility_on, c);
}
fn pdf(c: &mut Criterion) {
    both!(pdf_on, c);
}
fn cluster(c: &mut Criterion) {
    both!(cluster_on, c);
}
fn shade(c: &mut Criterion) {
    both!(shade_on, c);
}
fn frame(c: &mut Criterion) {
    both!(frame_on, c);
}

criterion_group!(benches, visibility, pdf, cluster, shade, frame);
criterion_main!(benches);
