//! What imperfect shadow maps cost and where they are wrong, beside exact rays. See `benches/README.md`.
//!
//! `cargo run --release -p vsgl-benches --bin occlusion-report -- ASSETS [key=value]…` prints a table for the views of the ground
//! truth: error against the references, time of the processor, and the light that is let through or held back where rays say
//! otherwise.

mod pairs;

use std::path::Path;
use vsgl_core::backend::{Backend, Senders, ShadeInputs};
use vsgl_core::data::SceneData;
use vsgl_core::metrics::{Metric, Plane, compare};
use vsgl_cpu::CpuBackend;
use vsgl_tests::usage::computed;
use vsgl_tests::view::{VIEWS, reference, shot};

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let Some((root, settings)) = words.split_first() else {
        eprintln!("give the folder of the ground truth's assets, then settings as key=value");
        std::process::exit(2);
    };
    let views: Vec<&str> = VIEWS
        .into_iter()
        .filter(|v| {
            settings.is_empty()
                || !settings.iter().any(|s| VIEWS.contains(&s.as_str()))
                || settings.iter().any(|s| s == v)
        })
        .collect();
    let settings: Vec<&str> = settings
        .iter()
        .map(String::as_str)
        .filter(|s| s.contains('='))
        .collect();
    println!("| view | occlusion | MAPE % | energy % | maps s | shading s | leak % | acne % |");
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    for view in views {
        for method in ["none", "rays", "ism", "ism-tessellated"] {
            row(Path::new(root), view, method, &settings.join(" "));
        }
    }
}

fn row(root: &Path, view: &str, method: &str, settings: &str) {
    let shot = shot(root, view).with(&format!("occlusion={method} {settings}"));
    let (plan, backend) = (shot.plan(), CpuBackend::new(0).expect("threads"));
    let scene = backend.upload(SceneData::new(&shot.scene)).expect("room");
    let bounce = plan.bounce.as_ref().expect("light");
    let cluster = bounce.cluster.as_ref().expect("clusters");
    let rsm = backend
        .rsm(&scene, &shot.lights, &bounce.rsm)
        .expect("maps");
    let vsgls = backend
        .cluster(&scene, &rsm, None, cluster)
        .expect("clusters");
    let gbuffer = backend
        .gbuffer(&scene, &shot.view, &plan.gbuffer)
        .expect("a view");
    let now = || computed().unwrap_or(f64::NAN);
    let start = now();
    let maps = bounce
        .occlusion
        .as_ref()
        .map(|p| backend.occlusion(&scene, &vsgls, p).expect("shadow maps"));
    let made = now();
    let inputs = ShadeInputs {
        scene: &scene,
        gbuffer: &gbuffer,
        view: &shot.view,
        lights: &[],
        senders: Senders::Vsgls(&vsgls),
        occlusion: maps.as_ref(),
    };
    let radiance = backend.shade(&inputs, &plan.shade, &()).expect("light");
    let shaded = now();
    let image = backend
        .resolve(&gbuffer, &radiance, &shot.view)
        .expect("a picture");
    let test = Plane::luminance(image.width, image.height, &image.indirect()).expect("a plane");
    let errors = compare(&test, &reference(root, view, "indirect"), 8)
        .expect("pictures of one size")
        .expect("blocks with light");
    let [mape, energy] = [Metric::Mape, Metric::Bias].map(|m| errors.get(m));
    let [leak, acne] = maps.as_ref().map_or([f64::NAN; 2], |maps| {
        pairs::differences(&scene, &gbuffer, &vsgls, maps, shot.view.camera.eye, &plan)
    });
    let share = |x: f64| match x.is_finite() {
        true => format!("{:.2}", 100.0 * x),
        false => "–".to_owned(),
    };
    println!(
        "| {view} | {method} | {mape:.2} | {energy:+.2} | {:.2} | {:.2} | {} | {} |",
        made - start,
        shaded - made,
        share(leak),
        share(acne)
    );
}
