//! Broken JSON, and broken .glb containers.

use super::Fate::{Drawn, Either, Refused};
use super::{Case, Thing};
use crate::file::{File, glb};
use serde_json::json;

pub(super) fn cases() -> Vec<Case> {
    let mut cases = vec![
        Case::of("sound", &File::sound(), Drawn),
        Case::glb("sound", &File::sound(), Drawn),
    ];
    cases.extend(texts());
    cases.extend(containers());
    cases
}

fn texts() -> Vec<Case> {
    let text = File::sound().to_text();
    let raw = |name: &str, bytes: Vec<u8>, fate| {
        Case::bytes(name, "s.gltf", bytes, fate).with("s.bin", Thing::Bytes(File::sound().bin))
    };
    let utf16: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let mut cases = vec![
        raw("empty file", Vec::new(), Refused("empty")),
        raw("blanks only", b" \n\t ".to_vec(), Refused("JSON")),
        raw("zeros", vec![0; 4096], Refused("JSON")),
        raw("no text at all", vec![0xff; 4096], Refused("JSON")),
        raw("not an object", b"[1,2,3]".to_vec(), Refused("")),
        raw("null", b"null".to_vec(), Refused("")),
        raw("empty object", b"{}".to_vec(), Refused("asset")),
        raw(
            "byte order mark",
            format!("\u{feff}{text}").into_bytes(),
            Drawn,
        ),
        raw(
            "two byte order marks",
            format!("\u{feff}\u{feff}{text}").into_bytes(),
            Refused("JSON"),
        ),
        raw("UTF-16", utf16, Refused("JSON")),
        raw(
            "text after the end",
            format!("{text}{{}}").into_bytes(),
            Refused("JSON"),
        ),
        raw(
            "comments",
            format!("/* a */{text}").into_bytes(),
            Refused("JSON"),
        ),
        raw(
            "cut in the middle",
            text.as_bytes()[..text.len() / 2].to_vec(),
            Refused("JSON"),
        ),
        raw(
            "last brace missing",
            text.as_bytes()[..text.len() - 1].to_vec(),
            Refused("JSON"),
        ),
        raw(
            "broken UTF-8",
            text.replacen("2.0", "2.\u{1}", 1).into_bytes(),
            Refused("JSON"),
        ),
        raw("deep arrays", nested("[", "]", 100_000), Refused("JSON")),
        raw(
            "deep objects",
            nested("{\"a\":", "}", 100_000),
            Refused("JSON"),
        ),
        raw("deep and open", b"[".repeat(5_000_000), Refused("JSON")),
        raw("a million braces", b"{".repeat(5_000_000), Refused("")),
        raw(
            "a long number",
            format!("{{\"asset\":{}}}", "9".repeat(3_000_000)).into_bytes(),
            Refused(""),
        ),
        raw(
            "a long exponent",
            format!("{{\"asset\":1e{}}}", "9".repeat(3_000_000)).into_bytes(),
            Refused(""),
        ),
        raw(
            "a long string",
            format!("{{\"asset\":\"{}\"}}", "x".repeat(9_000_000)).into_bytes(),
            Refused("asset"),
        ),
        raw(
            "escapes",
            format!("{{\"asset\":\"{}\"}}", "\\u0000".repeat(900_000)).into_bytes(),
            Refused("asset"),
        ),
    ];
    let edits: &[(&str, &str, &str, super::Fate)] = &[
        (
            "version missing",
            "\"version\":\"2.0\"",
            "\"a\":1",
            Refused("asset"),
        ),
        (
            "version 1",
            "\"version\":\"2.0\"",
            "\"version\":\"1.0\"",
            Refused("version"),
        ),
        (
            "version 3",
            "\"version\":\"2.0\"",
            "\"version\":\"3.0\"",
            Refused("version"),
        ),
        (
            "version a number",
            "\"version\":\"2.0\"",
            "\"version\":2.0",
            Refused("asset"),
        ),
        (
            "version with escapes",
            "\"version\":\"2.0\"",
            "\"version\":\"\\u001b[2J\"",
            Refused("version"),
        ),
        (
            "asset given twice",
            "\"asset\":{",
            "\"asset\":{\"version\":\"1.0\"},\"asset\":{",
            Either,
        ),
        (
            "accessors given twice",
            "\"accessors\":[",
            "\"accessors\":[],\"accessors\":[",
            Either,
        ),
        (
            "count given twice",
            "\"count\":12",
            "\"count\":3,\"count\":12",
            Either,
        ),
        (
            "count 1e999",
            "\"count\":12",
            "\"count\":1e999",
            Refused("JSON"),
        ),
        (
            "count negative",
            "\"count\":12",
            "\"count\":-12",
            Refused("JSON"),
        ),
        (
            "count a fraction",
            "\"count\":12",
            "\"count\":11.5",
            Refused("JSON"),
        ),
        (
            "count a text",
            "\"count\":12",
            "\"count\":\"12\"",
            Refused("JSON"),
        ),
        ("count null", "\"count\":12", "\"count\":null", Either),
        (
            "count 2^53",
            "\"count\":12",
            "\"count\":9007199254740992",
            Refused("accessors[3]"),
        ),
        (
            "count 2^64",
            "\"count\":12",
            "\"count\":18446744073709551616",
            Refused("JSON"),
        ),
        (
            "NaN as a word",
            "\"intensity\":10.0",
            "\"intensity\":NaN",
            Refused("JSON"),
        ),
        (
            "infinity as a word",
            "\"intensity\":10.0",
            "\"intensity\":Infinity",
            Refused("JSON"),
        ),
        (
            "intensity 1e999",
            "\"intensity\":10.0",
            "\"intensity\":1e999",
            Refused("JSON"),
        ),
        (
            "intensity 1e300",
            "\"intensity\":10.0",
            "\"intensity\":1e300",
            Refused(""),
        ),
        (
            "intensity 1e38",
            "\"intensity\":10.0",
            "\"intensity\":1e38",
            Either,
        ),
        (
            "intensity 1e-45",
            "\"intensity\":10.0",
            "\"intensity\":1e-45",
            Either,
        ),
        ("wrong case", "\"accessors\"", "\"Accessors\"", Either),
    ];
    for (name, old, new, fate) in edits {
        cases.push(Case::of(*name, &File::sound().text(old, new), *fate));
    }
    // Lists that are something else.
    for list in [
        "nodes",
        "scenes",
        "meshes",
        "accessors",
        "bufferViews",
        "buffers",
        "materials",
        "textures",
        "images",
        "samplers",
        "cameras",
        "extensions",
        "extensionsUsed",
        "scene",
    ] {
        for (kind, value) in [
            ("text", json!("x")),
            ("number", json!(1e30)),
            ("null", json!(null)),
            ("map", json!({"0": 1})),
            ("nulls", json!([null, null])),
            ("numbers", json!([1, 2, 3])),
            ("lists", json!([[[]]])),
        ] {
            let file = File::sound().set(&format!("/{list}"), value);
            cases.push(Case::of(format!("{list} is {kind}"), &file, Either));
        }
        let file = File::sound().remove(&format!("/{list}"));
        cases.push(Case::of(format!("{list} missing"), &file, Either));
    }
    for extension in ["NOBODY_knows", "\u{1b}[31m", ""] {
        let file = File::sound().set("/extensionsRequired", json!([extension]));
        cases.push(Case::of(
            format!("requires {extension:?}"),
            &file,
            Refused("extensionsRequired"),
        ));
    }
    let file = File::sound().set("/extensionsRequired", json!(vec!["A"; 50_000]));
    cases.push(Case::of(
        "requires a lot",
        &file,
        Refused("extensionsRequired"),
    ));
    let used: Vec<String> = (0..50_000).map(|i| format!("E{i}")).collect();
    let file = File::sound().set("/extensionsUsed", json!(used));
    cases.push(Case::of("uses a lot of extensions", &file, Drawn));
    cases
}

