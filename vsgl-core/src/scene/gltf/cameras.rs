//! Cameras.

use super::document::{Document, lookup};
use super::fault::{Fault, Result};
use super::nodes::Placed;
use super::warnings::Warnings;
use crate::scene::Camera;
use glam::DVec3;
use gltf::json::camera::{Perspective, Type};
use gltf::json::validation::Checked;

/// Perspective cameras that the nodes hold, in the order of the file's cameras, with the name of the camera, else of
/// its node, else its number in this list.
pub(super) fn collect(
    document: &Document,
    placed: &[Placed<'_>],
    origin: DVec3,
    warnings: &mut Warnings,
) -> Result<Vec<(String, Camera)>> {
    let mut found = Vec::new();
    for place in placed {
        let Some(index) = place.node.camera.map(|c| c.value()) else {
            continue;
        };
        let at = || format!("nodes[{}].camera", place.index);
        let source = lookup(&document.root.cameras, "cameras", index, at)?;
        let perspective = match (&source.type_, &source.perspective) {
            (Checked::Valid(Type::Perspective), Some(perspective)) => perspective,
            _ => {
                warnings.add("cameras that are not perspective are left out");
                continue;
            }
        };
        let Some(camera) = camera(perspective, index, place, origin)? else {
            warnings.add("cameras too far off, or scaled to nothing, are left out");
            continue;
        };
        let name = source.name.as_ref().or(place.node.name.as_ref());
        found.push((index, name.cloned(), camera));
    }
    found.sort_by_key(|&(index, ..)| index);
    let named = |(i, (_, name, camera)): (usize, (usize, Option<String>, Camera))| {
        (name.unwrap_or_else(|| i.to_string()), camera)
    };
    Ok(found.into_iter().enumerate().map(named).collect())
}

fn camera(
    perspective: &Perspective,
    index: usize,
    place: &Placed<'_>,
    origin: DVec3,
) -> Result<Option<Camera>> {
    let fov = perspective.yfov;
    if !(fov > 0.0 && fov < std::f32::consts::PI) {
        return Err(Fault::new(
            format!("cameras[{index}].perspective.yfov"),
            format!("{fov} is no field of view"),
            "an angle between 0 and pi is expected",
        ));
    }
    let forward = place
        .world
        .transform_vector3(DVec3::NEG_Z)
        .normalize_or_zero();
    let right = forward
        .cross(place.world.transform_vector3(DVec3::Y))
        .normalize_or_zero();
    let Some(eye) = place.position(origin).filter(|_| right != DVec3::ZERO) else {
        return Ok(None);
    };
    Ok(Some(Camera {
        eye,
        forward: forward.as_vec3().normalize(),
        right: right.as_vec3().normalize(),
        up: right.cross(forward).as_vec3().normalize(),
        tan_half_fov: (0.5 * fov).tan(),
    }))
}
