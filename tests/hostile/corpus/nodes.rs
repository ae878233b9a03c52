//! The tree of nodes: cycles, depths, transforms, instances, skins.

use super::Case;
use super::Fate::{self, Drawn, Either, Refused};
use crate::file::{File, floats, shorts};
use serde_json::{Value, json};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let tree = |name: &str, roots: Value, more: Vec<Value>, fate: Fate| {
        let mut file = File::sound().set("/scenes/0/nodes", roots);
        for node in more {
            file.push("nodes", node);
        }
        Case::of(name, &file, fate)
    };
    let family = |children: &[usize]| json!({"children": children});
    cases.extend([
        tree(
            "its own child",
            json!([3]),
            vec![family(&[3])],
            Refused("twice"),
        ),
        tree(
            "a ring of two",
            json!([3]),
            vec![family(&[4]), family(&[3])],
            Refused("twice"),
        ),
        tree(
            "a ring below",
            json!([0, 3]),
            vec![family(&[4]), family(&[5]), family(&[4])],
            Refused("twice"),
        ),
        tree(
            "two parents",
            json!([3, 4]),
            vec![family(&[0]), family(&[0])],
            Refused("twice"),
        ),
        tree(
            "root and child",
            json!([0, 3]),
            vec![family(&[0])],
            Refused("twice"),
        ),
        tree(
            "the same root twice",
            json!([0, 0]),
            vec![],
            Refused("twice"),
        ),
        tree(
            "child not there",
            json!([3]),
            vec![family(&[99])],
            Refused("nodes[3].children"),
        ),
        tree(
            "root not there",
            json!([99]),
            vec![],
            Refused("scenes[0].nodes"),
        ),
        tree("no root", json!([]), vec![], Refused("nothing to draw")),
        tree(
            "children null",
            json!([0, 3]),
            vec![json!({"children": null})],
            Either,
        ),
        tree("root negative", json!([-1]), vec![], Refused("JSON")),
    ]);
    let ring: Vec<Value> = (0..50_000)
        .map(|i| family(&[3 + (i + 1) % 50_000]))
        .collect();
    cases.push(tree("a ring of 50,000", json!([3]), ring, Refused("twice")));
    let mut chain: Vec<Value> = (0..100_000).map(|i| family(&[4 + i])).collect();
    chain.push(json!({"mesh": 0}));
    cases.push(tree(
        "a chain of 100,000",
        json!([1, 2, 3]),
        chain.clone(),
        Either,
    ));
    for node in &mut chain {
        node["scale"] = json!([1.001, 1.001, 1.001]);
    }
    cases.push(tree(
        "a chain of 100,000 that grows",
        json!([3]),
        chain.clone(),
        Refused(""),
    ));
    for node in &mut chain {
        node["scale"] = json!([0.999, 0.999, 0.999]);
    }
    cases.push(tree(
        "a chain of 100,000 that shrinks",
        json!([3]),
        chain.clone(),
        Either,
    ));
    for node in &mut chain {
        node["scale"] = json!([1, 1, 1]);
        node["rotation"] = json!([0.6, 0, 0, 0.8]);
    }
    cases.push(tree(
        "a chain of 100,000 that turns",
        json!([1, 2, 3]),
        chain,
        Either,
    ));
    let wide: Vec<usize> = (3..100_003).collect();
    let leaves = vec![json!({"translation": [1, 2, 3]}); 100_000];
    let mut all = leaves.clone();
    all.push(family(&wide));
    cases.push(tree(
        "100,000 children",
        json!([0, 1, 2, 100_003]),
        all,
        Drawn,
    ));
    let meshes = vec![json!({"mesh": 0}); 60_000];
    let roots: Vec<usize> = (1..60_003).collect();
    cases.push(tree(
        "60,000 times the same",
        json!(roots),
        meshes,
        Refused("one place"),
    ));
    let mut file = File::sound().remove("/scenes");
    file.json.as_object_mut().expect("a map").remove("scene");
    cases.push(Case::of("no scene", &file, Drawn));
    let scenes = vec![json!({"nodes": [0, 1, 2]}); 10_000];
    cases.push(Case::of(
        "10,000 scenes",
        &File::sound().set("/scenes", json!(scenes)),
        Drawn,
    ));
    cases.extend(transforms());
    cases.extend(instances());
    cases.extend(skins());
    cases
}

