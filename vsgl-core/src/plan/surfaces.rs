//! What is read of surfaces.

use super::SurfacePlan;
use super::reasons::Reasons;
use crate::scene::{SceneFacts, SurfaceFacts};

/// What is read of the surfaces that the camera sees, and of those that the lights see.
pub(super) fn surfaces(
    facts: &SceneFacts,
    lit: bool,
    reasons: &mut Reasons,
) -> (SurfacePlan, SurfacePlan) {
    let sent = if lit {
        facts.sent
    } else {
        SurfaceFacts::default()
    };
    let seen = facts.seen;
    let mut either = |topic, [seen, sent]: [bool; 2], without: &str, with: &str| {
        reasons.decide(topic, &[(seen || sent, without)], with);
        [seen, sent]
    };
    let textures = either(
        "texture reads",
        [seen.textures, sent.textures],
        "no surface that is seen or reflects light has a texture",
        "surfaces that are seen or reflect light have textures",
    );
    let normal_maps = either(
        "normal maps",
        [seen.normal_maps, sent.normal_maps],
        "no surface that is seen or reflects light has one",
        "surfaces that are seen or reflect light have them",
    );
    let colors = either(
        "vertex colours",
        [seen.colors, sent.colors],
        "no surface that is seen or reflects light has them",
        "surfaces that are seen or reflect light have them",
    );
    let unlit = either(
        "unlit surfaces",
        [seen.unlit, sent.unlit],
        "every surface that is seen or reflects light is lit",
        "they show their colour and reflect nothing",
    );
    let emission = either(
        "emission",
        [seen.emission || seen.unlit, false],
        "no surface in front of the camera shines by itself",
        "surfaces in front of the camera shine by themselves",
    );
    let masks = reasons.decide(
        "alpha masks",
        &[(facts.masks, "no surface has one")],
        "rays pass where surfaces are left out by their masks",
    );
    let plan = |i: usize| SurfacePlan {
        textures: textures[i],
        normal_maps: normal_maps[i],
        colors: colors[i],
        unlit: unlit[i],
        emission: emission[i],
        masks,
        ..SurfacePlan::default()
    };
    (plan(0), plan(1))
}
