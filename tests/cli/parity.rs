//! `vsgl parity` on this machine's first adapter.

use crate::adapters::adapters;
use crate::run::{Folder, Ran, SMALL};
use serde_json::Value;

#[test]
fn every_phase_is_named_and_the_verdict_is_the_exit_code() {
    let folder = Folder::new();
    if adapters(&folder).is_empty() {
        return;
    }
    let bounce: &[&str] = &["gbuffer", "rsm", "shade", "resolve", "frame"];
    let dark: &[&str] = &["gbuffer", "shade", "resolve", "frame"];
    for (plan, expected) in [("--method vpl", bounce), ("--only-added-lights", dark)] {
        let command = format!("parity {SMALL} {plan}");
        let ran = Ran::of(&mut folder.command_with_drivers(&format!("{command} --json")));
        let document: Value = serde_json::from_str(&ran.out).expect("one document");
        let passed = document["passed"].as_bool().expect("a verdict");
        assert_eq!(ran.code, Some(i32::from(!passed)), "{}", ran.err);
        let tiers = document["tiers"].as_array().expect("a list");
        assert!(!tiers.is_empty());
        for tier in tiers {
            let hardware = tier["tier"] == "hardware";
            assert!(hardware || tier["passed"] == true, "{tier:#}");
            let steps = tier["steps"].as_array().expect("a list");
            let stages: Vec<_> = steps.iter().filter_map(|s| s["stage"].as_str()).collect();
            assert_eq!(stages, expected);
            let columns = steps[0]["columns"].as_array().expect("a list");
            assert_eq!(columns[0]["entries"], 16 * 9);
        }
        let text = Ran::of(&mut folder.command_with_drivers(&command)).out;
        for word in ["gbuffer.triangle", "image.depth", "tested     wgpu"] {
            assert!(text.contains(word), "no {word} in\n{text}");
        }
    }
}

#[test]
fn bad_arguments_are_refused_before_any_work() {
    let folder = Folder::new();
    let message = folder.run("parity nowhere.glb").failed(3);
    assert!(message.contains("nowhere.glb"));
    folder.run(&format!("parity {SMALL} -o a.exr")).failed(2);
    let message = folder
        .run(&format!("parity {SMALL} --primary raster"))
        .failed(2);
    assert!(message.contains("--primary"), "{message}");
    folder
        .run(&format!("parity {SMALL} --threads 99999999"))
        .failed(2);
}

#[test]
fn pictures_of_the_differences_are_written() {
    let folder = Folder::new();
    if adapters(&folder).is_empty() {
        return;
    }
    let run = |output: &str| {
        let command = format!("parity {SMALL} --method vpl -o {output}");
        let ran = Ran::of(&mut folder.command_with_drivers(&command));
        assert!(ran.out.contains(output), "{}", ran.err);
    };
    run("a.png");
    assert_eq!(folder.names(), ["a.png"]);
    run("d");
    let names: Vec<String> = std::fs::read_dir(folder.path("d"))
        .expect("a folder")
        .map(|e| {
            e.expect("readable")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    for stage in [
        "gbuffer-gbuffer",
        "rsm-rsm",
        "shade-radiance",
        "frame-image",
    ] {
        let suffix = format!("{stage}.png");
        assert!(names.iter().any(|n| n.ends_with(&suffix)), "{names:?}");
    }
}
