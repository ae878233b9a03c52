//! Triangles that are none, or too much.

use super::Case;
use super::Fate::{self, Drawn, Either, Refused};
use crate::file::{CORNERS, File, floats};
use serde_json::json;

pub(super) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    // One number of each attribute.
    for value in [
        f32::NAN,
        f32::from_bits(0xffc0_0001),
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        f32::MIN,
        1e30,
        1e20,
        1e10,
        1e9,
        1e6,
        f32::MIN_POSITIVE,
        1e-45,
        -0.0,
        1e-20,
    ] {
        for (view, name) in [(0, "position"), (1, "normal"), (2, "texture coordinate")] {
            let fate = if view == 0 { Either } else { Drawn };
            let file = File::sound().poke(view, 4, &value.to_le_bytes());
            cases.push(Case::of(format!("a {name} {value:e}"), &file, fate));
        }
        let count = if value.is_finite() { 24 } else { 3 };
        let all = File::sound().poke(0, 0, &floats(&vec![value; count]));
        cases.push(Case::of(format!("all positions {value:e}"), &all, Either));
        let all = File::sound().poke(1, 0, &floats(&[value; 24]));
        cases.push(Case::of(format!("all normals {value:e}"), &all, Drawn));
        let all = File::sound().poke(2, 0, &floats(&[value; 16]));
        cases.push(Case::of(
            format!("all texture coordinates {value:e}"),
            &all,
            Drawn,
        ));
        let scaled: Vec<f32> = CORNERS.iter().map(|c| c * value).collect();
        let file = File::sound().poke(0, 0, &floats(&scaled));
        cases.push(Case::of(
            format!("positions times {value:e}"),
            &file,
            Either,
        ));
        let turned: Vec<f32> = CORNERS.iter().map(|c| c + value).collect();
        let file = File::sound().poke(0, 0, &floats(&turned));
        cases.push(Case::of(format!("positions plus {value:e}"), &file, Either));
    }
    for (name, positions, fate) in shapes() {
        cases.push(Case::of(name, &File::soup(&positions), fate));
    }
    for (name, mode, fate) in [
        ("mode 7", json!(7), Refused("mode")),
        ("mode -1", json!(-1), Refused("")),
        ("mode 2^40", json!(1u64 << 40), Either),
        ("mode a text", json!("x"), Refused("")),
        ("points", json!(0), Refused("nothing to draw")),
        ("line loop", json!(2), Refused("nothing to draw")),
        ("strip", json!(5), Drawn),
        ("fan", json!(6), Drawn),
    ] {
        let file = File::sound().set("/meshes/0/primitives/0/mode", mode);
        cases.push(Case::of(name, &file, fate));
    }
    cases.extend(primitives());
    cases
}

