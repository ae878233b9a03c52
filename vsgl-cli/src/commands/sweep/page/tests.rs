//! The page as a whole: safe, whole and always the same.

use super::page;
use serde_json::{Value, json};

const HOSTILE: &str = "</script><img src=x onerror=alert(1)>\"'&\u{2028}\u{202e}";
const PNG: &[u8] = b"\x89PNG\r\n\x1a\nrest";
/// Elements without an end.
const VOID: [&str; 4] = ["meta", "img", "br", "input"];

fn point(id: &str, backend: &str, wall: f64, error: f64, front: bool) -> Value {
    let at = |mape: f64| json!({"mape": mape, "rmspe": 2.0 * mape, "bias": -1.0});
    json!({
        "id": id, "backend": backend, "device": "2 threads", "name": format!("lights {id}"),
        "settings": {"lights": id, "rsm": "512"}, "command": format!("vsgl render --lights {id}"),
        "virtual_lights": 65_536, "runs": 3,
        "wall": {"median": wall, "least": 0.9 * wall, "most": 1.2 * wall}, "cpu": null,
        "phases": [{"phase": "rsm", "wall": 0.1 * wall, "cpu": null}],
        "errors": {"whole": {"1": at(error), "8": null}, "indirect": {"1": at(3.0 * error), "8": at(2.0 * error)}},
        "picture": format!("pictures/{id}.png"), "front": front,
    })
}

fn document(scene: &str) -> Value {
    json!({
        "schema_version": 1, "software": "vsgl 0.1.0", "command": "vsgl sweep x -o y", "date": "2026-11-22",
        "scene": {"name": scene, "triangles": 262_267, "lights": 1}, "width": 320, "height": 180,
        "machine": {"processor": "a processor", "threads": 2},
        "reference": {"source": "path", "spp": 256, "seconds": 12.0, "picture": "reference.png",
            "noise": {"indirect": {"8": {"mape": 1.25}}}},
        "points": [
            point("64", "cpu", 0.02, 20.0, true), point("1024", "cpu", 0.5, 3.0, true), point("777", "cpu", 0.6, 4.0, false),
        ],
        "advice": [{"for": "quick", "id": "64"}, {"for": "gone", "id": "no such point"}],
    })
}

fn made(document: &Value) -> String {
    page(document, &|_| Some(PNG.to_vec()))
}

/// Names of elements in their order, an end with a slash; every start has its end, and attributes are quoted.
fn elements(html: &str) -> Vec<String> {
    let mut open: Vec<String> = Vec::new();
    let mut all = Vec::new();
    let mut rest = html.strip_prefix("<!DOCTYPE html>").expect("a page");
    while let Some(at) = rest.find('<') {
        let text = &rest[..at];
        assert!(!text.contains('>'), "a loose > in {text:?}");
        rest = &rest[at + 1..];
        let mut quoted = false;
        let end = rest.find(|c| {
            quoted ^= c == '"';
            c == '>' && !quoted
        });
        let (tag, after) = rest.split_at(end.expect("an end of the tag"));
        rest = &after[1..];
        let name: String = tag.chars().take_while(|c| !c.is_whitespace()).collect();
        if let Some(name) = name.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(name), "in {all:?}");
        } else if !VOID.contains(&name.as_str()) {
            open.push(name.clone());
        }
        // What is inside is read by others.
        if name == "script" || name == "style" {
            rest = &rest[rest.find(&format!("</{name}")).expect("an end")..];
        }
        all.push(name);
    }
    assert!(open.is_empty(), "not closed: {open:?}");
    all
}

