//! More clusters, less error: the limit is every texel a point light.

use vsgl_core::metrics::Metric;
use vsgl_tests::measure::{indirect_errors, indirect_mape};
use vsgl_tests::render::Shot;

/// Errors against every texel as a point light for 64, 256 and 1024 clusters; at 1024 below limits of mean and median [%].
fn falls_to(name: &str, rsm: u32, mean: f64, median: f64) {
    shot_falls_to(name, Shot::sample(name), rsm, mean, median);
}

fn shot_falls_to(name: &str, shot: Shot, rsm: u32, mean: f64, median: f64) {
    let shot = || {
        shot.clone()
            .size(40, 22)
            .with(&format!("rsm={rsm} occlusion=none"))
    };
    let reference = shot().with("method=vpl").image();
    let errors = ["64", "256", "1024"].map(|lights| {
        let image = shot().with(&format!("lights={lights}")).image();
        let errors = indirect_errors(&image, &reference);
        [errors.get(Metric::Mape), errors.get(Metric::MapeMedian)]
    });
    println!("{name}: MAPE, median {errors:.3?} %");
    // A quarter at least with each step: an error that stays is a wrong form, not too few clusters.
    for i in 0..2 {
        assert!(
            errors[1][i] < 0.75 * errors[0][i] && errors[2][i] < 0.75 * errors[1][i],
            "{errors:?}"
        );
    }
    assert!(errors[2][0] < mean && errors[2][1] < median, "{errors:?}");
}

#[test]
fn cornell() {
    falls_to("cornell", 96, 5.0, 0.7);
}

#[test]
fn glossy_floor() {
    // Fewer texels leave the mirror image of the boards a pattern of dots in the reference.
    falls_to("glossy-floor", 160, 9.0, 2.5);
}

#[test]
fn brushed_floor() {
    let mut shot = Shot::sample("glossy-floor");
    for material in &mut shot.scene.materials {
        (material.anisotropy, material.anisotropy_rotation) = (0.6, 0.5);
    }
    shot.scene.mesh.tangents = shot
        .scene
        .mesh
        .normals
        .iter()
        .map(|n| n.any_orthonormal_vector().extend(1.0))
        .collect();
    let plan = shot.plan();
    assert!(plan.shade.anisotropic_receivers && plan.shade.anisotropic_senders);
    shot_falls_to("brushed floor", shot, 160, 9.0, 2.5);
}

#[test]
fn published_forms_do_not_converge() {
    // The reason for ours: a Gaussian is neither a cosine nor GGX, however many there are.
    let shot = || {
        Shot::sample("cornell")
            .size(32, 18)
            .with("rsm=64 occlusion=none")
    };
    let reference = shot().with("method=vpl").image();
    let mut published = shot();
    published.settings = vsgl_core::settings::Settings {
        rsm: 64,
        lights: 1024,
        occlusion: vsgl_core::settings::OcclusionMethod::None,
        ..vsgl_core::settings::Preset::Paper2016.settings()
    };
    let error = indirect_mape(&published.image(), &reference);
    println!("paper-2016: {error:.1} %");
    assert!((5.0..100.0).contains(&error), "{error}");
}

#[test]
fn cornell_with_rays() {
    let shot = || Shot::sample("cornell").size(40, 22).with("rsm=64");
    let reference = shot().with("method=vpl").image();
    let errors = indirect_errors(&shot().with("lights=1024").image(), &reference);
    let all = [Metric::Mape, Metric::MapeMedian, Metric::Bias].map(|m| errors.get(m));
    println!("with rays: MAPE, median, bias {all:.2?} %");
    // One ray decides over a whole cluster: penumbrae become steps, which cancel in the mean.
    assert!(
        all[0] < 8.0 && all[1] < 1.5 && all[2].abs() < 3.0,
        "{all:?}"
    );
}
