//! Density and clusters: the CPU's maps go into both backends, and what comes out must agree in every bit.

use std::sync::Arc;
use vsgl_core::backend::{Backend, PdfInputs};
use vsgl_core::data::{Columns, GBuffer, Pdf, Rsm, SceneData, Vsgls};
use vsgl_core::plan::BouncePlan;
use vsgl_cpu::CpuBackend;
use vsgl_tests::assets::assets;
use vsgl_tests::gpu::{Tier, device};
use vsgl_tests::render::Shot;
use vsgl_tests::view::shot;
use vsgl_wgpu::WgpuBackend;

/// Every column and the head of a resource, bit by bit; says which entry differs first, and how many do.
fn same<T: Columns>(name: &str, tested: &T, reference: &T) {
    assert_eq!(
        tested.head(),
        reference.head(),
        "{name}: head of {}",
        T::NAME
    );
    let mut problems = Vec::new();
    for (a, b) in tested.columns().iter().zip(&reference.columns()) {
        assert_eq!(a.name, b.name);
        if a.bytes.len() != b.bytes.len() {
            problems.push(format!(
                "{}: {} bytes, not {}",
                a.name,
                a.bytes.len(),
                b.bytes.len()
            ));
            continue;
        }
        let words = |bytes: &[u8]| bytemuck::pod_collect_to_vec::<u8, u32>(bytes);
        let (x, y) = (words(a.bytes), words(b.bytes));
        // The two zeros are equal.
        let differ = |i: &usize| x[*i] != y[*i] && (x[*i] | y[*i]) << 1 != 0;
        let differing: Vec<usize> = (0..x.len()).filter(differ).collect();
        if let Some(&i) = differing.first() {
            let float = f32::from_bits;
            problems.push(format!(
                "{}: {} of {} words differ; first lane {} of entry {}: {} ({:e}), not {} ({:e})",
                a.name,
                differing.len(),
                x.len(),
                i % a.lanes,
                i / a.lanes,
                x[i],
                float(x[i]),
                y[i],
                float(y[i]),
            ));
        }
    }
    assert!(
        problems.is_empty(),
        "{name}, {}:\n  {}",
        T::NAME,
        problems.join("\n  ")
    );
}

/// What both backends make of the same maps.
struct Made {
    pdf: Option<[Arc<Pdf>; 2]>,
    vsgls: [Arc<Vsgls>; 2],
}

fn made(gpu: &WgpuBackend, shot: &Shot) -> Made {
    made_with(gpu, shot, |_| {})
}

/// As [`made`], with clusters from a density that is changed before.
fn made_with(gpu: &WgpuBackend, shot: &Shot, change: impl Fn(&mut Pdf)) -> Made {
    let plan = shot.plan();
    let bounce: &BouncePlan = plan.bounce.as_ref().expect("a lit scene");
    let cluster = bounce.cluster.as_ref().expect("clusters");
    let cpu = CpuBackend::new(1).expect("threads");
    let scene: Arc<SceneData> = cpu.upload(SceneData::new(&shot.scene)).expect("room");
    let rsm: Arc<Rsm> = cpu.rsm(&scene, &shot.lights, &bounce.rsm).expect("maps");
    let scene_gpu = gpu.upload(SceneData::clone(&scene)).expect("room");
    let rsm_gpu = gpu.upload(Rsm::clone(&rsm)).expect("room");
    let gbuffer = cpu.gbuffer(&scene, &shot.view, &plan.gbuffer);
    let gbuffer: Arc<GBuffer> = gbuffer.expect("receivers");
    let gbuffer_gpu = gpu.upload(GBuffer::clone(&gbuffer)).expect("room");
    let pdf = bounce.pdf.as_ref().map(|plan| {
        let inputs = PdfInputs {
            scene: &scene_gpu,
            rsm: &rsm_gpu,
            gbuffer: &gbuffer_gpu,
            view: &shot.view,
        };
        let made = gpu.pdf(&inputs, plan).expect("a density");
        let inputs = PdfInputs {
            scene: &scene,
            rsm: &rsm,
            gbuffer: &gbuffer,
            view: &shot.view,
        };
        [
            Arc::new(gpu.download(&made).expect("a density")),
            cpu.pdf(&inputs, plan).expect("a density"),
        ]
    });
    let pdf_cpu = pdf.as_ref().map(|[_, cpu]| {
        let mut changed = Pdf::clone(cpu);
        change(&mut changed);
        Arc::new(changed)
    });
    let pdf_gpu = pdf_cpu
        .as_ref()
        .map(|pdf| gpu.upload(Pdf::clone(pdf)).expect("room"));
    let tested = gpu
        .cluster(&scene_gpu, &rsm_gpu, pdf_gpu.as_ref(), cluster)
        .expect("clusters");
    let tested = gpu.download(&tested).expect("clusters");
    let reference = cpu
        .cluster(&scene, &rsm, pdf_cpu.as_ref(), cluster)
        .expect("clusters");
    Made {
        pdf,
        vsgls: [Arc::new(tested), reference],
    }
}

