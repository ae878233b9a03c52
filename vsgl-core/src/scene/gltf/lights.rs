//! Lights of `KHR_lights_punctual`.

use super::document::{Document, lookup};
use super::fault::{Fault, Result, printable};
use super::nodes::Placed;
use super::warnings::Warnings;
use crate::scene::{DirectionalLight, Light, PointLight, SpotLight};
use glam::DVec3;
use gltf::json::extensions::scene::khr_lights_punctual::{self, Type};
use gltf::json::validation::Checked;
use std::f32::consts::FRAC_PI_2;

/// Lights that the nodes hold, with their names, else those of their nodes.
///
/// Intensities in candela are taken for \[W/sr\] as they stand, those in lux for \[W/m²\].
pub(super) fn collect(
    document: &Document,
    placed: &[Placed<'_>],
    origin: DVec3,
    warnings: &mut Warnings,
) -> Result<(Vec<Light>, Vec<String>)> {
    let extensions = document.root.extensions.as_ref();
    let list = extensions.and_then(|e| e.khr_lights_punctual.as_ref());
    let list = list.map_or(&[][..], |l| &l.lights);
    let (mut lights, mut names) = (Vec::new(), Vec::new());
    for place in placed {
        let extensions = place.node.extensions.as_ref();
        let Some(reference) = extensions.and_then(|e| e.khr_lights_punctual.as_ref()) else {
            continue;
        };
        let at = || {
            format!(
                "nodes[{}].extensions.KHR_lights_punctual.light",
                place.index
            )
        };
        let index = reference.light.value();
        let light = lookup(list, "lights", index, at)?;
        if let Some(read) = read(light, index, place, origin, warnings)? {
            let name = light.name.as_ref().or(place.node.name.as_ref());
            names.push(name.map_or(String::new(), |n| printable(n)));
            lights.push(read);
        }
    }
    Ok((lights, names))
}

fn read(
    light: &khr_lights_punctual::Light,
    index: usize,
    place: &Placed<'_>,
    origin: DVec3,
    warnings: &mut Warnings,
) -> Result<Option<Light>> {
    let Checked::Valid(kind) = light.type_ else {
        warnings.add("lights of unknown type are left out");
        return Ok(None);
    };
    let here = format!("extensions.KHR_lights_punctual.lights[{index}]");
    let intensity = light.color.map(|c| c * light.intensity);
    if intensity.iter().any(|i| !i.is_finite() || *i < 0.0) {
        return Err(Fault::new(
            here,
            format!("colour times intensity is {intensity:?}"),
            "finite values of at least 0 are expected",
        ));
    }
    if intensity == [0.0; 3] {
        warnings.add("lights without intensity are left out");
        return Ok(None);
    }
    let axis = place.world.transform_vector3(DVec3::NEG_Z).try_normalize();
    let (Some(axis), Some(position)) = (axis, place.position(origin)) else {
        warnings.add("lights too far off, or scaled to nothing, are left out");
        return Ok(None);
    };
    let axis = axis.as_vec3().normalize();
    let range = light.range.unwrap_or(f32::INFINITY);
    if range <= 0.0 {
        return Err(Fault::new(
            here,
            format!("range {range}"),
            "a range is greater than 0, or left out",
        ));
    }
    Ok(Some(match kind {
        Type::Spot => {
            let (inner, outer) = cone(light.spot.as_ref(), &here)?;
            Light::Spot(SpotLight {
                position,
                axis,
                intensity,
                inner,
                outer,
                range,
            })
        }
        Type::Point => Light::Point(PointLight {
            position,
            intensity,
            range,
        }),
        Type::Directional => Light::Directional(DirectionalLight {
            axis,
            irradiance: intensity,
        }),
    }))
}

/// Inner and outer half angle.
fn cone(spot: Option<&khr_lights_punctual::Spot>, here: &str) -> Result<(f32, f32)> {
    let Some(spot) = spot else {
        return Err(Fault::new(
            format!("{here}.spot"),
            "is missing",
            "a spot light needs its cone angles",
        ));
    };
    let (inner, outer) = (spot.inner_cone_angle, spot.outer_cone_angle);
    // A right angle, written with some digits, may come out a little larger.
    let in_range = (0.0..=outer).contains(&inner) && outer > 0.0 && outer <= FRAC_PI_2 + 1e-4;
    if !in_range {
        return Err(Fault::new(
            format!("{here}.spot"),
            format!("inner cone angle {inner}, outer {outer}"),
            "0 <= inner <= outer <= pi/2 is expected, and outer > 0",
        ));
    }
    let outer = outer.min(SpotLight::OUTER_MAX);
    Ok((inner.min(outer), outer))
}
