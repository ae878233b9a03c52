//! The same scene in other units, turned, or far away gives the same picture.

use vsgl_core::data::Image;
use vsgl_core::glam::{DVec3, Quat, Vec3};
use vsgl_core::render::Frame;
use vsgl_core::scene::{Scene, gltf};
use vsgl_cpu::CpuBackend;
use vsgl_tests::gltf::room;
use vsgl_tests::measure::{quantile, relative_differences};
use vsgl_tests::render::Shot;

/// The scene turned, then scaled, with the light's intensity so that radiances stay what they are.
fn moved(shot: Shot, scale: f32, turn: Quat) -> Shot {
    let mut shot = shot.placed(turn, scale, Vec3::ZERO);
    for spot in shot.spots() {
        spot.intensity = spot.intensity.map(|i| i * (scale * scale));
    }
    shot
}

/// Median and 99th percentile of the differences of both layers.
fn differences(name: &str, test: &Image, reference: &Image) -> [[f64; 2]; 2] {
    let of = |test: &[[f32; 3]], reference: &[[f32; 3]]| {
        let all = relative_differences(test, reference);
        [quantile(&all, 0.5), quantile(&all, 0.99)]
    };
    let both = [
        of(&test.direct, &reference.direct),
        of(&test.indirect(), &reference.indirect()),
    ];
    let [d, i] = both;
    println!(
        "{name}: direct {:.1e} {:.1e}, indirect {:.1e} {:.1e}",
        d[0], d[1], i[0], i[1]
    );
    both
}

fn base(name: &str) -> Shot {
    Shot::sample(name).with("rsm=128 lights=256")
}

#[test]
fn units_do_not_matter() {
    for name in ["cornell", "roughness-row"] {
        let reference = base(name).image();
        for scale in [1e-3, 1e3] {
            let image = moved(base(name), scale, Quat::IDENTITY).image();
            let [direct, indirect] = differences(&format!("{name} {scale:e}"), &image, &reference);
            // 1e-3 is no power of two: every number is rounded anew. A texel whose feature lies on a threshold, or a ray
            // that meets an edge, may go the other way.
            assert!(direct[0] < 1e-5 && direct[1] < 1e-3, "{direct:?}");
            assert!(indirect[0] < 1e-3 && indirect[1] < 0.02, "{indirect:?}");
        }
    }
}

#[test]
fn a_power_of_two_changes_no_cluster() {
    // Scaling by 2¹⁰ is exact, so no texel changes sides. Both scenes have their axes made unit again, which is not exact.
    let by = |scale| moved(base("cornell"), scale, Quat::IDENTITY).frame();
    let [reference, scaled] = [1.0, 1024.0].map(by);
    let label = |frame: &Frame<CpuBackend>| frame.vsgls.as_ref().map(|v| v.label.clone());
    assert!(label(&scaled) == label(&reference), "a texel changed sides");
    let (reference, image) = (reference.image, scaled.image);
    let [direct, indirect] = differences("2^10", &image, &reference);
    assert!(
        direct[1] < 2e-4 && indirect[1] < 2e-5,
        "{direct:?} {indirect:?}"
    );
}

#[test]
fn a_turn_does_not_matter() {
    // The map's columns follow the world's axes: after a turn the texels lie elsewhere on the surfaces and make other
    // clusters. Indirect light is compared between two pictures that each have the error of 1024 clusters; close to lit
    // surfaces, at the last percent, that is tens of percent.
    let turn = Quat::from_axis_angle(Vec3::new(0.36, 0.48, -0.8), 1.1);
    for (name, median, last) in [("cornell", 2e-3, 0.5), ("roughness-row", 0.04, 1.5)] {
        let base = || Shot::sample(name).with("rsm=256 lights=1024 occlusion=none");
        let reference = base().image();
        let image = moved(base(), 1.0, turn).image();
        let [direct, indirect] = differences(&format!("{name} turned"), &image, &reference);
        assert!(direct[0] < 1e-6 && direct[1] < 2e-4, "{direct:?}");
        assert!(indirect[0] < median && indirect[1] < last, "{indirect:?}");
    }
}

/// The scene of a glTF file, written and read.
fn loaded(text: &str) -> Scene {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("room.gltf");
    std::fs::write(&path, text).expect("room on the disk");
    gltf::load(&path).expect("a scene")
}

#[test]
fn a_scene_far_away_does_not_matter() {
    let here = loaded(&room(DVec3::ZERO));
    let reference = Shot::of(here.clone()).with("rsm=128 lights=256").image();
    assert!(reference.indirect().iter().any(|c| c[0] > 0.0));
    for offset in [DVec3::splat(1e5), DVec3::new(-1e5, 3e5, 1.2345e6)] {
        let there = loaded(&room(offset));
        let apart = there.origin - here.origin - offset;
        assert!(apart.length() < 1e-6, "{apart}");
        let image = Shot::of(there).with("rsm=128 lights=256").image();
        let [direct, indirect] = differences(&format!("{offset}"), &image, &reference);
        // Transforms are composed in f64 and the origin taken off before rounding: 1e6 m leave 1e-10 m.
        assert!(direct[1] < 1e-5, "{direct:?}");
        assert!(indirect[0] < 1e-5 && indirect[1] < 1e-2, "{indirect:?}");
    }
}

#[test]
fn the_origin_is_not_looked_at() {
    let reference = base("cornell").image();
    let mut far = base("cornell");
    far.scene.origin += DVec3::splat(1e5);
    assert!(far.image() == reference);
}
