//! Scenes made in code, with the lights and the camera that they are meant to be seen by.
//!
//! All are rooms of a few metres, closed on every side, so that no light is lost where nobody looks. They ship with
//! the program: a first picture and most tests need no file.

mod builder;
mod caustic_ring;
mod columns;
mod cornell;
mod glossy_floor;
mod many_lights;
mod roughness_row;

use super::Scene;
use crate::error::{Error, Result};
use builder::Builder;

pub use many_lights::LIGHTS_MAX;

/// Names of the scenes, as after `sample:`.
pub const NAMES: &[&str] = &{
    let mut names = [""; SAMPLES.len()];
    let mut i = 0;
    while i < names.len() {
        names[i] = SAMPLES[i].name;
        i += 1;
    }
    names
};

/// The scene of this name: one of [`NAMES`], with a number in the place of an `N`.
///
/// Every scene has at least one light and exactly one camera, called `main`.
///
/// # Errors
/// [`Error::Setting`] for an unknown name or a number out of range.
pub fn by_name(name: &str) -> Result<Scene> {
    let (stem, argument) = match name.split_once(':') {
        Some((stem, argument)) => (stem, Some(argument)),
        None => (name, None),
    };
    let Some(sample) = SAMPLES.iter().find(|s| stem_of(s.name) == stem) else {
        return Err(unknown(name));
    };
    let builder = match (&sample.make, argument) {
        (Make::Fixed(make), None) => make(),
        (Make::Fixed(_), Some(_)) => return Err(unknown(name)),
        (Make::Counted(make), argument) => make(light_count(argument)?),
    };
    Ok(builder.finish(name))
}

/// One line about the scene of this name; none for an unknown one.
pub fn describe(name: &str) -> Option<&'static str> {
    SAMPLES.iter().find(|s| s.name == name).map(|s| s.about)
}

struct Sample {
    name: &'static str,
    about: &'static str,
    make: Make,
}

enum Make {
    Fixed(fn() -> Builder),
    Counted(fn(u32) -> Builder),
}

const SAMPLES: &[Sample] = &[
    Sample {
        name: "cornell",
        about: "coloured walls, a copper block and a varnished floor under one spot",
        make: Make::Fixed(cornell::scene),
    },
    Sample {
        name: "glossy-floor",
        about: "matte boards mirrored in a brushed metal floor",
        make: Make::Fixed(glossy_floor::scene),
    },
    Sample {
        name: "columns",
        about: "a hall of columns under a slanting spot: shadows that only indirect light fills",
        make: Make::Fixed(columns::scene),
    },
    Sample {
        name: "caustic-ring",
        about: "a ring, steel inside, that gathers the light of a spot on the floor in it",
        make: Make::Fixed(caustic_ring::scene),
    },
    Sample {
        name: "roughness-row",
        about: "metal spheres of rising roughness between matte walls",
        make: Make::Fixed(roughness_row::scene),
    },
    Sample {
        name: "many-lights:N",
        about: "a gallery under a grid of N spots, one map each",
        make: Make::Counted(many_lights::scene),
    },
];

/// The name without its number.
fn stem_of(name: &str) -> &str {
    name.split_once(':').map_or(name, |(stem, _)| stem)
}

fn light_count(argument: Option<&str>) -> Result<u32> {
    argument
        .and_then(|a| a.parse().ok())
        .filter(|n| (1..=LIGHTS_MAX).contains(n))
        .ok_or_else(|| {
            Error::setting(
                "SCENE",
                format!("`many-lights` with `{}` lights", argument.unwrap_or("")),
                format!(
                    "write `many-lights:N` with N from 1 to {LIGHTS_MAX}; each light costs a map of its own"
                ),
            )
        })
}

fn unknown(name: &str) -> Error {
    Error::setting(
        "SCENE",
        format!("no sample `{name}`"),
        format!("samples are {}", NAMES.join(", ")),
    )
}

#[cfg(test)]
mod tests;
