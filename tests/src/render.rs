//! From a scene to a picture in a line or two.

use std::sync::Arc;
use vsgl_core::backend::Backend;
use vsgl_core::data::{Image, SceneData};
use vsgl_core::glam::{Quat, Vec3};
use vsgl_core::plan::Plan;
use vsgl_core::render::{Frame, View, render};
use vsgl_core::scene::{Camera, Light, Scene, SceneFacts, SpotLight, samples};
use vsgl_core::settings::Settings;
use vsgl_cpu::CpuBackend;

/// A scene with everything that its picture takes. Small and cheap until told otherwise.
#[derive(Clone, Debug)]
pub struct Shot {
    /// The scene.
    pub scene: Scene,
    /// Lights that shine.
    pub lights: Vec<Light>,
    /// The camera, the size and the samples.
    pub view: View,
    /// The settings.
    pub settings: Settings,
    /// Threads of the backend. One: tests run side by side already.
    pub threads: usize,
}

impl Shot {
    /// A built-in scene, 48x27 pixels, 128 lights from 64x64 texels.
    ///
    /// # Panics
    /// If there is no such scene.
    pub fn sample(name: &str) -> Self {
        Self::of(samples::by_name(name).expect(name))
    }

    /// A scene under its own lights, seen by its first camera; otherwise as [`Shot::sample`].
    ///
    /// # Panics
    /// If it has no camera.
    pub fn of(scene: Scene) -> Self {
        let camera = scene.cameras.first().expect("a camera").1;
        Self {
            lights: scene.lights.clone(),
            view: View::new(camera, 48, 27).expect("a small picture"),
            settings: Settings {
                lights: 128,
                rsm: 64,
                ..Settings::default()
            },
            threads: 1,
            scene,
        }
    }

    /// In another size.
    #[must_use]
    pub fn size(mut self, width: u32, height: u32) -> Self {
        (self.view.width, self.view.height) = (width, height);
        self
    }

    /// With other settings: words `key=value`, parted by spaces.
    ///
    /// # Panics
    /// If a key or a value is unknown.
    #[must_use]
    pub fn with(mut self, settings: &str) -> Self {
        for word in settings.split_whitespace() {
            let (key, value) = word.split_once('=').expect("key=value");
            self.settings.set(key, value).expect(word);
        }
        self
    }

    /// Seen by another camera.
    #[must_use]
    pub fn seen_by(mut self, camera: Camera) -> Self {
        self.view.camera = camera;
        self
    }

    /// Turned, then scaled, then moved: scene, lights and camera. Intensities stay as they are.
    #[must_use]
    pub fn placed(mut self, turn: Quat, scale: f32, offset: Vec3) -> Self {
        let place = |position: &mut Vec3| *position = turn * *position * scale + offset;
        let face = |direction: &mut Vec3| *direction = (turn * *direction).normalize();
        self.scene.mesh.positions.iter_mut().for_each(place);
        self.scene.mesh.normals.iter_mut().for_each(face);
        for light in &mut self.lights {
            match light {
                Light::Spot(spot) => {
                    place(&mut spot.position);
                    face(&mut spot.axis);
                }
                Light::Point(point) => place(&mut point.position),
                Light::Directional(sun) => face(&mut sun.axis),
                _ => panic!("{light:?}"),
            }
        }
        let camera = &mut self.view.camera;
        place(&mut camera.eye);
        for direction in [&mut camera.forward, &mut camera.right, &mut camera.up] {
            face(direction);
        }
        self
    }

    /// Without the triangles that lie at the top of the scene, so that a sun shines into a room.
    #[must_use]
    pub fn open(mut self) -> Self {
        let top = self.scene.bounds().1.y;
        let mesh = &mut self.scene.mesh;
        let kept = |triangle: &[u32; 3]| {
            let corners = triangle.map(|v| mesh.positions[v as usize].y);
            corners.iter().any(|&y| y < top)
        };
        let kept: Vec<bool> = mesh.triangles.iter().map(kept).collect();
        let (mut triangles, mut materials) = (kept.iter(), kept.iter());
        mesh.triangles.retain(|_| triangles.next() == Some(&true));
        mesh.material.retain(|_| materials.next() == Some(&true));
        self
    }

    /// The spot lights that shine.
    pub fn spots(&mut self) -> impl Iterator<Item = &mut SpotLight> {
        self.lights.iter_mut().filter_map(|light| match light {
            Light::Spot(spot) => Some(spot),
            _ => None,
        })
    }

    /// What the scene contains.
    pub fn facts(&self) -> SceneFacts {
        SceneFacts::new(&self.scene, &self.lights, &self.view.camera)
    }

    /// The plan.
    ///
    /// # Panics
    /// If the settings contradict each other.
    pub fn plan(&self) -> Plan {
        Plan::new(&self.facts(), &self.settings).expect("settings that go together")
    }

    /// The picture with everything that it was made of.
    pub fn frame(&self) -> Frame<CpuBackend> {
        self.frame_by(&self.plan())
    }

    /// As [`Shot::frame`], by another plan.
    ///
    /// # Panics
    /// If it cannot be rendered.
    pub fn frame_by(&self, plan: &Plan) -> Frame<CpuBackend> {
        let backend = CpuBackend::new(self.threads).expect("threads");
        let scene: Arc<SceneData> = backend.upload(SceneData::new(&self.scene)).expect("room");
        render(&backend, &scene, &self.lights, &self.view, plan, &()).expect("a picture")
    }

    /// The picture.
    pub fn image(&self) -> Image {
        Image::clone(&self.frame().image)
    }
}
