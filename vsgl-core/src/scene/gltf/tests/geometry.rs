use super::*;
use glam::{DVec3, Vec2, Vec3};

#[test]
fn a_triangle_is_recentred_and_gets_its_own_normal() {
    let scene = File::triangle().load().unwrap();
    assert_eq!(scene.name, "t.gltf");
    assert_eq!(scene.origin, DVec3::new(0.5, 0.5, 0.0));
    assert_eq!(scene.mesh.triangles, [[0, 1, 2]]);
    for (i, corner) in CORNERS.into_iter().enumerate() {
        assert_eq!(world(&scene, i).as_vec3(), Vec3::from(corner));
        assert_eq!(scene.mesh.normals[i], Vec3::Z);
    }
    assert_eq!(scene.materials.len(), 1);
    assert_eq!(scene.materials[0], crate::scene::Material::default());
    assert!(scene.mesh.texcoords.is_empty() && scene.warnings.is_empty());
}

#[test]
fn indices_of_every_width_and_none() {
    let expected = File::triangle().load().unwrap().mesh;
    for (bytes, component) in [
        (bytes_of(&[0u8, 1, 2]), 5121),
        (bytes_of(&[0u16, 1, 2]), 5123),
        (bytes_of(&[0u32, 1, 2]), 5125),
    ] {
        let mut file = File::triangle();
        file.accessor(&bytes, component, 3, "SCALAR");
        let primitive = r#"[{"primitives":[{"attributes":{"POSITION":0},"indices":2}]}]"#;
        let mesh = file.set("meshes", primitive).load().unwrap().mesh;
        assert_eq!(mesh.positions, expected.positions);
        assert_eq!(mesh.triangles, expected.triangles);
    }
    let none = r#"[{"primitives":[{"attributes":{"POSITION":0}}]}]"#;
    let mesh = File::triangle().set("meshes", none).load().unwrap().mesh;
    assert_eq!(mesh.positions, expected.positions);
}

#[test]
fn strips_and_fans_face_one_way_and_lines_are_left_out() {
    let square = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
    ];
    let round = [square[0], square[1], square[3], square[2]];
    for (mode, corners) in [(5, square), (6, round)] {
        let mut file = File::triangle();
        file.floats(&corners, "VEC3");
        let primitive =
            format!(r#"[{{"primitives":[{{"attributes":{{"POSITION":2}},"mode":{mode}}}]}}]"#);
        let scene = file.set("meshes", &primitive).load().unwrap();
        assert_eq!(scene.mesh.triangles.len(), 2);
        assert!(
            scene.mesh.normals.iter().all(|&n| n == Vec3::Z),
            "mode {mode}"
        );
    }
    for mode in 0..4 {
        let primitive =
            format!(r#"[{{"primitives":[{{"attributes":{{"POSITION":0}},"mode":{mode}}}]}}]"#);
        let scene = File::triangle().set("meshes", &primitive).load().unwrap();
        assert!(scene.mesh.triangles.is_empty());
        assert_eq!(scene.warnings, ["points and lines are left out"]);
    }
}

#[test]
fn transforms_compose_from_the_root() {
    let nodes = r#"[{"children":[1],"translation":[10,0,0]},
        {"mesh":0,"scale":[2,2,2],"rotation":[0,0,0.70710678118,0.70710678118]}]"#;
    let scene = File::triangle().set("nodes", nodes).load().unwrap();
    // x turns to y: the second corner is at (10, 2, 0).
    assert!(world(&scene, 1).distance(DVec3::new(10.0, 2.0, 0.0)) < 1e-6);
    let matrix = r#"[{"mesh":0,"matrix":[0,2,0,0,-2,0,0,0,0,0,2,0,10,0,0,1]}]"#;
    let same = File::triangle().set("nodes", matrix).load().unwrap();
    for i in 0..3 {
        assert!(world(&scene, i).distance(world(&same, i)) < 1e-6);
    }
}

