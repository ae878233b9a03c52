//! Animations at a time.

use super::*;
use glam::DVec3;

/// The triangle with keys at 1 and 3 seconds (accessor 2), and values (accessor 3) for its node.
fn animated(path: &str, interpolation: &str, values: &[f32], kind: &str, node: &str) -> File {
    let mut file = File::triangle();
    file.floats(&[[1.0], [3.0]], "SCALAR");
    let components = ["SCALAR", "", "VEC3", "VEC4"]
        .iter()
        .position(|k| *k == kind)
        .unwrap()
        + 1;
    file.accessor(&bytes_of(values), 5126, values.len() / components, kind);
    let animations = format!(
        r#"[{{"samplers":[{{"input":2,"output":3{interpolation}}}],
            "channels":[{{"sampler":0,"target":{{"node":0,"path":"{path}"}}}}]}}]"#
    );
    file.set("animations", &animations)
        .set("nodes", &format!(r#"[{{{node}"mesh":0}}]"#))
}

fn at(file: File, time: f64) -> Result<Scene> {
    file.load_as(&Options {
        time: Some(time),
        ..Options::default()
    })
}

const STEP: &str = r#","interpolation":"STEP""#;
const CUBIC: &str = r#","interpolation":"CUBICSPLINE""#;

#[test]
fn translations_by_every_interpolation() {
    let two = [1.0, 0.0, 0.0, 5.0, 0.0, 8.0];
    // No slope at either end: halfway in time is halfway in space, a quarter is 10 of 64 parts.
    let mut six = vec![0.0; 18];
    six[3..6].copy_from_slice(&two[..3]);
    six[12..15].copy_from_slice(&two[3..]);
    for (interpolation, values, time, expected) in [
        ("", &two[..], 0.0, [1.0, 0.0, 0.0]),
        ("", &two, 2.0, [3.0, 0.0, 4.0]),
        ("", &two, 99.0, [5.0, 0.0, 8.0]),
        (STEP, &two, 2.999, [1.0, 0.0, 0.0]),
        (STEP, &two, 3.0, [5.0, 0.0, 8.0]),
        (CUBIC, &six, 2.0, [3.0, 0.0, 4.0]),
        (CUBIC, &six, 1.5, [1.625, 0.0, 1.25]),
        (CUBIC, &six, -7.0, [1.0, 0.0, 0.0]),
    ] {
        let file = animated(
            "translation",
            interpolation,
            values,
            "VEC3",
            r#""translation":[9,9,9],"#,
        );
        let scene = at(file, time).unwrap();
        let moved = world(&scene, 0);
        assert!(
            moved.distance(DVec3::from(expected)) < 1e-6,
            "{moved} at {time}"
        );
        assert!(scene.warnings.is_empty());
    }
    let rest = animated("translation", "", &two, "VEC3", r#""translation":[9,9,9],"#);
    let rest = rest.load().unwrap();
    assert_eq!(world(&rest, 0), DVec3::splat(9.0));
    assert_eq!(
        rest.warnings,
        ["animations are ignored: the scene is shown at rest; a time can be chosen"]
    );
}

#[test]
fn slopes_of_splines_are_per_second() {
    // From 0 to 0 with a slope of 1 per second at both ends, over two seconds.
    let mut six = vec![0.0; 18];
    (six[6], six[9]) = (1.0, 1.0);
    let scene = at(animated("translation", CUBIC, &six, "VEC3", ""), 1.5).unwrap();
    let expected = 2.0 * (0.140625 - 0.046875);
    assert!((world(&scene, 0).x - expected).abs() < 1e-6);
}

#[test]
fn rotations_turn_the_shorter_way() {
    let quarter = std::f32::consts::FRAC_1_SQRT_2;
    // The same quarter about z, written with the other sign.
    let values = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -quarter, -quarter];
    let scene = at(animated("rotation", "", &values, "VEC4", ""), 2.0).unwrap();
    let eighth = std::f64::consts::FRAC_PI_4;
    assert!(world(&scene, 1).distance(DVec3::new(eighth.cos(), eighth.sin(), 0.0)) < 1e-6);
}

#[test]
fn weights_move_morph_targets() {
    for (interpolation, values) in [
        ("", &[0.0, 1.0, 1.0, 0.0][..]),
        (
            CUBIC,
            &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
        ),
    ] {
        let mut file = animated("weights", interpolation, values, "SCALAR", "");
        file.floats(&[[0.0, 0.0, 4.0]; 3], "VEC3");
        file.floats(&[[0.0, 6.0, 0.0]; 3], "VEC3");
        let mesh = r#"[{"weights":[1,1],"primitives":[{"attributes":{"POSITION":0},"indices":1,
            "targets":[{"POSITION":4},{"POSITION":5}]}]}]"#;
        let scene = at(file.set("meshes", mesh), 2.0).unwrap();
        assert_eq!(world(&scene, 0), DVec3::new(0.0, 3.0, 2.0));
    }
}