/// Density, labels, texels, kernels and lights agree in every bit; nothing if there is no such driver.
fn check(name: &str, shot: &Shot, settings: &[&str]) {
    let Some(gpu) = device(Tier::Lavapipe, true, &format!("phases of {name}")) else {
        return;
    };
    for settings in settings {
        let name = format!("{name} {settings}");
        let made = made(&gpu, &shot.clone().with(settings));
        if let Some([tested, reference]) = &made.pdf {
            same(&name, &**tested, &**reference);
        }
        let [tested, reference] = &made.vsgls;
        same(&name, &**tested, &**reference);
    }
}

#[test]
fn partition_by_any_number_from_any_size() {
    check(
        "cornell",
        &Shot::sample("cornell"),
        &[
            "rsm=1 lights=16",
            "rsm=3 lights=1",
            "rsm=3 lights=256",
            "rsm=64 lights=1",
            "rsm=64 lights=2",
            "rsm=64 lights=1024",
            "rsm=64 lights=65536",
            "rsm=512 lights=1024",
            "rsm=512 lights=65536",
        ],
    );
}

/// Clusterings that draw centres.
const DRAWN: [&str; 4] = [
    "clustering=filtered",
    "clustering=filtered-box",
    "clustering=filtered-original",
    "clustering=nearest-world",
];

#[test]
fn drawn_clusters_by_any_number_from_any_size() {
    for clustering in DRAWN {
        check(
            &format!("cornell, {clustering},"),
            &Shot::sample("cornell").with(clustering),
            &[
                "rsm=1 lights=16",
                "rsm=2 lights=5",
                "rsm=3 lights=1",
                "rsm=3 lights=256",
                "rsm=17 lights=20",
                "rsm=64 lights=1",
                "rsm=50 lights=300 kernel=3 bisections=20",
                "rsm=64 lights=30 kernel=100",
                "rsm=64 lights=16 kernel=0.01 bisections=64",
                "rsm=64 lights=65536",
                "rsm=512 lights=1024",
            ],
        );
    }
}

#[test]
fn nearest_centres_of_as_many_as_there_may_be() {
    let shot = Shot::sample("cornell").with("clustering=nearest-world");
    check("cornell", &shot, &["rsm=512 lights=65536"]);
}

#[test]
fn densities_of_any_size() {
    let shot = Shot::sample("cornell").with("clustering=filtered pdf=brsm");
    check(
        "cornell",
        &shot,
        &[
            "pdf=uniform rsm=1 lights=16",
            "pdf=uniform rsm=17 lights=300",
            "pdf=uniform rsm=64 lights=1024",
            "rsm=1 lights=16",
            "rsm=2 lights=16",
            "rsm=3 lights=1 camera_lights=1",
            "rsm=17 lights=300 camera_lights=100",
            "rsm=64 lights=65536 camera_lights=65536",
            "rsm=256 lights=1024",
        ],
    );
    check("cornell, one pixel", &shot.clone().size(1, 1), &["rsm=64"]);
    check("cornell, tall", &shot.clone().size(3, 500), &["rsm=64"]);
    let mut lambert = shot;
    for material in &mut lambert.scene.materials {
        (material.metallic, material.specular) = (0.0, 0.0);
    }
    check("Lambert alone", &lambert, &["rsm=64"]);
}

