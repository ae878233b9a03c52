//! `vsgl info`.

use crate::run::Folder;
use serde_json::Value;

#[test]
fn without_a_scene_it_lists_what_there_is() {
    let folder = Folder::new();
    let text = folder.run("info").ok();
    for word in [
        "cornell",
        "paper-2016",
        "paper-2015",
        "balanced",
        "cpu",
        env!("CARGO_PKG_VERSION"),
        "bisections",
    ] {
        assert!(text.contains(word), "no {word} in\n{text}");
    }
    let document = folder.run("info --json").json();
    assert_eq!(document["schema_version"], 1);
    let samples = document["samples"].as_array().expect("a list");
    assert!(samples.iter().any(|s| s["name"] == "columns"));
    let presets = document["presets"].as_array().expect("a list");
    assert_eq!(presets[0]["settings"]["lights"], "1024");
}

#[test]
fn every_sample_has_a_plan() {
    let folder = Folder::new();
    let list = folder.run("info --json").json();
    for sample in list["samples"].as_array().expect("a list") {
        let name = sample["name"]
            .as_str()
            .expect("a string")
            .replace(":N", ":2");
        let document = folder.run(&format!("info sample:{name} --json")).json();
        assert_eq!(document["plan"][0]["topic"], "bounce", "{name}");
        assert_eq!(document["plan"][0]["runs"], true, "{name}");
        assert!(document["cameras"][0]["fov_degrees"].is_number(), "{name}");
        assert!(
            !document["lights"].as_array().expect("a list").is_empty(),
            "{name}"
        );
    }
}

fn runs(document: &Value, topic: &str) -> Option<bool> {
    let plan = document["plan"].as_array()?;
    plan.iter().find(|r| r["topic"] == topic)?["runs"].as_bool()
}

#[test]
fn the_plan_follows_the_flags() {
    let folder = Folder::new();
    let plan = |flags: &str| {
        folder
            .run(&format!("info sample:cornell --json {flags}"))
            .json()
    };
    assert_eq!(runs(&plan(""), "occlusion"), Some(true));
    assert_eq!(runs(&plan("--occlusion none"), "occlusion"), Some(false));
    assert_eq!(runs(&plan("--clustering filtered"), "pdf"), Some(true));
    assert_eq!(
        runs(&plan("--clustering filtered"), "importance"),
        Some(false)
    );
    assert_eq!(
        runs(&plan("--clustering filtered --pdf brsm"), "importance"),
        Some(true)
    );
    let dark = plan("--only-added-lights");
    assert_eq!(runs(&dark, "bounce"), Some(false));
    assert!(
        dark["warnings"][0]
            .as_str()
            .is_some_and(|w| w.contains("no light"))
    );
    let text = folder.run("info sample:cornell --occlusion none").ok();
    assert!(text.contains("passes through walls"), "{text}");
}

#[test]
fn lights_of_all_kinds_are_named() {
    let folder = Folder::new();
    let flags = "--only-added-lights --spot 1,2,3:1,0,3:4:30 --point 1,0.5,-2:1,2,3 --sun 0,-2,0:7 --sun -1,0,0:0";
    let text = folder.run(&format!("info sample:cornell {flags}")).ok();
    for line in [
        "4 lights",
        "0 spot at 1,2,3 towards 0,-1,0, 4 W/sr",
        "1 point at 1,0.5,-2, 1,2,3 W/sr",
        "2 directional along 0,-1,0, 7 W/m²",
        "3 directional along -1,0,0, 0 W/m²",
    ] {
        assert!(text.contains(line), "no `{line}` in\n{text}");
    }
    let document = folder
        .run(&format!("info sample:cornell --json {flags}"))
        .json();
    let lights = document["lights"].as_array().expect("a list");
    let kinds: Vec<_> = lights
        .iter()
        .map(|l| l["kind"].as_str().expect("a kind"))
        .collect();
    assert_eq!(kinds, ["spot", "point", "directional", "directional"]);
    assert!(lights[1]["range"].is_null());
    assert_eq!(lights[2]["irradiance"][1], 7.0);
    assert_eq!(runs(&document, "smaller maps"), Some(true));
}

