//! Colours of vertices, morph targets, skins, instancing.

use super::*;
use glam::{DVec3, Vec3, Vec4};

/// The triangle with one more attribute, which is accessor 2.
fn with_attribute(file: File, name: &str) -> File {
    file.set(
        "meshes",
        &format!(
            r#"[{{"primitives":[{{"attributes":{{"POSITION":0,"{name}":2}},"indices":1}}]}}]"#
        ),
    )
}

#[test]
fn colors_of_every_kind_and_none() {
    let half = 128.0 / 255.0;
    for (bytes, component, kind, expected) in [
        (
            bytes_of(&[[0.5f32, 2.0, -1.0]; 3]),
            5126,
            "VEC3",
            [0.5, 1.0, 0.0, 1.0],
        ),
        (
            bytes_of(&[[0.5f32, f32::NAN, 0.25, 0.75]; 3]),
            5126,
            "VEC4",
            [0.5, 0.0, 0.25, 0.75],
        ),
        (
            bytes_of(&[[255u8, 128, 0, 128]; 3]),
            5121,
            "VEC4",
            [1.0, half, 0.0, half],
        ),
        (
            bytes_of(&[[65535u16, 0, 13107, 65535]; 3]),
            5123,
            "VEC4",
            [1.0, 0.0, 0.2, 1.0],
        ),
    ] {
        let mut file = File::triangle();
        file.accessor(&bytes, component, 3, kind);
        let scene = with_attribute(file, "COLOR_0").load().unwrap();
        assert_eq!(scene.mesh.colors, [Vec4::from(expected); 3]);
    }
    assert!(File::triangle().load().unwrap().mesh.colors.is_empty());
    let mut file = File::triangle();
    file.floats(&[[0.0; 3]; 2], "VEC3");
    refused_at(
        "meshes[0].primitives[0].attributes.COLOR_0",
        with_attribute(file, "COLOR_0"),
    );
}

#[test]
fn what_has_no_colors_is_white_beside_what_has() {
    let mut file = File::triangle();
    file.floats(&[[0.0, 0.5, 1.0]; 3], "VEC3");
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0}},
        {"attributes":{"POSITION":0,"COLOR_0":2}}]}]"#;
    let colors = file.set("meshes", mesh).load().unwrap().mesh.colors;
    assert_eq!(colors[..3], [Vec4::ONE; 3]);
    assert_eq!(colors[3..], [Vec4::new(0.0, 0.5, 1.0, 1.0); 3]);
}

