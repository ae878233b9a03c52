//! Little that becomes much.

use super::Case;
use super::Fate::{self, Drawn, Either, Refused};
use super::images::shown;
use crate::file::{File, floats, words};
use crate::png;
use ::png::{BitDepth, ColorType};
use serde_json::{Value, json};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = pictures();
    cases.extend(lists());
    cases.extend(meshes());
    cases
}

fn pictures() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add =
        |name: &str, image: &[u8], fate: Fate| cases.push(Case::glb(name, &shown(image), fate));
    add(
        "PNG of 4096x4096",
        &png::plain(4096, 4096, ColorType::Rgb, BitDepth::Eight),
        Drawn,
    );
    add(
        "PNG of 8192x8192",
        &png::plain(8192, 8192, ColorType::Grayscale, BitDepth::Eight),
        Either,
    );
    add(
        "PNG of 16384x16384",
        &png::plain(16_384, 16_384, ColorType::Grayscale, BitDepth::One),
        Refused("images[0]"),
    );
    add(
        "PNG of 16 bits",
        &png::plain(8192, 8192, ColorType::Rgba, BitDepth::Sixteen),
        Either,
    );
    add(
        "PNG of 60000x60000",
        &png::plain(60_000, 60_000, ColorType::Grayscale, BitDepth::One),
        Refused("images[0]"),
    );
    add(
        "PNG of 1x4000000",
        &png::plain(1, 4_000_000, ColorType::Grayscale, BitDepth::One),
        Either,
    );
    add(
        "PNG of 4000000x1",
        &png::plain(4_000_000, 1, ColorType::Grayscale, BitDepth::One),
        Either,
    );
    add(
        "PNG with a text of 100 MB",
        &png::stuffed(100 << 20, false),
        Either,
    );
    add(
        "PNG with a profile of 100 MB",
        &png::stuffed(100 << 20, true),
        Either,
    );
    // Each small enough alone.
    let image = png::plain(2048, 2048, ColorType::Indexed, BitDepth::One);
    let mut file = File::sound();
    let view = file.view(&image);
    let count = 60;
    file.json["images"] = json!(vec![json!({"bufferView": view}); count]);
    let textures: Vec<Value> = (0..count).map(|i| json!({"source": i})).collect();
    file.json["textures"] = json!(textures);
    let materials: Vec<Value> = (0..count)
        .map(|i| json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}}))
        .collect();
    file.json["materials"] = json!(materials);
    let primitive = file.json["meshes"][0]["primitives"][0].clone();
    let primitives: Vec<Value> = (0..count)
        .map(|i| {
            let mut primitive = primitive.clone();
            primitive["material"] = json!(i);
            primitive
        })
        .collect();
    let file = file.set("/meshes/0/primitives", json!(primitives));
    cases.push(Case::glb("60 PNGs of 2048x2048", &file, Refused("texels")));
    cases
}

/// Long lists of small things.
fn lists() -> Vec<Case> {
    let mut cases = Vec::new();
    for (list, item) in [
        ("nodes", "{}"),
        ("nodes", "{\"name\":\"a\",\"extras\":{\"a\":1}}"),
        ("meshes", "{\"primitives\":[{\"attributes\":{}}]}"),
        ("materials", "{}"),
        (
            "materials",
            "{\"extensions\":{\"KHR_materials_specular\":{}}}",
        ),
        (
            "accessors",
            "{\"componentType\":5126,\"count\":1,\"type\":\"VEC3\"}",
        ),
        ("bufferViews", "{\"buffer\":0,\"byteLength\":1}"),
        ("buffers", "{\"byteLength\":1}"),
        ("images", "{}"),
        ("textures", "{}"),
        ("samplers", "{}"),
        (
            "cameras",
            "{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":1}}",
        ),
        ("scenes", "{}"),
        ("skins", "{\"joints\":[]}"),
        ("animations", "{\"channels\":[],\"samplers\":[]}"),
        ("extras", "{}"),
        ("extras", "1"),
        ("extras", "[]"),
        ("extras", "\"\""),
        ("extras", "{\"a\":[]}"),
        ("extras", "{\"\":{\"\":{\"\":{}}}}"),
    ] {
        for (count, size) in [(100_000, "100,000"), (1_000_000, "a million")] {
            let file = move || {
                // After those that the scene needs.
                let mut file = File::sound();
                let first = file.json[list].as_array().into_iter().flatten();
                let first: String = first.map(|value| format!("{value},")).collect();
                file.json[list] = json!("@@");
                let long = format!("[{first}{}{item}]", format!("{item},").repeat(count - 1));
                file.text("\"@@\"", &long)
            };
            cases.push(Case::later(
                format!("{size} of {list}: {item}"),
                file,
                Either,
            ));
        }
    }
    cases
}

