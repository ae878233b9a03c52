//! Paths of light where the answer is known.
//!
//! Each test asks whether a mean over sixteen independent pictures is within five of its standard errors, and what the scene
//! itself is off, of the truth: a sound tracer fails one of them with a chance of 1.6e-4 (Student's t with 15 degrees of
//! freedom) when its seeds are changed, and never while they are not.

use super::emitters::{ALBEDO as FLOOR, irradiance, room};
use super::furnace::{ALBEDO, RADIUS, sphere};
use std::f64::consts::PI;
use vsgl_core::backend::Backend;
use vsgl_core::data::{Image, SceneData};
use vsgl_core::glam::{DVec3, Vec2, Vec3};
use vsgl_core::math::sobol::hash;
use vsgl_core::metrics::luminance;
use vsgl_core::plan::Plan;
use vsgl_core::scene::{Filter, Light, Material, PointLight, Texture, TextureRef};
use vsgl_core::settings::LightSampling;
use vsgl_core::trace::{Paths, pieces};
use vsgl_cpu::CpuBackend;
use vsgl_tests::chance::{Estimate, pictures};
use vsgl_tests::render::Shot;

const PICTURES: u32 = 16;
const ERRORS: f64 = 5.0;

fn mean(layer: &[[f32; 3]]) -> f64 {
    layer.iter().map(|&c| luminance(c)).sum::<f64>() / layer.len() as f64
}

fn estimate(shot: &Shot, plan: &Plan, value: impl Fn(&Image) -> f64) -> Estimate {
    let values: Vec<f64> = pictures(shot, plan, PICTURES).iter().map(value).collect();
    Estimate::of(&values)
}

/// In a matte sphere each bounce brings the same everywhere, and the next has the albedo's share of it.
#[test]
fn bounces_in_an_integrating_sphere_add_up() {
    let maps = Shot::of(sphere()).with("rsm=256 lights=1").frame().rsm;
    let flux: f64 = maps
        .expect("a bounce")
        .diffuse
        .iter()
        .map(|d| f64::from(d[1]))
        .sum();
    let albedo = f64::from(ALBEDO);
    let once = albedo / PI * flux / (4.0 * PI * f64::from(RADIUS * RADIUS));
    for (depth, bounces) in [(3, 1), (4, 2), (12, 10)] {
        let shot = Shot::of(sphere()).with(&format!("method=path spp=16 max_depth={depth}"));
        let found = estimate(&shot, &shot.plan(), |i| mean(&i.indirect()));
        let exact: f64 = (0..bounces).map(|k| once * albedo.powi(k)).sum();
        println!("depth {depth}: {found:?} for {exact}");
        // Facets lie up to 0.06 % inside the sphere.
        let allowed = ERRORS * found.error + 0.003 * exact;
        assert!((found.mean - exact).abs() < allowed, "depth {depth}");
        assert!(
            found.error < 0.01 * exact,
            "depth {depth}: too much noise to tell"
        );
    }
}

#[test]
fn a_lamp_over_a_floor_is_its_integral() {
    let shot = Shot::of(room()).with("method=path spp=16 max_depth=2");
    let seen = shot.frame().gbuffer;
    let exact: Vec<Option<f64>> = (0..seen.triangle.len())
        .map(|i| {
            let [x, y, z, _] = seen.position[i].map(f64::from);
            let floor = seen.normal[i][1] > 0.5 && y.abs() < 1e-3 && x.abs().max(z.abs()) < 1.9;
            floor.then(|| FLOOR / PI * 2.0 * irradiance(DVec3::new(x, 0.0, z)))
        })
        .collect();
    let ratio = |image: &Image| {
        let pairs = image.direct.iter().zip(&exact);
        let ratios: Vec<f64> = pairs
            .filter_map(|(found, exact)| Some(f64::from(found[1]) / (*exact)?))
            .collect();
        assert!(ratios.len() > 500, "{} pixels of floor", ratios.len());
        ratios.iter().sum::<f64>() / ratios.len() as f64
    };
    for emitters in [true, false] {
        let mut plan = shot.plan();
        plan.path.as_mut().expect("paths").emitters = emitters;
        let found = estimate(&shot, &plan, ratio);
        println!("points of the lamp drawn: {emitters}: {found:?}");
        // Pixels see a piece of floor, not its middle alone.
        let allowed = ERRORS * found.error + 0.003;
        assert!((found.mean - 1.0).abs() < allowed, "{emitters}");
        // Drawing points of the lamp pays.
        assert!(found.error < if emitters { 0.002 } else { 0.02 });
    }
}

/// Points drawn from surfaces that shine, and directions that find them: two ways to the same light.
#[test]
fn both_ways_to_surfaces_that_shine_bring_the_same() {
    let mut shot = Shot::sample("cornell").with("method=path spp=64 max_depth=4");
    let scene = &mut shot.scene;
    let texcoord = |i: usize| Vec2::new((i % 3) as f32, (i % 5) as f32 / 4.0);
    scene.mesh.texcoords = (0..scene.mesh.positions.len()).map(texcoord).collect();
    scene.textures = vec![Texture {
        width: 2,
        height: 2,
        texels: vec![[255; 4], [40, 0, 200, 255], [0, 0, 0, 255], [0, 255, 0, 10]],
    }];
    let pattern = TextureRef {
        filter: Filter::Nearest,
        ..TextureRef::new(0)
    };
    // Walls that shine on both sides through a mask, beside others that mirror.
    for material in [0, 1] {
        scene.materials[material] = Material {
            emission: [3.0, 2.0, 1.0],
            double_sided: true,
            emissive_texture: Some(pattern),
            base_color_texture: Some(pattern),
            alpha_cutoff: Some(0.5),
            ..scene.materials[material].clone()
        };
    }
    shot.lights.clear();
    let plan = shot.plan();
    let mut blind = plan.clone();
    blind.path.as_mut().expect("paths").emitters = false;
    type Layer = fn(&Image) -> f64;
    let layers: [(&str, Layer); 2] = [
        ("direct", |i| mean(&i.direct)),
        ("indirect", |i| mean(&i.indirect())),
    ];
    for (name, layer) in layers {
        let both = estimate(&shot, &plan, layer);
        let one = estimate(&shot, &blind, layer);
        println!("{name}: {both:?}, by directions alone {one:?}");
        let error = both.error.hypot(one.error);
        assert!((both.mean - one.mean).abs() < ERRORS * error, "{name}");
        assert!(error < 0.02 * one.mean, "{name}: too much noise to tell");
    }
}

