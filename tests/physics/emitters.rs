//! Surfaces that shine: their flux, and what they bring to others.

use std::f64::consts::PI;
use vsgl_core::data::{Rsm, SceneData};
use vsgl_core::glam::{DVec3, Vec2, Vec3};
use vsgl_core::metrics::luminance;
use vsgl_core::scene::{Camera, Light, Material, Mesh, PointLight, Scene, Texture, TextureRef};
use vsgl_tests::measure::quantile;
use vsgl_tests::render::Shot;

const HEIGHT: f32 = 1.0;
pub(super) const ALBEDO: f64 = 0.6;
const RADIANCE: [f32; 3] = [4.0, 2.0, 1.0];

/// A floor of 4 by 4 m and a lamp of 1 by 0.6 m over it, one metre up, that faces down.
pub(super) fn room() -> Scene {
    let mut mesh = Mesh::default();
    let mut quad = |half: [f32; 2], y: f32, down: bool, material: u32| {
        let [x, z] = half;
        let first = mesh.positions.len() as u32;
        let corners = [[-x, -z], [-x, z], [x, z], [x, -z]];
        mesh.positions
            .extend(corners.map(|[x, z]| Vec3::new(x, y, z)));
        let uv = corners.map(|c| Vec2::new((c[0] / x + 1.0) / 2.0, (c[1] / z + 1.0) / 2.0));
        mesh.texcoords.extend(uv);
        mesh.normals
            .extend([if down { Vec3::NEG_Y } else { Vec3::Y }; 4]);
        let turn = |[a, b, c]: [u32; 3]| if down { [a, c, b] } else { [a, b, c] };
        let triangles = [[0, 1, 2], [0, 2, 3]].map(|t| turn(t.map(|i| first + i)));
        mesh.triangles.extend(triangles);
        mesh.material.extend([material; 2]);
    };
    quad([2.0, 2.0], 0.0, false, 0);
    quad([0.5, 0.3], HEIGHT, true, 1);
    Scene {
        mesh,
        materials: vec![
            Material::lambert("floor", [ALBEDO as f32; 3]),
            Material {
                emission: RADIANCE,
                ..Material::lambert("lamp", [0.0; 3])
            },
        ],
        cameras: vec![(
            "main".into(),
            Camera::look_at(Vec3::new(1.6, 0.9, 1.4), Vec3::new(0.2, 0.0, 0.0), 1.0),
        )],
        ..Scene::default()
    }
}

/// Sum over the texels of the last map, channel by channel.
fn flux(rsm: &Rsm) -> [f64; 3] {
    let first = rsm.diffuse.len() - (rsm.size * rsm.size) as usize;
    [0, 1, 2].map(|k| rsm.diffuse[first..].iter().map(|d| f64::from(d[k])).sum())
}

#[test]
fn texels_hold_the_flux_that_surfaces_emit() {
    for double_sided in [false, true] {
        let mut scene = room();
        scene.materials[1].double_sided = double_sided;
        let sides = if double_sided { 2.0 } else { 1.0 };
        for size in [1, 7, 64, 100, 256, 300] {
            let rsm = Shot::of(scene.clone())
                .size(4, 4)
                .with(&format!("rsm={size}"))
                .frame()
                .rsm;
            let rsm = rsm.expect("a map");
            let found = flux(&rsm);
            for (found, radiance) in found.into_iter().zip(RADIANCE) {
                let exact = PI * f64::from(radiance) * 0.6 * sides;
                assert!(
                    (found / exact - 1.0).abs() < 1e-5,
                    "{size}: {found} for {exact}"
                );
            }
            let area: f64 = rsm.position.iter().map(|p| f64::from(p[3])).sum();
            assert!((area / (0.6 * sides) - 1.0).abs() < 1e-5, "{size}: {area}");
            let shining = rsm
                .normal
                .iter()
                .zip(&rsm.diffuse)
                .filter(|(_, d)| d[0] > 0.0);
            let up = shining.clone().filter(|(n, _)| n[1] > 0.0).count() as f64;
            let share = up / shining.count() as f64;
            if size >= 64 || !double_sided {
                assert!(
                    (share - (sides - 1.0) / 2.0).abs() < 0.01,
                    "{size}: {share} upwards"
                );
            }
        }
    }
}

