//! Buffers, buffer views, accessors: ranges, kinds, sparse replacements.

use super::Case;
use super::Fate::{self, Drawn, Either, Refused};
use crate::file::{File, floats, shorts, words};
use serde_json::{Value, json};

const HUGE: [u64; 8] = [
    1 << 31,
    u32::MAX as u64,
    1 << 32,
    1 << 53,
    (1 << 53) + 1,
    i64::MAX as u64,
    1 << 63,
    u64::MAX,
];

pub(super) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut edit = |name: String, pointer: &str, value: Value, fate: Fate| {
        cases.push(Case::of(name, &File::sound().set(pointer, value), fate));
    };
    for huge in HUGE {
        for (name, pointer) in [
            ("buffer length", "/buffers/0/byteLength"),
            ("view length", "/bufferViews/0/byteLength"),
            ("view offset", "/bufferViews/0/byteOffset"),
            ("accessor offset", "/accessors/0/byteOffset"),
            ("accessor count", "/accessors/0/count"),
            ("count of indices", "/accessors/3/count"),
        ] {
            edit(format!("{name} {huge}"), pointer, json!(huge), Refused(""));
        }
        edit(
            format!("stride {huge}"),
            "/bufferViews/0/byteStride",
            json!(huge),
            Refused(""),
        );
    }
    for (pointer, value, fate) in [
        ("/buffers/0/byteLength", json!(0), Refused("bufferViews")),
        ("/buffers/0/byteLength", json!(-1), Refused("JSON")),
        (
            "/bufferViews/0/byteLength",
            json!(0),
            Refused("accessors[0]"),
        ),
        ("/bufferViews/0/byteLength", json!(-4), Refused("JSON")),
        ("/bufferViews/0/byteOffset", json!(-4), Refused("JSON")),
        ("/bufferViews/0/byteOffset", json!(1), Either),
        ("/bufferViews/0/byteOffset", json!(3), Either),
        (
            "/bufferViews/0/buffer",
            json!(1),
            Refused("bufferViews[0].buffer"),
        ),
        ("/bufferViews/0/buffer", json!(-1), Refused("JSON")),
        ("/bufferViews/0/buffer", json!(4_294_967_296_u64), Either),
        ("/bufferViews/0/byteStride", json!(0), Refused("byteStride")),
        ("/bufferViews/0/byteStride", json!(1), Refused("byteStride")),
        (
            "/bufferViews/0/byteStride",
            json!(11),
            Refused("byteStride"),
        ),
        (
            "/bufferViews/0/byteStride",
            json!(13),
            Refused("accessors[0]"),
        ),
        ("/bufferViews/0/target", json!(1), Either),
        ("/bufferViews/0/target", json!("x"), Either),
        ("/accessors/0/byteOffset", json!(1), Refused("accessors[0]")),
        (
            "/accessors/0/bufferView",
            json!(99),
            Refused("accessors[0].bufferView"),
        ),
        ("/accessors/0/bufferView", json!(4), Either),
        ("/accessors/0/count", json!(0), Either),
        ("/accessors/0/count", json!(1), Refused("indices")),
        ("/accessors/0/count", json!(9), Refused("accessors[0]")),
        (
            "/accessors/0/componentType",
            json!(0),
            Refused("accessors[0].componentType"),
        ),
        (
            "/accessors/0/componentType",
            json!(5124),
            Refused("accessors[0].componentType"),
        ),
        (
            "/accessors/0/componentType",
            json!(5125),
            Refused("accessors[0].componentType"),
        ),
        ("/accessors/0/componentType", json!(5120), Either),
        ("/accessors/0/componentType", json!(5123), Either),
        ("/accessors/0/componentType", json!(1e10), Refused("")),
        (
            "/accessors/0/type",
            json!("VEC2"),
            Refused("accessors[0].type"),
        ),
        (
            "/accessors/0/type",
            json!("MAT4"),
            Refused("accessors[0].type"),
        ),
        (
            "/accessors/0/type",
            json!("VEC5"),
            Refused("accessors[0].type"),
        ),
        ("/accessors/0/type", json!("\u{1b}[31m"), Refused("")),
        ("/accessors/0/type", json!(3), Refused("")),
        ("/accessors/0/normalized", json!(true), Either),
        ("/accessors/0/min", json!([1e38, 1e38, 1e38]), Either),
        ("/accessors/0/max", json!([-1e38, -1e38, -1e38]), Either),
        ("/accessors/0/max", json!("x"), Either),
        ("/accessors/0/min", json!([]), Either),
        ("/accessors/0/min", json!(vec![0; 100_000]), Either),
        (
            "/accessors/3/componentType",
            json!(5126),
            Refused("accessors[3]"),
        ),
        (
            "/accessors/3/componentType",
            json!(5122),
            Refused("accessors[3]"),
        ),
        (
            "/accessors/3/componentType",
            json!(5125),
            Refused("accessors[3]"),
        ),
        ("/accessors/3/componentType", json!(5121), Either),
        ("/accessors/3/count", json!(11), Refused("indices")),
        ("/accessors/3/count", json!(0), Either),
        (
            "/accessors/3/type",
            json!("VEC3"),
            Refused("accessors[3].type"),
        ),
        ("/accessors/1/count", json!(3), Refused("NORMAL")),
        ("/accessors/2/count", json!(3), Refused("TEXCOORD")),
        ("/accessors/2/componentType", json!(5123), Either),
        (
            "/accessors/1/type",
            json!("VEC4"),
            Refused("accessors[1].type"),
        ),
    ] {
        edit(
            format!("{pointer} = {}", short(&value)),
            pointer,
            value,
            fate,
        );
    }
    cases.extend(references());
    cases.extend(sparse());
    cases
}