/// The triangle with two targets: 0 lifts all corners by 1, 1 moves the second corner to x = 3 and its normals.
fn morphed(weights: &str, node_weights: &str) -> File {
    let mut file = File::triangle();
    file.floats(&[[0.0, 0.0, 1.0]; 3], "VEC3");
    file.floats(&[[0.0; 3], [2.0, 0.0, 0.0], [0.0; 3]], "VEC3");
    let mesh = format!(
        r#"[{{{weights}"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":2}},"indices":1,
            "targets":[{{"POSITION":2}},{{"POSITION":3,"NORMAL":3}}]}}]}}]"#
    );
    let nodes = format!(r#"[{{{node_weights}"mesh":0}},{{"mesh":0,"translation":[0,0,7]}}]"#);
    file.set("meshes", &mesh)
        .set("nodes", &nodes)
        .set("scenes", r#"[{"nodes":[0,1]}]"#)
}

#[test]
fn morph_targets_move_by_their_weights() {
    let scene = morphed(r#""weights":[0.5,0.25],"#, "").load().unwrap();
    assert_eq!(world(&scene, 0), DVec3::Z * 0.5);
    assert_eq!(world(&scene, 1), DVec3::new(1.5, 0.0, 0.5));
    let leaning = Vec3::new(0.5, 0.0, 1.0).normalize();
    assert!(scene.mesh.normals[1].distance(leaning) < 1e-6);
    assert_eq!(scene.mesh.normals[2], Vec3::Z);
    // The second node shows the same.
    assert_eq!(world(&scene, 4), DVec3::new(1.5, 0.0, 7.5));
    assert!(scene.warnings.is_empty());
}

#[test]
fn weights_of_a_node_go_before_those_of_its_mesh() {
    let scene = morphed(r#""weights":[1,1],"#, r#""weights":[0,0.5],"#)
        .load()
        .unwrap();
    assert_eq!(world(&scene, 0), DVec3::ZERO);
    assert_eq!(world(&scene, 1), DVec3::X * 2.0);
    assert_eq!(world(&scene, 4), DVec3::new(3.0, 0.0, 8.0));
    let rest = morphed("", "").load().unwrap();
    assert_eq!(world(&rest, 1), DVec3::X);
}

#[test]
fn a_target_may_give_area_to_a_flat_triangle() {
    let mut file = File::triangle();
    file.floats(&[[0.0; 3]; 3], "VEC3");
    let mesh = r#"[{"weights":[1],"primitives":[{"attributes":{"POSITION":2},"targets":[{"POSITION":0}]}]}]"#;
    let scene = file.set("meshes", mesh).load().unwrap();
    assert_eq!(scene.mesh.triangles.len(), 1);
    assert_eq!(scene.mesh.normals, [Vec3::Z; 3]);
}

#[test]
fn displacements_are_counted_and_must_be_whole() {
    let limits = Limits {
        displacements: 6,
        ..Limits::default()
    };
    let file = || morphed(r#""weights":[0,1],"#, "");
    assert!(file().load_within(&limits).is_ok());
    let file = || morphed(r#""weights":[1,1],"#, "");
    let (_, message) = refused(file().load_within(&limits));
    assert!(message.contains("more than 6 displacements"), "{message}");
    let mut short = File::triangle();
    short.floats(&[[0.0; 3]; 2], "VEC3");
    let mesh = r#"[{"weights":[1],"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":2}]}]}]"#;
    refused_at(
        "meshes[0].primitives[0].targets[0].POSITION",
        short.set("meshes", mesh),
    );
}

/// The triangle, its last corner bound to a joint that stands 1 above and has moved up by 2.
fn skinned(joints: [u8; 4], nodes: &str) -> File {
    let mut file = File::triangle();
    file.accessor(
        &[[0, 0, 0, 0], [0, 0, 0, 0], joints].concat(),
        5121,
        3,
        "VEC4",
    );
    file.accessor(
        &[[255, 0, 0, 0], [255, 0, 0, 0], [0, 255, 0, 0]].concat(),
        5121,
        3,
        "VEC4",
    );
    let below = glam::Mat4::from_translation(Vec3::NEG_Y).to_cols_array();
    file.floats(&[glam::Mat4::IDENTITY.to_cols_array(), below], "MAT4");
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1}]}]"#;
    file.set("meshes", mesh)
        .set("skins", r#"[{"joints":[1,2],"inverseBindMatrices":4}]"#)
        .set("nodes", nodes)
}

const SKELETON: &str = r#"[{"mesh":0,"skin":0,"translation":[50,0,0],"children":[1]},
    {"children":[2],"translation":[-50,0,0]},{"translation":[0,3,0]}]"#;

#[test]
fn joints_place_the_vertices_and_the_node_of_the_mesh_does_not() {
    let scene = skinned([0, 1, 0, 0], SKELETON).load().unwrap();
    assert_eq!(world(&scene, 0), DVec3::ZERO);
    assert_eq!(world(&scene, 1), DVec3::X);
    assert_eq!(world(&scene, 2), DVec3::Y * 3.0);
    assert_eq!(scene.mesh.normals, [Vec3::Z; 3]);
    assert!(scene.warnings.is_empty());
}

#[test]
fn mirrored_joints_keep_the_winding_outward() {
    let nodes = SKELETON.replace(r#""translation":[-50,0,0]"#, r#""scale":[-1,1,1]"#);
    let scene = skinned([0, 1, 0, 0], &nodes).load().unwrap();
    let [a, b, c] = scene.mesh.triangles[0].map(|v| scene.mesh.positions[v as usize]);
    assert_eq!((b - a).cross(c - a).normalize(), Vec3::Z);
}

#[test]
fn skins_that_cannot_be_followed() {
    refused_at("nodes[0].skin", skinned([0, 2, 0, 0], SKELETON));
    // A joint that moves nothing does not count.
    assert!(skinned([0, 1, 200, 0], SKELETON).load().is_ok());
    refused_at(
        "skins[0].joints[1]",
        skinned([0, 1, 0, 0], SKELETON).set("skins", r#"[{"joints":[1,9]}]"#),
    );
    let three = r#"[{"joints":[1,2,2],"inverseBindMatrices":4}]"#;
    refused_at(
        "skins[0].inverseBindMatrices",
        skinned([0, 1, 0, 0], SKELETON).set("skins", three),
    );
    refused_at(
        "nodes[0].skin",
        skinned([0, 1, 0, 0], SKELETON).set("skins", "[]"),
    );
    let outside = r#"[{"mesh":0,"skin":0},{"children":[2]},{"translation":[0,3,0]}]"#;
    let scene = skinned([0, 1, 0, 0], outside).load().unwrap();
    assert_eq!(world(&scene, 2), DVec3::Y);
    assert_eq!(
        scene.warnings,
        ["skins with joints outside the scene are ignored: meshes are shown unbent"]
    );
    let limits = Limits {
        joints: 1,
        ..Limits::default()
    };
    let (place, _) = refused(skinned([0, 1, 0, 0], SKELETON).load_within(&limits));
    assert_eq!(place, "skins[0].joints");
}

/// The triangle under a node with these attributes; accessors 2, 3 and 4 are two translations, rotations and scales.
fn instanced(attributes: &str) -> File {
    let mut file = File::triangle();
    file.floats(&[[0.0f32, 0.0, 4.0], [0.0, 0.0, 8.0]], "VEC3");
    file.accessor(
        &bytes_of(&[[0i16, 0, 0, 32767], [0, 0, 32767, 0]]),
        5122,
        2,
        "VEC4",
    );
    file.floats(&[[1.0, 1.0, 1.0], [2.0, 2.0, 2.0]], "VEC3");
    file.push(
        "accessors",
        r#"{"componentType":5126,"count":9000000000000,"type":"VEC3"}"#,
    );
    let nodes = format!(
        r#"[{{"mesh":0,"translation":[10,0,0],"extensions":{{"EXT_mesh_gpu_instancing":
            {{"attributes":{attributes}}}}}}}]"#
    );
    file.set("nodes", &nodes)
        .set("extensionsRequired", r#"["EXT_mesh_gpu_instancing"]"#)
}

