//! Each phase alone, and whole frames, on the built-in scenes. See `benches/README.md`.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;
use vsgl_core::backend::{Backend, PdfInputs, Senders, ShadeInputs};
use vsgl_core::data::{GBuffer, Pdf, Rsm, SceneData};
use vsgl_core::glam::Vec3;
use vsgl_core::plan::{BouncePlan, PdfPlan, Plan, RsmPlan};
use vsgl_core::render::{View, render};
use vsgl_core::scene::{Light, PointLight, Scene, SceneFacts, samples};
use vsgl_core::settings::{
    Clustering, DiffuseForm, GlossyForm, LightSampling, Method, OcclusionMethod, PdfMethod, Preset,
    Settings,
};
use vsgl_cpu::CpuBackend;

/// A scene with everything that its phases read, uploaded.
struct Set {
    backend: CpuBackend,
    scene: Scene,
    data: Arc<SceneData>,
    view: View,
}

impl Set {
    fn new(sample: &str, width: u32, height: u32) -> Self {
        let backend = CpuBackend::new(0).expect("threads");
        let scene = samples::by_name(sample).expect("a sample");
        let data = backend.upload(SceneData::new(&scene)).expect("host memory");
        let view = View::new(scene.cameras[0].1, width, height).expect("a size that fits");
        Self {
            backend,
            scene,
            data,
            view,
        }
    }

    fn plan(&self, settings: &Settings) -> Plan {
        let facts = SceneFacts::new(&self.scene, &self.scene.lights, &self.view.camera);
        Plan::new(&facts, settings).expect("settings that fit together")
    }

    fn gbuffer(&self) -> Arc<GBuffer> {
        let plan = self.plan(&Settings::default());
        let made = self.backend.gbuffer(&self.data, &self.view, &plan.gbuffer);
        made.expect("cpu")
    }

    fn density(&self, rsm: &Arc<Rsm>, gbuffer: &Arc<GBuffer>, plan: &PdfPlan) -> Arc<Pdf> {
        let inputs = PdfInputs {
            scene: &self.data,
            rsm,
            gbuffer,
            view: &self.view,
        };
        self.backend.pdf(&inputs, plan).expect("cpu")
    }
}

/// The maps of the lights, and the density where the plan draws from one.
fn light_side(set: &Set, bounce: &BouncePlan) -> (Arc<Rsm>, Option<Arc<Pdf>>) {
    let rsm = set
        .backend
        .rsm(&set.data, &set.scene.lights, &bounce.rsm)
        .expect("cpu");
    let pdf = bounce.pdf.as_ref();
    let pdf = pdf.map(|p| set.density(&rsm, &set.gbuffer(), p));
    (rsm, pdf)
}

fn densities(c: &mut Criterion) {
    let set = Set::new("cornell", 640, 360);
    let gbuffer = set.gbuffer();
    let mut group = c.benchmark_group("pdf");
    group.sample_size(10);
    for &pdf in PdfMethod::ALL {
        let plan = set.plan(&Settings {
            clustering: Clustering::Filtered,
            pdf,
            ..Settings::default()
        });
        let bounce = plan.bounce.as_ref().expect("a lit scene");
        let (rsm, _) = light_side(&set, bounce);
        let plan = bounce.pdf.as_ref().expect("kernels are drawn");
        group.bench_function(BenchmarkId::new(pdf.word(), "512² texels"), |b| {
            b.iter(|| set.density(black_box(&rsm), &gbuffer, plan));
        });
    }
    group.finish();
}