/// Triangles that are drawn many times, or that need much of everything.
fn meshes() -> Vec<Case> {
    let mut cases = vec![
        Case::later(
            "a million triangles without normals",
            || place(708, 1, 0.0),
            Either,
        ),
        Case::later(
            "50 instances of 20,000 triangles",
            || place(100, 50, 150.0),
            Either,
        ),
        Case::later(
            "50 instances of 20,000 triangles in one place",
            || place(100, 50, 0.0),
            Either,
        ),
        Case::later(
            "60,000 instances of 20,000 triangles",
            || place(100, 60_000, 1.0),
            Refused(""),
        ),
        Case::later(
            "180,000 triangles with all attributes",
            || full(300),
            Either,
        ),
        Case::later(
            "a million triangles with all attributes",
            || full(700),
            Either,
        ),
    ];
    let large = || {
        let mut file = full(750);
        let view = file.view(&png::plain(
            8192,
            8000,
            ColorType::Grayscale,
            BitDepth::Eight,
        ));
        file.set("/images/0/bufferView", json!(view))
    };
    cases.push(Case::later("much of everything", large, Refused("memory")));
    let filled = |bytes: usize| {
        move || {
            let mut file = full(40);
            file.view(&vec![0; bytes]);
            file
        }
    };
    cases.push(Case::later(
        "240 MB beside the scene",
        filled(240 << 20),
        Drawn,
    ));
    cases.push(Case::later(
        "300 MB beside the scene",
        filled(300 << 20),
        Refused("file_bytes"),
    ));
    let filled = || {
        let mut file = full(40);
        file.view(&vec![0; 240 << 20]);
        file
    };
    cases.push(Case::glb_later("glb of 240 MB", filled, Drawn));
    let inside = || {
        let file = full(40);
        file.set(
            "/buffers/0/uri",
            json!(format!("data:;base64,{}", "A".repeat(92 << 20))),
        )
    };
    cases.push(Case::later("92 MB inside the address", inside, Either));
    let inside = || {
        let file = full(40);
        file.set(
            "/buffers/0/uri",
            json!(format!("data:;base64,{}", "A".repeat(200 << 20))),
        )
    };
    cases.push(Case::later(
        "200 MB inside the address",
        inside,
        Refused("json_bytes"),
    ));
    // One accessor of zeros, many corners.
    let strip = |count: u64| {
        let mut file = File::sound();
        let zeros = json!({"componentType": 5126, "count": count, "type": "VEC3"});
        let zeros = file.push("accessors", zeros);
        file.set(
            "/meshes/0/primitives",
            json!([{"attributes": {"POSITION": zeros}, "mode": 5}]),
        )
    };
    for count in [1_000_000u64, 8_000_000, 80_000_000, 4_000_000_000] {
        cases.push(Case::of(
            format!("a strip of {count} zeros"),
            &strip(count),
            Either,
        ));
    }
    // The same zeros in many primitives.
    let mut file = File::sound();
    let zeros = json!({"componentType": 5126, "count": 3_000_000, "type": "VEC3"});
    let zeros = file.push("accessors", zeros);
    let primitive = json!({"attributes": {"POSITION": zeros}});
    let file = file.set("/meshes/0/primitives", json!(vec![primitive; 1_000]));
    cases.push(Case::of(
        "1,000 times a million triangles of zeros",
        &file,
        Either,
    ));
    cases
}

/// Corners and triangles of a bumpy floor.
fn grid(side: u32) -> (Vec<f32>, Vec<u32>) {
    let mut positions = Vec::new();
    for i in 0..=side {
        for k in 0..=side {
            positions.extend([i as f32, ((i * 7 + k * 13) % 5) as f32 * 0.1, k as f32]);
        }
    }
    let mut indices = Vec::new();
    for i in 0..side {
        for k in 0..side {
            let a = i * (side + 1) + k;
            indices.extend([a, a + 1, a + side + 2, a, a + side + 2, a + side + 1]);
        }
    }
    (positions, indices)
}

/// Such a floor in many places.
fn place(side: u32, nodes: usize, apart: f64) -> File {
    let (positions, indices) = grid(side);
    let mut file = File::sound();
    let at = file.accessor(&floats(&positions), 5126, positions.len() / 3, "VEC3");
    let by = file.accessor(&words(&indices), 5125, indices.len(), "SCALAR");
    let primitive = json!({"attributes": {"POSITION": at}, "indices": by});
    let mut file = file.set("/meshes/0/primitives", json!([primitive]));
    let mut roots = vec![1, 2];
    for i in 0..nodes {
        let node = json!({"mesh": 0, "translation": [i as f64 * apart, 0, 0]});
        roots.push(file.push("nodes", node));
    }
    file.set("/scenes/0/nodes", json!(roots))
}

/// A floor with everything that a corner can have, and nothing shared.
fn full(side: u32) -> File {
    let (positions, indices) = grid(side);
    let mut file = File::sound();
    let count = positions.len() / 3;
    let at = file.accessor(&floats(&positions), 5126, count, "VEC3");
    let by = file.accessor(&words(&indices), 5125, indices.len(), "SCALAR");
    let set: Vec<f32> = positions
        .chunks_exact(3)
        .flat_map(|p| [p[0] * 0.1, p[2] * 0.1])
        .collect();
    let set = file.accessor(&floats(&set), 5126, count, "VEC2");
    let colors = file.accessor(&floats(&vec![0.5; count * 4]), 5126, count, "VEC4");
    file.json["materials"][0]["normalTexture"] = json!({"index": 0, "texCoord": 1});
    file.json["materials"][0]["extensions"] =
        json!({"KHR_materials_anisotropy": {"anisotropyStrength": 0.5}});
    file.set(
        "/meshes/0/primitives",
        json!([{"material": 0, "indices": by, "attributes": {
        "POSITION": at, "TEXCOORD_0": set, "TEXCOORD_1": set, "COLOR_0": colors}}]),
    )
}
