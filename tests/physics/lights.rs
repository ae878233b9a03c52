//! Points, suns and wide cones: the flux of their maps, and what they bring to a surface.

use std::f64::consts::{FRAC_1_PI, PI, TAU};
use vsgl_core::data::{MapRecord, NO_TRIANGLE};
use vsgl_core::glam::{DVec3, Vec3};
use vsgl_core::metrics::luminance;
use vsgl_core::phase::rsm;
use vsgl_core::scene::{
    Camera, DirectionalLight, Light, Material, Mesh, PointLight, Scene, SpotLight,
};
use vsgl_tests::measure::relative_differences;
use vsgl_tests::render::Shot;

fn point(position: Vec3, intensity: f32) -> Light {
    Light::Point(PointLight {
        position,
        intensity: [intensity; 3],
        range: f32::INFINITY,
    })
}

fn sun(axis: Vec3, irradiance: f32) -> Light {
    Light::Directional(DirectionalLight {
        axis: axis.normalize(),
        irradiance: [irradiance; 3],
    })
}

/// Flux through all texels of all maps of a light.
fn flux(light: Light, size: u32) -> f64 {
    let maps = rsm::maps(&[light], size, (Vec3::ZERO, Vec3::ONE));
    let of = |map: &MapRecord| -> f64 {
        let texel = |i: u32| f64::from(rsm::ray(map, size, i % size, i / size).1.y);
        (0..size * size).map(texel).sum()
    };
    maps.iter().map(of).sum()
}

#[test]
fn faces_around_a_point_hold_all_its_flux() {
    for size in [1, 2, 3, 16, 64, 511, 512, 2048] {
        let error = flux(point(Vec3::new(1.0, 2.0, 3.0), 1.0), size) / (4.0 * PI) - 1.0;
        println!("{size}: {error:.1e}");
        // Some roundings of 6e-8 in each texel's flux, and from 2048 on the midpoint rule's error.
        assert!(error.abs() < 3e-7, "{size}: {error:.1e}");
    }
}

#[test]
fn faces_around_a_point_meet_without_gap_or_overlap() {
    // Every direction lies in one face: none of its coordinates on the others' axes exceeds the one on its own.
    let maps = rsm::maps(&[point(Vec3::ZERO, 1.0)], 8, Default::default());
    assert_eq!(maps.len(), 6);
    for i in 0..10_000 {
        let direction = vsgl_tests::random::sphere_point(i, 10_000);
        let inside = |map: &&MapRecord| {
            let [axis, right, up] = [map.axis, map.right, map.up].map(Vec3::from_array);
            let depth = direction.dot(axis) * map.tan_half_fov;
            direction.dot(right).abs() <= depth && direction.dot(up).abs() <= depth
        };
        assert_eq!(maps.iter().filter(inside).count(), 1, "{direction}");
    }
}

#[test]
fn faces_hold_the_flux_of_wide_cones() {
    for (inner, outer) in [(0.0, 85.0), (60.0, 90.0), (0.0, 90.0), (81.0, 90.0)] {
        for size in [64, 256] {
            let light = Light::Spot(SpotLight {
                position: Vec3::ZERO,
                axis: Vec3::new(0.48, -0.6, 0.64),
                intensity: [1.0; 3],
                inner: f32::to_radians(inner),
                outer: f32::to_radians(outer),
                range: f32::INFINITY,
            });
            assert_eq!(light.maps(), 5);
            let [inner, outer] = [inner, outer].map(|a| f64::from(a).to_radians().cos());
            let exact = TAU * ((1.0 - inner) + (inner - outer) / 3.0);
            let error = flux(light, size) / exact - 1.0;
            println!("{inner:.2} {outer:.2} {size}: {error:.1e}");
            // The falloff has a kink at the inner cone: the midpoint rule is off by a texel's width squared.
            let width = 2.0 / f64::from(size);
            assert!(
                error.abs() < width * width,
                "{inner} {outer} {size}: {error:.1e}"
            );
        }
    }
}

/// A box seen from inside, or a dish: floor and low walls.
fn room(height: f32, lid: bool, albedo: f32) -> Scene {
    let mut mesh = Mesh::default();
    let mut quad = |corners: [Vec3; 4]| {
        let [a, b, c, _] = corners;
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(corners);
        mesh.normals.extend([(b - a).cross(c - a).normalize(); 4]);
        mesh.triangles.push([first, first + 1, first + 2]);
        mesh.triangles.push([first, first + 2, first + 3]);
        mesh.material.extend([0, 0]);
    };
    let at = Vec3::new;
    let level = |y: f32| {
        [
            at(-1.0, y, -1.0),
            at(-1.0, y, 1.0),
            at(1.0, y, 1.0),
            at(1.0, y, -1.0),
        ]
    };
    let (low, high) = (level(0.0), level(height));
    quad(low);
    for i in 0..4 {
        let j = (i + 1) % 4;
        quad([low[i], low[j], high[j], high[i]]);
    }
    if lid {
        let [a, b, c, d] = high;
        quad([a, d, c, b]);
    }
    let camera = Camera::look_at(
        at(0.9, (0.8 * height).max(0.7), 0.9),
        at(-0.5, 0.0, -0.5),
        1.2,
    );
    Scene {
        mesh,
        materials: vec![Material::lambert("matte", [albedo; 3])],
        cameras: vec![("main".into(), camera)],
        ..Scene::default()
    }
}