fn clusters(c: &mut Criterion) {
    let set = Set::new("cornell", 64, 36);
    let mut group = c.benchmark_group("cluster");
    group.sample_size(10);
    for clustering in [
        Clustering::Partition,
        Clustering::Filtered,
        Clustering::Whole,
        Clustering::FilteredBox,
        Clustering::FilteredOriginal,
        Clustering::NearestWorld,
    ] {
        let plan = set.plan(&Settings {
            clustering,
            ..Settings::default()
        });
        let bounce = plan.bounce.as_ref().expect("a lit scene");
        let (rsm, pdf) = light_side(&set, bounce);
        let cluster = bounce.cluster.as_ref().expect("method vsgl");
        group.bench_function(
            BenchmarkId::new(clustering.word(), "512² texels, 1024 lights"),
            |b| {
                b.iter(|| {
                    set.backend
                        .cluster(&set.data, black_box(&rsm), pdf.as_ref(), cluster)
                        .expect("cpu")
                });
            },
        );
    }
    group.finish();
}

fn maps(c: &mut Criterion) {
    let set = Set::new("cornell", 320, 180);
    let plan = set.plan(&Settings::default());
    let bounce = plan.bounce.as_ref().expect("a lit scene");
    let mut group = c.benchmark_group("visibility");
    group.sample_size(10);
    group.throughput(Throughput::Elements(512 * 512));
    group.bench_function("rsm 512²", |b| {
        b.iter(|| {
            set.backend
                .rsm(&set.data, black_box(&set.scene.lights), &bounce.rsm)
                .expect("cpu")
        });
    });
    // As many texels in six maps, each with its own frame.
    group.throughput(Throughput::Elements(6 * 256 * 256));
    let point = Light::Point(PointLight {
        position: Vec3::new(0.2, 0.5, 0.0),
        intensity: [5.0; 3],
        range: f32::INFINITY,
    });
    let faces = RsmPlan {
        size: 256,
        ..bounce.rsm.clone()
    };
    group.bench_function("rsm 6 x 256², a point", |b| {
        b.iter(|| {
            set.backend
                .rsm(&set.data, black_box(&[point]), &faces)
                .expect("cpu")
        });
    });
    group.throughput(Throughput::Elements(320 * 180));
    group.bench_function("gbuffer 320x180", |b| {
        b.iter(|| {
            set.backend
                .gbuffer(&set.data, black_box(&set.view), &plan.gbuffer)
                .expect("cpu")
        });
    });
    group.finish();
}

/// Throughput is draws of points or triangles. `columns` has small triangles, `cornell` none.
fn shadow_maps(c: &mut Criterion) {
    let mut group = c.benchmark_group("shadow maps");
    group.sample_size(10);
    group.throughput(Throughput::Elements(64 * 8192));
    for scene in ["cornell", "columns"] {
        let set = Set::new(scene, 16, 9);
        for occlusion in [OcclusionMethod::Ism, OcclusionMethod::IsmTessellated] {
            let plan = set.plan(&Settings {
                lights: 64,
                occlusion,
                ..Settings::default()
            });
            let bounce = plan.bounce.as_ref().expect("a lit scene");
            let (rsm, pdf) = light_side(&set, bounce);
            let cluster = bounce.cluster.as_ref().expect("method vsgl");
            let made = set.backend.cluster(&set.data, &rsm, pdf.as_ref(), cluster);
            let vsgls = made.expect("cpu");
            let maps = bounce.occlusion.as_ref().expect("shadow maps");
            group.bench_function(BenchmarkId::new(occlusion.word(), scene), |b| {
                b.iter(|| {
                    set.backend
                        .occlusion(&set.data, black_box(&vsgls), maps)
                        .expect("cpu")
                });
            });
        }
    }
    group.finish();
}