fn short(value: &Value) -> String {
    value.to_string().chars().take(30).collect()
}

/// Indices of attributes and the like.
fn references() -> Vec<Case> {
    let mut cases = Vec::new();
    for index in [
        json!(99),
        json!(-1),
        json!(4_294_967_295_u64),
        json!(1e3),
        json!(1.5),
        json!("0"),
        json!(null),
    ] {
        for place in [
            "/meshes/0/primitives/0/attributes/POSITION",
            "/meshes/0/primitives/0/attributes/NORMAL",
            "/meshes/0/primitives/0/attributes/TEXCOORD_0",
            "/meshes/0/primitives/0/attributes/TANGENT",
            "/meshes/0/primitives/0/attributes/COLOR_0",
            "/meshes/0/primitives/0/attributes/JOINTS_0",
            "/meshes/0/primitives/0/indices",
            "/meshes/0/primitives/0/material",
            "/nodes/0/mesh",
            "/nodes/1/camera",
            "/nodes/2/extensions/KHR_lights_punctual/light",
            "/materials/0/pbrMetallicRoughness/baseColorTexture/index",
            "/textures/0/source",
            "/textures/0/sampler",
            "/images/0/bufferView",
            "/scene",
        ] {
            let file = File::sound().set(place, index.clone());
            cases.push(Case::of(format!("{place} = {index}"), &file, Either));
        }
    }
    let file = File::sound().set(
        "/meshes/0/primitives/0/attributes",
        json!({"POSITION": 3, "NORMAL": 3}),
    );
    cases.push(Case::of(
        "indices as positions",
        &file,
        Refused("accessors[3].type"),
    ));
    let file = File::sound().set("/meshes/0/primitives/0/attributes/NORMAL", json!(0));
    cases.push(Case::of("positions as normals", &file, Drawn));
    let file = File::sound().set("/meshes/0/primitives/0/indices", json!(0));
    cases.push(Case::of(
        "positions as indices",
        &file,
        Refused("accessors[0]"),
    ));
    let mut file = File::sound();
    let image = file.json["images"][0]["bufferView"].clone();
    file.json["accessors"][0]["bufferView"] = image;
    cases.push(Case::of("an image as positions", &file, Refused("")));
    let names: serde_json::Map<String, Value> = (0..20_000)
        .map(|i| (format!("TEXCOORD_{i}"), json!(2)))
        .collect();
    let mut file = File::sound();
    let attributes = file.json["meshes"][0]["primitives"][0]["attributes"]
        .as_object_mut()
        .expect("a map");
    attributes.extend(names);
    cases.push(Case::of(
        "20,000 sets of texture coordinates",
        &file,
        Either,
    ));
    for (name, set) in [
        ("set 4,294,967,295", json!(u32::MAX)),
        ("set -1", json!(-1)),
        ("set 7", json!(7)),
    ] {
        let file = File::sound().set(
            "/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord",
            set,
        );
        cases.push(Case::of(
            format!("texture coordinates: {name}"),
            &file,
            Either,
        ));
    }
    for index in [8u16, 255, 65_535] {
        let file = File::sound().poke(3, 4, &shorts(&[index]));
        cases.push(Case::of(
            format!("index {index} of 8 corners"),
            &file,
            Refused("indices"),
        ));
    }
    let mut file = File::sound();
    let indices = file.accessor(&words(&[0, 1, u32::MAX]), 5125, 3, "SCALAR");
    let file = file.set("/meshes/0/primitives/0/indices", json!(indices));
    cases.push(Case::of("index 2^32-1", &file, Refused("indices")));
    cases
}

