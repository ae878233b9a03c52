//! Rooms in which the answer is known.

use std::f64::consts::PI;
use vsgl_core::glam::Vec3;
use vsgl_core::metrics::luminance;
use vsgl_core::phase::shade::{Incoming, glossy_2024, glossy_masked};
use vsgl_core::scene::{Camera, Light, Material, Mesh, Scene, SpotLight};
use vsgl_core::sg::glossy::GlossyView;
use vsgl_tests::random::sphere_point;
use vsgl_tests::render::Shot;

pub(super) const RADIUS: f32 = 2.0;
pub(super) const ALBEDO: f32 = 0.8;

/// An integrating sphere: matte, seen from inside, with a lamp off its centre.
pub(super) fn sphere() -> Scene {
    let (rings, segments) = (64u32, 128u32);
    let mut mesh = Mesh::default();
    for ring in 0..=rings {
        for segment in 0..segments {
            let (sin, cos) = (ring as f32 / rings as f32 * std::f32::consts::PI).sin_cos();
            let (y, x) = (segment as f32 / segments as f32 * std::f32::consts::TAU).sin_cos();
            let out = Vec3::new(sin * x, sin * y, cos).normalize();
            mesh.positions.push(out * RADIUS);
            mesh.normals.push(-out);
        }
    }
    for ring in 0..rings {
        for segment in 0..segments {
            let next = (segment + 1) % segments;
            let (a, b) = (ring * segments + segment, ring * segments + next);
            let (c, d) = (a + segments, b + segments);
            if ring > 0 {
                mesh.triangles.push([a, b, c]);
            }
            if ring + 1 < rings {
                mesh.triangles.push([b, d, c]);
            }
        }
    }
    mesh.material = vec![0; mesh.triangles.len()];
    let light = SpotLight {
        position: Vec3::new(0.3, -0.2, 0.1),
        axis: Vec3::new(0.6, 0.0, 0.8),
        intensity: [10.0; 3],
        inner: 0.5,
        outer: 0.7,
        range: f32::INFINITY,
    };
    Scene {
        mesh,
        materials: vec![Material::lambert("matte", [ALBEDO; 3])],
        lights: vec![Light::Spot(light)],
        cameras: vec![(
            "main".into(),
            Camera::look_at(Vec3::new(0.0, 0.9, -0.4), Vec3::ZERO, 2.0),
        )],
        ..Scene::default()
    }
}

/// One bounce in a matte sphere is the same everywhere: two points at `2 r cos` from each other see each other under the
/// same cosine at both ends, so a flux `Φ` reflected anywhere gives the irradiance `Φ/(4π r²)` everywhere.
fn integrating_sphere(settings: &str, mean_limit: f64, worst_limit: f64) {
    let frame = Shot::of(sphere()).with(settings).frame();
    let map = frame.rsm.as_ref().expect("a bounce");
    let flux: f64 = map.diffuse.iter().map(|d| f64::from(d[1])).sum();
    let exact = f64::from(ALBEDO) / PI * flux / (4.0 * PI * f64::from(RADIUS * RADIUS));
    let found: Vec<f64> = frame
        .image
        .indirect()
        .iter()
        .map(|&c| luminance(c) / exact)
        .collect();
    let mean = found.iter().sum::<f64>() / found.len() as f64;
    let mut errors: Vec<f64> = found.iter().map(|f| (f - 1.0).abs()).collect();
    errors.sort_by(f64::total_cmp);
    let p99 = vsgl_tests::measure::quantile(&errors, 0.99);
    println!(
        "{settings}: mean {:+.3} %, p99 {:.3} %",
        100.0 * (mean - 1.0),
        100.0 * p99
    );
    assert!((mean - 1.0).abs() < mean_limit, "{settings}: mean {mean}");
    assert!(p99 < worst_limit, "{settings}: p99 {p99}");
}

#[test]
fn an_integrating_sphere_is_evenly_lit_by_points() {
    // Facets lie up to 0.06 % inside the sphere.
    integrating_sphere("method=vpl rsm=48 occlusion=none", 0.005, 0.02);
}

#[test]
fn an_integrating_sphere_is_evenly_lit_by_clusters() {
    integrating_sphere("rsm=128 lights=1024 occlusion=none", 0.01, 0.05);
}

#[test]
fn nothing_in_an_integrating_sphere_is_in_shadow() {
    // A ray that hits the surface it starts or ends on would take light away.
    integrating_sphere("rsm=128 lights=1024 occlusion=rays", 0.01, 0.05);
}

/// What a surface of reflectance 1 sends to the eye under light of radiance 1 from everywhere, cut into lobes.
fn reflected(alpha: f32, view_cosine: f32, sharpness: f32, masked: bool) -> f64 {
    let view = Vec3::new((1.0 - view_cosine * view_cosine).sqrt(), 0.0, view_cosine);
    let surface = GlossyView::new(view, Vec3::Z, alpha);
    let count = 60_000;
    let sum: f64 = (0..count)
        .map(|i| {
            let incoming = Incoming {
                axis: sphere_point(i, count),
                sharpness,
                horizon: sharpness,
                strength: Vec3::ONE,
            };
            f64::from(if masked {
                glossy_masked(&incoming, &surface)
            } else {
                glossy_2024(&incoming, &surface)
            })
        })
        .sum();
    // Lobes of any sharpness with their axes spread evenly add up to even light: each brings 4π/count.
    sum * 4.0 * PI / f64::from(count as u32)
}

#[test]
fn a_mirror_for_all_directions_reflects_no_more_than_arrives() {
    let mut worst = [0.0f64; 2];
    for alpha in [0.05, 0.1, 0.2, 0.4, 0.7, 1.0] {
        for view_cosine in [0.05, 0.2, 0.5, 0.8, 1.0] {
            for sharpness in [0.0, 0.5, 2.0, 8.0, 32.0, 128.0] {
                for (worst, masked) in worst.iter_mut().zip([true, false]) {
                    let share = reflected(alpha, view_cosine, sharpness, masked);
                    if share > *worst {
                        println!("{masked} {alpha} {view_cosine} {sharpness}: {share:.3}");
                        *worst = share;
                    }
                }
            }
        }
    }
    println!("greatest shares {worst:.4?}");
    assert!(worst[0] < 1.05, "{worst:?}");
    // As published, without the masking ratio.
    assert!(worst[1] < 1.2, "{worst:?}");
}
