//! `vsgl render` with good input.

use crate::errors::TRIANGLE;
use crate::run::{Folder, SMALL};
use serde_json::Value;
use vsgl_cli::input;
use vsgl_cli::picture::Picture;

fn exr(folder: &Folder, name: &str) -> Picture {
    input::read(&folder.path(name)).expect("readable").picture
}

#[test]
fn the_first_command_needs_nothing_but_an_output() {
    let folder = Folder::new();
    let report = folder.run(&format!("render -o a.png {SMALL}")).ok();
    assert!(
        report.starts_with("vsgl render sample:cornell "),
        "{report}"
    );
    for word in ["bounce", "shade", "a.png", "triangles"] {
        assert!(report.contains(word), "no {word} in\n{report}");
    }
    assert_eq!(folder.names(), ["a.png"]);
    let picture = exr(&folder, "a.png");
    assert_eq!((picture.width, picture.height), (16, 9));
    let lit = picture
        .rgb("")
        .expect("colours")
        .iter()
        .filter(|p| p[1] > 0.01)
        .count();
    assert!(lit > 16 * 9 / 2, "{lit} pixels are lit");
}

#[test]
fn an_exr_has_every_layer_and_they_add_up() {
    let folder = Folder::new();
    folder.run(&format!("render -o new/dir/a.exr {SMALL}")).ok();
    let picture = exr(&folder, "new/dir/a.exr");
    let layer = |name: &str| {
        picture
            .rgb(name)
            .unwrap_or_else(|| panic!("no layer {name}"))
    };
    let (all, direct, indirect) = (layer(""), layer("direct"), layer("indirect"));
    let (diffuse, glossy) = (layer("indirect_diffuse"), layer("indirect_glossy"));
    for i in 0..all.len() {
        for c in 0..3 {
            assert!((all[i][c] - direct[i][c] - indirect[i][c]).abs() <= 1e-6 * all[i][c]);
            assert_eq!(indirect[i][c], diffuse[i][c] + glossy[i][c]);
        }
    }
    assert!(indirect.iter().any(|p| p[0] > 0.0));
    for channel in ["albedo.R", "N.X", "N.Y", "N.Z", "Z"] {
        assert!(picture.channel(channel).is_some(), "no channel {channel}");
    }
    assert!(
        picture
            .channel("Z")
            .is_some_and(|z| z.iter().all(|&z| z > 0.0))
    );
}

#[test]
fn equal_pictures_are_equal_files_for_any_number_of_threads() {
    let folder = Folder::new();
    for (name, threads) in [("a", 1), ("b", 3), ("c", 1)] {
        let outputs = format!("-o {name}.png -o {name}.exr --threads {threads}");
        folder.run(&format!("render {outputs} {SMALL} --aa 2")).ok();
    }
    for other in ["b", "c"] {
        for suffix in ["png", "exr"] {
            let (a, b) = (format!("a.{suffix}"), format!("{other}.{suffix}"));
            assert!(folder.bytes(&a) == folder.bytes(&b), "{a} and {b} differ");
        }
    }
}

#[test]
fn the_reported_command_makes_the_same_picture() {
    let folder = Folder::new();
    folder.write(
        "settings.txt",
        "rsm = 16\nlights = 9\nvariance = trace # as printed\n",
    );
    let flags = "--preset paper-2016 --settings settings.txt --set sharpness=banerjee --lights 7 \
                 --size 20x10 --stride 3 --aa 2 --seed 5 --look-at -1,1,2:0,1,-1 --fov 60 \
                 --spot -1,1.5,2:0,0,0:3,2,1:40:10 --only-added-lights --exposure -1 --tonemap none";
    let first = folder
        .run(&format!("render -o a.png {flags} --json"))
        .json();
    let command = first["command"].as_str().expect("a string");
    let picture = folder.bytes("a.png");
    std::fs::remove_file(folder.path("a.png")).expect("written");
    std::fs::remove_file(folder.path("settings.txt")).expect("written");
    let again = folder.run(command.strip_prefix("vsgl ").expect("of this program"));
    assert!(again.ok().starts_with(&format!("{command}\n")));
    assert!(folder.bytes("a.png") == picture);
    assert_eq!(first["settings"]["lights"], "7");
    assert_eq!(first["settings"]["sharpness"], "banerjee");
    assert_eq!(first["settings"]["variance"], "trace");
    assert_eq!(first["settings"]["diffuse"], "constant");
    assert_eq!(first["seed"], 5);
    assert_eq!((&first["width"], &first["height"]), (&7.into(), &4.into()));
}