#[test]
fn whole_maps_of_any_size() {
    check(
        "cornell",
        &Shot::sample("cornell").with("clustering=whole"),
        &[
            "rsm=1", "rsm=2", "rsm=3", "rsm=17", "rsm=64", "rsm=128", "rsm=300", "rsm=512",
        ],
    );
}

/// A host's density may leave a lit map out: its texels are of no cluster.
#[test]
fn maps_without_density_have_no_nearest_centre() {
    let Some(gpu) = device(Tier::Lavapipe, true, "maps without density") else {
        return;
    };
    let shot = Shot::sample("many-lights:3").with("rsm=16 lights=40 clustering=nearest-world");
    for dark in [vec![1], vec![0, 1], vec![0, 1, 2]] {
        let made = made_with(&gpu, &shot, |pdf| {
            let mut first = 0;
            for level in 0..=4 {
                let texels = 256 >> (2 * level);
                for &map in &dark {
                    pdf.share[map] = 0;
                    pdf.weight[first + map * texels..][..texels].fill(0.0);
                }
                first += 3 * texels;
            }
        });
        let [tested, reference] = &made.vsgls;
        same(
            &format!("{dark:?} without density"),
            &**tested,
            &**reference,
        );
        let dark_label = |map: usize| {
            let labels = &reference.label[256 * map..][..256];
            labels.iter().all(|l| *l == u32::MAX)
        };
        for map in 0..3 {
            assert_eq!(
                dark_label(map),
                dark.contains(&map),
                "map {map} of {dark:?}"
            );
        }
    }
}

#[test]
fn built_in_scenes() {
    for name in ["glossy-floor", "columns", "caustic-ring", "roughness-row"] {
        let shot = Shot::sample(name).with("rsm=64 lights=256");
        check(name, &shot, &["clustering=partition"]);
        check(name, &shot, &DRAWN);
        let seen = ["clustering=filtered pdf=brsm camera_lights=300"];
        check(name, &shot, &seen);
        check(name, &shot, &["clustering=whole"]);
    }
}

#[test]
fn several_maps_and_dark_ones() {
    let settings = [
        "lights=2",
        "lights=256",
        "lights=2 clustering=filtered",
        "clustering=filtered",
        "clustering=filtered pdf=uniform",
        "clustering=filtered pdf=brsm camera_lights=200",
        "clustering=whole",
        "lights=2 clustering=filtered-box",
        "clustering=filtered-box",
        "clustering=filtered-original",
        "lights=2 clustering=nearest-world",
        "clustering=nearest-world",
    ];
    let mut shot = Shot::sample("many-lights:3").with("rsm=50");
    check("many-lights", &shot, &settings);
    for (dark, spot) in shot.spots().enumerate() {
        // The light in the middle, which has maps before and after it.
        if dark == 1 {
            spot.intensity = [0.0; 3];
        }
    }
    check("many-lights with a dark one", &shot, &settings);
    shot.spots().for_each(|spot| spot.intensity = [0.0; 3]);
    check("many-lights, all dark", &shot, &settings);
}

#[test]
fn published_forms_and_senders_that_are_not_glossy() {
    let all = [
        "clustering=partition",
        "clustering=filtered",
        "clustering=filtered-box",
        "clustering=nearest-world",
        "clustering=whole",
    ];
    let published = Shot::sample("cornell")
        .with("emission=sg sharpness=toksvig variance=trace glossy=asg-2013");
    check("published", &published, &all);
    check(
        "emission by SG",
        &Shot::sample("cornell").with("emission=sg"),
        &all,
    );
    let mut lambert = Shot::sample("cornell");
    for material in &mut lambert.scene.materials {
        (material.metallic, material.specular) = (0.0, 0.0);
    }
    assert!(!lambert.facts().glossy_senders);
    check("Lambert alone", &lambert, &all);
}

#[test]
fn scenes_by_others() {
    let Some(root) = assets("", "phases of scenes by others") else {
        return;
    };
    for name in ["room_spot", "cornell"] {
        let all = [
            "rsm=512 lights=256",
            "rsm=64 lights=1024",
            "rsm=64 lights=256 clustering=filtered",
            "rsm=64 lights=256 clustering=filtered-box",
            "rsm=64 lights=256 clustering=nearest-world",
        ];
        check(name, &shot(&root, name), &all);
    }
}