/// Lights of very different power, one of them dark: however they are drawn, the mean is the sum of what each of them brings.
#[test]
fn drawn_lights_bring_what_all_of_them_bring() {
    let point = |x: f32, intensity: f32| {
        Light::Point(PointLight {
            position: Vec3::new(x, 0.6, 0.1),
            intensity: [intensity; 3],
            range: f32::INFINITY,
        })
    };
    let mut shot = Shot::sample("cornell");
    let own = shot.lights[0];
    shot.lights = vec![own, point(0.3, 0.02), point(-0.3, 3.0), point(0.0, 0.0)];
    let value = |image: &Image| mean(&image.direct) + mean(&image.indirect());
    let exact: Vec<Estimate> = shot.lights[..3]
        .iter()
        .map(|&light| {
            let mut alone = shot.clone().with("method=path spp=32");
            alone.lights = vec![light];
            estimate(&alone, &alone.plan(), value)
        })
        .collect();
    let sum: f64 = exact.iter().map(|e| e.mean).sum();
    let errors = exact.iter().map(|e| e.error).fold(0.0, f64::hypot);
    for sampling in LightSampling::WORDS {
        let words = format!("method=path spp=64 light_sampling={sampling}");
        let shot = shot.clone().with(&words);
        let found = estimate(&shot, &shot.plan(), value);
        println!("{sampling}: {found:?} for {sum} ± {errors}");
        let error = found.error.hypot(errors);
        assert!((found.mean - sum).abs() < ERRORS * error, "{sampling}");
        assert!(error < 0.03 * sum, "{sampling}: too much noise to tell");
    }
}

/// Lamps of very different power and size, beside each other.
#[test]
fn drawn_lamps_bring_what_all_of_them_bring() {
    let mut shot = Shot::sample("cornell").with("method=path spp=64 max_depth=3");
    for (material, emission) in [(0, 30.0), (1, 0.02), (2, 0.5)] {
        shot.scene.materials[material].emission = [emission, 0.5 * emission, 0.1];
    }
    shot.lights.clear();
    let plan = shot.plan();
    let mut blind = plan.clone();
    blind.path.as_mut().expect("paths").emitters = false;
    let value = |image: &Image| mean(&image.direct) + mean(&image.indirect());
    let exact = estimate(&shot, &blind, value);
    for sampling in LightSampling::ALL {
        let mut plan = plan.clone();
        plan.path.as_mut().expect("paths").light_sampling = *sampling;
        let found = estimate(&shot, &plan, value);
        println!("{sampling}: {found:?}, by directions alone {exact:?}");
        let error = found.error.hypot(exact.error);
        assert!((found.mean - exact.mean).abs() < ERRORS * error);
        assert!(error < 0.02 * exact.mean, "too much noise to tell");
    }
}

/// Any split into parts has the bits of the whole, whichever order they are put together in.
#[test]
fn parts_of_a_picture_add_up_to_its_bits() {
    let shot = Shot::sample("cornell").with("method=path spp=44");
    let whole = shot.image();
    let plan = shot.plan();
    let backend = CpuBackend::new(1).expect("threads");
    let scene = backend.upload(SceneData::new(&shot.scene)).expect("room");
    let paths = Paths {
        backend: &backend,
        scene: &scene,
        lights: &shot.lights,
        view: &shot.view,
        plan: &plan,
    };
    let layers = paths.layers(&()).expect("a view");
    for seed in 0..4 {
        let mut parts = vec![paths.sums(); 3];
        let mut pieces: Vec<_> = pieces(0..44, 44).expect("whole").collect();
        pieces.sort_by_key(|piece| hash(piece.start ^ hash(seed)));
        for piece in pieces {
            let part = hash(piece.start + 100 * seed) as usize % parts.len();
            paths.add(piece, &mut parts[part], &()).expect("a backend");
        }
        let mut all = paths.sums();
        for part in &parts {
            all.merge(part).expect("of one size");
        }
        assert_eq!(all.samples(), 44);
        assert_eq!(all.mean(layers.image.clone()), whole, "{seed}");
    }
}

#[test]
fn a_picture_does_not_depend_on_how_its_samples_are_shared_out() {
    let whole = Shot::sample("cornell").with("method=path spp=24");
    let threads = Shot {
        threads: 3,
        ..whole.clone()
    };
    assert_eq!(whole.image(), threads.image());
    // The first eight samples of many are those of eight.
    let few = whole.clone().with("spp=8").image();
    let more = whole.clone().with("spp=16").image();
    assert_ne!(few.direct, more.direct);
    let again = whole.with("spp=8").image();
    assert_eq!(few, again);
}