#[test]
fn added_lights_and_cameras_are_where_they_were_put() {
    let folder = Folder::new();
    let flags = "--spot 1,2,3:1,0,3:4,5,6:30:20 --look-at 0,1,2:0,1,0 --fov 40";
    let document = folder
        .run(&format!("info sample:cornell --json {flags}"))
        .json();
    let light = document["lights"]
        .as_array()
        .expect("a list")
        .last()
        .expect("lights");
    let number = |value: &Value| value.as_f64().expect("a number");
    for (lane, place) in [1.0, 2.0, 3.0].into_iter().enumerate() {
        assert!((number(&light["position"][lane]) - place).abs() < 1e-6);
    }
    assert!((number(&light["axis"][1]) + 1.0).abs() < 1e-6);
    assert!((number(&light["outer_degrees"]) - 30.0).abs() < 1e-4);
    assert!((number(&document["camera"]["fov_degrees"]) - 40.0).abs() < 1e-4);
    assert!((number(&document["camera"]["eye"][2]) - 2.0).abs() < 1e-6);
}

#[test]
fn the_contents_of_a_file_are_listed() {
    let folder = Folder::new();
    let file = crate::errors::TRIANGLE
        .replacen(r#""scene": 0,"#, r#""extensionsUsed": ["EXT_nobody"],"#, 1)
        .replacen(
            r#""scenes": ["#,
            r#""scenes": [{"name": "empty", "nodes": []}, "#,
            1,
        )
        .replacen(
            r#""meshes": "#,
            r#""materials": [{"name": "chalk"}], "meshes": "#,
            1,
        )
        .replacen(r#"{"POSITION": 0}"#, r#"{"POSITION": 0}, "material": 0"#, 1);
    folder.write("a.gltf", &file);
    let document = folder.run("info a.gltf --scene 1 --json").json();
    assert_eq!(document["triangles"]["drawn"], 1);
    assert_eq!(document["triangles"]["unique"], 1);
    assert_eq!(document["bytes"]["files"], file.len() + 36);
    assert_eq!(document["bytes"]["memory"], 3 * 24 + 16);
    assert_eq!(document["extensions"]["ignored"][0], "EXT_nobody");
    assert_eq!(document["scenes"][0]["name"], "empty");
    assert_eq!(document["scenes"][1]["shown"], true);
    assert_eq!(document["materials"][0]["name"], "chalk");
    assert_eq!(document["materials"][0]["metallic"], 1.0);
    assert!(
        document["command"]
            .as_str()
            .is_some_and(|c| c.contains("--scene 1"))
    );
    let text = folder.run("info a.gltf --scene 1").ok();
    for words in ["EXT_nobody", "empty", "chalk", "1 without a name, shown"] {
        assert!(text.contains(words), "no {words} in\n{text}");
    }
    let empty = folder.run("info a.gltf --scene empty --json").json();
    assert_eq!(empty["triangles"]["drawn"], 0);
    folder.run("render a.gltf --scene empty -o a.png").failed(3);
    let message = folder.run("info a.gltf --scene 2").failed(2);
    assert!(message.contains("0 `empty`"), "{message}");
}

#[test]
fn limits_are_changed_by_their_names() {
    let folder = Folder::new();
    folder.write("a.gltf", crate::errors::TRIANGLE);
    let message = folder.run("info a.gltf --limit triangles=0").failed(3);
    assert!(message.contains("raise the limit `triangles`"), "{message}");
    let raised = folder.run("info a.gltf --limit triangles=0 --limit triangles=1 --json");
    let command = raised.json()["command"].as_str().map(str::to_owned);
    assert!(command.is_some_and(|c| c.contains("--limit triangles=1")));
    let message = folder.run("info a.gltf --limit corners=1").failed(2);
    assert!(message.contains("give one of file_bytes"), "{message}");
    folder.run("info a.gltf --limit triangles").failed(2);
    folder
        .run("info sample:cornell --limit triangles=1")
        .failed(2);
    let help = folder.run("info --help").ok();
    assert!(help.contains("texels=67108864"), "{help}");
}