#[test]
fn the_first_of_two_channels_has_its_way() {
    let mut file = animated("scale", STEP, &[2.0, 2.0, 2.0, 3.0, 3.0, 3.0], "VEC3", "");
    let channel = r#"{"sampler":0,"target":{"node":0,"path":"scale"}}"#;
    let twice = file.json["animations"].replacen(channel, &format!("{channel},{channel}"), 1);
    let again = twice.replacen(r#""output":3"#, r#""output":0"#, 1);
    let both = format!("{},{}", &twice[..twice.len() - 1], &again[1..]);
    file.json.insert("animations", both);
    assert_eq!(world(&at(file, 1.0).unwrap(), 1), DVec3::X * 2.0);
}

#[test]
fn channels_that_move_no_node_are_no_fault() {
    let file = || {
        animated(
            "translation",
            "",
            &[1.0, 0.0, 0.0, 5.0, 0.0, 8.0],
            "VEC3",
            "",
        )
    };
    let loose = file().json["animations"].replacen(
        r#""channels":["#,
        r#""channels":[{"sampler":0,"target":{"path":"pointer"}},"#,
        1,
    );
    let scene = at(file().set("animations", &loose), 3.0).unwrap();
    assert_eq!(world(&scene, 0), DVec3::new(5.0, 0.0, 8.0));
}

#[test]
fn broken_curves_are_refused_and_empty_ones_change_nothing() {
    let file = |text: &str, with: &str| {
        let file = animated(
            "translation",
            "",
            &[1.0, 0.0, 0.0, 5.0, 0.0, 8.0],
            "VEC3",
            "",
        );
        let animations = file.json["animations"].replacen(text, with, 1);
        file.set("animations", &animations)
    };
    for (text, with, place) in [
        (
            r#""node":0"#,
            r#""node":7"#,
            "animations[0].channels[0].target.node",
        ),
        (
            r#""sampler":0"#,
            r#""sampler":7"#,
            "animations[0].channels[0].sampler",
        ),
        (
            r#""input":2"#,
            r#""input":99"#,
            "animations[0].samplers[0].input",
        ),
        (
            r#""output":3"#,
            r#""output":99"#,
            "animations[0].samplers[0].output",
        ),
        (
            r#""output":3"#,
            r#""output":3,"interpolation":"CUBICSPLINE""#,
            "animations[0].samplers[0].output",
        ),
        (
            r#""output":3"#,
            r#""output":3,"interpolation":"X""#,
            "animations[0].samplers[0].interpolation",
        ),
        (r#""output":3"#, r#""output":2"#, "accessors[2].type"),
    ] {
        let (at, message) = refused(at(file(text, with), 1.0));
        assert_eq!(at, place, "{message}");
    }
    let mut many = file("", "");
    many.push(
        "accessors",
        r#"{"componentType":5126,"count":9000000000000,"type":"SCALAR"}"#,
    );
    let animations = many.json["animations"].replacen(r#""input":2"#, r#""input":4"#, 1);
    refused(at(many.set("animations", &animations), 1.0));
    let mut none = file("", "");
    none.push(
        "accessors",
        r#"{"componentType":5126,"count":0,"type":"SCALAR"}"#,
    );
    let animations = none.json["animations"].replacen(r#""input":2"#, r#""input":4"#, 1);
    let scene = at(none.set("animations", &animations), 1.0).unwrap();
    assert_eq!(world(&scene, 0), DVec3::ZERO);
}
