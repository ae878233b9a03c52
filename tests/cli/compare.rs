//! `vsgl compare`.

use crate::run::Folder;
use serde_json::Value;
use vsgl_cli::input;
use vsgl_cli::output::{Metadata, exr, png};
use vsgl_cli::picture::Picture;

/// Writes a grey picture, 16 pixels wide, under a layer's name.
fn write(folder: &Folder, name: &str, layer: &str, values: &[f32]) {
    let pixels: Vec<[f32; 3]> = values.iter().map(|&v| [v; 3]).collect();
    let height = values.len() as u32 / 16;
    let mut picture = Picture {
        width: 16,
        height,
        channels: Vec::new(),
    };
    picture.push(layer, ["R", "G", "B"], &pixels);
    let mut file = std::io::Cursor::new(Vec::new());
    exr::write(&mut file, picture, &Metadata::default()).expect("written to memory");
    folder.write(name, file.into_inner());
}

/// A reference of ones, and a test that is 1.1 on the left half and 1 on the right.
fn pair(folder: &Folder) {
    write(folder, "b.exr", "", &[1.0; 256]);
    let test: Vec<f32> = (0..256)
        .map(|i| if i % 16 < 8 { 1.1 } else { 1.0 })
        .collect();
    write(folder, "a.exr", "", &test);
}

fn metric(document: &Value, scale: usize, name: &str) -> f64 {
    let value = &document["scales"][scale]["metrics"][name];
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{name} is {value}"))
}

#[test]
fn values_are_those_computed_by_hand() {
    let folder = Folder::new();
    pair(&folder);
    let document = folder.run("compare a.exr b.exr --json").json();
    assert_eq!(document["schema_version"], 1);
    for scale in 0..2 {
        for (name, value) in [
            ("rmse", 0.1 / 2f64.sqrt()),
            ("relmse", 0.005 / 1.0001),
            ("rmspe", 10.0 / 2f64.sqrt()),
            ("mape", 5.0),
            ("mape_median", 5.0),
            ("smape", 5.0 / 1.05),
            ("psnr", 20.0 * (10.0 * 2f64.sqrt()).log10()),
            ("mae", 0.05),
            ("bias", 5.0),
        ] {
            let found = metric(&document, scale, name);
            assert!(
                (found - value).abs() < 1e-5 * value,
                "{name}: {found}, not {value}"
            );
        }
    }
    assert_eq!(document["scales"][0]["compared"], 256);
    assert_eq!(document["scales"][1]["compared"], 4);
    assert_eq!(document["scales"][1]["box"], 8);
}

#[test]
fn limits_decide_the_exit_code() {
    let folder = Folder::new();
    pair(&folder);
    folder
        .run("compare a.exr b.exr --fail-above mape=5.1 --fail-above bias=6")
        .ok();
    let message = folder
        .run("compare a.exr b.exr --fail-above mape=4.9 --fail-above mae=1")
        .failed(1);
    assert!(
        message.contains("mape") && !message.contains("mae "),
        "{message}"
    );
    // Of the bias the size counts.
    folder
        .run("compare b.exr a.exr --fail-above bias=4")
        .failed(1);
    // Noise that cancels in a block.
    let noisy: Vec<f32> = (0..256)
        .map(|i| 1.0 + 0.5 * (1 - i % 2 * 2) as f32)
        .collect();
    write(&folder, "noisy.exr", "", &noisy);
    folder
        .run("compare noisy.exr b.exr --fail-above mape=1")
        .failed(1);
    folder
        .run("compare noisy.exr b.exr --box 2 --fail-above mape=1")
        .ok();
}

#[test]
fn dark_and_broken_pixels_are_counted() {
    let folder = Folder::new();
    let mut reference = vec![1.0; 256];
    reference[0] = 0.0;
    write(&folder, "b.exr", "", &reference);
    let mut test = vec![1.0; 256];
    test[0] = 5.0;
    test[255] = f32::NAN;
    write(&folder, "a.exr", "", &test);
    let document = folder.run("compare a.exr b.exr --json").json();
    let scale = &document["scales"][0];
    assert_eq!(
        (&scale["dark"], &scale["not_finite"]),
        (&1.into(), &1.into())
    );
    assert_eq!(metric(&document, 0, "mape"), 0.0);
    assert!(document["scales"][0]["metrics"]["psnr"].is_null());
    assert_eq!(document["scales"][1]["compared"], 2);
    let message = folder
        .run("compare a.exr b.exr --fail-above mape=50")
        .failed(1);
    assert!(message.contains("not finite"), "{message}");
}