/// Throughput is pairs of a sample and a virtual light.
fn shading(c: &mut Criterion) {
    let set = Set::new("cornell", 160, 90);
    let mut group = c.benchmark_group("shade 160x90, 256 lights");
    group.sample_size(10);
    group.throughput(Throughput::Elements(160 * 90 * 256));
    let unoccluded = Settings {
        lights: 256,
        occlusion: OcclusionMethod::None,
        ..Settings::default()
    };
    let cases = [
        ("unoccluded", unoccluded.clone()),
        (
            "rays",
            Settings {
                occlusion: OcclusionMethod::Rays,
                ..unoccluded.clone()
            },
        ),
        (
            "unoccluded, shares of 4x4",
            Settings {
                interleave: 4,
                ..unoccluded.clone()
            },
        ),
        (
            "8 rays drawn, shares of 4x4",
            Settings {
                interleave: 4,
                occlusion: OcclusionMethod::Sampled,
                ..unoccluded.clone()
            },
        ),
        (
            "paper-2016",
            Settings {
                lights: 256,
                occlusion: OcclusionMethod::None,
                ..Preset::Paper2016.settings()
            },
        ),
    ];
    for (name, settings) in cases {
        shade(&mut group, &set, name, &set.plan(&settings));
    }
    for &diffuse in DiffuseForm::ALL {
        let settings = Settings {
            diffuse,
            ..unoccluded.clone()
        };
        shade(
            &mut group,
            &set,
            &format!("diffuse {diffuse}"),
            &set.plan(&settings),
        );
    }
    for &glossy in GlossyForm::ALL {
        let settings = Settings {
            glossy,
            ..unoccluded.clone()
        };
        shade(
            &mut group,
            &set,
            &format!("glossy {glossy}"),
            &set.plan(&settings),
        );
    }
    // What the plan saves where no surface is glossy, beside what it would cost.
    let mut lambert = Set::new("cornell", 160, 90);
    for material in &mut lambert.scene.materials {
        (material.metallic, material.specular) = (0.0, 0.0);
    }
    lambert.data = lambert
        .backend
        .upload(SceneData::new(&lambert.scene))
        .expect("host memory");
    shade(
        &mut group,
        &lambert,
        "all Lambert, pruned",
        &lambert.plan(&unoccluded),
    );
    shade(
        &mut group,
        &lambert,
        "all Lambert, not pruned",
        &set.plan(&unoccluded),
    );
    group.finish();
}

/// A frame of two lights at 640x360, part by part: what the published configuration takes, and the same by v13 and NDF
/// filtering. Primary rays and the rays of direct light stand apart.
fn two_lights(c: &mut Criterion) {
    let set = Set::new("cornell", 640, 360);
    let mut group = c.benchmark_group("two lights 640x360");
    group.sample_size(10);
    let published = Preset::Paper2015.settings();
    let ours = Settings {
        clustering: published.clustering,
        rsm: published.rsm,
        occlusion: published.occlusion,
        ..Settings::default()
    };
    for (name, settings) in [("paper-2015", published), ("v13", ours)] {
        let plan = set.plan(&settings);
        let bounce = plan.bounce.as_ref().expect("a lit scene");
        let cluster = bounce.cluster.as_ref().expect("method vsgl");
        let (lights, view) = (&set.scene.lights, &set.view);
        let maps = || set.backend.rsm(&set.data, black_box(lights), &bounce.rsm);
        let rsm = maps().expect("cpu");
        let whole = || {
            set.backend
                .cluster(&set.data, black_box(&rsm), None, cluster)
        };
        let vsgls = whole().expect("cpu");
        let gbuffer = set.backend.gbuffer(&set.data, view, &plan.gbuffer);
        let gbuffer = gbuffer.expect("cpu");
        let shade = |lights: &[Light], senders| {
            let inputs = ShadeInputs {
                scene: &set.data,
                gbuffer: &gbuffer,
                view,
                lights,
                senders,
                occlusion: None,
            };
            let made = set.backend.shade(black_box(&inputs), &plan.shade, &());
            made.expect("cpu")
        };
        let radiance = shade(lights, Senders::Vsgls(&vsgls));
        let mut part = |part: &str, run: &mut dyn FnMut()| {
            group.bench_function(BenchmarkId::new(name, part), |b| b.iter(&mut *run));
        };
        part("rsm 128²", &mut || drop(black_box(maps().expect("cpu"))));
        part("reduction", &mut || drop(black_box(whole().expect("cpu"))));
        part("shading", &mut || {
            drop(black_box(shade(&[], Senders::Vsgls(&vsgls))));
        });
        part("direct light", &mut || {
            drop(black_box(shade(lights, Senders::None)))
        });
        part("resolve", &mut || {
            let made = set.backend.resolve(&gbuffer, black_box(&radiance), view);
            drop(black_box(made.expect("cpu")));
        });
    }
    group.finish();
}