fn transforms() -> Vec<Case> {
    let mut cases = Vec::new();
    for node in 0..3 {
        for (key, value) in [
            (
                "matrix",
                json!([0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]),
            ),
            (
                "matrix",
                json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0]),
            ),
            (
                "matrix",
                json!([1, 0, 0, 5, 0, 1, 0, 5, 0, 0, 1, 5, 0, 0, 0, 1]),
            ),
            ("matrix", json!(vec![1e38; 16])),
            ("matrix", json!(vec![1e-38; 16])),
            (
                "matrix",
                json!([1e300, 0, 0, 0, 0, 1e300, 0, 0, 0, 0, 1e300, 0, 0, 0, 0, 1]),
            ),
            (
                "matrix",
                json!([1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1]),
            ),
            ("matrix", json!([1, 2, 3])),
            ("matrix", json!(vec![0; 17])),
            ("matrix", json!(null)),
            ("scale", json!([0, 0, 0])),
            ("scale", json!([1, 0, 1])),
            ("scale", json!([-1, -1, -1])),
            ("scale", json!([1e-30, 1e-30, 1e-30])),
            ("scale", json!([1e30, 1e-30, 1])),
            ("scale", json!([1e308, 1e308, 1e308])),
            ("scale", json!([1e9, 1, 1])),
            ("translation", json!([1e8, 0, 0])),
            ("translation", json!([1e15, 0, 0])),
            ("translation", json!([1e300, 1e300, 1e300])),
            ("translation", json!([1e-300, 0, 0])),
            ("translation", json!([1, 2])),
            ("rotation", json!([0, 0, 0, 0])),
            ("rotation", json!([1e-30, 0, 0, 0])),
            ("rotation", json!([1e300, 0, 0, 1e300])),
            ("rotation", json!([0, 0, 0, -1])),
            ("rotation", json!([1, 1, 1, 1])),
            ("rotation", json!(["0", 0, 0, 1])),
        ] {
            let mut file = File::sound();
            let name = format!("node {node}: {key} {value}");
            file.json["nodes"][node][key] = value;
            cases.push(Case::of(name, &file, Either));
        }
    }
    let both = File::sound()
        .set(
            "/nodes/0/matrix",
            json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]),
        )
        .set("/nodes/0/scale", json!([2, 2, 2]));
    cases.push(Case::of("matrix and scale", &both, Either));
    cases
}

/// `EXT_mesh_gpu_instancing`.
fn instances() -> Vec<Case> {
    let mut cases = Vec::new();
    let with = |attributes: Value, prepare: &dyn Fn(&mut File) -> Value| {
        let mut file = File::sound();
        let made = prepare(&mut file);
        let attributes = if attributes.is_null() {
            made
        } else {
            attributes
        };
        file.set(
            "/nodes/0/extensions",
            json!({"EXT_mesh_gpu_instancing": {"attributes": attributes}}),
        )
        .set("/extensionsUsed/-", json!("EXT_mesh_gpu_instancing"))
    };
    let none = |_: &mut File| Value::Null;
    for (name, attributes) in [
        ("attribute not there", json!({"TRANSLATION": 99})),
        ("no attribute", json!({})),
        ("attributes a text", json!("x")),
        ("of the wrong kind", json!({"TRANSLATION": 2})),
        ("rotations of the wrong kind", json!({"ROTATION": 0})),
        (
            "of different lengths",
            json!({"TRANSLATION": 0, "SCALE": 3}),
        ),
        ("of the positions", json!({"TRANSLATION": 0})),
        ("unknown", json!({"_\u{1b}": 0})),
    ] {
        cases.push(Case::of(
            format!("instances: {name}"),
            &with(attributes, &none),
            Either,
        ));
    }
    for (name, count) in [
        ("a million", 1_000_000u64),
        ("24 million", 24_000_000),
        ("2^53", 1 << 53),
    ] {
        let zeros = move |file: &mut File| {
            let accessor = json!({"componentType": 5126, "count": count, "type": "VEC3"});
            json!({"TRANSLATION": file.push("accessors", accessor)})
        };
        cases.push(Case::of(
            format!("instances: {name} in one place"),
            &with(Value::Null, &zeros),
            Either,
        ));
    }
    for value in [f32::NAN, f32::INFINITY, 1e38, 0.0, 1e-40] {
        for (key, kind, width) in [
            ("TRANSLATION", "VEC3", 3),
            ("SCALE", "VEC3", 3),
            ("ROTATION", "VEC4", 4),
        ] {
            let made = move |file: &mut File| {
                let accessor = file.accessor(&floats(&vec![value; 2 * width]), 5126, 2, kind);
                json!({ key: accessor })
            };
            cases.push(Case::of(
                format!("instances: {key} {value:e}"),
                &with(Value::Null, &made),
                Either,
            ));
        }
    }
    cases
}

