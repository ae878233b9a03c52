//! `vsgl sweep --explain`: causes add up, and each is found where it was planted.

use crate::run::Folder;
use serde_json::Value;

/// A small split.
fn split(folder: &Folder, words: &str) -> Value {
    let small = "sample:columns --size 16x16 --rsm 32 --lights 16 --quick --explain -o out --json";
    folder.run(&format!("sweep {small} {words}")).json()
}

fn links(document: &Value) -> Vec<Value> {
    document["links"].as_array().expect("links").clone()
}

fn link(document: &Value, cause: &str) -> Value {
    let found = links(document).into_iter().find(|l| l["cause"] == cause);
    found.unwrap_or_else(|| panic!("no {cause}: {document:#}"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

fn causes(document: &Value) -> Vec<String> {
    let word = |l: &Value| l["cause"].as_str().expect("a word").to_owned();
    links(document).iter().map(word).collect()
}

#[test]
fn causes_add_up_to_the_whole_and_are_drawn() {
    let folder = Folder::new();
    let document = split(&folder, "--interleave 2 --aa 2");
    let expected = [
        "interleaving",
        "occlusion",
        "visibility",
        "emission",
        "integral",
        "rsm",
        "rest",
        "pixels",
    ];
    assert_eq!(causes(&document), expected);
    for scale in ["pixel", "block"] {
        let sum = |column: &str| -> f64 {
            let links = links(&document);
            links.iter().map(|l| number(&l[scale][column])).sum()
        };
        let whole = &document["whole"][scale];
        assert!(
            (sum("bias") - number(&whole["bias"])).abs() < 1e-6,
            "{scale}"
        );
        assert!((sum("share") - 100.0).abs() < 1e-6, "{scale}");
        // The other order of three links comes to the same.
        let three = |other: bool| -> f64 {
            let of = |l: &Value| {
                if other {
                    l["other_order"].clone()
                } else {
                    l.clone()
                }
            };
            let three = ["visibility", "emission", "integral"];
            three
                .map(|c| number(&of(&link(&document, c))[scale]["bias"]))
                .iter()
                .sum()
        };
        assert!((three(true) - three(false)).abs() < 1e-6, "{scale}");
    }
    assert!(number(&link(&document, "interleaving")["pixel"]["mape"]) > 0.0);
    for link in links(&document) {
        let Some(picture) = link["picture"].as_str() else {
            assert_eq!(link["runs"], false, "{link:#}");
            continue;
        };
        assert!(!folder.bytes(&format!("out/{picture}")).is_empty());
    }
    let written: Value = serde_json::from_slice(&folder.bytes("out/explain.json")).expect("JSON");
    assert_eq!(written, document);
    let table = String::from_utf8(folder.bytes("out/explain.csv")).expect("text");
    assert_eq!(table.lines().count(), 10, "{table}");
    let commas = |line: &str| line.matches(',').count();
    assert!(table.starts_with("cause,runs,from,to,pixel_bias"));
    assert!(table.lines().all(|l| commas(l) >= 13), "{table}");
}

#[test]
fn what_is_not_done_has_no_error() {
    let folder = Folder::new();
    let document = split(&folder, "");
    for cause in ["interleaving", "occlusion"] {
        let link = link(&document, cause);
        assert_eq!(
            (&link["runs"], number(&link["pixel"]["rmspe"])),
            (&false.into(), 0.0)
        );
        assert!(link["why"].is_string());
    }
    for cause in ["visibility", "emission", "integral"] {
        assert!(
            number(&link(&document, cause)["pixel"]["mape"]) > 0.0,
            "{cause}"
        );
    }
}

#[test]
fn what_is_planted_is_found() {
    let folder = Folder::new();
    let mape = |document: &Value, cause: &str| number(&link(document, cause)["pixel"]["mape"]);
    let usual = split(&folder, "--rsm 64 --lights 64");
    let none = split(&folder, "--rsm 64 --lights 64 --occlusion none");
    assert!(mape(&none, "occlusion") > 3.0, "light through walls");
    assert!((mape(&none, "visibility") - mape(&usual, "visibility")).abs() < 1e-9);
    let coarse = split(&folder, "--rsm 8 --lights 64");
    assert!(mape(&coarse, "rsm") > 2.0 * mape(&usual, "rsm"));
    let form = split(&folder, "--rsm 64 --lights 64 --diffuse sg-product");
    assert!(mape(&form, "integral") > 1.5 * mape(&usual, "integral"));
    assert!(mape(&form, "emission") < 1.2 * mape(&usual, "emission"));
    let maps = split(&folder, "--rsm 64 --occlusion ism --set map_size=8");
    let larger = split(&folder, "--rsm 64 --occlusion ism --set map_size=32");
    assert!(mape(&maps, "map-size") > mape(&larger, "map-size"));
    // More lights, less of what is clusters' fault.
    let lights = &usual["lights"];
    let [few, many] = ["error_given", "error_more"].map(|e| number(&lights[e]["pixel"]["mape"]));
    assert!(many < few, "{many} of {few}");
}

#[test]
fn kernels_and_whole_maps_have_their_links() {
    let folder = Folder::new();
    let kernels = split(&folder, "--clustering filtered");
    assert!(causes(&kernels).contains(&"clusters".to_owned()));
    assert!(!causes(&kernels).contains(&"emission".to_owned()));
    let whole = split(&folder, "--clustering whole");
    assert!(number(&link(&whole, "emission")["pixel"]["mape"]) > 0.0);
    assert!(whole["lights"]["why"].is_string());
}

#[test]
fn large_pictures_are_looked_at_here_and_there() {
    let folder = Folder::new();
    let words = "sample:cornell --size 640x360 --rsm 16 --lights 4 --quick --explain -o out";
    let text = folder.run(&format!("sweep {words}")).ok();
    assert!(
        text.contains("blocks of 8x8") && text.contains("whole error"),
        "{text}"
    );
    let document: Value = serde_json::from_slice(&folder.bytes("out/explain.json")).expect("JSON");
    assert_eq!(document["points"]["whole_picture"], false);
    assert!(number(&document["points"]["blocks"]) >= 4.0);
}

#[test]
fn what_cannot_be_split_is_refused() {
    let folder = Folder::new();
    let run = |words: &str| folder.run(&format!("sweep {words} --explain -o out --size 8x8"));
    for (words, about) in [
        ("--method path", "method"),
        ("--method vpl", "method"),
        ("--stride 2", "stride"),
        ("--backend wgpu", "CPU"),
        ("--grid lights=1,2", "--grid"),
    ] {
        let message = run(words).failed(2);
        assert!(message.contains(about), "{words}: {message}");
    }
}
