//! Views of the ground truth: their scenes, and their reference pictures.

use crate::render::Shot;
use std::path::Path;
use vsgl_cli::input;
use vsgl_core::glam::{DVec3, Vec3};
use vsgl_core::metrics::{Plane, luminance};
use vsgl_core::scene::{Camera, Light, SpotLight, gltf};

/// Size of the references.
const SIZE: (u32, u32) = (320, 180);

/// Names of the views.
pub const VIEWS: [&str; 4] = ["room_spot", "cornell", "zdm2", "breakfast"];

/// The view of this name: 1024 lights from 512² texels, one sample in the middle of a pixel.
///
/// # Panics
/// If the folder `root` of the assets has no such view, or its scene cannot be read.
pub fn shot(root: &Path, name: &str) -> Shot {
    let text = std::fs::read_to_string(root.join("ground-truth/views.json")).expect("views.json");
    let views: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let view = &views[name];
    let field = |key: &str| view[key].as_str();
    let mut scene = gltf::load(&root.join(field("scene").expect("a scene"))).expect(name);
    // The references hold the light of the view's spot alone: emissive materials do not shine in them.
    for material in &mut scene.materials {
        material.emission = [0.0; 3];
    }
    if let Some(words) = field("light") {
        scene.lights = vec![light(words, scene.origin)];
    }
    if let Some(words) = field("camera") {
        scene
            .cameras
            .insert(0, ("view".into(), camera(words, scene.origin)));
    }
    Shot::of(scene)
        .size(SIZE.0, SIZE.1)
        .with("lights=1024 rsm=512")
}

/// Numbers parted by commas.
fn numbers(text: &str) -> Vec<f64> {
    text.split(',')
        .map(|n| n.parse().expect("a number"))
        .collect()
}

fn vector(text: &str) -> DVec3 {
    DVec3::from_slice(&numbers(text))
}

/// `eye/target/vertical field of view in degrees`.
fn camera(words: &str, origin: DVec3) -> Camera {
    let parts: Vec<&str> = words.split('/').collect();
    let [eye, target] = [0, 1].map(|i| (vector(parts[i]) - origin).as_vec3());
    Camera::look_at(eye, target, (numbers(parts[2])[0] as f32).to_radians())
}

/// `spot:position:direction:intensity:inner:outer`, half angles in degrees.
fn light(words: &str, origin: DVec3) -> Light {
    let parts: Vec<&str> = words.split(':').collect();
    let intensity: Vec3 = vector(parts[3]).as_vec3();
    Light::Spot(SpotLight {
        position: (vector(parts[1]) - origin).as_vec3(),
        axis: vector(parts[2]).normalize().as_vec3(),
        intensity: intensity.to_array(),
        inner: (numbers(parts[4])[0] as f32).to_radians(),
        outer: (numbers(parts[5])[0] as f32).to_radians(),
        range: f32::INFINITY,
    })
}

/// Luminances of a reference.
///
/// # Panics
/// If the folder `root` of the assets has no such picture.
pub fn reference(root: &Path, name: &str, kind: &str) -> Plane {
    let path = root.join(format!("ground-truth/{name}_{kind}.exr"));
    let picture = input::read(&path).expect("an EXR file").picture;
    assert_eq!((picture.width, picture.height), SIZE);
    let [r, g, b] = ["R", "G", "B"].map(|channel| {
        let channel = picture.channels.iter().find(|c| c.name == channel);
        &channel.expect("three colours").values
    });
    let values = (0..r.len()).map(|i| luminance([r[i], g[i], b[i]]));
    Plane::new(SIZE.0, SIZE.1, values.collect()).expect("as many values")
}
