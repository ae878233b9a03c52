use super::*;
use crate::scene::Material;

fn material(json: &str) -> Result<Material> {
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}]"#;
    let file = File::triangle()
        .set("meshes", mesh)
        .set("materials", &format!("[{json}]"));
    Ok(file.load()?.materials.remove(0))
}

#[test]
fn factors_and_their_defaults() {
    let read = material("{}").unwrap();
    let expected = Material {
        name: "material 0".into(),
        ..Material::default()
    };
    assert_eq!(read, expected);
    let read = material(
        r#"{"name":"gold","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,1],
        "metallicFactor":0.25,"roughnessFactor":0.5}}"#,
    )
    .unwrap();
    let expected = Material {
        name: "gold".into(),
        base_color: [0.1, 0.2, 0.3],
        metallic: 0.25,
        roughness: 0.5,
        ..Material::default()
    };
    assert_eq!(read, expected);
}

#[test]
fn specular_and_refraction() {
    let read = material(
        r#"{"extensions":{"KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[1,2,0]},
        "KHR_materials_ior":{"ior":1.33}}}"#,
    )
    .unwrap();
    assert_eq!(read.specular, 0.5);
    assert_eq!(read.specular_color, [1.0, 2.0, 0.0]);
    assert_eq!(read.ior, 1.33);
    let infinite = material(r#"{"extensions":{"KHR_materials_ior":{"ior":0}}}"#).unwrap();
    assert_eq!(infinite.dielectric_fresnel(), ([1.0; 3], 1.0));
}

#[test]
fn what_shines_what_lets_through_and_what_is_not_lit() {
    let read = material(
        r#"{"emissiveFactor":[1,0.5,0],"doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.25,
        "pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.75]},
        "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":8},"KHR_materials_unlit":{},
        "KHR_materials_anisotropy":{"anisotropyStrength":0.5,"anisotropyRotation":-1.5}}}"#,
    )
    .unwrap();
    assert_eq!(read.emission, [8.0, 4.0, 0.0]);
    assert!(read.double_sided && read.unlit);
    assert_eq!((read.alpha, read.alpha_cutoff), (0.75, Some(0.25)));
    assert_eq!((read.anisotropy, read.anisotropy_rotation), (0.5, -1.5));
    assert_eq!(
        material(r#"{"alphaMode":"MASK"}"#).unwrap().alpha_cutoff,
        Some(0.5)
    );
    assert_eq!(
        material(r#"{"alphaMode":"BLEND"}"#).unwrap().alpha_cutoff,
        Some(0.5)
    );
    assert_eq!(
        material(r#"{"alphaCutoff":0.1}"#).unwrap().alpha_cutoff,
        None
    );
}

#[test]
fn extensions_that_the_parser_leaves_alone_are_checked() {
    for broken in [
        r#"{"anisotropyStrength":"much"}"#,
        r#"{"anisotropyTexture":7}"#,
    ] {
        let json = format!(r#"{{"extensions":{{"KHR_materials_anisotropy":{broken}}}}}"#);
        let error = material(&json).expect_err("refused").to_string();
        assert!(
            error.contains("materials[0].extensions.KHR_materials_anisotropy"),
            "{error}"
        );
    }
}

#[test]
fn factors_out_of_range_are_clamped_and_infinite_ones_refused() {
    let read = material(
        r#"{"pbrMetallicRoughness":{"baseColorFactor":[-1,7,0.5,1],"metallicFactor":2,"roughnessFactor":-3}}"#,
    )
    .unwrap();
    assert_eq!(read.base_color, [0.0, 1.0, 0.5]);
    assert_eq!((read.metallic, read.roughness), (1.0, 0.0));
    let (place, _) = refused(
        File::triangle()
            .set(
                "materials",
                r#"[{"pbrMetallicRoughness":{"metallicFactor":1e99}}]"#,
            )
            .set(
                "meshes",
                r#"[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}]"#,
            )
            .load(),
    );
    assert!(
        place.starts_with("materials[0].") || place.starts_with("JSON"),
        "{place}"
    );
}

#[test]
fn what_is_ignored_is_said_once() {
    let one = r#"{"alphaMode":"BLEND","emissiveFactor":[1,1,1],"normalTexture":{"index":0}}"#;
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":0},"material":0},
        {"attributes":{"POSITION":0,"COLOR_0":0},"material":1,"targets":[{"POSITION":0}]}]}]"#;
    let scene = File::triangle()
        .set("meshes", mesh)
        .set("materials", &format!("[{one},{one}]"))
        .set("textures", "[{}]")
        .set(
            "extensionsUsed",
            r#"["KHR_materials_sheen","KHR_materials_sheen"]"#,
        )
        .load()
        .unwrap();
    assert_eq!(
        scene.warnings,
        [
            "extension `KHR_materials_sheen` is ignored",
            "alpha blending is shown as a mask: surfaces are there where they are at least half opaque",
            "textures without a PNG, JPEG or WebP image are left out",
        ]
    );
    assert_eq!(scene.materials.len(), 2);
}

#[test]
fn materials_that_nothing_shows_are_dropped() {
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0},"material":1}]}]"#;
    let scene = File::triangle()
        .set("meshes", mesh)
        .set("materials", r#"[{"name":"a"},{"name":"b"}]"#)
        .load()
        .unwrap();
    assert_eq!(scene.materials.len(), 1);
    assert_eq!(scene.materials[0].name, "b");
    assert_eq!(scene.mesh.material, [0]);
}
