//! Small scenes at the edge.

use vsgl_core::glam::{Quat, Vec3};
use vsgl_core::scene::{Camera, Light, Material, Mesh, Scene, SpotLight, samples};
use vsgl_core::settings::{Preset, Settings};
use vsgl_tests::measure::fault;
use vsgl_tests::render::Shot;

/// A cheap picture of a built-in scene.
pub(crate) fn sample(name: &str) -> Shot {
    cheap(samples::by_name(name).expect(name))
}

fn cheap(scene: Scene) -> Shot {
    Shot::of(scene).size(32, 18).with("lights=32 rsm=32")
}

/// Cornell with one thing changed.
pub(crate) fn changed(change: impl FnOnce(&mut Shot)) -> Shot {
    let mut shot = sample("cornell");
    change(&mut shot);
    shot
}

/// Cornell with every material changed.
pub(crate) fn materials(change: impl Fn(&mut Material)) -> Shot {
    changed(|shot| shot.scene.materials.iter_mut().for_each(change))
}

/// Everything multiplied in size, the light's intensity as it is.
pub(crate) fn scaled(factor: f32) -> Shot {
    changed(|_| ()).placed(Quat::IDENTITY, factor, Vec3::ZERO)
}

/// Triangles, a material, a spot at `light` that shines at the origin, and an eye.
pub(crate) fn made(corners: &[[Vec3; 3]], material: Material, light: Vec3, eye: Vec3) -> Shot {
    let mut mesh = Mesh::default();
    for (i, triangle) in corners.iter().enumerate() {
        let [a, b, c] = *triangle;
        let normal = (b - a).cross(c - a).normalize_or(Vec3::Y);
        mesh.positions.extend(triangle);
        mesh.normals.extend([normal; 3]);
        mesh.triangles.push([0, 1, 2].map(|k| 3 * i as u32 + k));
        mesh.material.push(0);
    }
    cheap(Scene {
        mesh,
        materials: vec![material],
        lights: vec![Light::Spot(SpotLight {
            position: light,
            axis: (Vec3::ZERO - light).normalize_or(Vec3::NEG_Z),
            intensity: [10.0; 3],
            inner: 0.5,
            outer: 0.6,
            range: f32::INFINITY,
        })],
        cameras: vec![("main".into(), Camera::look_at(eye, Vec3::ZERO, 1.0))],
        ..Scene::default()
    })
}

/// A square of half side 1 that faces upwards.
pub(crate) fn floor() -> [[Vec3; 3]; 2] {
    let at = |x, z| Vec3::new(x, 0.0, z);
    [
        [at(-1.0, -1.0), at(-1.0, 1.0), at(1.0, 1.0)],
        [at(-1.0, -1.0), at(1.0, 1.0), at(1.0, -1.0)],
    ]
}

/// The settings that every scene is rendered with: presets with and without rays, all methods and clusterings.
pub(crate) fn common() -> Vec<(String, Settings)> {
    let mut all = Vec::new();
    for &preset in Preset::ALL {
        for words in ["occlusion=rays", "occlusion=none"] {
            all.push((format!("{preset} {words}"), with(preset.settings(), words)));
        }
    }
    for words in [
        "method=vpl",
        "occlusion=ism map_points=512",
        "occlusion=ism-tessellated map_size=16",
        "method=path spp=2 max_depth=5",
        "method=path spp=1 light_sampling=uniform",
        "clustering=filtered",
        "clustering=whole",
        "clustering=filtered pdf=uniform",
        "clustering=filtered pdf=brsm camera_lights=64",
        "clustering=filtered-box",
        "clustering=filtered-original",
        "clustering=nearest-world",
        "interleave=4",
        "interleave=2 occlusion=sampled",
        "interleave=2 occlusion=ism map_points=512",
    ] {
        all.push((words.into(), with(Settings::default(), words)));
    }
    all
}

fn with(mut settings: Settings, words: &str) -> Settings {
    for (key, value) in words.split_whitespace().filter_map(|w| w.split_once('=')) {
        settings.set(key, value).expect(words);
    }
    settings
}

/// Renders with all common settings, with the shot's own numbers; every layer must be light. The mean luminance of the
/// first picture's indirect light.
pub(crate) fn sound(name: &str, shot: &Shot) -> f64 {
    let mut first = None;
    for (words, settings) in common() {
        let mut shot = shot.clone();
        shot.settings = Settings {
            lights: shot.settings.lights,
            rsm: shot.settings.rsm,
            kernel: shot.settings.kernel,
            ..settings
        };
        let image = shot.image();
        if let Some(fault) = fault(&image) {
            panic!("{name}, {words}: {fault}");
        }
        let indirect = image.indirect();
        let sum: f64 = indirect.iter().map(|c| f64::from(c[1])).sum();
        first.get_or_insert(sum / indirect.len() as f64);
    }
    first.expect("some settings")
}