#[test]
fn a_stride_takes_every_nth_pixel_of_the_full_picture() {
    let folder = Folder::new();
    let flags = "--rsm 16 --lights 8 --size 16x9";
    folder.run(&format!("render -o full.exr {flags}")).ok();
    folder
        .run(&format!("render -o few.exr {flags} --stride 4"))
        .ok();
    let (full, few) = (exr(&folder, "full.exr"), exr(&folder, "few.exr"));
    assert_eq!((few.width, few.height), (4, 3));
    let (full, few) = (
        full.rgb("").expect("colours"),
        few.rgb("").expect("colours"),
    );
    for y in 0..3 {
        for x in 0..4 {
            assert_eq!(few[y * 4 + x], full[4 * y * 16 + 4 * x]);
        }
    }
}

#[test]
fn json_is_all_that_is_printed() {
    let folder = Folder::new();
    let ran = folder.run(&format!("render -o a.png -o a.exr {SMALL} --json"));
    assert_eq!(ran.err, "");
    let document = ran.json();
    assert_eq!(document["schema_version"], 1);
    assert_eq!(document["backend"], "cpu");
    assert_eq!(document["backend_reason"], "no GPU found");
    assert_eq!(document["phase_clock"], "host");
    assert_eq!(document["scene"]["name"], "sample:cornell");
    let files = document["outputs"].as_array().expect("a list");
    assert_eq!(files.len(), 2);
    assert!(files[0]["exposure"].is_number() && files[1]["exposure"].is_null());
    let phases = document["phases"].as_array().expect("a list");
    assert!(
        phases
            .iter()
            .any(|p| p["phase"] == "shade" && p["seconds"].is_number())
    );
    let plan = document["plan"].as_array().expect("a list");
    assert!(
        plan.iter()
            .all(|p| p["runs"].is_boolean() && p["why"].is_string())
    );
}

#[test]
fn quiet_is_quiet_and_verbose_shows_settings() {
    let folder = Folder::new();
    let ran = folder.run(&format!("render -q -o a.png {SMALL} --only-added-lights"));
    assert_eq!(
        (ran.code, ran.out.as_str(), ran.err.as_str()),
        (Some(0), "", "")
    );
    let report = folder.run(&format!("render -v -o a.png {SMALL}")).ok();
    assert!(report.contains("bisections = 12"), "{report}");
}

#[test]
fn progress_goes_to_standard_error_and_only_when_wanted() {
    let folder = Folder::new();
    let lines = folder.run(&format!("render -o a.png {SMALL} --progress always"));
    assert!(lines.err.contains("shade"), "{}", lines.err);
    assert!(!lines.ok().contains("..."));
    let none = folder.run(&format!("render -o a.png {SMALL} --backend cpu"));
    assert_eq!(none.err, "");
}

#[test]
fn a_scene_without_light_is_black_and_says_so() {
    let folder = Folder::new();
    for flags in [
        "--only-added-lights",
        "--only-added-lights --spot 0,1,0:0,0,0:0:40",
    ] {
        let ran = folder.run(&format!("render -o a.png -o a.exr {SMALL} {flags}"));
        if !flags.contains("--spot") {
            assert!(ran.err.contains("no light"), "{}", ran.err);
        }
        ran.ok();
        for name in ["a.png", "a.exr"] {
            let pixels = exr(&folder, name).rgb("").expect("colours");
            assert!(pixels.iter().all(|p| *p == [0.0; 3]), "{name} with {flags}");
        }
    }
}

#[test]
fn brute_force_and_every_choice_of_a_setting_render() {
    let folder = Folder::new();
    for flags in [
        "--method vpl",
        "--preset paper-2016",
        "--preset paper-2015",
        "--clustering whole --diffuse sg-product --glossy blend",
        "--clustering filtered --pdf flux --kernel 2",
        "--clustering filtered --pdf uniform",
        "--clustering filtered --pdf brsm --set camera_lights=64",
        "--emission sg --diffuse 2024 --glossy asg-2013",
        "--occlusion none --glossy ndf-filter-2024",
        "--backend cpu --diffuse constant --set sharpness=toksvig",
    ] {
        folder.run(&format!("render -o a.exr {SMALL} {flags}")).ok();
        let pixels = exr(&folder, "a.exr").rgb("indirect").expect("colours");
        let sound = |p: &[f32; 3]| p.iter().all(|c| c.is_finite() && *c >= 0.0);
        assert!(pixels.iter().all(sound), "{flags}");
        assert!(pixels.iter().any(|p| p[0] > 0.0), "{flags}");
    }
}