fn lit(scene: Scene, lights: &[Light]) -> Shot {
    let mut shot = Shot::of(scene);
    shot.lights = lights.to_vec();
    shot
}

#[test]
fn a_closed_white_room_reflects_all_that_a_point_emits() {
    let shot = lit(
        room(2.0, true, 1.0),
        &[point(Vec3::new(0.2, 0.7, -0.3), 3.0)],
    );
    let frame = shot.size(4, 4).with("occlusion=none lights=1").frame();
    let rsm = frame.rsm.as_ref().expect("maps");
    assert_eq!(rsm.maps, 6);
    let reflected: f64 = rsm.diffuse.iter().map(|d| f64::from(d[1])).sum();
    assert!(
        (reflected / (4.0 * PI * 3.0) - 1.0).abs() < 3e-7,
        "{reflected}"
    );
}

#[test]
fn footprints_of_faces_cover_the_room_once() {
    // Six sides of a box of 2 by 2 by 2: 24 m². Texels' areas are taken as if they were flat parallelograms.
    let shot = lit(
        room(2.0, true, 1.0),
        &[point(Vec3::new(0.0, 1.0, 0.0), 3.0)],
    );
    let rsm = shot.size(4, 4).frame().rsm.expect("maps");
    let area: f64 = rsm.position.iter().map(|p| f64::from(p[3])).sum();
    assert!((area / 24.0 - 1.0).abs() < 1e-5, "{area}");
}

#[test]
fn a_sun_sends_what_falls_on_the_floor() {
    // A floor of 2 by 2 m under a slant sun receives `E cos · 4`; what passes it is not caught.
    let slant = Vec3::new(0.3, -1.0, 0.2);
    let shot = lit(room(1e-6, false, 1.0), &[sun(slant, 5.0)]);
    for size in [64, 256] {
        let frame = shot.clone().with(&format!("rsm={size}")).frame();
        let rsm = frame.rsm.as_ref().expect("maps");
        let reflected: f64 = rsm.diffuse.iter().map(|d| f64::from(d[1])).sum();
        let exact = 5.0 * 4.0 * f64::from(-slant.normalize().y);
        let error = reflected / exact - 1.0;
        println!("{size}: {error:.1e}");
        // Texels on the floor's edges are in or out as a whole: one row of `size` is off by half a texel at each edge.
        assert!(error.abs() < 2.0 / f64::from(size), "{size}: {error}");
        let area: f64 = rsm.position.iter().map(|p| f64::from(p[3])).sum();
        assert!((area / 4.0 - 1.0 - error).abs() < 1e-3, "{area}");
    }
}

/// Direct light of matte pixels against what the definitions say, in f64. `arriving` is the irradiance of a surface with
/// a normal at a point.
fn direct_is(shot: &Shot, albedo: f64, arriving: impl Fn(DVec3, DVec3) -> f64) {
    let frame = shot.frame();
    let mut lit = 0;
    for (i, &direct) in frame.radiance.direct.iter().enumerate() {
        if frame.gbuffer.triangle[i] == NO_TRIANGLE {
            continue;
        }
        let [x, y, z, _] = frame.gbuffer.position[i].map(f64::from);
        let [nx, ny, nz, _] = frame.gbuffer.normal[i].map(f64::from);
        let exact = albedo * FRAC_1_PI * arriving(DVec3::new(x, y, z), DVec3::new(nx, ny, nz));
        let found = luminance(direct);
        lit += usize::from(found > 0.0);
        assert!(
            (found - exact).abs() <= 2e-5 * exact,
            "{i}: {found} for {exact}"
        );
    }
    assert!(lit > 300, "{lit} lit pixels");
}

#[test]
fn direct_light_is_what_its_definition_says() {
    // The whole of a convex room is in the light.
    let place = Vec3::new(0.2, 1.3, -0.3);
    for range in [f32::INFINITY, 10.0, 2.0, 0.5] {
        let light = Light::Point(PointLight {
            position: place,
            intensity: [3.0; 3],
            range,
        });
        let shot = lit(room(2.0, true, 0.5), &[light]);
        let expected = |p: DVec3, n: DVec3| {
            let apart = place.as_dvec3() - p;
            let near = apart.length() / f64::from(range);
            let window = (1.0 - near.powi(4)).clamp(0.0, 1.0);
            3.0 * window * apart.normalize().dot(n) / apart.length_squared()
        };
        if range > 1.0 {
            direct_is(&shot, 0.5, expected);
        } else {
            let dark = shot
                .frame()
                .radiance
                .direct
                .iter()
                .all(|d| luminance(*d) == 0.0);
            assert!(dark, "nothing is within {range} m");
        }
    }
    let along = Vec3::new(0.1, -1.0, 0.05);
    let shot = lit(room(1e-6, false, 0.5), &[sun(along, 7.0)]);
    direct_is(&shot, 0.5, |_, n| {
        7.0 * n.dot(-along.normalize().as_dvec3())
    });
}

