//! Bad input to `vsgl render` and `vsgl info`: message, exit code, no partial file.

use crate::run::{Folder, SMALL};

/// A triangle, and neither light nor camera.
pub(crate) const TRIANGLE: &str = r#"{
  "asset": {"version": "2.0"},
  "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                 "min": [0, 0, 0], "max": [1, 1, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36,
    "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]
}"#;

/// Runs must fail with the code, name each word in the message, and leave the folder as it was.
fn refuses(folder: &Folder, code: i32, arguments: &str, words: &[&str]) {
    let before = folder.names();
    let message = folder.run(arguments).failed(code);
    for word in words {
        assert!(
            message.contains(word),
            "{arguments}: no `{word}` in\n{message}"
        );
    }
    assert_eq!(folder.names(), before, "{arguments}");
}

#[test]
fn nonsense_in_flags_is_code_2() {
    let folder = Folder::new();
    for (flags, words) in [
        ("--size 0x0", &["--size", "WIDTHxHEIGHT"][..]),
        ("--size 1e9x1e9", &["--size"]),
        ("--size NaNxNaN", &["--size"]),
        ("--size -5x5", &["--size"]),
        ("--size 65536x65536", &["size", "samples"]),
        ("--size 60000x500 --aa 64", &["samples"]),
        ("--aa 0", &["--aa"]),
        ("--stride 0", &["--stride"]),
        ("--lights 0", &["lights", "1 to 65536"]),
        ("--lights NaN", &["lights"]),
        ("--lights -3", &["lights"]),
        ("--seed -3", &["--seed"]),
        ("--fov -3 --look-at 0,0,0:0,0,1", &["--fov"]),
        ("--point 0,0,0", &["--point", "px,py,pz:I"]),
        ("--point 0,0:5", &["--point", "no point"]),
        ("--point 0,0,0:-5", &["--point", "W/sr"]),
        ("--point 1e300,0,0:5", &["--point", "nearer"]),
        ("--sun 0,-1,0", &["--sun", "dx,dy,dz:E"]),
        ("--sun 0,0,0:5", &["--sun", "direction"]),
        ("--sun 0,-1,0:NaN", &["--sun", "W/m²"]),
        ("--method path --aa 2", &["aa", "spp"]),
        ("--method path --spp 0", &["spp", "1 to"]),
        (
            "--method path --light-sampling sg",
            &["--light-sampling", "power", "uniform"],
        ),
        ("--method path --max-depth 65", &["max_depth", "64"]),
        ("--occlusion lightmaps", &["--occlusion", "rays"]),
        ("--occlusion ism --method vpl", &["occlusion", "vpl"]),
        ("--set map_size=7", &["map_size", "8 to"]),
        ("--set map_points=0", &["map_points"]),
        ("--glossy asg", &["--glossy", "asg-2015"]),
        ("--rsm 1000000", &["rsm", "4096"]),
        ("--kernel NaN", &["kernel"]),
        ("--kernel inf", &["kernel"]),
        ("--threads 99999999", &["threads"]),
        ("--threads -1", &["--threads"]),
        ("--exposure NaN", &["--exposure", "auto"]),
        ("--tonemap aces", &["--tonemap", "neutral"]),
        ("--backend cuda", &["--backend", "cpu"]),
        ("--method photons", &["--method", "vpl"]),
        ("--clustering kmeans-image", &["--clustering", "partition"]),
        ("--preset fastest", &["--preset", "paper-2016"]),
        ("--set lights", &["KEY=VALUE"]),
        ("--set nokey=1", &["nokey", "bisections"]),
        ("--set bisections=0", &["bisections"]),
        ("--look-at 0,0,0:0,0,0", &["--look-at", "one point"]),
        ("--look-at NaN,0,0:0,0,1", &["--look-at"]),
        ("--look-at 1e30,0,0:0,0,1", &["look-at", "scene"]),
        ("--look-at 0,0,0:0,0,1 --fov 180", &["--fov"]),
        ("--fov 40", &["--look-at"]),
        ("--camera nobody", &["nobody", "main"]),
        ("--camera 7", &["7", "main"]),
        ("--spot 0,0,0:0,1,0:NaN:30", &["--spot"]),
        ("--spot 0,0,0:0,1,0:-5:30", &["--spot"]),
        ("--spot 0,0,0:0,1,0:5:95", &["--spot", "90"]),
        ("-o b.png", &["twice"]),
        ("-o b.jpg", &["b.jpg", ".png", ".exr"]),
        ("-o -", &[".png"]),
    ] {
        let arguments = format!("render -o b.png {SMALL} {flags}");
        refuses(&folder, 2, &arguments, words);
    }
    refuses(&folder, 2, "render", &["--output"]);
    refuses(
        &folder,
        2,
        "render sample:nowhere -o b.png",
        &["nowhere", "cornell"],
    );
    refuses(
        &folder,
        2,
        "render sample:many-lights:0 -o b.png",
        &["many-lights"],
    );
    refuses(&folder, 2, "info --lights 5", &["SCENE"]);
    refuses(&folder, 2, "nonsense", &["nonsense"]);
}

