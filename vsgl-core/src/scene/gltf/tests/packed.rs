//! Triangles packed by extensions.

use super::*;
use draco_core::{
    DataType, EncoderBuffer, EncoderOptions, FaceIndex, GeometryAttributeType, Mesh, MeshEncoder,
    PointAttribute,
};
use glam::{DVec3, Vec4};

/// Two triangles of a square with colours in bytes, as Draco packs them.
fn square() -> Vec<u8> {
    let mut mesh = Mesh::new();
    let mut position = PointAttribute::new();
    position.init(
        GeometryAttributeType::Position,
        3,
        DataType::Float32,
        false,
        4,
    );
    let corners = [
        [0.0f32, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    for (i, value) in corners.as_flattened().iter().enumerate() {
        position.buffer_mut().write(4 * i, &value.to_le_bytes());
    }
    let mut color = PointAttribute::new();
    color.init(GeometryAttributeType::Color, 4, DataType::Uint8, true, 4);
    color.buffer_mut().write(0, &[255, 0, 51, 255].repeat(4));
    mesh.add_attribute(position);
    mesh.add_attribute(color);
    mesh.set_num_faces(2);
    for (i, face) in [[0u32, 1, 2], [0, 2, 3]].into_iter().enumerate() {
        mesh.set_face(FaceIndex(i as u32), face.map(Into::into));
    }
    let mut encoder = MeshEncoder::new();
    encoder.set_mesh(mesh);
    let mut buffer = EncoderBuffer::new();
    encoder.encode(&EncoderOptions::new(), &mut buffer).unwrap();
    buffer.data().to_vec()
}

/// A file whose triangles are these packed ones; its accessors have no data.
fn packed(bytes: &[u8]) -> File {
    let mut file = File::triangle();
    let view = file.view(bytes);
    file.push(
        "accessors",
        r#"{"componentType":5126,"count":4,"type":"VEC3"}"#,
    );
    file.push(
        "accessors",
        r#"{"componentType":5121,"normalized":true,"count":4,"type":"VEC4"}"#,
    );
    file.push(
        "accessors",
        r#"{"componentType":5123,"count":6,"type":"SCALAR"}"#,
    );
    let mesh = format!(
        r#"[{{"primitives":[{{"attributes":{{"POSITION":2,"COLOR_0":3}},"indices":4,"extensions":
            {{"KHR_draco_mesh_compression":{{"bufferView":{view},"attributes":{{"POSITION":0,"COLOR_0":1}}}}}}}}]}}]"#
    );
    file.set("meshes", &mesh)
        .set("extensionsRequired", r#"["KHR_draco_mesh_compression"]"#)
}

#[test]
fn draco_triangles_are_unpacked() {
    let scene = packed(&square()).load().unwrap();
    assert_eq!(scene.mesh.triangles.len(), 2);
    assert_eq!(scene.origin, DVec3::new(0.5, 0.5, 0.0));
    for triangle in &scene.mesh.triangles {
        let [a, b, c] = triangle.map(|v| scene.mesh.positions[v as usize]);
        assert!(((b - a).cross(c - a) - glam::Vec3::Z).length() < 1e-3);
    }
    let pink = Vec4::new(1.0, 0.0, 0.2, 1.0);
    assert!(scene.mesh.colors.iter().all(|&c| c == pink));
}

#[test]
fn broken_draco_is_refused() {
    let whole = square();
    let here = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression";
    for length in 0..whole.len() - 1 {
        refused_at(here, packed(&whole[..length]));
    }
    let mesh = packed(&whole).json["meshes"].clone();
    for (from, to, place) in [
        (r#""bufferView":2"#, r#""bufferView":-1"#, ".bufferView"),
        (r#""bufferView":2"#, r#""bufferView":99"#, ".bufferView"),
        (r#""COLOR_0":1}"#, r#""COLOR_0":"x"}"#, ".attributes"),
    ] {
        let file = packed(&whole).set("meshes", &mesh.replacen(from, to, 1));
        refused_at(&format!("{here}{place}"), file);
    }
    // What the packed data do not hold has no data at all.
    let file = packed(&whole).set(
        "meshes",
        &mesh.replacen(r#""POSITION":0"#, r#""POSITION":9"#, 1),
    );
    assert!(file.load().unwrap().mesh.triangles.is_empty());
}

#[test]
fn limits_hold_for_what_is_unpacked() {
    for (limits, word) in [
        (
            Limits {
                triangles: 1,
                ..Limits::default()
            },
            "triangles",
        ),
        (
            Limits {
                vertices: 3,
                ..Limits::default()
            },
            "vertices",
        ),
    ] {
        let (_, message) = refused(packed(&square()).load_within(&limits));
        assert!(message.contains(word), "{message}");
    }
}
