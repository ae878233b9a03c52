//! glTF text made in code.

use serde_json::json;
use vsgl_core::glam::{DVec3, Vec3};

/// Bytes as a `data:` URI.
fn data_uri(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::from("data:application/octet-stream;base64,");
    for three in bytes.chunks(3) {
        let padded = [0, 1, 2].map(|i| u32::from(three.get(i).copied().unwrap_or(0)));
        let bits = padded[0] << 16 | padded[1] << 8 | padded[2];
        for i in 0..4 {
            let digit = DIGITS[(bits >> (18 - 6 * i) & 63) as usize];
            text.push(if i <= three.len() { digit as char } else { '=' });
        }
    }
    text
}

/// A room with a tilted metal board, a spot and a camera, all below one node that is moved by `offset` \[m\].
pub fn room(offset: DVec3) -> String {
    let quads: [[[f32; 3]; 3]; 6] = [
        // Corner and two sides.
        [[-2.0, 0.0, -2.0], [0.0, 0.0, 4.0], [4.0, 0.0, 0.0]],
        [[-2.0, 3.0, -2.0], [4.0, 0.0, 0.0], [0.0, 0.0, 4.0]],
        [[-2.0, 0.0, -2.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]],
        [[-2.0, 0.0, -2.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]],
        [[2.0, 0.0, -2.0], [0.0, 0.0, 4.0], [0.0, 3.0, 0.0]],
        [[-0.5, 0.3, -1.0], [1.0, 0.0, 0.2], [0.0, 1.0, -0.5]],
    ];
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    for quad in quads {
        let [corner, u, v] = quad.map(Vec3::from_array);
        let normal = u.cross(v).normalize();
        for place in [
            corner,
            corner + u,
            corner + u + v,
            corner,
            corner + u + v,
            corner + v,
        ] {
            positions.push(place);
            normals.push(normal);
        }
    }
    let low = positions.iter().copied().reduce(Vec3::min).expect("some");
    let high = positions.iter().copied().reduce(Vec3::max).expect("some");
    let count = positions.len();
    let bytes: Vec<u8> = positions
        .iter()
        .chain(&normals)
        .flat_map(|v| v.to_array())
        .flat_map(f32::to_le_bytes)
        .collect();
    let walls = count - 6;
    let accessor = |first: usize, count: usize, bounds: Option<(Vec3, Vec3)>| {
        let mut accessor = json!({
            "bufferView": 0, "byteOffset": first * 12, "componentType": 5126, "count": count, "type": "VEC3"
        });
        if let Some((low, high)) = bounds {
            accessor["min"] = json!(low.to_array());
            accessor["max"] = json!(high.to_array());
        }
        accessor
    };
    json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": { "KHR_lights_punctual": { "lights": [{
            "type": "spot", "intensity": 30.0, "color": [1.0, 0.9, 0.8],
            "spot": { "innerConeAngle": 0.4, "outerConeAngle": 0.6 }
        }] } },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [
            { "translation": offset.to_array(), "children": [1, 2, 3] },
            { "mesh": 0 },
            // Downwards, along its own -z.
            { "translation": [0.3, 2.7, 0.4], "rotation": [-0.644_217_7, 0.0, 0.0, 0.764_842_2],
              "extensions": { "KHR_lights_punctual": { "light": 0 } } },
            { "translation": [0.0, 1.5, 1.9], "camera": 0 }
        ],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 1.0, "znear": 0.01 } }],
        "materials": [
            { "pbrMetallicRoughness": { "baseColorFactor": [0.7, 0.6, 0.5, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.5 } },
            { "pbrMetallicRoughness": { "baseColorFactor": [0.9, 0.8, 0.6, 1.0], "metallicFactor": 1.0, "roughnessFactor": 0.4 } }
        ],
        "meshes": [{ "primitives": [
            { "attributes": { "POSITION": 0, "NORMAL": 1 }, "material": 0 },
            { "attributes": { "POSITION": 2, "NORMAL": 3 }, "material": 1 }
        ] }],
        "accessors": [
            accessor(0, walls, Some((low, high))),
            accessor(count, walls, None),
            accessor(walls, 6, Some((low, high))),
            accessor(count + walls, 6, None),
        ],
        "bufferViews": [{ "buffer": 0, "byteLength": bytes.len() }],
        "buffers": [{ "uri": data_uri(&bytes), "byteLength": bytes.len() }]
    })
    .to_string()
}