#[test]
fn far_from_the_origin_no_digit_is_lost() {
    let near =
        r#"[{"children":[1]},{"mesh":0,"translation":[0.123456789,0,0],"scale":[0.3,0.7,1]}]"#;
    let far = near.replacen(
        "\"children\"",
        "\"translation\":[100000,-100000,50000],\"children\"",
        1,
    );
    let near = File::triangle().set("nodes", near).load().unwrap();
    let far = File::triangle().set("nodes", &far).load().unwrap();
    assert_eq!(near.mesh.normals, far.mesh.normals);
    for (a, b) in near.mesh.positions.iter().zip(&far.mesh.positions) {
        assert!(a.distance(*b) < 1e-7, "{a} {b}");
    }
    let moved = far.origin - near.origin;
    assert!(moved.distance(DVec3::new(1e5, -1e5, 5e4)) < 1e-9);
}

#[test]
fn a_mirror_keeps_normals_and_winding_outward() {
    let mut file = File::triangle();
    file.floats(&[[0.0, 0.6, 0.8]; 3], "VEC3");
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":2},"indices":1}]}]"#;
    let nodes = r#"[{"mesh":0,"scale":[-1,1,1]}]"#;
    let scene = file.set("meshes", mesh).set("nodes", nodes).load().unwrap();
    let [a, b, c] = scene.mesh.triangles[0].map(|v| scene.mesh.positions[v as usize]);
    assert_eq!((b - a).cross(c - a).normalize(), Vec3::Z);
    assert!(scene.mesh.normals[0].distance(Vec3::new(0.0, 0.6, 0.8)) < 1e-6);
}

#[test]
fn normals_stay_upright_when_a_scale_squeezes() {
    let mut file = File::triangle();
    let slope = std::f32::consts::FRAC_1_SQRT_2;
    file.floats(
        &[[0.0, 0.0, 0.0], [1.0, -1.0, 0.0], [0.0, 0.0, 1.0]],
        "VEC3",
    );
    file.floats(&[[slope, slope, 0.0]; 3], "VEC3");
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":2,"NORMAL":3}}]}]"#;
    let nodes = r#"[{"mesh":0,"scale":[3,0.5,1]}]"#;
    let scene = file.set("meshes", mesh).set("nodes", nodes).load().unwrap();
    let [a, b, c] = scene.mesh.triangles[0].map(|v| scene.mesh.positions[v as usize]);
    let face = (b - a).cross(c - a).normalize();
    assert!(scene.mesh.normals[0].dot(face).abs() > 1.0 - 1e-6);
    assert!(scene.mesh.normals[0].is_normalized());
}

#[test]
fn instances_are_placed_one_by_one() {
    let nodes = r#"[{"mesh":0},{"mesh":0,"translation":[5,0,0]}]"#;
    let scenes = r#"[{"nodes":[1,0]}]"#;
    let scene = File::triangle()
        .set("nodes", nodes)
        .set("scenes", scenes)
        .load()
        .unwrap();
    assert_eq!(scene.mesh.triangles, [[0, 1, 2], [3, 4, 5]]);
    assert!(world(&scene, 0).distance(DVec3::ZERO) < 1e-6);
    assert!(world(&scene, 3).distance(DVec3::X * 5.0) < 1e-6);
}

#[test]
fn unusable_normals_are_made_from_the_faces() {
    let mut file = File::triangle();
    file.floats(
        &[[0.0, 0.0, 0.0], [f32::NAN, 0.0, 0.0], [0.0, 0.0, 7.0]],
        "VEC3",
    );
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":2},"indices":1}]}]"#;
    let scene = file.set("meshes", mesh).load().unwrap();
    assert_eq!(scene.mesh.normals, [Vec3::Z; 3]);
}

