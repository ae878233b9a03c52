//! Density and clusters: the CPU's maps go into both backends, and what comes out must agree in every bit.

use std::sync::{Arc, OnceLock};
use vsgl_core::backend::Backend;
use vsgl_core::data::{Columns, Pdf, Rsm, SceneData, Vsgls};
use vsgl_core::plan::BouncePlan;
use vsgl_cpu::CpuBackend;
use vsgl_tests::render::Shot;
use vsgl_wgpu::{WgpuBackend, WgpuOptions};

/// One device for all tests: a driver's compiler is slow, and pipelines are kept.
fn gpu() -> &'static WgpuBackend {
    static GPU: OnceLock<WgpuBackend> = OnceLock::new();
    GPU.get_or_init(|| {
        let options = WgpuOptions {
            strict: true,
            ..WgpuOptions::default()
        };
        let gpu = WgpuBackend::headless(&options).expect("an adapter with Vulkan");
        println!("on {:?}", gpu.context().info());
        gpu
    })
}

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

fn made(shot: &Shot) -> Made {
    let plan = shot.plan();
    let bounce: &BouncePlan = plan.bounce.as_ref().expect("a lit scene");
    let cluster = bounce.cluster.as_ref().expect("clusters");
    let (cpu, gpu) = (CpuBackend::new(1).expect("threads"), gpu());
    let scene: Arc<SceneData> = cpu.upload(SceneData::new(&shot.scene)).expect("room");
    let rsm: Arc<Rsm> = cpu.rsm(&scene, &shot.lights, &bounce.rsm).expect("maps");
    let scene_gpu = gpu.upload(SceneData::clone(&scene)).expect("room");
    let rsm_gpu = gpu.upload(Rsm::clone(&rsm)).expect("room");
    let pdf = bounce.pdf.as_ref().map(|plan| {
        let made = gpu.pdf(&rsm_gpu, plan).expect("a density");
        [
            Arc::new(gpu.download(&made).expect("a density")),
            cpu.pdf(&rsm, plan).expect("a density"),
        ]
    });
    let pdf_cpu = pdf.as_ref().map(|[_, cpu]| cpu.clone());
    let pdf_gpu = pdf_cpu
        .as_ref()
        .map(|pdf| gpu.upload(Pdf::clone(pdf)).expect("room"));
    let start = std::time::Instant::now();
    let tested = gpu
        .cluster(&scene_gpu, &rsm_gpu, pdf_gpu.as_ref(), cluster)
        .expect("clusters");
    let tested = gpu.download(&tested).expect("clusters");
    println!(
        "{} texels, {} lights: {:.3} s on the GPU",
        rsm.position.len(),
        tested.count,
        start.elapsed().as_secs_f64()
    );
    let reference = cpu
        .cluster(&scene, &rsm, pdf_cpu.as_ref(), cluster)
        .expect("clusters");
    Made {
        pdf,
        vsgls: [Arc::new(tested), reference],
    }
}

fn check(name: &str, shot: &Shot) {
    let made = made(shot);
    if let Some([tested, reference]) = &made.pdf {
        same(name, &**tested, &**reference);
    }
    let [tested, reference] = &made.vsgls;
    same(name, &**tested, &**reference);
}

#[test]
fn partition_of_a_built_in_scene() {
    for settings in [
        "rsm=64 lights=64",
        "rsm=64 lights=512",
        "rsm=64 lights=1",
        "rsm=512 lights=1024",
        "rsm=1 lights=16",
        "rsm=3 lights=256",
    ] {
        check(settings, &Shot::sample("cornell").with(settings));
    }
}

#[test]
fn filtered_kernels_of_a_built_in_scene() {
    for settings in [
        "rsm=64 lights=64",
        "rsm=64 lights=1",
        "rsm=50 lights=300 kernel=3 bisections=20",
        "rsm=1 lights=16",
        "rsm=3 lights=256",
    ] {
        let shot = Shot::sample("cornell")
            .with("clustering=filtered")
            .with(settings);
        check(settings, &shot);
    }
}
