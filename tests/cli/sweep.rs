//! `vsgl sweep`: what it leaves, and that it goes on where it stopped.

use crate::run::Folder;
use serde_json::Value;

const SWEEP: &str = "sweep --backend cpu --size 48x32 --rsm 32 --spp 64 --runs 1 --grid lights=4,16 --grid interleave=1,2";

#[test]
fn a_sweep_leaves_its_points_and_is_not_done_twice() {
    let folder = Folder::new();
    let document = folder.run(&format!("{SWEEP} -o s --json")).json();
    let points = document["points"].as_array().expect("a list").clone();
    assert_eq!(points.len(), 4);
    assert!(points.iter().any(|p| p["front"] == true));
    for point in &points {
        let file = point["picture"].as_str().expect("a name");
        assert!(folder.bytes(&format!("s/{file}")).starts_with(b"\x89PNG"));
        let errors = &point["errors"]["indirect"]["8"];
        assert!(
            errors["mape"].as_f64().is_some_and(|e| e > 0.0),
            "{point:#}"
        );
        assert_eq!(errors["not_finite"], 0);
        let command = point["command"].as_str().expect("text");
        assert!(command.starts_with("vsgl render ") && command.contains("--rsm 32"));
    }
    let noise = &document["reference"]["noise"]["whole"]["8"]["mape"];
    assert!(noise.as_f64().is_some_and(|e| e > 0.0 && e < 100.0));
    let table = String::from_utf8(folder.bytes("s/sweep.csv")).expect("text");
    assert_eq!(table.lines().count(), 5);
    let reference = folder.bytes("s/reference.exr");
    let page = String::from_utf8(folder.bytes("s/report.html")).expect("text");
    for point in &points {
        let row = format!("<tr data-id=\"{}\">", point["id"].as_str().expect("text"));
        // In the table of all, and in that of the front if it is there.
        let tables = 1 + usize::from(point["front"] == true);
        assert_eq!(page.matches(&row).count(), tables, "{row}");
    }
    // The usual value of a setting that other points state.
    assert!(page.contains("<th scope=\"col\">interleave</th>") && page.contains("<td>1</td>"));
    assert!(page.contains("id=\"reference\""));

    // One point is lost and measured anew; the others stay as they were.
    let lines = String::from_utf8(folder.bytes("s/sweep.jsonl")).expect("text");
    let kept: Vec<&str> = lines.lines().take(4).collect();
    folder.write("s/sweep.jsonl", kept.join("\n") + "\n{\"id\": \"cut sh");
    let again = folder.run(&format!("{SWEEP} -o s --json")).json();
    let again = again["points"].as_array().expect("a list");
    for (again, point) in again.iter().zip(&points).take(3) {
        // Whether it is on the front depends on the time of the one that was measured anew.
        let kept = |point: &Value| {
            let mut point = point.clone();
            point["front"].take();
            point
        };
        assert_eq!(kept(again), kept(point));
    }
    assert_eq!(again[3]["id"], points[3]["id"]);
    assert_eq!(again[3]["errors"], points[3]["errors"]);
    assert_eq!(folder.bytes("s/reference.exr"), reference);
}

#[test]
fn a_folder_belongs_to_one_sweep() {
    let folder = Folder::new();
    folder.run(&format!("{SWEEP} -o s")).ok();
    let before = folder.bytes("s/sweep.jsonl");
    let message = folder
        .run(
            &format!("sample:columns {SWEEP} -o s")
                .replace("sample:columns sweep", "sweep sample:columns"),
        )
        .failed(5);
    assert!(
        message.contains("sweep.jsonl") && message.contains("another"),
        "{message}"
    );
    assert_eq!(folder.bytes("s/sweep.jsonl"), before);
}

#[test]
fn times_of_phases_add_up_to_the_frame() {
    let folder = Folder::new();
    let sweep = "sweep --backend cpu --threads 2 --size 320x180 --spp 2 --runs 3 --grid lights=64,256 -o s --json";
    let document = folder.run(sweep).json();
    for point in document["points"].as_array().expect("a list") {
        let Some(frame) = point["cpu"]["median"].as_f64() else {
            println!("skipped: this system does not tell processor times");
            return;
        };
        let phases = point["phases"].as_array().expect("a list");
        let sum: f64 = phases.iter().filter_map(|p| p["cpu"].as_f64()).sum();
        println!("phases {sum:.4} s, frame {frame:.4} s");
        assert!((sum / frame - 1.0).abs() < 0.05, "{point:#}");
    }
}

#[test]
fn a_scene_is_not_swept_over_what_it_does_not_have() {
    let folder = Folder::new();
    // No light bounces: every combination is the same.
    let document = folder
        .run(&format!("{SWEEP} --only-added-lights -o s --json"))
        .json();
    assert_eq!(document["points"].as_array().map(Vec::len), Some(1));
    let left_out = document["left_out"].as_array().expect("a list");
    assert_eq!(left_out.len(), 3);
    assert!(left_out.iter().all(|l: &Value| l["why"].is_string()));
}

#[test]
fn bad_grids_are_refused_before_any_work() {
    let folder = Folder::new();
    for (words, told) in [
        ("--grid lights=0", "lights"),
        ("--grid nothing=1", "nothing"),
        ("--grid lights", "lights"),
        ("--grid lights=4 --grid lights=8", "twice"),
        ("--runs 0", "--runs"),
        ("--longest 0", "--longest"),
    ] {
        let message = folder.run(&format!("sweep -o s {words}")).failed(2);
        assert!(message.contains(told), "{words}: {message}");
    }
    folder.run("sweep nowhere.glb -o s").failed(3);
    folder.run("sweep").failed(2);
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}
