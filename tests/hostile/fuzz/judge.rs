//! What a file comes to, in this process.

use super::seeds::Seed;
use crate::run::{PEAK, SECONDS};
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};
use vsgl_core::data::SceneData;
use vsgl_core::glam::Vec3;
use vsgl_core::scene::gltf::Limits;
use vsgl_core::scene::{Camera, DirectionalLight, Light, PointLight, Scene, SpotLight, gltf};
use vsgl_tests::measure;
use vsgl_tests::random::Random;
use vsgl_tests::render::Shot;
use vsgl_tests::usage::{computed, forget_peak, peak};

pub(crate) enum Outcome {
    /// An error.
    Refused,
    /// A scene without triangles.
    Empty,
    /// A picture.
    Drawn,
    /// A panic, a picture of no light, or too much of time or memory.
    Fault(String),
}

pub(crate) struct Judged {
    pub(crate) outcome: Outcome,
    /// Time that the process computed \[s\].
    pub(crate) seconds: f64,
    /// Largest resident set \[KiB\].
    pub(crate) peak: u64,
}

/// Ends the process if a file takes no end.
pub(crate) struct Watch(Arc<Mutex<Option<(Instant, String, Seed)>>>);

impl Watch {
    pub(crate) fn new() -> Self {
        let current: Arc<Mutex<Option<(Instant, String, Seed)>>> = Arc::default();
        let watched = Arc::downgrade(&current);
        thread::spawn(move || {
            while let Some(current) = watched.upgrade() {
                if let Some((start, name, mutant)) = &*current.lock().expect("no panic")
                    && start.elapsed() > Duration::from_secs(240)
                {
                    mutant.keep(0);
                    eprintln!("{name} hangs");
                    std::process::exit(1);
                }
                drop(current);
                thread::sleep(Duration::from_millis(500));
            }
        });
        Self(current)
    }

    fn set(&self, current: Option<(Instant, String, Seed)>) {
        *self.0.lock().expect("no panic") = current;
    }
}

/// Reads the file and draws what is in it.
pub(crate) fn judge(mutant: &Seed, name: &str, random: &mut Random, watch: &Watch) -> Judged {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = mutant.write(folder.path());
    watch.set(Some((Instant::now(), name.to_owned(), mutant.clone())));
    forget_peak();
    let start = Instant::now();
    let before = computed();
    let ran = catch_unwind(AssertUnwindSafe(|| match gltf::load(&path) {
        Err(error) => refusal(&error.to_string()),
        Ok(scene) if scene.mesh.triangles.is_empty() => Outcome::Empty,
        Ok(scene) => picture(scene, random),
    }));
    let seconds = match (before, computed()) {
        (Some(before), Some(after)) => after - before,
        _ => start.elapsed().as_secs_f64(),
    };
    let peak = peak().unwrap_or(0);
    watch.set(None);
    let outcome = match ran {
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str);
            let text = text.or(panic.downcast_ref::<&str>().copied());
            Outcome::Fault(format!("panics: {}", text.unwrap_or("without a word")))
        }
        Ok(fault @ Outcome::Fault(_)) => fault,
        Ok(_) if seconds > SECONDS => Outcome::Fault(format!("takes {seconds:.1} s")),
        Ok(_) if peak > PEAK => Outcome::Fault(format!("takes {} MB", peak / 1000)),
        Ok(outcome) => outcome,
    };
    fs::remove_dir_all(folder.path()).expect("writable");
    Judged {
        outcome,
        seconds,
        peak,
    }
}

fn refusal(message: &str) -> Outcome {
    let complete = message
        .rsplit_once("; ")
        .is_some_and(|(told, remedy)| told.contains(": ") && !remedy.is_empty());
    if !complete || message.contains(char::is_control) {
        return Outcome::Fault(format!("says {message:?}"));
    }
    Outcome::Refused
}

fn picture(mut scene: Scene, random: &mut Random) -> Outcome {
    if let Some(what) = broken_promise(&scene) {
        return Outcome::Fault(what);
    }
    // Fewer cannot be too many.
    if scene.mesh.triangles.len() > 2048 {
        let checked = SceneData::new(&scene).check_overlap("scene", Limits::default().overlap);
        if let Err(error) = checked {
            return refusal(&error.to_string());
        }
    }
    let (low, high) = scene.bounds();
    let size = (high - low).length().max(1e-6);
    // Cameras of the file may look elsewhere.
    if scene.cameras.is_empty() || random.bits().is_multiple_of(2) {
        let eye = 0.5 * (low + high) + Vec3::new(0.4, 0.5, 0.8) * size;
        let camera = Camera::look_at(eye, 0.5 * (low + high), 0.9);
        scene.cameras.insert(0, ("framing".into(), camera));
    }
    if scene.lights.is_empty() {
        let position = 0.5 * (low + high) + Vec3::new(-0.3, 0.9, 0.5) * size;
        let axis = (0.5 * (low + high) - position).normalize_or(Vec3::NEG_Y);
        let (intensity, range) = ([10.0; 3], f32::INFINITY);
        scene.lights.push(match random.bits() % 3 {
            0 => Light::Spot(SpotLight {
                position,
                axis,
                intensity,
                inner: 0.4,
                outer: 0.8,
                range,
            }),
            1 => Light::Point(PointLight {
                position,
                intensity,
                range,
            }),
            _ => Light::Directional(DirectionalLight {
                axis,
                irradiance: intensity,
            }),
        });
    }
    // More than a few lights only take time.
    scene.lights.truncate(4);
    let image = Shot::of(scene)
        .size(16, 16)
        .with("lights=24 rsm=16")
        .image();
    match measure::fault(&image) {
        Some(what) => Outcome::Fault(format!("in the picture {what}")),
        None => Outcome::Drawn,
    }
}

/// What a scene promises to the phases, and does not hold.
fn broken_promise(scene: &Scene) -> Option<String> {
    let mesh = &scene.mesh;
    let vertices = mesh.positions.len();
    let lengths = [
        ("normals", mesh.normals.len(), false),
        ("texcoords", mesh.texcoords.len(), true),
        ("texcoords_second", mesh.texcoords_second.len(), true),
        ("tangents", mesh.tangents.len(), true),
        ("colors", mesh.colors.len(), true),
    ];
    for (name, length, may_be_empty) in lengths {
        if length != vertices && !(may_be_empty && length == 0) {
            return Some(format!("{name}: {length} for {vertices} vertices"));
        }
    }
    let finite = mesh.positions.iter().all(|p| p.is_finite())
        && mesh
            .texcoords
            .iter()
            .chain(&mesh.texcoords_second)
            .all(|t| t.is_finite())
        && mesh
            .tangents
            .iter()
            .chain(&mesh.colors)
            .all(|v| v.is_finite());
    let unit = mesh.normals.iter().all(|n| n.is_normalized());
    let placed = mesh
        .triangles
        .as_flattened()
        .iter()
        .all(|&v| (v as usize) < vertices)
        && mesh
            .material
            .iter()
            .all(|&m| (m as usize) < scene.materials.len())
        && mesh.material.len() == mesh.triangles.len();
    let textures = scene
        .textures
        .iter()
        .all(|t| t.texels.len() as u64 == u64::from(t.width) * u64::from(t.height));
    [
        (finite, "a number is not finite"),
        (unit, "a normal is not of length 1"),
        (placed, "an index leads nowhere"),
        (textures, "a texture has not its size"),
    ]
    .into_iter()
    .find_map(|(holds, what)| (!holds).then(|| what.to_owned()))
}