#[test]
fn instancing_places_copies_in_the_space_of_the_node() {
    let scene = instanced(r#"{"TRANSLATION":2,"ROTATION":3,"SCALE":4,"_ID":99}"#)
        .load()
        .unwrap();
    assert_eq!(scene.mesh.triangles, [[0, 1, 2], [3, 4, 5]]);
    assert!(world(&scene, 1).distance(DVec3::new(11.0, 0.0, 4.0)) < 1e-6);
    // Half a turn about z, twice as large.
    assert!(world(&scene, 4).distance(DVec3::new(8.0, 0.0, 8.0)) < 1e-6);
    assert!(scene.warnings.is_empty());
    assert_eq!(instanced("{}").load().unwrap().mesh.triangles.len(), 1);
}

#[test]
fn instancing_that_cannot_be() {
    let here = "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes";
    refused_at(&format!("{here}.SCALE"), instanced(r#"{"SCALE":99}"#));
    refused_at(&format!("{here}.SCALE"), instanced(r#"{"SCALE":"x"}"#));
    refused_at("accessors[3].type", instanced(r#"{"SCALE":3}"#));
    refused_at(here, instanced(r#"{"TRANSLATION":2,"SCALE":0}"#));
    let (place, message) = refused(instanced(r#"{"TRANSLATION":5}"#).load());
    assert_eq!(place, "scene");
    assert!(message.contains("triangles"), "{message}");
}

/// The triangle with normals, texture coordinates as an upright image has them, and a material with a normal map.
fn mapped(attributes: &str, node: &str) -> File {
    let mut file = File::triangle();
    file.floats(&[[0.0, 0.0, 1.0]; 3], "VEC3");
    file.floats(&[[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]], "VEC2");
    file.accessor(&bytes_of(&[[0i8, 127, 0, -127]; 3]), 5120, 3, "VEC4");
    file.json.insert(
        "accessors",
        file.json["accessors"].replace("5120,", "5120,\"normalized\":true,"),
    );
    let mesh = format!(
        r#"[{{"primitives":[{{"attributes":{{"POSITION":0{attributes}}},"indices":1,"material":0}}]}}]"#
    );
    let image = format!(r#"[{{"uri":"data:image/png;base64,{ONE_TEXEL}"}}]"#);
    file.set("meshes", &mesh)
        .set("nodes", &format!(r#"[{{{node}"mesh":0}}]"#))
        .set(
            "materials",
            r#"[{"normalTexture":{"index":0,"texCoord":1}}]"#,
        )
        .set("textures", r#"[{"source":0}]"#)
        .set("images", &image)
}

/// A PNG of one texel.
const ONE_TEXEL: &str = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJggg==";

const BOTH: &str = r#","NORMAL":2,"TEXCOORD_1":3"#;

#[test]
fn tangents_are_made_where_a_material_needs_them() {
    for attributes in [BOTH, r#","TEXCOORD_1":3"#] {
        let scene = mapped(attributes, "").load().unwrap();
        assert_eq!(scene.mesh.tangents, [Vec4::new(1.0, 0.0, 0.0, 1.0); 3]);
    }
    let plain = mapped(BOTH, "").set("materials", "[{}]").load().unwrap();
    assert!(plain.mesh.tangents.is_empty());
    let without = mapped("", "").load().unwrap();
    assert_eq!(without.mesh.tangents, [Vec4::ZERO; 3]);
}

#[test]
fn tangents_of_the_file_turn_with_the_node() {
    let given = format!(r#"{BOTH},"TANGENT":4"#);
    let scene = mapped(&given, "").load().unwrap();
    assert_eq!(scene.mesh.tangents, [Vec4::new(0.0, 1.0, 0.0, -1.0); 3]);
    let node = r#""rotation":[0,0,0.70710678118,0.70710678118],"scale":[1,-3,1],"#;
    let mirrored = mapped(&given, node).load().unwrap().mesh.tangents;
    assert!(
        mirrored
            .iter()
            .all(|t| t.distance(Vec4::new(1.0, 0.0, 0.0, 1.0)) < 1e-6)
    );
    // Made ones are the same as if the mirror had been there when they were made.
    let made = mapped(BOTH, node).load().unwrap().mesh.tangents;
    assert!(
        made.iter()
            .all(|t| t.distance(Vec4::new(0.0, 1.0, 0.0, -1.0)) < 1e-6),
        "{made:?}"
    );
}
