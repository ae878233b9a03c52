//! Cameras.

use super::assemble::Geometry;
use super::document::{Document, lookup};
use super::fault::{Fault, Result, printable};
use super::nodes::{LARGEST, Placed};
use super::warnings::Warnings;
use crate::scene::Camera;
use glam::DVec3;
use gltf::json::camera::{Orthographic, Perspective, Type};
use gltf::json::validation::Checked;

/// How far behind an orthographic camera the eye of its stand-in is, in radii of the scene or half heights of the view,
/// whichever is larger: lines of sight at the edge of the picture are then half a degree from parallel, and positions
/// lose seven of 24 bits on the way.
const AWAY: f64 = 128.0;

/// Cameras that the nodes hold, in the order of the file's cameras, with the name of the camera, else of its node, else
/// its number in this list.
pub(super) fn collect(
    document: &Document,
    placed: &[Placed<'_>],
    geometry: &Geometry,
    warnings: &mut Warnings,
) -> Result<Vec<(String, Camera)>> {
    let mut found = Vec::new();
    for place in placed {
        let Some(index) = place.node.camera.map(|c| c.value()) else {
            continue;
        };
        let at = || format!("nodes[{}].camera", place.index);
        let source = lookup(&document.root.cameras, "cameras", index, at)?;
        let (tangent, behind) = match (&source.type_, &source.perspective, &source.orthographic) {
            (Checked::Valid(Type::Perspective), Some(lens), _) => (half_field(lens, index)?, 0.0),
            (Checked::Valid(Type::Orthographic), _, Some(view)) => {
                warnings
                    .add("orthographic cameras are replaced by perspective ones far behind them");
                let half = half_height(view, index)?;
                let away = AWAY * half.max(geometry.radius);
                ((half / away) as f32, away)
            }
            _ => {
                warnings.add("cameras of unknown type are left out");
                continue;
            }
        };
        let Some(camera) = camera(tangent, behind, place, geometry.origin) else {
            warnings.add("cameras too far off, or scaled to nothing, are left out");
            continue;
        };
        let name = source.name.as_ref().or(place.node.name.as_ref());
        found.push((index, name.map(|name| printable(name)), camera));
    }
    found.sort_by_key(|&(index, ..)| index);
    let named = |(i, (_, name, camera)): (usize, (usize, Option<String>, Camera))| {
        (name.unwrap_or_else(|| i.to_string()), camera)
    };
    Ok(found.into_iter().enumerate().map(named).collect())
}

/// Tangent of half the vertical field of view.
fn half_field(lens: &Perspective, index: usize) -> Result<f32> {
    let fov = lens.yfov;
    if fov > 0.0 && fov < std::f32::consts::PI {
        return Ok((0.5 * fov).tan());
    }
    Err(Fault::new(
        format!("cameras[{index}].perspective.yfov"),
        format!("{fov} is no field of view"),
        "an angle between 0 and pi is expected",
    ))
}

/// Half the height that an orthographic camera sees \[m\]. Scales of nodes have no say in it.
fn half_height(view: &Orthographic, index: usize) -> Result<f64> {
    // A negative one would turn the picture over, which nobody means.
    let half = f64::from(view.ymag.abs());
    if half > 1e-30 && half < LARGEST {
        return Ok(half);
    }
    Err(Fault::new(
        format!("cameras[{index}].orthographic.ymag"),
        format!("{} is no height of a view", view.ymag),
        "a length above 0 is expected",
    ))
}

/// A camera where a node is, `behind` it by so much.
fn camera(tan_half_fov: f32, behind: f64, place: &Placed<'_>, origin: DVec3) -> Option<Camera> {
    let forward = place
        .world
        .transform_vector3(DVec3::NEG_Z)
        .normalize_or_zero();
    let right = forward
        .cross(place.world.transform_vector3(DVec3::Y))
        .normalize_or_zero();
    let eye = place.world.w_axis.truncate() - origin - forward * behind;
    if right == DVec3::ZERO || eye.abs().max_element() > LARGEST {
        return None;
    }
    Some(Camera {
        eye: eye.as_vec3(),
        forward: forward.as_vec3().normalize(),
        right: right.as_vec3().normalize(),
        up: right.cross(forward).as_vec3().normalize(),
        tan_half_fov,
    })
}