#[test]
fn dark_texels_send_nothing() {
    let mut scene = room();
    // A quarter of the lamp shines: u and v below a half.
    let (on, off) = ([255, 255, 255, 255], [0, 0, 0, 255]);
    scene.textures = vec![Texture {
        width: 2,
        height: 2,
        texels: vec![on, off, off, off],
    }];
    scene.materials[1].emissive_texture = Some(TextureRef {
        filter: vsgl_core::scene::Filter::Nearest,
        ..TextureRef::new(0)
    });
    let rsm = Shot::of(scene.clone())
        .size(4, 4)
        .frame()
        .rsm
        .expect("a map");
    // The lamp is cut into cells that lie across the edges of the texture: a row of 64 or so.
    let exact = PI * 4.0 * 0.6 / 4.0;
    assert!(
        (flux(&rsm)[0] / exact - 1.0).abs() < 0.03,
        "{:?}",
        flux(&rsm)
    );
    for (position, flux) in rsm.position.iter().zip(&rsm.diffuse) {
        let inside = position[0] < 0.02 && position[2] < 0.02;
        assert!(inside || flux[0] == 0.0, "{position:?}");
    }
    // All of it dark: a plan with surfaces that shine, and no light.
    scene.textures[0].texels = vec![off; 4];
    assert!(SceneData::new(&scene).emitter.is_empty());
    for words in [
        "",
        "method=vpl rsm=8",
        "clustering=filtered",
        "clustering=whole",
    ] {
        let image = Shot::of(scene.clone()).with(words).image();
        let emitted = image
            .direct
            .iter()
            .zip(&image.normal)
            .filter(|(_, n)| n[1] > 0.5);
        assert!(
            emitted.into_iter().all(|(d, _)| luminance(*d) == 0.0),
            "{words}"
        );
    }
}

/// Irradiance of the floor under the lamp, by the midpoint rule on 200 by 200 points.
pub(super) fn irradiance(at: DVec3) -> f64 {
    let n = 200;
    let mut sum = 0.0;
    for i in 0..n {
        for j in 0..n {
            let x = (f64::from(i) + 0.5) / f64::from(n) - 0.5;
            let z = ((f64::from(j) + 0.5) / f64::from(n) - 0.5) * 0.6;
            let apart = DVec3::new(x, f64::from(HEIGHT), z) - at;
            let cosine = apart.y / apart.length();
            sum += cosine * cosine / apart.length_squared();
        }
    }
    sum * 0.6 / f64::from(n * n)
}

/// Relative errors of the direct light on the floor, ascending.
fn errors(settings: &str) -> Vec<f64> {
    let frame = Shot::of(room()).with(settings).frame();
    let mut errors = Vec::new();
    for i in 0..frame.radiance.direct.len() {
        let [x, y, z, _] = frame.gbuffer.position[i].map(f64::from);
        if frame.gbuffer.normal[i][1] > 0.5 && y.abs() < 1e-3 && z.abs() < 2.0 {
            let exact = ALBEDO / PI * 2.0 * irradiance(DVec3::new(x, 0.0, z));
            errors.push((f64::from(frame.radiance.direct[i][1]) / exact - 1.0).abs());
        }
    }
    assert!(errors.len() > 500, "{} pixels of floor", errors.len());
    errors.sort_by(f64::total_cmp);
    println!(
        "{settings}: median {:.1e}, worst {:.1e}",
        quantile(&errors, 0.5),
        quantile(&errors, 1.0)
    );
    errors
}

#[test]
fn a_lamp_over_a_floor_is_its_integral() {
    // As points, and as clusters of ever more texels.
    assert!(quantile(&errors("method=vpl rsm=32"), 1.0) < 4e-3);
    assert!(quantile(&errors("rsm=256 lights=1024"), 1.0) < 2e-3);
    assert!(quantile(&errors("rsm=256 lights=64"), 1.0) < 1e-2);
    assert!(quantile(&errors("rsm=256 lights=8"), 1.0) < 5e-2);
    assert!(quantile(&errors("rsm=64 lights=256 clustering=filtered"), 0.5) < 5e-2);
}

#[test]
fn light_of_emitters_is_direct_and_leaves_the_bounce_alone() {
    let point = Light::Point(PointLight {
        position: Vec3::new(0.6, 0.4, 0.5),
        intensity: [2.0; 3],
        range: f32::INFINITY,
    });
    let mut lit = Shot::of(room()).with("method=vpl rsm=16");
    lit.scene.materials[1].base_color = [0.5; 3];
    lit.lights = vec![point];
    let shining = lit.clone();
    for material in &mut lit.scene.materials {
        material.emission = [0.0; 3];
    }
    let mut alone = shining.clone();
    alone.lights.clear();
    let [both, lit, alone] = [shining, lit, alone].map(|shot| shot.frame());
    assert_eq!(
        both.radiance.indirect_diffuse,
        lit.radiance.indirect_diffuse
    );
    assert!(
        alone
            .radiance
            .indirect_diffuse
            .iter()
            .all(|d| *d == [0.0; 3])
    );
    for i in 0..both.radiance.direct.len() {
        let [both, lit, alone] = [&both, &lit, &alone].map(|f| Vec3::from(f.radiance.direct[i]));
        assert!(
            (both - (lit + alone)).abs().max_element() <= 1e-6 * both.max_element(),
            "{i}"
        );
    }
}
