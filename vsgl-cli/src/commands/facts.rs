//! What `info` and `render` both say about a job, for people and for machines.

use crate::job::{Job, settings_json};
use serde_json::{Value, json};
use vsgl_core::glam::{DVec3, Vec3};
use vsgl_core::scene::{Camera, Light};

/// Longest list that people get to see in full.
const LIST_MAX: usize = 12;

/// The scene, its lights and cameras.
pub(super) fn scene_text(job: &Job) -> String {
    let scene = &job.scene;
    let [low, high] = bounds(job);
    let mut out = format!("scene     {}\n", job.name);
    out += &format!(
        "  {} triangles, {} vertices, {}, {}\n",
        scene.mesh.triangles.len(),
        scene.mesh.positions.len(),
        count(scene.materials.len(), "material"),
        count(scene.textures.len(), "texture"),
    );
    out += &format!("  from {} to {} m\n", point(low), point(high));
    if job.facts.emitters > 0 {
        let shine = count(job.facts.emitters, "triangle");
        out +=
            &format!("  {shine} that may shine; their light is sent once, and does not bounce\n");
    }
    out += &format!("  {}\n", count(job.lights.len(), "light"));
    for (index, light) in job.lights.iter().take(LIST_MAX).enumerate() {
        out += &format!(
            "    {index} {}{}\n",
            light_name(job, index),
            light_text(job, light)
        );
    }
    if job.lights.len() > LIST_MAX {
        out += &format!("    and {} more\n", job.lights.len() - LIST_MAX);
    }
    out += &format!(
        "camera    {}: {}\n",
        job.camera,
        camera_text(job, &job.view.camera)
    );
    out
}

/// The cameras of the scene.
pub(super) fn cameras_text(job: &Job) -> String {
    let cameras = &job.scene.cameras;
    let mut out = format!("cameras   {}\n", count(cameras.len(), "camera"));
    for (index, (name, camera)) in cameras.iter().take(LIST_MAX).enumerate() {
        out += &format!("  {index} {name}: {}\n", camera_text(job, camera));
    }
    if cameras.len() > LIST_MAX {
        out += &format!("  and {} more\n", cameras.len() - LIST_MAX);
    }
    out
}

/// A line for each decision of the plan.
pub(super) fn plan_text(job: &Job) -> String {
    let mut out = "plan\n".to_owned();
    let width = job
        .plan
        .reasons
        .iter()
        .map(|r| r.topic.len())
        .max()
        .unwrap_or(0);
    for reason in &job.plan.reasons {
        let runs = if reason.runs { "yes" } else { "no " };
        out += &format!("  {:<width$}  {runs}  {}\n", reason.topic, reason.why);
    }
    out
}

/// A line for each setting.
pub(super) fn settings_text(job: &Job) -> String {
    let entries = job.settings.entries().into_iter();
    let lines = entries.map(|(key, value)| format!("  {key} = {value}\n"));
    format!("settings\n{}", lines.collect::<String>())
}

/// All of it as JSON.
pub(super) fn json(job: &Job) -> Value {
    let scene = &job.scene;
    let [low, high] = bounds(job).map(|p| p.to_array());
    let light = |(index, light): (usize, &Light)| {
        let mut light = light_json(job, light);
        light["name"] = job.light_name(index).into();
        light
    };
    let camera = |(name, camera): &(String, Camera)| camera_json(job, name, camera);
    let reason =
        |r: &vsgl_core::plan::Reason| json!({"topic": r.topic, "runs": r.runs, "why": r.why});
    json!({
        "scene": {
            "name": job.name,
            "triangles": scene.mesh.triangles.len(),
            "vertices": scene.mesh.positions.len(),
            "materials": scene.materials.len(),
            "textures": scene.textures.len(),
            "bounds": {"low": low, "high": high},
            "emitting_triangles": job.facts.emitters,
            "glossy_senders": job.facts.glossy_senders,
            "reflecting_senders": job.facts.reflecting_senders,
            "glossy_receivers": job.facts.glossy_receivers,
        },
        "lights": job.lights.iter().enumerate().map(light).collect::<Vec<_>>(),
        "camera": camera_json(job, &job.camera, &job.view.camera),
        "cameras": scene.cameras.iter().map(camera).collect::<Vec<_>>(),
        "settings": settings_json(&job.settings),
        "plan": job.plan.reasons.iter().map(reason).collect::<Vec<_>>(),
        "warnings": job.warnings,
    })
}

