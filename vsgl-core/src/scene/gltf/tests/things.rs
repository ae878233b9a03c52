//! Lights, cameras, versions, extensions.

use super::*;
use crate::scene::{Light, SpotLight};
use glam::Vec3;

fn lit(lights: &str, node: &str) -> File {
    let nodes =
        format!(r#"[{{"mesh":0}},{{{node}"extensions":{{"KHR_lights_punctual":{{"light":0}}}}}}]"#);
    File::triangle()
        .set("nodes", &nodes)
        .set("scenes", r#"[{"nodes":[0,1]}]"#)
        .set(
            "extensions",
            &format!(r#"{{"KHR_lights_punctual":{{"lights":[{lights}]}}}}"#),
        )
}

fn spot(file: File) -> (SpotLight, Vec<String>) {
    let scene = file.load().unwrap();
    let [Light::Spot(spot)] = scene.lights[..] else {
        panic!("{:?}", scene.lights);
    };
    (spot, scene.warnings)
}

#[test]
fn spots_take_place_and_direction_from_their_node() {
    let light = r#"{"type":"spot","color":[1,0.5,0],"intensity":60,
        "spot":{"innerConeAngle":0.25,"outerConeAngle":0.5}}"#;
    // Looks along -z, turned to look down; the scale must not matter.
    let node =
        r#""translation":[0.5,3,0],"rotation":[-0.70710678,0,0,0.70710678],"scale":[2,2,2],"#;
    let (spot, warnings) = spot(lit(light, node));
    assert!(spot.position.distance(Vec3::new(0.0, 2.5, 0.0)) < 1e-6);
    assert!(spot.axis.distance(Vec3::NEG_Y) < 1e-6);
    assert_eq!(spot.intensity, [60.0, 30.0, 0.0]);
    assert_eq!((spot.inner, spot.outer), (0.25, 0.5));
    assert!(warnings.is_empty());
}

#[test]
fn cones_have_defaults_hard_edges_and_a_largest_angle() {
    let (default, _) = spot(lit(r#"{"type":"spot","spot":{}}"#, ""));
    assert_eq!(
        (default.inner, default.outer),
        (0.0, std::f32::consts::FRAC_PI_4)
    );
    let hard = r#"{"type":"spot","spot":{"innerConeAngle":0.5,"outerConeAngle":0.5}}"#;
    let (hard, _) = spot(lit(hard, ""));
    assert_eq!((hard.inner, hard.outer), (0.5, 0.5));
    let wide = r#"{"type":"spot","spot":{"innerConeAngle":1.5,"outerConeAngle":1.5708}}"#;
    let (wide, warnings) = spot(lit(wide, ""));
    assert_eq!((wide.inner, wide.outer), (1.5, SpotLight::OUTER_MAX));
    assert!(warnings.is_empty());
}

#[test]
fn points_and_suns_with_and_without_range() {
    let node =
        r#""translation":[0.5,3,0],"rotation":[-0.70710678,0,0,0.70710678],"scale":[2,2,2],"#;
    let light = |text: &str| {
        let scene = lit(text, node).load().unwrap();
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
        scene.lights[0]
    };
    let Light::Point(point) = light(r#"{"type":"point","intensity":3,"color":[1,0.5,0]}"#) else {
        panic!("a point")
    };
    assert!(point.position.distance(Vec3::new(0.0, 2.5, 0.0)) < 1e-6);
    assert_eq!(
        (point.intensity, point.range),
        ([3.0, 1.5, 0.0], f32::INFINITY)
    );
    // The scale of the node has no say in the range.
    let Light::Point(point) = light(r#"{"type":"point","range":7}"#) else {
        panic!("a point")
    };
    assert_eq!((point.intensity, point.range), ([1.0; 3], 7.0));
    let Light::Directional(sun) = light(r#"{"type":"directional","intensity":5,"range":7}"#) else {
        panic!("a sun")
    };
    assert!(sun.axis.distance(Vec3::NEG_Y) < 1e-6);
    assert_eq!(sun.irradiance, [5.0; 3]);
    let (spot, _) = spot(lit(r#"{"type":"spot","spot":{},"range":0.5}"#, node));
    assert_eq!(spot.range, 0.5);
}

#[test]
fn broken_lights_are_refused() {
    let here = "extensions.KHR_lights_punctual.lights[0]";
    for cone in [
        r#"{"innerConeAngle":0.6,"outerConeAngle":0.5}"#,
        r#"{"outerConeAngle":0}"#,
        r#"{"outerConeAngle":2}"#,
        r#"{"innerConeAngle":-0.1,"outerConeAngle":0.5}"#,
    ] {
        let light = format!(r#"{{"type":"spot","spot":{cone}}}"#);
        refused_at(&format!("{here}.spot"), lit(&light, ""));
    }
    refused_at(&format!("{here}.spot"), lit(r#"{"type":"spot"}"#, ""));
    refused_at(here, lit(r#"{"type":"spot","spot":{},"intensity":-1}"#, ""));
    for range in ["0", "-3"] {
        let light = format!(r#"{{"type":"point","range":{range}}}"#);
        refused_at(here, lit(&light, ""));
    }
    let missing = "nodes[1].extensions.KHR_lights_punctual.light";
    refused_at(missing, lit("", ""));
}

#[test]
fn other_lights_are_left_out_with_a_warning() {
    for (light, warning) in [
        (r#"{"type":"area"}"#, "lights of unknown type are left out"),
        (
            r#"{"type":"spot","spot":{},"intensity":0}"#,
            "lights without intensity are left out",
        ),
    ] {
        let scene = lit(light, "").load().unwrap();
        assert!(scene.lights.is_empty());
        assert_eq!(scene.warnings, [warning]);
    }
}

#[test]
fn cameras_have_names_and_directions() {
    let camera = r#"{"type":"perspective","perspective":{"yfov":1.5707963267948966,"znear":0.1}}"#;
    let named = camera.replacen('{', r#"{"name":"lens","#, 1);
    let scene = File::triangle()
        .set("cameras", &format!("[{named},{camera},{camera}]"))
        .set(
            "nodes",
            r#"[{"mesh":0},{"camera":2},{"camera":1,"name":"stand"},
            {"camera":0,"translation":[0.5,0.5,4],"rotation":[0,0.70710678,0,0.70710678],"scale":[-1,1,1]}]"#,
        )
        .set("scenes", r#"[{"nodes":[0,1,2,3]}]"#)
        .load()
        .unwrap();
    let names: Vec<_> = scene
        .cameras
        .iter()
        .map(|(name, _)| name.as_str())
        .collect();
    assert_eq!(names, ["lens", "stand", "2"]);
    let camera = scene.cameras[0].1;
    assert!(camera.eye.distance(Vec3::Z * 4.0) < 1e-6);
    assert!(camera.forward.distance(Vec3::NEG_X) < 1e-6);
    assert!(camera.up.distance(Vec3::Y) < 1e-6);
    assert!(camera.right.distance(Vec3::NEG_Z) < 1e-6);
    assert!((camera.tan_half_fov - 1.0).abs() < 1e-6);
}

#[test]
fn cameras_that_cannot_be_used() {
    let nodes = r#"[{"mesh":0,"camera":0}]"#;
    let scene = File::triangle()
        .set("cameras", r#"[{"type":"fisheye"}]"#)
        .set("nodes", nodes)
        .load()
        .unwrap();
    assert!(scene.cameras.is_empty());
    assert_eq!(scene.warnings, ["cameras of unknown type are left out"]);
    for fov in ["0", "-1", "3.2", "1e99"] {
        let camera =
            format!(r#"[{{"type":"perspective","perspective":{{"yfov":{fov},"znear":1}}}}]"#);
        let (place, _) = refused(
            File::triangle()
                .set("cameras", &camera)
                .set("nodes", nodes)
                .load(),
        );
        assert!(
            place.starts_with("cameras[0]") || place.starts_with("JSON"),
            "{place}"
        );
    }
    refused_at("nodes[0].camera", File::triangle().set("nodes", nodes));
}

#[test]
fn required_extensions_are_all_named() {
    let file = File::triangle().set(
        "extensionsRequired",
        r#"["KHR_a","KHR_lights_punctual","EXT_b"]"#,
    );
    let (place, message) = refused(file.load());
    assert_eq!(place, "extensionsRequired");
    assert!(
        message.contains("`KHR_a`, `EXT_b` not supported"),
        "{message}"
    );
    assert!(message.contains("t.gltf"), "{message}");
}

#[test]
fn other_versions_are_refused() {
    for asset in [
        r#"{"version":"1.0"}"#,
        r#"{"version":"3.0"}"#,
        r#"{"version":"2.1","minVersion":"2.1"}"#,
        "{}",
        r#"{"version":2.0}"#,
    ] {
        let (place, _) = refused(File::triangle().set("asset", asset).load());
        assert!(place.starts_with("asset"), "{place}");
    }
    let later = r#"{"version":"2.1","minVersion":"2.0"}"#;
    assert!(File::triangle().set("asset", later).load().is_ok());
}

#[test]
fn messages_hold_no_control_characters() {
    let file = File::triangle().set("extensionsRequired", r#"["\u001b[31mred\n"]"#);
    let (_, message) = refused(file.load());
    assert!(!message.contains(char::is_control), "{message:?}");
}

#[test]
fn orthographic_cameras_are_far_behind() {
    let view = |ymag: &str| {
        let cameras = format!(
            r#"[{{"type":"orthographic","orthographic":{{"xmag":1,"ymag":{ymag},"zfar":2,"znear":1}}}}]"#
        );
        let nodes = r#"[{"mesh":0},{"camera":0,"translation":[0.5,0.5,1],"scale":[3,3,3]}]"#;
        File::triangle()
            .set("cameras", &cameras)
            .set("nodes", nodes)
            .set("scenes", r#"[{"nodes":[0,1]}]"#)
    };
    for ymag in [2.0f32, 0.001] {
        let scene = view(&ymag.to_string()).load().unwrap();
        assert_eq!(
            scene.warnings,
            ["orthographic cameras are replaced by perspective ones far behind them"]
        );
        let camera = scene.cameras[0].1;
        assert_eq!((camera.eye.x, camera.eye.y), (0.0, 0.0));
        assert_eq!(camera.forward, Vec3::NEG_Z);
        // At the place of the camera it sees as much as it should.
        let half = (camera.eye.z - 1.0) * camera.tan_half_fov;
        assert!((half / ymag - 1.0).abs() < 1e-4, "{half}");
        assert!(camera.tan_half_fov < 0.01);
    }
    for ymag in ["0", "1e38"] {
        refused_at("cameras[0].orthographic.ymag", view(ymag));
    }
}

/// A scene of one triangle, called `near`, and one of two.
fn scenes(more: &str) -> File {
    let scenes = r#"[{"name":"near","nodes":[0]},{"nodes":[0,1]},{"name":"0","nodes":[]}]"#;
    let mut file = File::triangle()
        .set("nodes", r#"[{"mesh":0},{"mesh":0,"translation":[0,0,1]}]"#)
        .set("scenes", scenes);
    file.json.remove("scene");
    if !more.is_empty() {
        file = file.set("scene", more);
    }
    file
}

#[test]
fn another_scene_can_be_chosen() {
    let choose = |wanted: Option<&str>, default: &str| {
        let options = Options {
            scene: wanted.map(String::from),
            ..Options::default()
        };
        scenes(default).load_as(&options)
    };
    for (wanted, default, shown, triangles) in [
        (None, "", 0, 1),
        (None, "1", 1, 2),
        (Some("near"), "1", 0, 1),
        (Some("1"), "", 1, 2),
        (Some("0"), "1", 2, 0),
    ] {
        let scene = choose(wanted, default).unwrap();
        assert_eq!(scene.source.scene, Some(shown));
        assert_eq!(scene.mesh.triangles.len(), triangles);
        let said = format!("scene {shown} of 3 is shown; another can be chosen");
        assert_eq!(scene.warnings.contains(&said), wanted.is_none());
        assert_eq!(scene.source.scenes, ["near", "", "0"]);
    }
    for wanted in ["far", "3", "-1", ""] {
        let error = choose(Some(wanted), "").unwrap_err();
        assert!(matches!(error, Error::Setting { .. }), "{error}");
        assert!(
            error
                .to_string()
                .contains("its scenes are 0 `near`, 1, 2 `0`"),
            "{error}"
        );
    }
    let none = File::triangle().set("scenes", "[]");
    let mut none = none.set("nodes", r#"[{"mesh":0}]"#);
    none.json.remove("scene");
    let options = Options {
        scene: Some("0".into()),
        ..Options::default()
    };
    assert!(none.load_as(&options).is_err());
}

#[test]
fn a_scene_says_where_it_comes_from() {
    let light = r#"{"name":"lamp","type":"spot","spot":{}}"#;
    let file = lit(light, "").set("extensionsUsed", r#"["KHR_lights_punctual","X"]"#);
    let file = file.set(
        "nodes",
        r#"[{"mesh":0,"children":[2]},
        {"extensions":{"KHR_lights_punctual":{"light":0}}},{"mesh":0,"translation":[0,0,1]}]"#,
    );
    let bytes = (file.text().len() + file.bin.len()) as u64;
    let scene = file.load().unwrap();
    let source = &scene.source;
    assert_eq!(source.bytes, bytes);
    assert_eq!(source.extensions_used, ["KHR_lights_punctual", "X"]);
    assert_eq!(source.extensions_ignored, ["X"]);
    assert_eq!(
        (source.unique_triangles, scene.mesh.triangles.len()),
        (1, 2)
    );
    assert_eq!(source.lights, ["lamp"]);
    assert_eq!(scene.memory_bytes(), 6 * 24 + 2 * 16);
}