fn skins() -> Vec<Case> {
    let skinned = |skin: Value, joints: &[u16], weights: &[f32]| {
        let mut file = File::sound();
        let joints = file.accessor(&shorts(joints), 5123, joints.len() / 4, "VEC4");
        let weights = file.accessor(&floats(weights), 5126, weights.len() / 4, "VEC4");
        file.json["skins"] = json!([skin]);
        file.set("/nodes/0/skin", json!(0))
            .set("/meshes/0/primitives/0/attributes/JOINTS_0", json!(joints))
            .set(
                "/meshes/0/primitives/0/attributes/WEIGHTS_0",
                json!(weights),
            )
    };
    let (zero, even) = ([0u16; 32], [0.25f32; 32]);
    let of = |name: &str, file: &File| Case::of(format!("skin: {name}"), file, Either);
    let mut cases = vec![
        of("sound", &skinned(json!({"joints": [1, 2]}), &zero, &even)),
        of("no joint", &skinned(json!({"joints": []}), &zero, &even)),
        of(
            "joint not there",
            &skinned(json!({"joints": [99]}), &zero, &even),
        ),
        of(
            "joint is the mesh",
            &skinned(json!({"joints": [0]}), &zero, &even),
        ),
        of(
            "joint out of range",
            &skinned(json!({"joints": [1]}), &[65_535; 32], &even),
        ),
        of(
            "100,000 joints",
            &skinned(json!({"joints": vec![1; 100_000]}), &zero, &even),
        ),
        of(
            "matrices not there",
            &skinned(
                json!({"joints": [1], "inverseBindMatrices": 99}),
                &zero,
                &even,
            ),
        ),
        of(
            "matrices of positions",
            &skinned(
                json!({"joints": [1], "inverseBindMatrices": 0}),
                &zero,
                &even,
            ),
        ),
        of(
            "skeleton not there",
            &skinned(json!({"joints": [1], "skeleton": 99}), &zero, &even),
        ),
        of(
            "too few joints",
            &skinned(json!({"joints": [1]}), &zero[..8], &even),
        ),
        of(
            "too few weights",
            &skinned(json!({"joints": [1]}), &zero, &even[..8]),
        ),
        of("empty", &skinned(json!({}), &zero, &even)),
        of("not there", &File::sound().set("/nodes/0/skin", json!(7))),
    ];
    for weight in [f32::NAN, f32::INFINITY, -1.0, 0.0, 1e38, 1e-45] {
        let file = skinned(json!({"joints": [1, 2]}), &zero, &[weight; 32]);
        cases.push(of(&format!("weights {weight:e}"), &file));
    }
    for number in [f32::NAN, f32::INFINITY, 0.0, 1e38] {
        let mut file = skinned(json!({"joints": [1, 2]}), &zero, &even);
        let matrices = file.accessor(&floats(&[number; 32]), 5126, 2, "MAT4");
        let file = file.set("/skins/0/inverseBindMatrices", json!(matrices));
        cases.push(of(&format!("matrices of {number:e}"), &file));
    }
    cases
}
