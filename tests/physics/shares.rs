//! Shares of the virtual lights add up to all of them, and rays to some tell what rays to all do.

use vsgl_core::data::Image;
use vsgl_core::glam::Vec3;
use vsgl_core::metrics::luminance;
use vsgl_core::scene::Camera;
use vsgl_tests::render::Shot;

/// A picture in which all pixels see about one point, half in shadow of the blocks.
fn point(settings: &str) -> Shot {
    let mut shot = Shot::sample("cornell")
        .size(64, 64)
        .with("lights=256 rsm=64")
        .with(settings);
    let eye = shot.view.camera.eye;
    let target = Vec3::new(-0.35, 0.0, -0.2);
    shot.view.camera = Camera::look_at(eye, target, 1e-3);
    shot
}

fn mean(image: &Image) -> f64 {
    let all = image.indirect();
    all.iter().map(|&c| luminance(c)).sum::<f64>() / all.len() as f64
}

fn share_of(settings: &str, reference: &str) -> f64 {
    mean(&point(settings).image()) / mean(&point(reference).image())
}

#[test]
fn shares_add_up_to_all_lights() {
    for side in [2, 4, 8] {
        let share = share_of(
            &format!("occlusion=none interleave={side}"),
            "occlusion=none",
        );
        println!("{side}x{side}: {share}");
        assert!((share - 1.0).abs() < 1e-4, "{side}x{side}: {share}");
    }
}

/// In the mean over the numbers that choose lights, whatever the number of rays.
#[test]
fn rays_to_some_lights_are_without_bias() {
    let open = share_of("occlusion=rays", "occlusion=none");
    assert!((0.2..0.9).contains(&open), "{open} of the light arrives");
    for rays in [1, 3, 8, 64] {
        for side in [1, 4] {
            let words = format!("occlusion=sampled rays={rays} interleave={side}");
            let found = share_of(&words, "occlusion=none");
            println!("{rays} rays, {side}x{side}: {found:.4} instead of {open:.4}");
            assert!(
                (found / open - 1.0).abs() < 0.01,
                "{rays} rays, {side}x{side}: {found} instead of {open}"
            );
        }
    }
}

/// Where all is open, and where nothing is, nothing is left to chance.
#[test]
fn visibility_is_exact_where_there_is_no_choice() {
    let shot = |settings: &str| {
        Shot::sample("glossy-floor")
            .with("lights=64 rsm=64")
            .with(settings)
    };
    let (all, some) = (shot("occlusion=none"), shot("occlusion=sampled rays=2"));
    let mut all = all;
    let mut some = some;
    // A floor alone, which hides nothing of itself.
    for shot in [&mut all, &mut some] {
        let floor = shot.scene.bounds().0.y + 1e-3;
        let mesh = &mut shot.scene.mesh;
        let low = |t: &[u32; 3]| t.iter().all(|&v| mesh.positions[v as usize].y < floor);
        let kept: Vec<bool> = mesh.triangles.iter().map(low).collect();
        let (mut a, mut b) = (kept.iter(), kept.iter());
        mesh.triangles.retain(|_| a.next() == Some(&true));
        mesh.material.retain(|_| b.next() == Some(&true));
    }
    let (a, b) = (mean(&all.image()), mean(&some.image()));
    assert!((a - b).abs() <= 1e-5 * a, "{b} instead of {a}");
}
