//! The command that makes the same picture again, and the settings that go into files.

use super::Job;
use crate::args::{SceneArgs, SettingsArgs};
use crate::commands::SCHEMA_VERSION;
use serde_json::{Map, Value, json};
use vsgl_core::glam::DVec3;
use vsgl_core::scene::Camera;
use vsgl_core::settings::Settings;

/// Arguments that choose a scene, its lights and a camera.
pub(super) fn scene_words(name: &str, args: &SceneArgs) -> Vec<String> {
    let mut words = vec![name.to_owned()];
    if let Some(part) = &args.part {
        words.extend(["--scene".into(), part.clone()]);
    }
    if let Some(time) = args.time {
        words.push(format!("--time={time}"));
    }
    for (limit, value) in &args.limit {
        words.extend(["--limit".into(), format!("{limit}={value}")]);
    }
    if let Some(camera) = &args.camera {
        words.extend(["--camera".into(), camera.clone()]);
    }
    if let Some(look) = &args.look_at {
        words.push(format!("--look-at={look}"));
    }
    if let Some(fov) = args.fov {
        words.extend(["--fov".into(), fov.to_string()]);
    }
    words.extend(args.spot.iter().map(|spot| format!("--spot={spot}")));
    words.extend(args.point.iter().map(|point| format!("--point={point}")));
    words.extend(args.sun.iter().map(|sun| format!("--sun={sun}")));
    if args.only_added_lights {
        words.push("--only-added-lights".into());
    }
    words
}

impl Job {
    /// The words after `vsgl` that do this job again with another command in front: resolved, so that they need
    /// neither preset nor settings file.
    pub fn words(&self) -> Vec<String> {
        self.words_for(&self.settings)
    }

    /// As [`Job::words`], with other settings.
    pub fn words_for(&self, settings: &Settings) -> Vec<String> {
        let mut words = self.scene_words.clone();
        let view = &self.view;
        words.extend(["--size".into(), format!("{}x{}", view.width, view.height)]);
        for (flag, value) in [("--aa", view.aa), ("--stride", view.stride)] {
            if value != 1 {
                words.extend([flag.into(), value.to_string()]);
            }
        }
        if self.seed != 0 {
            words.extend(["--seed".into(), self.seed.to_string()]);
        }
        let usual = Settings::default().entries();
        for ((key, value), (_, usual)) in settings.entries().into_iter().zip(usual) {
            if value == usual {
                continue;
            }
            if SettingsArgs::FLAGS.contains(&key) {
                let flag = key.replace('_', "-");
                words.extend([format!("--{flag}"), value]);
            } else {
                words.extend(["--set".into(), format!("{key}={value}")]);
            }
        }
        words
    }

    /// All that decides the pixels, for the metadata of a file.
    pub fn metadata(&self, backend: &str) -> Map<String, Value> {
        let view = &self.view;
        let document = json!({
            "schema_version": SCHEMA_VERSION,
            "scene": self.name,
            "arguments": self.scene_words,
            "width": view.width,
            "height": view.height,
            "aa": view.aa,
            "stride": view.stride,
            "seed": self.seed,
            "backend": backend,
            "settings": settings_json(&self.settings),
        });
        match document {
            Value::Object(map) => map,
            _ => Map::new(),
        }
    }

    /// World to camera space for row vectors, row by row: x right, y up, z towards the viewer.
    pub fn world_to_camera(&self) -> [f32; 16] {
        world_to_camera(&self.view.camera, self.scene.origin)
    }
}

fn world_to_camera(camera: &Camera, origin: DVec3) -> [f32; 16] {
    let axes = [camera.right, camera.up, -camera.forward].map(|a| a.as_dvec3());
    let eye = camera.eye.as_dvec3() + origin;
    let mut matrix = [0.0; 16];
    for (column, axis) in axes.into_iter().enumerate() {
        matrix[column] = axis.x as f32;
        matrix[4 + column] = axis.y as f32;
        matrix[8 + column] = axis.z as f32;
        matrix[12 + column] = -axis.dot(eye) as f32;
    }
    matrix[15] = 1.0;
    matrix
}

/// All settings with their values.
pub fn settings_json(settings: &Settings) -> Value {
    let entries = settings.entries().into_iter();
    Value::Object(entries.map(|(k, v)| (k.to_owned(), v.into())).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use vsgl_core::glam::Vec3;

    #[test]
    fn the_matrix_moves_the_eye_to_zero_and_the_view_to_minus_z() {
        let camera = Camera::look_at(Vec3::new(1.0, 2.0, 3.0), Vec3::new(4.0, 2.0, 3.0), 1.0);
        let matrix = world_to_camera(&camera, DVec3::new(10.0, 0.0, 0.0));
        let times = |p: [f32; 3]| {
            [0, 1, 2].map(|c| {
                p[0] * matrix[c] + p[1] * matrix[4 + c] + p[2] * matrix[8 + c] + matrix[12 + c]
            })
        };
        assert_eq!(times([11.0, 2.0, 3.0]), [0.0; 3]);
        assert_eq!(times([16.0, 3.0, 3.0]), [0.0, 1.0, -5.0]);
    }
}