#[test]
fn names_from_files_stay_text() {
    let plain = elements(&made(&document("a room")));
    let mut hostile = document(HOSTILE);
    hostile["software"] = HOSTILE.into();
    hostile["machine"]["processor"] = HOSTILE.into();
    hostile["command"] = HOSTILE.into();
    hostile["advice"][0]["for"] = HOSTILE.into();
    for key in ["id", "backend", "device", "name", "command", "picture"] {
        hostile["points"][0][key] = HOSTILE.into();
    }
    hostile["advice"][0]["id"] = HOSTILE.into();
    hostile["points"][0]["settings"] = json!({HOSTILE: HOSTILE, "lights": HOSTILE});
    let html = made(&hostile);
    let found = elements(&html);
    let count = |of: &[String], name: &str| of.iter().filter(|n| *n == name).count();
    assert_eq!(count(&found, "script"), 2);
    // The picture of the point with that name is not asked for.
    assert_eq!(count(&found, "img"), count(&plain, "img") - 1);
    assert!(
        !html.contains("<img src=x") && !html.contains('\u{202e}') && !html.contains('\u{2028}')
    );
    // The script reads back what was in the document, but for what turns the direction of text.
    let data = html
        .split("id=\"document\">")
        .nth(1)
        .and_then(|d| d.split("</script>").next());
    let read: Value = serde_json::from_str(data.expect("the document")).expect("JSON");
    assert_eq!(
        read["scene"]["name"],
        HOSTILE.replace('\u{202e}', "\u{fffd}")
    );
}

#[test]
fn the_front_is_there_without_a_script() {
    let html = made(&document("a room"));
    let table = html.split("id=\"front-table\"").nth(1).expect("a table");
    let table = table.split("</table>").next().expect("its end");
    for text in [
        "data-id=\"64\"",
        "20.0 ms",
        "40.0 %",
        "data-id=\"1024\"",
        "500 ms",
        "6.00 %",
        "65,536",
    ] {
        assert!(table.contains(text), "{text} in {table}");
    }
    assert!(!table.contains("777"));
    let all = html.split("id=\"all-table\"").nth(1).expect("a table");
    assert!(all.contains("data-id=\"777\""));
    assert_eq!(html.matches("<g class=\"point").count(), 3);
    assert!(html.contains("class=\"noise\"") && html.contains("262,267 triangles"));
    // The reference and the two of the front.
    assert_eq!(html.matches("src=\"data:image/png;base64,").count(), 3);
}

#[test]
fn nothing_is_loaded_and_the_policy_names_what_runs() {
    let html = made(&document("a room"));
    for (tag, directive) in [("<style>", "style-src"), ("<script>", "script-src")] {
        let inside = html.split(tag).nth(1).and_then(|s| s.split("</").next());
        let digest = super::digest::sha256(inside.expect("its text").as_bytes());
        let named = format!("{directive} 'sha256-{}'", super::base64::encode(&digest));
        assert!(html.contains(&named), "{named}");
    }
    let loads = [
        "src=\"http",
        "href=",
        "url(",
        "@import",
        " style=\"",
        " onclick=\"",
        "fetch(",
        "innerHTML",
        "eval(",
    ];
    for text in loads {
        assert!(!html.contains(text), "{text}");
    }
    // The name of a kind of element is the one address.
    let addresses = html.matches("http").count();
    let named =
        html.matches("http-equiv").count() + html.matches("http://www.w3.org/2000/svg").count();
    assert_eq!(addresses, named);
}

#[test]
fn the_same_document_makes_the_same_page() {
    assert_eq!(made(&document("a room")), made(&document("a room")));
}

#[test]
fn what_is_missing_is_left_out() {
    for document in [
        json!({}),
        json!({"points": [{}]}),
        json!({"points": [{"id": "a", "wall": {"median": 0.0}}]}),
    ] {
        elements(&page(&document, &|_| None));
    }
    let mut early = document("a room");
    early["planned"] = 54.into();
    let html = made(&early);
    assert!(html.contains("3 of 54 points"));
    assert!(!made(&document("a room")).contains("not finished"));
}

#[test]
fn pictures_are_taken_as_far_as_they_fit_and_from_the_folder_alone() {
    let large = |_: &str| {
        let mut bytes = PNG.to_vec();
        bytes.resize(3 << 20, 0);
        Some(bytes)
    };
    let html = page(&document("a room"), &large);
    assert_eq!(html.matches("src=\"data:image/png").count(), 2);
    // What is advised is not what is missing.
    assert!(
        html.contains("data-picture=\"64\"") && html.contains("1 picture of the front left out")
    );
    assert!(html.len() < 10 << 20);
    for name in [
        "../a.png",
        "/etc/a.png",
        "a/../../b.png",
        "a//b",
        "",
        "a\\b",
        "https://x/y.png",
    ] {
        assert!(!super::pictures::inside(name), "{name}");
    }
    assert!(super::pictures::inside("pictures/cpu_lights-64.png"));
}
