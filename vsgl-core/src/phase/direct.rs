//! Light of the lights themselves at one receiver.

use super::facing::lift;
use super::mask::any_hit;
use super::shade::{
    Colors, Incoming, Receiver, anisotropic_point, fresnel_weight, glossy_point, lambert_constant,
};
use crate::data::{LightRecord, SceneData};
use crate::geom::Ray;
use crate::math::vec::normalize;
use crate::plan::ShadePlan;
use crate::scene::SpotLight;
use crate::scene::light::window;
use crate::sg::lobe::SHARPNESS_MAX;
use glam::Vec3;

/// Most that one over the square of a distance is taken for \[1/m²\]: keeps products of it finite.
pub const STRENGTH_MAX: f32 = f32::MAX * 1e-6;

/// What a light brings to a point, shadows left aside.
pub fn incoming(light: &LightRecord, position: Vec3) -> Incoming {
    let axis = Vec3::from_array(light.axis);
    let apart = Vec3::from_array(light.position) - position;
    let distance2 = apart.dot(apart).max(f32::MIN_POSITIVE);
    let (direction, share) = if light.parallel != 0 {
        (-axis, 1.0)
    } else {
        let direction = normalize(apart);
        let falloff = SpotLight::falloff(-direction.dot(axis), light.cos_inner, light.cos_outer);
        let left = falloff * window(distance2, light.inverse_range2);
        (direction, (left / distance2).min(STRENGTH_MAX))
    };
    Incoming {
        axis: direction,
        sharpness: SHARPNESS_MAX,
        horizon: SHARPNESS_MAX,
        strength: Vec3::from_array(light.intensity) * share,
    }
}

/// Direction of a shadow ray to a light, and the parameter at its end: up to the light, or out of the scene.
pub fn way(light: &LightRecord, incoming: &Incoming, origin: Vec3) -> (Vec3, f32) {
    if light.parallel != 0 {
        (incoming.axis, f32::MAX)
    } else {
        (Vec3::from_array(light.position) - origin, 1.0)
    }
}

/// Radiance to the eye from one light \[W/(m² sr)\], with a shadow ray where it would shine.
///
/// `facing` is the geometric normal on the side of the eye. Of the plan, masks and two roughnesses matter.
pub fn radiance(
    scene: &SceneData,
    light: &LightRecord,
    receiver: &Receiver,
    facing: Vec3,
    colors: &Colors,
    plan: &ShadePlan,
) -> Vec3 {
    let incoming = incoming(light, receiver.position);
    let lambert = lambert_constant(&incoming, receiver) * std::f32::consts::FRAC_1_PI;
    let specular = if plan.anisotropic_receivers {
        anisotropic_point(&incoming, receiver)
    } else {
        glossy_point(&incoming, receiver)
    };
    let Colors { albedo, f0, f90 } = *colors;
    let fresnel = f0 + (Vec3::splat(f90) - f0) * fresnel_weight(&incoming, receiver);
    let reflected = incoming.strength * (albedo * lambert + fresnel * specular);
    if reflected == Vec3::ZERO {
        return Vec3::ZERO;
    }
    let origin = receiver.position + facing * lift(scene.lift(), receiver.position);
    let (towards, end) = way(light, &incoming, origin);
    if any_hit(scene, &Ray::new(origin, towards), end, plan.masks) {
        Vec3::ZERO
    } else {
        reflected
    }
}
