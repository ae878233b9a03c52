//! Settings, lights and camera, from what was typed and what the scene has.

use crate::args::{SceneArgs, SettingsArgs, Size, Spot, Sun};
use crate::exit::{Failure, Result};
use std::io::Read;
use std::path::Path;
use vsgl_core::glam::{DVec3, Vec3};
use vsgl_core::scene::{Camera, DirectionalLight, Light, PointLight, Scene, SpotLight};
use vsgl_core::settings::{Preset, Settings};

/// Greatest distance of an added camera or light from the scene \[m\]: squares of it fit into f32 with room to spare.
const FAR: f64 = 1e9;
/// Vertical field of view unless told otherwise [degrees].
const FOV: f64 = 45.0;
/// Longest settings file in bytes.
const SETTINGS_BYTES_MAX: u64 = 1 << 20;

/// Settings from preset, file, keys and flags, in this order; `lights` takes the place of the preset's number.
///
/// # Errors
/// [`Failure::Usage`] for an unknown key or value, [`Failure::Input`] for a settings file that cannot be read or is
/// wrong.
pub fn settings(args: &SettingsArgs, lights: Option<u32>) -> Result<Settings> {
    let preset = args.preset.as_deref().and_then(Preset::from_word);
    let mut settings = preset.unwrap_or(Preset::Default).settings();
    settings.lights = lights.unwrap_or(settings.lights);
    if let Some(path) = &args.file {
        read_settings(path, &mut settings)?;
    }
    for (key, value) in &args.set {
        settings.set(key, value)?;
    }
    for (key, value) in args.flags() {
        settings.set(key, value)?;
    }
    Ok(settings)
}

fn read_settings(path: &Path, settings: &mut Settings) -> Result<()> {
    let remedy = "give a text file with a line `key = value` for each setting";
    let mut text = String::new();
    let file = std::fs::File::open(path).map_err(|e| Failure::input(path, e, remedy))?;
    let read = file.take(SETTINGS_BYTES_MAX).read_to_string(&mut text);
    read.map_err(|e| Failure::input(path, e, remedy))?;
    for (index, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default().trim();
        if line.is_empty() {
            continue;
        }
        let at = |problem: String| {
            Failure::Input(format!("{}: line {}: {problem}", path.display(), index + 1))
        };
        let pair = line.split_once('=');
        let (key, value) = pair.ok_or_else(|| at(format!("there is no `=`; {remedy}")))?;
        let set = settings.set(key.trim(), value.trim());
        set.map_err(|e| at(e.to_string()))?;
    }
    Ok(())
}

/// The lights that shine.
pub(super) fn lights(scene: &Scene, args: &SceneArgs) -> Result<Vec<Light>> {
    let own = if args.only_added_lights {
        &[]
    } else {
        &scene.lights[..]
    };
    let mut lights = own.to_vec();
    for spot in &args.spot {
        lights.push(Light::Spot(spot_light(scene, spot)?));
    }
    for point in &args.point {
        lights.push(Light::Point(PointLight {
            position: local(scene, point.position, "point")?,
            intensity: point.intensity.map(|i| i as f32),
            range: f32::INFINITY,
        }));
    }
    lights.extend(args.sun.iter().map(directional_light));
    Ok(lights)
}

fn spot_light(scene: &Scene, spot: &Spot) -> Result<SpotLight> {
    let axis = DVec3::from(spot.target) - DVec3::from(spot.position);
    let outer = spot.outer.to_radians() as f32;
    let inner = spot.inner.unwrap_or(spot.outer).to_radians() as f32;
    Ok(SpotLight {
        position: local(scene, spot.position, "spot")?,
        axis: unit(axis),
        intensity: spot.intensity.map(|i| i as f32),
        inner: inner.min(outer),
        outer: outer.min(SpotLight::OUTER_MAX),
        range: f32::INFINITY,
    })
}

fn directional_light(sun: &Sun) -> Light {
    Light::Directional(DirectionalLight {
        axis: unit(DVec3::from(sun.direction)),
        irradiance: sun.irradiance.map(|e| e as f32),
    })
}

/// A unit vector. Scaled first: squares of a tiny or huge length would not fit.
fn unit(direction: DVec3) -> Vec3 {
    (direction / direction.abs().max_element())
        .normalize()
        .as_vec3()
}

/// A world position relative to the scene's origin.
fn local(scene: &Scene, world: [f64; 3], flag: &str) -> Result<Vec3> {
    let relative = DVec3::from(world) - scene.origin;
    if relative.abs().max_element() < FAR {
        return Ok(relative.as_vec3());
    }
    let [x, y, z] = world;
    let o = scene.origin;
    Err(Failure::Usage(format!(
        "--{flag}: {x},{y},{z} is more than {FAR:e} m from the scene, which lies around {},{},{}; give a nearer point",
        o.x, o.y, o.z
    )))
}

/// Name and place of the camera.
pub(super) fn camera(
    scene: &Scene,
    args: &SceneArgs,
    size: Size,
    warnings: &mut Vec<String>,
) -> Result<(String, Camera)> {
    if let Some(look) = &args.look_at {
        let eye = local(scene, look.eye, "look-at")?;
        let target = local(scene, look.target, "look-at")?;
        let fov = args.fov.unwrap_or(FOV).to_radians() as f32;
        return Ok(("--look-at".into(), Camera::look_at(eye, target, fov)));
    }
    if let Some(wanted) = &args.camera {
        return named_camera(scene, wanted);
    }
    if let Some((name, camera)) = scene.cameras.first() {
        return Ok((name.clone(), *camera));
    }
    warnings
        .push("no camera in the scene: one that frames all of it is used; see --look-at".into());
    Ok(("framing".into(), framing(scene, size)))
}