#[test]
fn triangles_without_area_and_vertices_without_triangle_are_dropped() {
    let mut file = File::triangle();
    file.floats(
        &[
            [9.0, 9.0, 9.0],
            CORNERS[0],
            CORNERS[1],
            CORNERS[2],
            [2.0, 0.0, 0.0],
        ],
        "VEC3",
    );
    let indices = [1u16, 2, 3, 1, 1, 2, 1, 2, 4];
    file.accessor(&bytes_of(&indices), 5123, indices.len(), "SCALAR");
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":2},"indices":3}]}]"#;
    let scene = file.set("meshes", mesh).load().unwrap();
    assert_eq!(scene.mesh.triangles.len(), 1);
    let flat = r#"[{"mesh":0,"scale":[1,0,0]}]"#;
    let scene = File::triangle().set("nodes", flat).load().unwrap();
    assert!(scene.mesh.triangles.is_empty());
}

#[test]
fn interleaved_and_quantised_attributes() {
    let mut file = File::triangle();
    // Four signed bytes a vertex: position and padding, scaled by the node.
    let bytes = [0u8, 0, 0, 99, 127, 0, 0, 99, 0, 127, 0, 99];
    file.view(&bytes);
    file.json.insert(
        "bufferViews",
        file.json["bufferViews"]
            .replace("\"byteLength\":12}", "\"byteLength\":12,\"byteStride\":4}"),
    );
    file.push(
        "accessors",
        r#"{"bufferView":2,"componentType":5120,"normalized":true,"count":3,"type":"VEC3"}"#,
    );
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":2},"indices":1}]}]"#;
    let required = r#"["KHR_mesh_quantization"]"#;
    let scene = file
        .set("meshes", mesh)
        .set("extensionsRequired", required)
        .load()
        .unwrap();
    let expected = File::triangle().load().unwrap();
    assert_eq!(scene.mesh.positions, expected.mesh.positions);
}

#[test]
fn sparse_accessors_with_and_without_a_base() {
    for base in [r#""bufferView":0,"#, ""] {
        let mut file = File::triangle();
        let indices = file.view(&bytes_of(&[1u16, 2]));
        let values = file.view(&bytes_of(&[4.0f32, 0.0, 0.0, 0.0, 6.0, 0.0]));
        file.push(
            "accessors",
            &format!(
                r#"{{{base}"componentType":5126,"count":3,"type":"VEC3","sparse":{{"count":2,
                "indices":{{"bufferView":{indices},"componentType":5123}},
                "values":{{"bufferView":{values}}}}}}}"#
            ),
        );
        let mesh = r#"[{"primitives":[{"attributes":{"POSITION":2},"indices":1}]}]"#;
        let scene = file.set("meshes", mesh).load().unwrap();
        assert_eq!(world(&scene, 1), DVec3::X * 4.0);
        assert_eq!(world(&scene, 2), DVec3::Y * 6.0);
    }
}

#[test]
fn texture_coordinates_only_where_a_texture_needs_them() {
    let mut file = File::triangle();
    file.floats(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], "VEC2");
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1}]}]"#;
    let scene = file.set("meshes", mesh).load().unwrap();
    assert_eq!(scene.mesh.texcoords, [Vec2::ZERO; 0]);
}

#[test]
fn nothing_to_draw_is_no_error() {
    for (member, text) in [("nodes", "[{}]"), ("scenes", r#"[{"nodes":[]}]"#)] {
        let scene = File::triangle().set(member, text).load().unwrap();
        assert!(scene.mesh.triangles.is_empty());
        assert_eq!(scene.origin, DVec3::ZERO);
    }
}

#[test]
fn without_a_scene_every_root_is_shown() {
    let nodes = r#"[{"children":[1]},{"mesh":0},{"mesh":0}]"#;
    let mut file = File::triangle().set("nodes", nodes);
    file.json.remove("scene");
    file.json.remove("scenes");
    let scene = file.load().unwrap();
    assert_eq!(scene.mesh.triangles.len(), 2);
    assert_eq!(
        scene.warnings,
        ["the file has no scene: all nodes are shown"]
    );
}
