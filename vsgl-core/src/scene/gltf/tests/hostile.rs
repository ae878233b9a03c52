use super::*;

/// Places one primitive instead of the triangle's.
fn primitive(text: &str) -> File {
    File::triangle().set("meshes", &format!("[{{\"primitives\":[{text}]}}]"))
}

#[test]
fn indices_out_of_range() {
    let mut file = File::triangle();
    file.accessor(&bytes_of(&[0u16, 1, 3]), 5123, 3, "SCALAR");
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0},"indices":2}]}]"#;
    refused_at("meshes[0].primitives[0].indices", file.set("meshes", mesh));
}

#[test]
fn references_to_nothing() {
    for (place, file) in [
        ("scene", File::triangle().set("scene", "1")),
        (
            "scenes[0].nodes",
            File::triangle().set("scenes", r#"[{"nodes":[7]}]"#),
        ),
        (
            "nodes[0].children",
            File::triangle().set("nodes", r#"[{"children":[7]}]"#),
        ),
        (
            "nodes[0].mesh",
            File::triangle().set("nodes", r#"[{"mesh":7}]"#),
        ),
        (
            "meshes[0].primitives[0].attributes.POSITION",
            primitive(r#"{"attributes":{"POSITION":7}}"#),
        ),
        (
            "meshes[0].primitives[0].indices",
            primitive(r#"{"attributes":{"POSITION":0},"indices":7}"#),
        ),
        (
            "meshes[0].primitives[0].material",
            primitive(r#"{"attributes":{"POSITION":0},"material":7}"#),
        ),
        (
            "accessors[0].bufferView",
            File::triangle().set("bufferViews", "[]"),
        ),
    ] {
        refused_at(place, file);
    }
}

#[test]
fn accessors_beyond_their_buffer() {
    for accessor in [
        r#"{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}"#,
        r#"{"bufferView":0,"byteOffset":1,"componentType":5126,"count":3,"type":"VEC3"}"#,
        r#"{"bufferView":0,"byteOffset":18446744073709551615,"componentType":5126,"count":3,"type":"VEC3"}"#,
        r#"{"bufferView":0,"componentType":5126,"count":18446744073709551615,"type":"VEC3"}"#,
        r#"{"bufferView":0,"componentType":5126,"count":1537228672809129302,"type":"VEC3"}"#,
    ] {
        let index = r#"{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}"#;
        let file = File::triangle().set("accessors", &format!("[{accessor},{index}]"));
        refused_at("accessors[0]", file);
    }
}

#[test]
fn accessors_of_the_wrong_kind() {
    let index = r#"{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}"#;
    for (place, accessor) in [
        (
            "accessors[0].type",
            r#"{"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"}"#,
        ),
        (
            "accessors[0].type",
            r#"{"bufferView":0,"componentType":5126,"count":3,"type":"VEC9"}"#,
        ),
        (
            "accessors[0].componentType",
            r#"{"bufferView":0,"componentType":5125,"count":3,"type":"VEC3"}"#,
        ),
        (
            "accessors[0].componentType",
            r#"{"bufferView":0,"componentType":1,"count":3,"type":"VEC3"}"#,
        ),
    ] {
        let file = File::triangle().set("accessors", &format!("[{accessor},{index}]"));
        refused_at(place, file);
    }
    // Floats as indices.
    refused_at(
        "accessors[0].type",
        primitive(r#"{"attributes":{"POSITION":0},"indices":0}"#),
    );
}

#[test]
fn views_beyond_their_buffer_and_narrow_strides() {
    for view in [
        r#"{"buffer":0,"byteOffset":40,"byteLength":36}"#,
        r#"{"buffer":0,"byteOffset":18446744073709551615,"byteLength":36}"#,
        r#"{"buffer":0,"byteLength":18446744073709551615}"#,
    ] {
        let file = File::triangle().set("bufferViews", &format!("[{view},{view}]"));
        let (place, message) = refused(file.load());
        assert!(place.starts_with("bufferViews["), "{message}");
    }
    for stride in [0, 4, 11] {
        let view = format!(r#"{{"buffer":0,"byteLength":36,"byteStride":{stride}}}"#);
        let file = File::triangle().set("bufferViews", &format!("[{view},{view}]"));
        refused_at("bufferViews[0].byteStride", file);
    }
}

#[test]
fn counts_without_data_cost_nothing() {
    for count in [99_999_999u64, u64::MAX / 3 * 3] {
        let accessor = format!(r#"{{"componentType":5126,"count":{count},"type":"VEC3"}}"#);
        let file = primitive(r#"{"attributes":{"POSITION":0}}"#);
        refused_at(
            "meshes[0].primitives[0].indices",
            file.set("accessors", &format!("[{accessor}]")),
        );
    }
    // Within the limits, but all in one point.
    let accessor = r#"[{"componentType":5126,"count":3000000,"type":"VEC3"}]"#;
    let file = primitive(r#"{"attributes":{"POSITION":0}}"#).set("accessors", accessor);
    assert!(file.load().unwrap().mesh.triangles.is_empty());
}

#[test]
fn attributes_of_different_lengths() {
    let mut file = File::triangle();
    file.floats(&[[0.0, 0.0, 1.0]; 2], "VEC3");
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":2},"indices":1}]}]"#;
    refused_at(
        "meshes[0].primitives[0].attributes.NORMAL",
        file.set("meshes", mesh),
    );
}

#[test]
fn corners_that_make_no_whole_triangle() {
    let mut file = File::triangle();
    file.accessor(&bytes_of(&[0u16, 1, 2, 0]), 5123, 4, "SCALAR");
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0},"indices":2}]}]"#;
    refused_at("meshes[0].primitives[0].indices", file.set("meshes", mesh));
}

#[test]
fn positions_that_are_no_place() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut file = File::triangle();
        file.floats(&[CORNERS[0], [1.0, bad, 0.0], CORNERS[2]], "VEC3");
        let mesh = r#"[{"primitives":[{"attributes":{"POSITION":2},"indices":1}]}]"#;
        let (place, message) = refused(file.set("meshes", mesh).load());
        assert_eq!(place, "meshes[0].primitives[0].attributes.POSITION");
        assert!(message.contains("vertex 1"), "{message}");
    }
}

#[test]
fn transforms_that_lead_nowhere() {
    for (place, node) in [
        ("nodes[0].rotation", r#"{"mesh":0,"rotation":[0,0,0,0]}"#),
        ("scene", r#"{"mesh":0,"scale":[1e20,1e20,1e20]}"#),
        ("scene", r#"{"mesh":0,"scale":[1e308,1e308,1]}"#),
        ("scene", r#"{"mesh":0,"scale":[1e-12,1e-12,1e-12]}"#),
    ] {
        refused_at(place, File::triangle().set("nodes", &format!("[{node}]")));
    }
    let deep: Vec<String> = (1..40)
        .map(|i| format!(r#"{{"scale":[1e30,1e30,1e30],"children":[{i}]}}"#))
        .collect();
    let nodes = format!("[{},{{\"mesh\":0}}]", deep.join(","));
    let (place, _) = refused(File::triangle().set("nodes", &nodes).load());
    assert!(place.starts_with("nodes["), "{place}");
}

#[test]
fn cameras_and_lights_out_of_reach_are_left_out() {
    let scene = File::triangle()
        .set("scenes", r#"[{"nodes":[0,1,2]}]"#)
        .set(
            "nodes",
            r#"[{"mesh":0},{"camera":0,"translation":[1e300,0,0]},
            {"translation":[0,-1e12,0],"extensions":{"KHR_lights_punctual":{"light":0}}}]"#,
        )
        .set(
            "cameras",
            r#"[{"type":"perspective","perspective":{"yfov":1,"znear":1}}]"#,
        )
        .set(
            "extensions",
            r#"{"KHR_lights_punctual":{"lights":[{"type":"spot","spot":{}}]}}"#,
        )
        .load()
        .unwrap();
    assert!(scene.cameras.is_empty() && scene.lights.is_empty());
    assert_eq!(scene.warnings.len(), 2);
}

#[test]
fn node_cycles_and_shared_children() {
    for nodes in [
        r#"[{"children":[0]}]"#,
        r#"[{"children":[1]},{"children":[0]}]"#,
        r#"[{"children":[1,2]},{"children":[3]},{"children":[3]},{"mesh":0}]"#,
        r#"[{"children":[1,1]},{"mesh":0}]"#,
    ] {
        let (place, message) = refused(File::triangle().set("nodes", nodes).load());
        assert!(place.ends_with(".children"), "{message}");
        assert!(message.contains("reached twice"), "{message}");
    }
}

#[test]
fn depth_is_no_matter() {
    let last = 50_000;
    let mut nodes: Vec<String> = (0..last)
        .map(|i| format!(r#"{{"children":[{}],"translation":[1,0,0]}}"#, i + 1))
        .collect();
    nodes.push(r#"{"mesh":0}"#.into());
    let file = File::triangle().set("nodes", &format!("[{}]", nodes.join(",")));
    let scene = file.load().unwrap();
    assert_eq!(world(&scene, 0).x, f64::from(last));
    // Deep JSON, on the other hand, is the parser's to refuse.
    let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    let (place, _) = refused(File::triangle().set("extras", &deep).load());
    assert!(place.starts_with("JSON"), "{place}");
}

#[test]
fn limits_hold_for_instances() {
    let limits = Limits {
        triangles: 3,
        ..Limits::default()
    };
    let nodes = r#"[{"mesh":0},{"mesh":0},{"mesh":0},{"mesh":0}]"#;
    let file = |scene: &str| File::triangle().set("nodes", nodes).set("scenes", scene);
    assert!(file(r#"[{"nodes":[0,1,2]}]"#).load_within(&limits).is_ok());
    let (_, message) = refused(file(r#"[{"nodes":[0,1,2,3]}]"#).load_within(&limits));
    assert!(message.contains("more than 3 triangles"), "{message}");
    let limits = Limits {
        vertices: 8,
        ..Limits::default()
    };
    let (_, message) = refused(file(r#"[{"nodes":[0,1,2]}]"#).load_within(&limits));
    assert!(message.contains("more than 8 vertices"), "{message}");
}

#[test]
fn many_objects_are_refused_before_they_are_made() {
    let nodes = format!("[{}{{}}]", "{},".repeat(1 << 20));
    let (place, message) = refused(File::triangle().set("nodes", &nodes).load());
    assert_eq!(place, "JSON");
    assert!(message.contains("objects"), "{message}");
    // Braces in strings are no objects.
    let name = "{".repeat(2 << 20);
    let nodes = format!(r#"[{{"mesh":0,"name":"{name}\""}}]"#);
    assert!(File::triangle().set("nodes", &nodes).load().is_ok());
}

#[test]
fn every_truncation_of_a_binary_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let glb = File::triangle().glb();
    for length in 0..glb.len() {
        refused(load_bytes(&folder, &glb[..length]));
    }
}

/// Every byte of the JSON and of the headers changed: never a panic.
#[test]
fn changed_bytes_are_refused_or_read() {
    let folder = tempfile::tempdir().unwrap();
    let glb = File::triangle().glb();
    let mut outcomes = [0, 0];
    for position in 0..glb.len() {
        for change in [0x01, 0x90] {
            let mut changed = glb.clone();
            changed[position] ^= change;
            outcomes[usize::from(load_bytes(&folder, &changed).is_ok())] += 1;
        }
    }
    assert!(outcomes[0] > 100 && outcomes[1] > 50, "{outcomes:?}");
}

#[test]
fn text_that_is_not_gltf() {
    let folder = tempfile::tempdir().unwrap();
    for text in [
        "[]",
        "null",
        "{}",
        "{\"asset\":[]}",
        "\u{feff}{",
        "glTF",
        "not JSON",
    ] {
        refused(load_bytes(&folder, text.as_bytes()));
    }
    refused(load_bytes(&folder, &[0xff; 100]));
    refused(load_bytes(
        &folder,
        b"glTF\x01\0\0\0\x14\0\0\0\0\0\0\0\0\0\0\0",
    ));
}