/// Corners of triangles, three after three, with a name.
fn shapes() -> Vec<(&'static str, Vec<f32>, Fate)> {
    let copies = |one: &[f32], count: usize| one.repeat(count);
    let unit = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let tiny = unit.map(|c: f32| c * 1e-5);
    let spread = |count: i32, place: fn(i32) -> [f32; 3], size: fn(i32) -> f32| -> Vec<f32> {
        let triangle = |i| {
            let ([x, y, z], s) = (place(i), size(i));
            [x, y, z, x + s, y, z, x, y + s, z]
        };
        (0..count).flat_map(triangle).collect()
    };
    vec![
        ("one triangle", unit.to_vec(), Drawn),
        ("one point", vec![0.5; 9], Refused("nothing to draw")),
        (
            "one line",
            vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0],
            Refused("nothing to draw"),
        ),
        (
            "a needle",
            vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 1e-38, 0.0],
            Either,
        ),
        (
            "a long needle",
            vec![0.0, 0.0, 0.0, 1e8, 0.0, 0.0, 0.0, 1e-8, 0.0],
            Either,
        ),
        ("two corners", vec![0.0; 6], Refused("")),
        ("no corner", vec![], Refused("nothing to draw")),
        ("1,000 copies of a triangle", copies(&unit, 1_000), Drawn),
        (
            "20,000 copies of a triangle",
            copies(&unit, 20_000),
            Refused("one place"),
        ),
        (
            "20,000 copies of a tiny triangle",
            copies(&tiny, 20_000),
            Refused("one place"),
        ),
        // Each place twice as far as the last: as deep as a hierarchy can be made.
        (
            "powers of two",
            spread(
                60,
                |i| [2f32.powi(i / 2), 0.0, 0.0],
                |i| 2f32.powi(i / 2 - 2),
            ),
            Either,
        ),
        (
            "nested triangles",
            spread(20_000, |_| [0.0; 3], |i| 1.0 + i as f32 * 1e-3),
            Refused("one place"),
        ),
        (
            "nested triangles of all sizes",
            spread(56, |_| [0.0; 3], |i| 2f32.powi(i - 28)),
            Drawn,
        ),
        (
            "a stair of powers",
            spread(
                2_000,
                |i| [2f32.powi(i % 28), (i / 28) as f32, 0.0],
                |_| 0.5,
            ),
            Drawn,
        ),
        (
            "neighbours a rounding apart",
            spread(
                10_000,
                |i| [f32::from_bits(0x3f80_0000 + i as u32), 0.0, 0.0],
                |_| 1e-6,
            ),
            Drawn,
        ),
        (
            "far apart",
            spread(2, |i| [i as f32 * 1e9, 0.0, 0.0], |_| 1.0),
            Either,
        ),
        (
            "too far apart",
            spread(2, |i| [i as f32 * 1e30, 0.0, 0.0], |_| 1.0),
            Either,
        ),
    ]
}

/// Lists of primitives and meshes.
fn primitives() -> Vec<Case> {
    let of = |name: &str, primitives, fate| {
        Case::of(
            name,
            &File::sound().set("/meshes/0/primitives", primitives),
            fate,
        )
    };
    let sound = File::sound().json["meshes"][0]["primitives"][0].clone();
    let morphed = |targets| {
        let mut primitive = sound.clone();
        primitive["targets"] = targets;
        json!([primitive])
    };
    vec![
        of("no primitive", json!([]), Refused("nothing to draw")),
        of("primitive without attributes", json!([{}]), Refused("")),
        of(
            "no attribute",
            json!([{"attributes": {}}]),
            Refused("nothing to draw"),
        ),
        of(
            "unknown attribute",
            json!([{"attributes": {"POSITION": 0, "\u{1b}[31m": 0}}]),
            Either,
        ),
        of(
            "20,000 empty primitives",
            json!(vec![json!({"attributes": {}}); 20_000]),
            Refused("nothing to draw"),
        ),
        of(
            "20,000 primitives",
            json!(vec![sound.clone(); 20_000]),
            Refused("one place"),
        ),
        of("primitives null", json!([null]), Refused("JSON")),
        of("morph: nothing", morphed(json!([{}])), Drawn),
        of(
            "morph: not there",
            morphed(json!([{"POSITION": 99}])),
            Either,
        ),
        of(
            "morph: too short",
            morphed(json!([{"POSITION": 3}])),
            Either,
        ),
        of("morph: unknown", morphed(json!([{"JOINTS_0": 0}])), Either),
        of(
            "morph: 10,000 targets",
            morphed(json!(vec![json!({"POSITION": 0, "NORMAL": 1}); 10_000])),
            Either,
        ),
        Case::of(
            "morph: weights not fitting",
            &File::sound()
                .set("/meshes/0/primitives", morphed(json!([{"POSITION": 0}])))
                .set("/meshes/0/weights", json!(vec![1e38; 300])),
            Either,
        ),
        Case::of(
            "morph: weights out of range",
            &File::sound()
                .set(
                    "/meshes/0/primitives",
                    morphed(json!([{"POSITION": 0, "NORMAL": 1}])),
                )
                .set("/nodes/0/weights", json!([1e38])),
            Either,
        ),
        Case::of(
            "no mesh",
            &File::sound().set("/meshes", json!([])),
            Refused("nodes[0].mesh"),
        ),
    ]
}