/// A file whose positions are `count` zeros, of which `sparse` replaces some.
fn replacing(count: u64, indices: &[u8], kind: u32, replaced: u64, values: &[f32]) -> File {
    let mut file = File::sound();
    let (at, with) = (file.view(indices), file.view(&floats(values)));
    let accessor = file.push(
        "accessors",
        json!({"componentType": 5126, "count": count, "type": "VEC3", "sparse": {
            "count": replaced,
            "indices": {"bufferView": at, "componentType": kind},
            "values": {"bufferView": with},
        }}),
    );
    file.set(
        "/meshes/0/primitives",
        json!([{"attributes": {"POSITION": accessor}}]),
    )
}

fn sparse() -> Vec<Case> {
    let triangle = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let short = |list: &[u16]| shorts(list);
    let mut cases = vec![
        Case::of(
            "sparse",
            &replacing(3, &short(&[0, 1, 2]), 5123, 3, &triangle),
            Drawn,
        ),
        Case::of(
            "sparse: out of order",
            &replacing(3, &short(&[2, 1, 0]), 5123, 3, &triangle),
            Refused("sparse"),
        ),
        Case::of(
            "sparse: repeated",
            &replacing(3, &short(&[1, 1, 1]), 5123, 3, &triangle),
            Refused("sparse"),
        ),
        Case::of(
            "sparse: out of range",
            &replacing(3, &short(&[0, 1, 3]), 5123, 3, &triangle),
            Refused("sparse"),
        ),
        Case::of(
            "sparse: index 2^32-1",
            &replacing(3, &words(&[0, 1, u32::MAX]), 5125, 3, &triangle),
            Refused("sparse"),
        ),
        Case::of(
            "sparse: too few indices",
            &replacing(3, &short(&[0, 1]), 5123, 3, &triangle),
            Refused(""),
        ),
        Case::of(
            "sparse: too few values",
            &replacing(3, &short(&[0, 1, 2]), 5123, 3, &triangle[..6]),
            Refused(""),
        ),
        Case::of(
            "sparse: indices of floats",
            &replacing(3, &short(&[0, 1, 2]), 5126, 1, &triangle),
            Refused(""),
        ),
        Case::of(
            "sparse: indices of signed numbers",
            &replacing(3, &short(&[0, 1, 2]), 5122, 3, &triangle),
            Refused(""),
        ),
        Case::of(
            "sparse: indices of unknown kind",
            &replacing(3, &short(&[0, 1, 2]), 9, 3, &triangle),
            Refused(""),
        ),
        Case::of(
            "sparse: none replaced",
            &replacing(3, &short(&[0]), 5123, 0, &triangle),
            Either,
        ),
        Case::of(
            "sparse: more replaced than there are",
            &replacing(2, &short(&[0, 1, 2]), 5123, 3, &triangle),
            Refused("sparse"),
        ),
        Case::of(
            "sparse: 24 million zeros",
            &replacing(24_000_000, &short(&[0, 1, 2]), 5123, 3, &triangle),
            Either,
        ),
        Case::of(
            "sparse: values not finite",
            &replacing(3, &short(&[0, 1, 2]), 5123, 3, &[f32::NAN; 9]),
            Refused("POSITION"),
        ),
    ];
    for huge in HUGE {
        let name = format!("sparse: {huge} replaced");
        cases.push(Case::of(
            name,
            &replacing(3, &short(&[0, 1, 2]), 5123, huge, &triangle),
            Refused(""),
        ));
        let name = format!("sparse: {huge} zeros");
        cases.push(Case::of(
            name,
            &replacing(huge, &short(&[0, 1, 2]), 5123, 3, &triangle),
            Refused(""),
        ));
    }
    // The places are those of the values themselves.
    let mut file = replacing(3, &short(&[0, 1, 2]), 5123, 3, &triangle);
    let last = file.json["accessors"].as_array().map_or(0, |a| a.len() - 1);
    let values = file.json["accessors"][last]["sparse"]["values"]["bufferView"].clone();
    file.json["accessors"][last]["sparse"]["indices"]["bufferView"] = values;
    cases.push(Case::of("sparse: indices from the values", &file, Either));
    for (name, pointer) in [
        ("sparse: empty", ""),
        ("sparse: no indices", "/indices"),
        ("sparse: no values", "/values"),
        ("sparse: no count", "/count"),
    ] {
        let mut file = replacing(3, &short(&[0, 1, 2]), 5123, 3, &triangle);
        let sparse = &mut file.json["accessors"][last]["sparse"];
        match pointer {
            "" => *sparse = json!({}),
            _ => drop(
                sparse
                    .as_object_mut()
                    .and_then(|map| map.remove(&pointer[1..])),
            ),
        }
        cases.push(Case::of(name, &file, Refused("JSON")));
    }
    let mut file = File::sound();
    file.json["accessors"][3]["sparse"] = json!({"count": 1, "indices": {"bufferView": 3, "componentType": 5123},
        "values": {"bufferView": 3}});
    cases.push(Case::of("sparse indices of triangles", &file, Either));
    cases
}
