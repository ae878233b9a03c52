//! Cameras, lights, materials, names.

use super::Case;
use super::Fate::{self, Drawn, Either, Refused};
use crate::file::File;
use serde_json::{Value, json};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    cases.extend(numbers());
    cases.extend(cameras_and_lights());
    cases.extend(materials());
    cases.extend(names());
    cases
}

/// Numbers of cameras, lights and materials, one after the other at each edge.
fn numbers() -> Vec<Case> {
    let mut cases = Vec::new();
    let file = File::sound()
        .set("/cameras/0/perspective/aspectRatio", json!(1.0))
        .set("/cameras/0/perspective/zfar", json!(100.0))
        .set(
            "/extensions/KHR_lights_punctual/lights/0/range",
            json!(100.0),
        )
        .set("/materials/0/emissiveFactor", json!([0, 0, 0]))
        .set("/materials/0/alphaCutoff", json!(0.5))
        .set(
            "/materials/0/pbrMetallicRoughness/baseColorFactor",
            json!([1, 1, 1, 1]),
        )
        .set(
            "/materials/0/normalTexture",
            json!({"index": 0, "scale": 1.0}),
        )
        .set(
            "/materials/0/occlusionTexture",
            json!({"index": 0, "strength": 1.0}),
        )
        .set(
            "/materials/0/extensions",
            json!({
                "KHR_materials_ior": {"ior": 1.5},
                "KHR_materials_specular": {"specularFactor": 1.0, "specularColorFactor": [1, 1, 1]},
                "KHR_materials_emissive_strength": {"emissiveStrength": 1.0},
                "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 0.0},
            }),
        )
        .set(
            "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions",
            json!({
                "KHR_texture_transform": {"offset": [0, 0], "scale": [1, 1], "rotation": 0.0},
            }),
        );
    for pointer in [
        "/cameras/0/perspective/yfov",
        "/cameras/0/perspective/znear",
        "/cameras/0/perspective/zfar",
        "/cameras/0/perspective/aspectRatio",
        "/extensions/KHR_lights_punctual/lights/0/intensity",
        "/extensions/KHR_lights_punctual/lights/0/range",
        "/extensions/KHR_lights_punctual/lights/0/color/0",
        "/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle",
        "/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle",
        "/materials/0/alphaCutoff",
        "/materials/0/emissiveFactor/1",
        "/materials/0/normalTexture/scale",
        "/materials/0/occlusionTexture/strength",
        "/materials/0/pbrMetallicRoughness/baseColorFactor/0",
        "/materials/0/pbrMetallicRoughness/baseColorFactor/3",
        "/materials/0/pbrMetallicRoughness/metallicFactor",
        "/materials/0/pbrMetallicRoughness/roughnessFactor",
        "/materials/0/extensions/KHR_materials_ior/ior",
        "/materials/0/extensions/KHR_materials_specular/specularFactor",
        "/materials/0/extensions/KHR_materials_specular/specularColorFactor/2",
        "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength",
        "/materials/0/extensions/KHR_materials_anisotropy/anisotropyStrength",
        "/materials/0/extensions/KHR_materials_anisotropy/anisotropyRotation",
        "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset/0",
        "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/scale/0",
        "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/rotation",
    ] {
        for value in [
            json!(0),
            json!(-1),
            json!(3.2),
            json!(1e-38),
            json!(1e38),
            json!(-1e38),
            json!(1e300),
            json!("1"),
            json!(null),
        ] {
            let changed = file.clone().set(pointer, value.clone());
            cases.push(Case::of(format!("{pointer} = {value}"), &changed, Either));
        }
    }
    cases
}