#[test]
fn a_dump_shows_maps_density_and_clusters() {
    let folder = Folder::new();
    folder
        .run(&format!(
            "render --dump d {SMALL} --clustering filtered --rsm 12"
        ))
        .ok();
    for what in [
        "position.png",
        "normal.png",
        "flux.png",
        "pdf.png",
        "clusters.png",
    ] {
        let name = format!("d/map0-{what}");
        let picture = exr(&folder, &name);
        assert!(
            picture.width >= 512 && picture.width.is_multiple_of(12),
            "{name}"
        );
        let pixels = picture.rgb("").expect("colours");
        let first = pixels[picture.width as usize / 2 * (picture.height as usize + 1)];
        assert!(
            pixels.iter().any(|p| *p != first),
            "{name} is of one colour"
        );
    }
    let maps = exr(&folder, "d/map0.exr");
    assert!(maps.rgb("P").is_none() && maps.channel("P.X").is_some());
    folder.run(&format!("render --dump e {SMALL}")).ok();
    let labels = exr(&folder, "e/map0.exr");
    let labels = labels.channel("cluster.Y").expect("a partition has labels");
    assert_eq!(labels.iter().copied().fold(0.0, f32::max), 7.0);
}

#[test]
fn a_file_without_camera_is_framed() {
    let folder = Folder::new();
    folder.write("a.gltf", TRIANGLE);
    let flags = "--spot 0.3,0.3,2:0.3,0.3,0:5:30 --size 16x9 --rsm 16 --lights 4";
    let ran = folder.run(&format!("render a.gltf -o a.exr {flags}"));
    assert!(ran.err.contains("no camera"), "{}", ran.err);
    ran.ok();
    let pixels = exr(&folder, "a.exr").rgb("direct").expect("colours");
    assert!(
        pixels.iter().any(|p| p[0] > 0.0),
        "the triangle is in the picture"
    );
}

#[test]
fn far_from_the_origin_coordinates_on_the_command_line_keep_their_digits() {
    let folder = Folder::new();
    let moved = TRIANGLE.replace(
        r#"{"mesh": 0}"#,
        r#"{"mesh": 0, "translation": [100000, 0, 0]}"#,
    );
    folder.write("near.gltf", TRIANGLE);
    folder.write("far.gltf", moved);
    let flags = "--size 16x16 --rsm 16 --lights 4 --fov 30";
    let near = "--look-at 0.31,0.32,3:0.3,0.3,0 --spot 0.333,0.3,1:0.3,0.3,0:5:30";
    let far =
        "--look-at 100000.31,0.32,3:100000.3,0.3,0 --spot 100000.333,0.3,1:100000.3,0.3,0:5:30";
    folder
        .run(&format!("render near.gltf -o near.exr {flags} {near}"))
        .ok();
    folder
        .run(&format!("render far.gltf -o far.exr {flags} {far}"))
        .ok();
    folder
        .run("compare far.exr near.exr --fail-above rmspe=0.01")
        .ok();
}

#[test]
fn files_tell_how_they_were_made() {
    let folder = Folder::new();
    folder
        .run(&format!("render -o a.png -o a.exr {SMALL} --seed 3"))
        .ok();
    let bytes = folder.bytes("a.exr");
    let text = String::from_utf8_lossy(&bytes);
    let start = text.find("{\"aa\":1").expect("settings in the header");
    let mut values = serde_json::Deserializer::from_str(&text[start..]).into_iter::<Value>();
    let settings = values.next().expect("a document").expect("valid");
    assert_eq!(settings["seed"], 3);
    assert_eq!(settings["settings"]["lights"], "8");
    assert!(text.contains("worldToCamera") && text.contains("vsgl render sample:cornell"));
    let bytes = folder.bytes("a.png");
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.contains("vsgl:settings") && text.contains("\"tonemap\":\"neutral\""));
}

#[test]
fn paths_are_drawn_by_their_seed() {
    let folder = Folder::new();
    let words = format!("render {SMALL} --method path --spp 4");
    for (file, seed) in [("a", "1"), ("b", "1"), ("c", "4294967297")] {
        let report = folder
            .run(&format!("{words} --seed {seed} -o {file}.exr"))
            .ok();
        assert!(report.contains("trace"), "{report}");
    }
    let [a, b, c] = ["a.exr", "b.exr", "c.exr"].map(|name| exr(&folder, name));
    let light = |picture: &Picture| picture.rgb("indirect").expect("a layer");
    assert_eq!(light(&a), light(&b));
    assert_ne!(light(&a), light(&c));
}