fn nested(open: &str, close: &str, depth: usize) -> Vec<u8> {
    format!("{}1{}", open.repeat(depth), close.repeat(depth)).into_bytes()
}

fn containers() -> Vec<Case> {
    let file = File::sound();
    let whole = file.to_glb();
    let patched = |at: usize, value: u32| {
        let mut bytes = whole.clone();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        bytes
    };
    let json_size = u32::from_le_bytes(whole[12..16].try_into().expect("four"));
    let bin_header = 20 + json_size as usize;
    let mut cases: Vec<Case> = [
        4,
        8,
        11,
        12,
        16,
        20,
        21,
        bin_header,
        bin_header + 7,
        whole.len() - 1,
    ]
    .iter()
    .map(|&length| {
        Case::bytes(
            format!("cut after {length} bytes"),
            "s.glb",
            whole[..length].to_vec(),
            Refused(""),
        )
    })
    .collect();
    for (name, at, value, fate) in [
        ("version 0", 4, 0, Refused("version")),
        ("version 1", 4, 1, Refused("version")),
        ("version 2^32-1", 4, u32::MAX, Refused("version")),
        ("length 0", 8, 0, Either),
        ("length short", 8, 40, Either),
        ("length beyond the file", 8, u32::MAX, Refused("truncated")),
        ("first chunk empty", 12, 0, Refused("")),
        ("first chunk 2^32-1", 12, u32::MAX, Refused("truncated")),
        ("first chunk 2^31", 12, 1 << 31, Refused("truncated")),
        (
            "first chunk one byte too long",
            12,
            json_size + 1,
            Refused(""),
        ),
        ("first chunk is no JSON", 16, 0x1234_5678, Refused("JSON")),
        (
            "first chunk is binary",
            16,
            u32::from_le_bytes(*b"BIN\0"),
            Refused("JSON"),
        ),
        ("second chunk empty", bin_header, 0, Refused("")),
        (
            "second chunk 2^32-1",
            bin_header,
            u32::MAX,
            Refused("truncated"),
        ),
        (
            "second chunk of unknown kind",
            bin_header + 4,
            7,
            Refused("buffers[0]"),
        ),
        (
            "second chunk is JSON",
            bin_header + 4,
            u32::from_le_bytes(*b"JSON"),
            Refused("buffers[0]"),
        ),
    ] {
        cases.push(Case::bytes(
            format!("glb: {name}"),
            "s.glb",
            patched(at, value),
            fate,
        ));
    }
    let text = file.to_text().into_bytes();
    let chunk = |kind: &[u8; 4], content: &[u8]| (*kind, content.to_vec());
    for (name, chunks, fate) in [
        ("no chunk", vec![], Refused("JSON")),
        (
            "binary first",
            vec![chunk(b"BIN\0", &file.bin), chunk(b"JSON", &text)],
            Either,
        ),
        (
            "JSON twice",
            vec![
                chunk(b"JSON", &text),
                chunk(b"JSON", b"{}"),
                chunk(b"BIN\0", &file.bin),
            ],
            Either,
        ),
        ("JSON alone", vec![chunk(b"JSON", &text)], Refused("s.bin")),
        (
            "empty JSON",
            vec![chunk(b"JSON", b""), chunk(b"BIN\0", &file.bin)],
            Refused("JSON"),
        ),
    ] {
        cases.push(Case::bytes(
            format!("glb: {name}"),
            "s.glb",
            glb(&chunks),
            fate,
        ));
    }
    let mut many = vec![chunk(b"JSON", &text)];
    many.extend((0..200_000).map(|_| chunk(b"ABCD", b"")));
    cases.push(Case::bytes(
        "glb: 200,000 chunks",
        "s.glb",
        glb(&many),
        Refused("s.bin"),
    ));
    let mut padded = whole.clone();
    padded.extend([0; 5]);
    cases.push(Case::bytes("glb: five bytes more", "s.glb", padded, Either));
    cases.push(Case::bytes(
        "glb under the name of text",
        "s.gltf",
        whole,
        Drawn,
    ));
    cases.push(
        Case::bytes("text under the name of glb", "s.glb", text, Drawn)
            .with("s.bin", Thing::Bytes(file.bin)),
    );
    cases
}
