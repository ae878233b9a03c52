//! Light of the lights themselves at one receiver.

use super::facing::lift;
use super::shade::{Colors, Incoming, Receiver, fresnel_weight, glossy_point, lambert_constant};
use crate::data::SceneData;
use crate::geom::{Ray, any_hit};
use crate::math::vec::normalize;
use crate::scene::{Light, SpotLight};
use crate::sg::lobe::SHARPNESS_MAX;
use glam::Vec3;

/// What a light brings to a point, shadows left aside.
pub fn incoming(light: &Light, position: Vec3) -> Incoming {
    let Light::Spot(SpotLight {
        position: source,
        axis,
        intensity,
        inner,
        outer,
    }) = *light;
    let apart = source - position;
    let distance2 = apart.dot(apart).max(f32::MIN_POSITIVE);
    let direction = normalize(apart);
    let falloff = SpotLight::falloff(-direction.dot(axis), inner.cos(), outer.cos());
    Incoming {
        axis: direction,
        sharpness: SHARPNESS_MAX,
        horizon: SHARPNESS_MAX,
        strength: Vec3::from_array(intensity) * (falloff / distance2).min(f32::MAX * 1e-6),
    }
}

/// Radiance to the eye from one light \[W/(m² sr)\], with a shadow ray where it would shine.
///
/// `facing` is the geometric normal on the side of the eye.
pub fn radiance(
    scene: &SceneData,
    light: &Light,
    receiver: &Receiver,
    facing: Vec3,
    colors: &Colors,
) -> Vec3 {
    let Light::Spot(SpotLight {
        position: source, ..
    }) = *light;
    let incoming = incoming(light, receiver.position);
    let lambert = lambert_constant(&incoming, receiver) * std::f32::consts::FRAC_1_PI;
    let specular = glossy_point(&incoming, receiver);
    let Colors { albedo, f0, f90 } = *colors;
    let fresnel = f0 + (Vec3::splat(f90) - f0) * fresnel_weight(&incoming, receiver);
    let reflected = incoming.strength * (albedo * lambert + fresnel * specular);
    if reflected == Vec3::ZERO {
        return Vec3::ZERO;
    }
    let origin = receiver.position + facing * lift(scene.lift(), receiver.position);
    let ray = Ray::new(origin, source - origin);
    if any_hit(&scene.node, &scene.corner, &ray, 1.0) {
        Vec3::ZERO
    } else {
        reflected
    }
}
