//! What stands where the picture should go stays as it was, unless a whole new picture takes its place.

use crate::corpus::{Case, Fate};
use crate::file::File;
use crate::run::run;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

const OLD: &[u8] = b"an older picture";

/// A folder with an older picture, and a scene beside it.
fn prepared(case: &Case) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::create_dir(folder.path().join("work")).expect("writable");
    fs::write(folder.path().join("work/a.png"), OLD).expect("writable");
    fs::write(folder.path().join("work/a.exr"), OLD).expect("writable");
    let scene = case.write(&folder.path().join("scene"));
    let scene = scene.to_str().expect("a path of ASCII").to_owned();
    (folder, scene)
}

fn untouched(work: &Path, why: &str) {
    for name in ["a.png", "a.exr"] {
        assert_eq!(
            fs::read(work.join(name)).ok().as_deref(),
            Some(OLD),
            "{name} after {why}"
        );
    }
    assert_eq!(crate::names(work), ["a.exr", "a.png"], "after {why}");
}

#[test]
fn a_refused_scene_leaves_the_old_picture() {
    let cut = File::sound().to_text().split_at(300).0.as_bytes().to_vec();
    let empty = File::sound().set("/meshes/0/primitives/0/mode", 0.into());
    let missing = File::sound().set("/buffers/0/uri", "none.bin".into());
    for (why, case) in [
        ("a cut file", Case::new("s.gltf", cut, Fate::Either)),
        (
            "nothing to draw",
            Case::new("s.glb", empty.to_glb(), Fate::Either),
        ),
        (
            "a missing buffer",
            Case::new("s.gltf", missing.to_text().into_bytes(), Fate::Either),
        ),
    ] {
        let (folder, scene) = prepared(&case);
        let work = folder.path().join("work");
        let ran = run(
            &work,
            &[
                "render", &scene, "-o", "a.png", "-o", "a.exr", "--size", "8x8",
            ],
        );
        assert_eq!(ran.code, Some(3), "{why}: {}", ran.err);
        untouched(&work, why);
    }
}

/// Whenever the signal comes: while the file is read, while the scene is prepared, while the picture is drawn.
#[cfg(unix)]
#[test]
fn an_interrupted_load_leaves_the_old_picture() {
    let mut file = File::sound();
    for i in 0..6_000 {
        let apart = serde_json::json!([3 * i, 0, 0]);
        let node = file.push(
            "nodes",
            serde_json::json!({"mesh": 0, "translation": apart}),
        );
        file = file.set("/scenes/0/nodes/-", node.into());
    }
    let case = Case::new("s.glb", file.to_glb(), Fate::Either);
    let (folder, scene) = prepared(&case);
    let work = folder.path().join("work");
    let mut interrupted = 0;
    for wait in [0, 1, 2, 5, 10, 20, 50, 100, 200, 400] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_vsgl-under-test"))
            .args([
                "render",
                &scene,
                "-o",
                "a.png",
                "-o",
                "a.exr",
                "--size",
                "800x600",
                "--backend",
                "cpu",
            ])
            .current_dir(&work)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        std::thread::sleep(Duration::from_millis(wait));
        let signal = Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .status();
        assert!(signal.expect("kill is there").success());
        let status = child.wait().expect("it ends");
        // By the signal itself until there is something to tidy up, by its own code after that.
        assert!(
            matches!(status.code(), None | Some(130)),
            "{status:?} after {wait} ms"
        );
        interrupted += 1;
        untouched(&work, &format!("an interrupt after {wait} ms"));
    }
    assert_eq!(interrupted, 10);
}