#[test]
fn layers_are_chosen_by_prefix_and_bare_colours_stand_for_any() {
    let folder = Folder::new();
    write(&folder, "a.exr", "indirect.", &[2.0; 256]);
    write(&folder, "b.exr", "", &[1.0; 256]);
    let document = folder
        .run("compare a.exr b.exr --layer indirect --json")
        .json();
    assert_eq!(metric(&document, 0, "bias"), 100.0);
    assert_eq!(document["test"]["layer"], "indirect");
    assert_eq!(document["reference"]["layer"], "R,G,B");
    assert!(
        document["reference"]["notes"][0]
            .as_str()
            .is_some_and(|n| n.contains("indirect"))
    );
    let message = folder.run("compare a.exr b.exr --layer direct").failed(3);
    assert!(
        message.contains("direct") && message.contains("indirect"),
        "{message}"
    );
    folder.run("compare a.exr b.exr").failed(3);
    folder.run("compare b.exr b.exr --layer indirect").failed(3);
}

#[test]
fn a_png_is_made_linear() {
    let folder = Folder::new();
    let mut file = Vec::new();
    png::write(&mut file, 16, 16, &[[188; 3]; 256], &Metadata::default()).expect("written");
    folder.write("a.png", file);
    write(&folder, "b.exr", "", &[0.5; 256]);
    let report = folder.run("compare a.png b.exr --metric bias").ok();
    assert!(report.contains("made linear"), "{report}");
    let document = folder.run("compare a.png b.exr --json").json();
    // Code 188 is 0.5029 in linear light.
    assert!((metric(&document, 0, "bias") - 0.58).abs() < 0.05);
}

#[test]
fn the_map_is_a_picture_with_a_legend() {
    let folder = Folder::new();
    pair(&folder);
    folder.run("compare a.exr b.exr -o maps/error.png").ok();
    let map = input::read(&folder.path("maps/error.png"))
        .expect("readable")
        .picture;
    assert!(map.width >= 16 && map.height > 16);
    let pixels = map.rgb("").expect("colours");
    assert_ne!(
        pixels[0], pixels[15],
        "wrong and right pixels have their colours"
    );
    assert_eq!(pixels[0], pixels[map.width as usize * 15]);
}

#[test]
fn a_report_has_the_asked_metrics_alone() {
    let folder = Folder::new();
    pair(&folder);
    let report = folder
        .run("compare a.exr b.exr --metric mape,rmse --box 4")
        .ok();
    assert!(
        report.starts_with("vsgl compare a.exr b.exr --box 4\n"),
        "{report}"
    );
    assert!(report.contains("mape ") && report.contains("rmse") && report.contains("4x4 blocks"));
    assert!(!report.contains("psnr") && report.contains("eps"));
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let folder = Folder::new();
    pair(&folder);
    write(&folder, "small.exr", "", &[1.0; 128]);
    write(&folder, "black.exr", "", &[0.0; 256]);
    let message = folder.run("compare a.exr small.exr").failed(2);
    assert!(
        message.contains("16x16") && message.contains("16x8"),
        "{message}"
    );
    let message = folder.run("compare a.exr black.exr").failed(3);
    assert!(message.contains("black.exr"), "{message}");
    folder.run("compare a.exr b.exr --box 17").failed(3);
    for flags in [
        "--metric mse",
        "--fail-above mape",
        "--fail-above mape=NaN",
        "--fail-above psnr=20",
        "--box 0",
        "-o a.exr",
        "-o a.jpg",
    ] {
        folder
            .run(&format!("compare a.exr b.exr {flags}"))
            .failed(2);
    }
    folder.run("compare a.exr missing.exr").failed(3);
    folder.run("compare a.exr .").failed(3);
    folder.write("text.exr", "not a picture");
    folder.run("compare a.exr text.exr").failed(3);
    let whole = folder.bytes("a.exr");
    folder.write("cut.exr", &whole[..whole.len() / 2]);
    let message = folder.run("compare cut.exr b.exr").failed(3);
    assert!(message.contains("cut.exr"), "{message}");
    folder.run("compare a.exr b.exr -o a.exr/map.png").failed(5);
}