/// By name, and if none has it by index.
fn named_camera(scene: &Scene, wanted: &str) -> Result<(String, Camera)> {
    let cameras = &scene.cameras;
    let by_name = cameras.iter().find(|(name, _)| name == wanted);
    let by_index = || cameras.get(wanted.parse::<usize>().ok()?);
    if let Some((name, camera)) = by_name.or_else(by_index) {
        return Ok((name.clone(), *camera));
    }
    let list = |(index, (name, _)): (usize, &(String, Camera))| format!("{index} `{name}`");
    let names: Vec<_> = cameras.iter().enumerate().map(list).collect();
    let remedy = match names.is_empty() {
        true => "it has none; use --look-at".to_owned(),
        false => format!("it has {}", names.join(", ")),
    };
    Err(Failure::Usage(format!(
        "--camera: the scene has no camera `{wanted}`; {remedy}"
    )))
}

/// A camera that sees the whole scene from the front, a little from the right and from above.
fn framing(scene: &Scene, size: Size) -> Camera {
    let (low, high) = scene.bounds();
    let centre = 0.5 * (low + high);
    let radius = (0.5 * (high - low).length()).max(1e-6);
    let fov = FOV.to_radians() as f32;
    let half_height = (0.5 * fov).tan();
    let half_width = half_height * size.width as f32 / size.height as f32;
    let narrower = half_height.min(half_width).atan();
    let away = Vec3::new(0.45, 0.35, 1.0).normalize();
    let eye = centre + away * (1.05 * radius / narrower.sin());
    Camera::look_at(eye, centre, fov)
}

#[cfg(test)]
mod tests {
    use super::*;
    use vsgl_core::scene::Mesh;

    fn far_scene() -> Scene {
        Scene {
            origin: DVec3::new(1e5, 0.0, 0.0),
            mesh: Mesh {
                positions: vec![Vec3::splat(-1.0), Vec3::splat(1.0), Vec3::X],
                ..Mesh::default()
            },
            ..Scene::default()
        }
    }

    const SIZE: Size = Size {
        width: 40,
        height: 30,
    };

    #[test]
    fn world_coordinates_keep_their_digits_far_from_the_origin() {
        let args = SceneArgs {
            spot: vec![Spot::parse("100000.001,2,0:100000.001,0,0:5:30:20").expect("a spot")],
            ..SceneArgs::default()
        };
        let lights = lights(&far_scene(), &args).expect("near the scene");
        let [Light::Spot(spot)] = lights[..] else {
            panic!("one spot");
        };
        assert_eq!(
            spot.position,
            Vec3::new(1e-3, 2.0, 0.0).with_x((100_000.001f64 - 1e5) as f32)
        );
        assert_eq!(spot.axis, Vec3::NEG_Y);
        assert!(spot.inner < spot.outer);
    }

    #[test]
    fn points_beyond_all_measure_are_refused() {
        let args = SceneArgs {
            spot: vec![Spot::parse("1e300,0,0:0,0,0:5:30").expect("finite")],
            ..SceneArgs::default()
        };
        let code = lights(&far_scene(), &args).map_err(|f| f.code());
        assert_eq!(code, Err(2));
    }

    #[test]
    fn the_default_camera_sees_every_corner() {
        for size in [
            SIZE,
            Size {
                width: 10,
                height: 90,
            },
        ] {
            let scene = far_scene();
            let camera = framing(&scene, size);
            let aspect = size.width as f32 / size.height as f32;
            for &corner in &scene.mesh.positions {
                let to = corner - camera.eye;
                let depth = to.dot(camera.forward) * camera.tan_half_fov;
                assert!(to.dot(camera.up).abs() < depth);
                assert!(to.dot(camera.right).abs() < depth * aspect);
            }
        }
    }

    #[test]
    fn cameras_are_found_by_name_then_by_index() {
        let mut scene = far_scene();
        let camera = framing(&scene, SIZE);
        scene.cameras = vec![("1".into(), camera), ("b".into(), camera)];
        let name = |wanted| named_camera(&scene, wanted).map(|(name, _)| name).ok();
        assert_eq!(name("b").as_deref(), Some("b"));
        assert_eq!(name("1").as_deref(), Some("1"));
        assert_eq!(name("0").as_deref(), Some("1"));
        assert_eq!(name("2"), None);
        let mut warnings = Vec::new();
        scene.cameras.clear();
        let chosen = super::camera(&scene, &SceneArgs::default(), SIZE, &mut warnings);
        assert!(chosen.is_ok() && warnings.len() == 1);
    }

    #[test]
    fn later_sources_of_settings_win() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.txt");
        std::fs::write(&path, "# all\nlights = 10 # few\n\nrsm=64\nkernel=2\n").expect("writable");
        let args = SettingsArgs {
            preset: Some("paper-2016".into()),
            file: Some(path.clone()),
            set: vec![("rsm".into(), "128".into()), ("lights".into(), "20".into())],
            lights: Some("30".into()),
            ..SettingsArgs::default()
        };
        let found = settings(&args, Some(7)).expect("all valid");
        assert_eq!((found.lights, found.rsm, found.kernel), (30, 128, 2.0));
        assert_eq!(found.emission, Preset::Paper2016.settings().emission);
        std::fs::write(&path, "rsm = 64\nlights = many\n").expect("writable");
        let failure = settings(&args, None).map_err(|f| (f.code(), f.to_string()));
        let (code, message) = failure.expect_err("not a number");
        assert_eq!(code, 3);
        assert!(message.contains("line 2"), "{message}");
    }
}