#[test]
fn input_that_cannot_be_read_is_code_3() {
    let folder = Folder::new();
    folder.write("empty.glb", "");
    folder.write("text.gltf", "hello");
    folder.write("cut.gltf", &TRIANGLE[..TRIANGLE.len() / 2]);
    folder.write("nothing.gltf", r#"{"asset": {"version": "2.0"}}"#);
    folder.write("bad.txt", "lights = 5\nrsm = many\n");
    for file in ["missing.glb", "empty.glb", "text.gltf", "cut.gltf", "."] {
        refuses(&folder, 3, &format!("render {file} -o b.png"), &[file]);
        refuses(&folder, 3, &format!("info {file}"), &[file]);
    }
    refuses(
        &folder,
        3,
        "render nothing.gltf -o b.png",
        &["nothing.gltf"],
    );
    refuses(
        &folder,
        3,
        "render -o b.png --settings bad.txt",
        &["bad.txt", "line 2", "rsm"],
    );
    refuses(
        &folder,
        3,
        "render -o b.png --settings missing.txt",
        &["missing.txt"],
    );
}

#[cfg(unix)]
#[test]
fn input_without_an_end_is_refused() {
    let folder = Folder::new();
    for arguments in [
        "compare /dev/zero /dev/zero",
        "render -o b.png --settings /dev/zero",
        "info /dev/zero",
    ] {
        let message = folder.run(arguments).failed(3);
        assert!(
            message.contains("/dev/zero") && message.len() < 1000,
            "{arguments}"
        );
    }
}

#[test]
fn output_that_cannot_be_written_is_code_5_before_any_work() {
    let folder = Folder::new();
    folder.write("file", "");
    std::fs::create_dir(folder.path("folder.png")).expect("writable");
    // Hours of work, were it begun.
    let slow = "--size 4000x4000 --method vpl --rsm 4096";
    refuses(
        &folder,
        5,
        &format!("render -o file/b.png {slow}"),
        &["file/b.png"],
    );
    refuses(
        &folder,
        5,
        &format!("render -o folder.png {slow}"),
        &["folder.png"],
    );
    refuses(
        &folder,
        5,
        &format!("render -o b.exr -o file/b.png {slow}"),
        &["file/b.png"],
    );
    refuses(&folder, 5, &format!("render --dump file {slow}"), &["file"]);
}

#[test]
fn a_failed_run_leaves_the_old_picture() {
    let folder = Folder::new();
    folder.write("b.png", "old");
    refuses(&folder, 3, "render missing.glb -o b.png", &[]);
    refuses(&folder, 2, "render -o b.png --threads 99999999", &[]);
    assert_eq!(folder.bytes("b.png"), b"old");
    folder.run(&format!("render -o b.png {SMALL}")).ok();
    assert_ne!(folder.bytes("b.png"), b"old");
    assert_eq!(folder.names(), ["b.png"]);
}