/// The name of a light that has one, ready for what follows.
fn light_name(job: &Job, index: usize) -> String {
    match job.light_name(index) {
        "" => String::new(),
        name => format!("{name}: "),
    }
}

/// Corners of the scene's box in world space.
fn bounds(job: &Job) -> [DVec3; 2] {
    let (low, high) = job.scene.bounds();
    [world(job, low), world(job, high)]
}

fn world(job: &Job, local: Vec3) -> DVec3 {
    local.as_dvec3() + job.scene.origin
}

fn light_text(job: &Job, light: &Light) -> String {
    match light {
        Light::Spot(spot) => format!(
            "spot at {} towards {}, {} W/sr, half angles {}° and {}°{}",
            point(world(job, spot.position)),
            point(spot.axis.as_dvec3()),
            amount(spot.intensity),
            short(f64::from(spot.inner).to_degrees()),
            short(f64::from(spot.outer).to_degrees()),
            reach(spot.range),
        ),
        Light::Point(light) => format!(
            "point at {}, {} W/sr{}",
            point(world(job, light.position)),
            amount(light.intensity),
            reach(light.range),
        ),
        Light::Directional(sun) => format!(
            "directional along {}, {} W/m²",
            point(sun.axis.as_dvec3()),
            amount(sun.irradiance),
        ),
        _ => "a light of another kind".into(),
    }
}

fn light_json(job: &Job, light: &Light) -> Value {
    match light {
        Light::Spot(spot) => json!({
            "kind": "spot",
            "position": world(job, spot.position).to_array(),
            "axis": spot.axis.to_array(),
            "intensity": spot.intensity,
            "inner_degrees": f64::from(spot.inner).to_degrees(),
            "outer_degrees": f64::from(spot.outer).to_degrees(),
            "range": range_json(spot.range),
        }),
        Light::Point(light) => json!({
            "kind": "point",
            "position": world(job, light.position).to_array(),
            "intensity": light.intensity,
            "range": range_json(light.range),
        }),
        Light::Directional(sun) => json!({
            "kind": "directional",
            "axis": sun.axis.to_array(),
            "irradiance": sun.irradiance,
        }),
        _ => json!({"kind": "other"}),
    }
}

/// One number for grey, three for colours.
fn amount(rgb: [f32; 3]) -> String {
    let [r, g, b] = rgb.map(f64::from).map(short);
    if r == g && g == b {
        r
    } else {
        format!("{r},{g},{b}")
    }
}

/// The range of a light where it has one.
fn reach(range: f32) -> String {
    match range.is_finite() {
        true => format!(", range {} m", short(f64::from(range))),
        false => String::new(),
    }
}

/// Null: the light reaches everywhere.
fn range_json(range: f32) -> Value {
    range.is_finite().then_some(range).into()
}

fn camera_text(job: &Job, camera: &Camera) -> String {
    format!(
        "at {} towards {}, {}° high",
        point(world(job, camera.eye)),
        point(camera.forward.as_dvec3()),
        short(degrees(camera))
    )
}

fn camera_json(job: &Job, name: &str, camera: &Camera) -> Value {
    json!({
        "name": name,
        "eye": world(job, camera.eye).to_array(),
        "forward": camera.forward.to_array(),
        "up": camera.up.to_array(),
        "fov_degrees": degrees(camera),
    })
}

/// Full vertical field of view.
fn degrees(camera: &Camera) -> f64 {
    2.0 * f64::from(camera.tan_half_fov).atan().to_degrees()
}

fn point(p: DVec3) -> String {
    format!("{},{},{}", short(p.x), short(p.y), short(p.z))
}

/// A number with four decimals at most.
fn short(value: f64) -> String {
    let rounded = (value * 1e4).round() / 1e4;
    // Also turns -0 into 0.
    format!("{}", rounded + 0.0)
}

/// A count with its noun.
pub(crate) fn count(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}