fn cameras_and_lights() -> Vec<Case> {
    let of = |name: &str, pointer: &str, value, fate: Fate| {
        Case::of(name, &File::sound().set(pointer, value), fate)
    };
    let light = "/extensions/KHR_lights_punctual/lights/0";
    let mut cases = vec![
        of(
            "camera of no kind",
            "/cameras/0",
            json!({}),
            Refused("JSON"),
        ),
        of(
            "camera of unknown kind",
            "/cameras/0/type",
            json!("fisheye"),
            Either,
        ),
        of(
            "camera without its numbers",
            "/cameras/0",
            json!({"type": "perspective"}),
            Either,
        ),
        of(
            "parallel camera",
            "/cameras/0",
            json!({"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 1}}),
            Drawn,
        ),
        of(
            "parallel camera of nothing",
            "/cameras/0",
            json!({"type": "orthographic", "orthographic": {"xmag": 0, "ymag": 0, "znear": 0, "zfar": 0}}),
            Either,
        ),
        of(
            "parallel camera without end",
            "/cameras/0",
            json!({"type": "orthographic", "orthographic": {"xmag": 1e38, "ymag": 1e38, "znear": -1e38, "zfar": 1e38}}),
            Either,
        ),
        of("light of no kind", light, json!({}), Refused("")),
        of(
            "light of unknown kind",
            light,
            json!({"type": "laser"}),
            Either,
        ),
        of(
            "spot without a cone",
            light,
            json!({"type": "spot"}),
            Either,
        ),
        of(
            "cone reversed",
            &format!("{light}/spot"),
            json!({"innerConeAngle": 0.7, "outerConeAngle": 0.3}),
            Either,
        ),
        of(
            "cone of no angle",
            &format!("{light}/spot"),
            json!({"innerConeAngle": 0, "outerConeAngle": 0}),
            Either,
        ),
        of(
            "cone of half a turn",
            &format!("{light}/spot"),
            json!({"innerConeAngle": 0, "outerConeAngle": 3.1}),
            Either,
        ),
        of(
            "cone of a hair",
            &format!("{light}/spot"),
            json!({"innerConeAngle": 0, "outerConeAngle": 1e-30}),
            Either,
        ),
        of(
            "cone of 90 degrees",
            &format!("{light}/spot"),
            json!({"outerConeAngle": std::f64::consts::FRAC_PI_2}),
            Drawn,
        ),
        of(
            "point light",
            light,
            json!({"type": "point", "intensity": 5}),
            Drawn,
        ),
        of(
            "sun",
            light,
            json!({"type": "directional", "intensity": 5}),
            Drawn,
        ),
        of(
            "sun of 1e38",
            light,
            json!({"type": "directional", "intensity": 1e38}),
            Either,
        ),
        of(
            "light of no range",
            &format!("{light}/range"),
            json!(0),
            Either,
        ),
        of(
            "light of a huge colour",
            &format!("{light}/color"),
            json!([1e38, 1e38, 1e38]),
            Either,
        ),
        of(
            "light of too few colours",
            &format!("{light}/color"),
            json!([1]),
            Refused("JSON"),
        ),
        of(
            "light in a surface",
            "/nodes/2/translation",
            json!([0, 0, 0]),
            Drawn,
        ),
        of(
            "light in a corner",
            "/nodes/2/translation",
            json!([-1, 0, -1]),
            Drawn,
        ),
        of(
            "light a rounding off",
            "/nodes/2/translation",
            json!([0, 1e-40, 0]),
            Drawn,
        ),
        of(
            "eye in a surface",
            "/nodes/1/translation",
            json!([0, 0, 0]),
            Drawn,
        ),
        of(
            "eye far off",
            "/nodes/1/translation",
            json!([0, 0, 1e8]),
            Drawn,
        ),
        of(
            "light far off",
            "/nodes/2/translation",
            json!([0, 1e8, 0]),
            Drawn,
        ),
        of(
            "list of lights null",
            "/extensions/KHR_lights_punctual/lights",
            json!(null),
            Either,
        ),
        of(
            "list of lights a text",
            "/extensions/KHR_lights_punctual",
            json!("x"),
            Refused("JSON"),
        ),
        of(
            "no list of lights",
            "/extensions",
            json!({}),
            Refused("lights[0]"),
        ),
    ];
    for kind in ["spot", "point", "directional"] {
        for (count, fate) in [(20, Drawn), (1_000, Either), (60_000, Refused("lights"))] {
            let mut file = File::sound();
            file.json["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = json!(kind);
            let mut roots = vec![0, 1];
            for i in 0..count {
                let at = json!([(i % 7) as f64 * 0.1, 1.5, (i % 11) as f64 * 0.1]);
                let node = json!({"translation": at, "rotation": [-0.6, 0.0, 0.0, 0.8],
                    "extensions": {"KHR_lights_punctual": {"light": 0}}});
                roots.push(file.push("nodes", node));
            }
            let file = file.set("/scenes/0/nodes", json!(roots));
            cases.push(Case::of(format!("{count} lights: {kind}"), &file, fate));
        }
    }
    let mut file = File::sound();
    let mut roots = vec![0, 2];
    for _ in 0..20_000 {
        roots.push(file.push("nodes", json!({"camera": 0})));
    }
    cases.push(Case::of(
        "20,000 cameras",
        &file.set("/scenes/0/nodes", json!(roots)),
        Drawn,
    ));
    cases
}

fn materials() -> Vec<Case> {
    let of = |name: &str, pointer: &str, value, fate: Fate| {
        Case::of(name, &File::sound().set(pointer, value), fate)
    };
    let mut cases = vec![
        of(
            "material null",
            "/materials/0",
            json!(null),
            Refused("JSON"),
        ),
        of("material empty", "/materials/0", json!({}), Drawn),
        of(
            "unknown alpha mode",
            "/materials/0/alphaMode",
            json!("WINDOW"),
            Either,
        ),
        of(
            "alpha mode a number",
            "/materials/0/alphaMode",
            json!(1),
            Refused("JSON"),
        ),
        of(
            "three colours",
            "/materials/0/pbrMetallicRoughness/baseColorFactor",
            json!([1, 1, 1]),
            Refused("JSON"),
        ),
        of(
            "five colours",
            "/materials/0/pbrMetallicRoughness/baseColorFactor",
            json!([1, 1, 1, 1, 1]),
            Refused("JSON"),
        ),
        of(
            "extensions null",
            "/materials/0/extensions",
            json!(null),
            Either,
        ),
        of(
            "extension null",
            "/materials/0/extensions",
            json!({"KHR_materials_specular": null}),
            Either,
        ),
        of(
            "extension a number",
            "/materials/0/extensions",
            json!({"KHR_materials_ior": 5}),
            Either,
        ),
        of(
            "extension of the wrong kind",
            "/materials/0/extensions",
            json!({"KHR_materials_anisotropy": []}),
            Either,
        ),
        of(
            "anisotropy of texts",
            "/materials/0/extensions",
            json!({"KHR_materials_anisotropy": {"anisotropyStrength": "x"}}),
            Either,
        ),
        of(
            "anisotropy texture not there",
            "/materials/0/extensions",
            json!({"KHR_materials_anisotropy": {"anisotropyTexture": {"index": 77}}}),
            Either,
        ),
        of(
            "normal map without coordinates",
            "/materials/0/normalTexture",
            json!({"index": 0, "texCoord": 5}),
            Either,
        ),
        of(
            "normal map",
            "/materials/0/normalTexture",
            json!({"index": 0}),
            Drawn,
        ),
        of(
            "masked away",
            "/materials/0",
            json!({"alphaMode": "MASK", "alphaCutoff": 2.0}),
            Either,
        ),
        of(
            "shining",
            "/materials/0",
            json!({"emissiveFactor": [1, 1, 1],
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 1e30}}}),
            Either,
        ),
    ];
    let extras = (0..2_000).fold(json!(1), |inner, _| json!([inner]));
    cases.push(of(
        "deep extras",
        "/materials/0/extras",
        extras,
        Refused("JSON"),
    ));
    cases.push(of(
        "large extras",
        "/materials/0/extras",
        json!(vec![1; 500_000]),
        Drawn,
    ));
    let one = File::sound().json["materials"][0].clone();
    let mut file = File::sound();
    file.json["materials"] = json!(vec![one; 10_000]);
    let primitive = file.json["meshes"][0]["primitives"][0].clone();
    let primitives = (0..10_000).map(|i| {
        let mut primitive = primitive.clone();
        primitive["material"] = json!(i);
        primitive
    });
    let primitives: Vec<Value> = primitives.collect();
    cases.push(Case::of(
        "10,000 materials",
        &file.set("/meshes/0/primitives", json!(primitives)),
        Refused("one place"),
    ));
    cases
}

/// Names that a terminal would obey, or that are too long for one.
fn names() -> Vec<Case> {
    let mut cases = Vec::new();
    for (kind, name) in [
        (
            "escapes",
            "\u{1b}[2J\u{1b}]0;owned\u{7}\u{9b}31m".to_owned(),
        ),
        ("lines", "a\nerror: none\r\n\tb\0c".to_owned()),
        ("reversed text", "a\u{202e}b\u{2066}c".to_owned()),
        ("a million letters", "x".repeat(1_000_000)),
        ("nothing", String::new()),
        ("half a pair", "\u{fffd}".to_owned()),
    ] {
        let mut file = File::sound();
        for pointer in [
            "nodes",
            "meshes",
            "materials",
            "cameras",
            "images",
            "textures",
            "samplers",
            "scenes",
        ] {
            file.json[pointer][0]["name"] = json!(name);
        }
        file.json["nodes"][1]["name"] = json!(name);
        file.json["extensions"]["KHR_lights_punctual"]["lights"][0]["name"] = json!(name);
        file.json["asset"]["generator"] = json!(name);
        file.json["asset"]["copyright"] = json!(name);
        file.json["extensionsUsed"] = json!([name]);
        cases.push(Case::of(format!("names of {kind}"), &file, Either));
    }
    let lone = File::sound()
        .set("/cameras/0/name", json!("@"))
        .text("\"@\"", "\"\\ud800\"");
    cases.push(Case::of(
        "names of a lone surrogate",
        &lone,
        Refused("JSON"),
    ));
    cases
}