type Group<'a> = criterion::BenchmarkGroup<'a, criterion::measurement::WallTime>;

fn shade(group: &mut Group<'_>, set: &Set, name: &str, plan: &Plan) {
    let bounce = plan.bounce.as_ref().expect("a lit scene");
    let (rsm, pdf) = light_side(set, bounce);
    let cluster = bounce.cluster.as_ref().expect("method vsgl");
    let vsgls = set
        .backend
        .cluster(&set.data, &rsm, pdf.as_ref(), cluster)
        .expect("cpu");
    let gbuffer = set
        .backend
        .gbuffer(&set.data, &set.view, &plan.gbuffer)
        .expect("cpu");
    group.bench_function(name, |b| {
        b.iter(|| {
            let inputs = ShadeInputs {
                scene: &set.data,
                gbuffer: &gbuffer,
                view: &set.view,
                lights: &set.scene.lights,
                senders: Senders::Vsgls(&vsgls),
                occlusion: None,
            };
            set.backend
                .shade(black_box(&inputs), &plan.shade, &())
                .expect("cpu")
        });
    });
}

fn frames(c: &mut Criterion) {
    let mut group = c.benchmark_group("frame 160x90");
    group.sample_size(10);
    for sample in ["cornell", "glossy-floor", "columns"] {
        let set = Set::new(sample, 160, 90);
        let plan = set.plan(&Settings::default());
        group.bench_function(sample, |b| {
            b.iter(|| {
                render(
                    &set.backend,
                    &set.data,
                    &set.scene.lights,
                    &set.view,
                    &plan,
                    &(),
                )
                .expect("cpu")
            });
        });
    }
    group.finish();
}

/// Throughput is paths.
fn paths(c: &mut Criterion) {
    let set = Set::new("cornell", 160, 90);
    let mut group = c.benchmark_group("paths 160x90, 8 a pixel");
    group.sample_size(10);
    group.throughput(Throughput::Elements(160 * 90 * 8));
    for (name, max_depth) in [("direct", 2), ("one bounce", 3), ("ten bounces", 12)] {
        let plan = set.plan(&Settings {
            method: Method::Path,
            spp: 8,
            max_depth,
            ..Settings::default()
        });
        let path = plan.path.as_ref().expect("paths");
        group.bench_function(name, |b| {
            b.iter(|| {
                let lights = &set.scene.lights;
                set.backend
                    .trace(&set.data, black_box(lights), &set.view, path, 0..8, &())
                    .expect("cpu")
            });
        });
    }
    // Lights of very different power.
    let mut set = Set::new("many-lights:16", 160, 90);
    for (index, light) in set.scene.lights.iter_mut().enumerate() {
        if let Light::Spot(spot) = light {
            spot.intensity = spot.intensity.map(|i| i / (1 << index) as f32);
        }
    }
    for &light_sampling in LightSampling::ALL {
        let plan = set.plan(&Settings {
            method: Method::Path,
            spp: 8,
            max_depth: 3,
            light_sampling,
            ..Settings::default()
        });
        let path = plan.path.as_ref().expect("paths");
        group.bench_function(format!("16 lights, {light_sampling}"), |b| {
            b.iter(|| {
                let lights = &set.scene.lights;
                set.backend
                    .trace(&set.data, black_box(lights), &set.view, path, 0..8, &())
                    .expect("cpu")
            });
        });
    }
    group.finish();
}

criterion_group!(
    benches,
    densities,
    clusters,
    maps,
    shadow_maps,
    shading,
    two_lights,
    frames,
    paths
);
criterion_main!(benches);