#[test]
fn shadows_of_a_sun_lie_where_it_is_hidden() {
    // A wall of the dish, as high as it is far: a sun at 45 degrees leaves half of the floor dark.
    let shot = lit(
        room(1.0, false, 0.5),
        &[sun(Vec3::new(1.0, -1.0, 0.0), 7.0)],
    );
    let frame = shot.frame();
    let mut seen = [0; 2];
    for (position, direct) in frame.gbuffer.position.iter().zip(&frame.radiance.direct) {
        let [x, y, ..] = *position;
        if y.abs() < 1e-6 && x.abs() > 1e-3 {
            assert_eq!(luminance(*direct) > 0.0, x > 0.0, "{position:?}");
            seen[usize::from(x > 0.0)] += 1;
        }
    }
    assert!(seen.into_iter().all(|n| n > 20), "{seen:?}");
}

/// Two sets of lights over a scene, their light brought to every pixel by every texel of their maps: largest relative difference of
/// the direct light, median and nine tenths of the differences of the indirect light.
fn apart(scene: &Scene, lights: [&[Light]; 2], settings: [&str; 2]) -> [f64; 3] {
    let [a, b] = [0, 1].map(|i| {
        let words = format!("method=vpl occlusion=none {}", settings[i]);
        let mut shot = lit(scene.clone(), lights[i]).size(24, 14).with(&words);
        shot.threads = 2;
        shot.image()
    });
    let direct = relative_differences(&a.direct, &b.direct);
    let indirect = relative_differences(&a.indirect(), &b.indirect());
    let all = [
        direct[direct.len() - 1],
        vsgl_tests::measure::quantile(&indirect, 0.5),
        vsgl_tests::measure::quantile(&indirect, 0.9),
    ];
    println!(
        "{settings:?}: direct {:.1e}, indirect {:.1e}, p90 {:.1e}",
        all[0], all[1], all[2]
    );
    all
}

#[test]
fn a_far_point_is_a_sun() {
    let scene = room(0.5, false, 0.7);
    let (from, far) = (Vec3::new(-0.3, 1.0, 0.2).normalize(), 1000.0);
    let spot = Light::Spot(SpotLight {
        position: from * far,
        axis: -from,
        intensity: [2.0 * far * far; 3],
        inner: 2e-3,
        outer: 2e-3,
        range: f32::INFINITY,
    });
    let lights = [&[sun(-from, 2.0)][..], &[spot][..]];
    let [direct, median, p90] = apart(&scene, lights, ["rsm=128", "rsm=128"]);
    // A metre and a half in a thousand is three in a thousand of the irradiance, and as much of the cosine on walls.
    assert!(direct < 1e-2 && median < 2e-3 && p90 < 1e-2);
}

#[test]
fn a_point_over_a_dish_is_a_spot_over_it() {
    // All of the dish is seen within 60 degrees: a spot as wide and a point send the same there, through other texels.
    let scene = room(0.5, false, 0.7);
    let position = Vec3::new(0.1, 1.5, -0.1);
    let spot = |outer: f32| {
        Light::Spot(SpotLight {
            position,
            axis: Vec3::NEG_Y,
            intensity: [2.0; 3],
            inner: outer.to_radians(),
            outer: outer.to_radians(),
            range: f32::INFINITY,
        })
    };
    for wide in [point(position, 2.0), spot(89.0)] {
        let lights = [&[wide][..], &[spot(60.0)][..]];
        let [direct, median, p90] = apart(&scene, lights, ["rsm=100", "rsm=128"]);
        // The same formula and the same numbers for one; other texels for the other.
        assert_eq!(direct, 0.0);
        assert!(median < 5e-3 && p90 < 3e-2);
    }
}

#[test]
fn clusters_of_points_and_suns_tend_to_the_sum_over_all_texels() {
    let scene = room(1.0, false, 0.7);
    for light in [
        point(Vec3::new(0.2, 0.6, -0.3), 2.0),
        sun(Vec3::new(0.5, -1.0, 0.2), 2.0),
    ] {
        let shot = lit(scene.clone(), &[light]).with("rsm=32 occlusion=none");
        let brute = shot.clone().with("method=vpl").image();
        let errors = ["lights=64", "lights=1024"].map(|lights| {
            vsgl_tests::measure::indirect_mape(&shot.clone().with(lights).image(), &brute)
        });
        println!("{light:?}: {errors:.2?} %");
        // Corners, where receivers are next to the lights, take the most lights.
        assert!(errors[1] < 3.0 && errors[1] < 0.5 * errors[0], "{errors:?}");
    }
}
