//! A sound scene made in code, to be broken piece by piece.

use crate::png;
use serde_json::{Value, json};

/// A glTF file: its JSON, its binary buffer, and changes of the text that JSON values cannot express.
#[derive(Clone, Debug)]
pub(crate) struct File {
    pub(crate) json: Value,
    pub(crate) bin: Vec<u8>,
    replaced: Vec<(String, String)>,
}

/// Bytes of numbers, little endian.
pub(crate) fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// Bytes of numbers, little endian.
pub(crate) fn shorts(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// Bytes of numbers, little endian.
pub(crate) fn words(values: &[u32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// A floor and a wall.
pub(crate) const CORNERS: [f32; 24] = [
    -1.0, 0.0, -1.0, -1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 0.0, -1.0, // floor
    -1.0, 0.0, -1.0, 1.0, 0.0, -1.0, 1.0, 2.0, -1.0, -1.0, 2.0, -1.0, // wall
];
const NORMALS: [f32; 24] = [
    0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, //
    0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0,
];
const TEXCOORDS: [f32; 16] = [
    0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0,
];
const INDICES: [u16; 12] = [0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7];

impl File {
    /// A textured floor and wall under a spot light, with a camera. Accessors: 0 positions, 1 normals, 2 texture
    /// coordinates, 3 indices; the buffer views have the same numbers, and 4 is the image. Nodes: 0 the mesh, 1 the
    /// camera, 2 the light.
    pub(crate) fn sound() -> Self {
        let mut file = Self {
            json: json!({
                "asset": {"version": "2.0"},
                "scene": 0,
                "scenes": [{"nodes": [0, 1, 2]}],
                "nodes": [
                    {"mesh": 0},
                    {"camera": 0, "translation": [0.0, 1.0, 3.0]},
                    {"translation": [0.0, 1.8, 0.9], "rotation": [-0.6, 0.0, 0.0, 0.8],
                     "extensions": {"KHR_lights_punctual": {"light": 0}}},
                ],
                "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
                "extensionsUsed": ["KHR_lights_punctual"],
                "extensions": {"KHR_lights_punctual": {"lights": [
                    {"type": "spot", "intensity": 10.0, "color": [1.0, 0.9, 0.8],
                     "spot": {"innerConeAngle": 0.3, "outerConeAngle": 0.7}},
                ]}},
                "meshes": [{"primitives": [{
                    "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0,
                }]}],
                "materials": [{"pbrMetallicRoughness": {
                    "baseColorTexture": {"index": 0}, "metallicFactor": 0.2, "roughnessFactor": 0.4,
                }}],
                "textures": [{"source": 0, "sampler": 0}],
                "samplers": [{"wrapS": 10497, "wrapT": 33648}],
                "accessors": [],
                "bufferViews": [],
                "buffers": [{"uri": "s.bin", "byteLength": 0}],
            }),
            bin: Vec::new(),
            replaced: Vec::new(),
        };
        file.accessor(&floats(&CORNERS), 5126, 8, "VEC3");
        file.accessor(&floats(&NORMALS), 5126, 8, "VEC3");
        file.accessor(&floats(&TEXCOORDS), 5126, 8, "VEC2");
        file.accessor(&shorts(&INDICES), 5123, 12, "SCALAR");
        let image = file.view(&png::checks(4, 4));
        file.set(
            "/images",
            json!([{"bufferView": image, "mimeType": "image/png"}]),
        )
    }

    /// Puts a value at a JSON pointer whose parent is there; `-` as the last part appends.
    pub(crate) fn set(mut self, pointer: &str, value: Value) -> Self {
        self.put(pointer, value);
        self
    }

    fn put(&mut self, pointer: &str, value: Value) {
        let (parent, last) = pointer.rsplit_once('/').expect("a pointer");
        match self.json.pointer_mut(parent) {
            Some(Value::Array(list)) if last == "-" => list.push(value),
            Some(Value::Array(list)) => list[last.parse::<usize>().expect("an index")] = value,
            Some(Value::Object(map)) => {
                map.insert(last.to_owned(), value);
            }
            _ => panic!("no {pointer}"),
        }
    }

    /// Takes what is at a JSON pointer away.
    pub(crate) fn remove(mut self, pointer: &str) -> Self {
        let (parent, last) = pointer.rsplit_once('/').expect("a pointer");
        let parent = self.json.pointer_mut(parent).expect("a parent");
        let gone = parent.as_object_mut().and_then(|map| map.remove(last));
        assert!(gone.is_some(), "no {pointer}");
        self
    }

    /// Replaces text of the JSON, for what no JSON value can be. It must be there.
    pub(crate) fn text(mut self, old: &str, new: &str) -> Self {
        self.replaced.push((old.to_owned(), new.to_owned()));
        self
    }

    /// Adds a buffer view; returns its index.
    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        let view = json!({"buffer": 0, "byteOffset": self.bin.len(), "byteLength": bytes.len()});
        self.bin.extend_from_slice(bytes);
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        self.json["buffers"][0]["byteLength"] = self.bin.len().into();
        self.push("bufferViews", view)
    }

    /// Adds an accessor with a buffer view of its own; returns its index.
    pub(crate) fn accessor(
        &mut self,
        bytes: &[u8],
        component: u32,
        count: usize,
        kind: &str,
    ) -> usize {
        let view = self.view(bytes);
        self.push(
            "accessors",
            json!({"bufferView": view, "componentType": component, "count": count, "type": kind}),
        )
    }

    /// Adds to a list of the file, which is made if need be; returns the index.
    pub(crate) fn push(&mut self, list: &str, item: Value) -> usize {
        let slot = &mut self.json[list];
        if slot.is_null() {
            *slot = json!([]);
        }
        let list = slot.as_array_mut().expect("a list");
        list.push(item);
        list.len() - 1
    }

    /// The same with other positions, as many corners as wanted, drawn without indices, normals and material.
    pub(crate) fn soup(positions: &[f32]) -> Self {
        let mut file = Self::sound();
        let accessor = file.accessor(&floats(positions), 5126, positions.len() / 3, "VEC3");
        file.set(
            "/meshes/0/primitives",
            json!([{"attributes": {"POSITION": accessor}}]),
        )
    }

    /// The same with other bytes in a part of the binary buffer.
    pub(crate) fn poke(mut self, view: usize, offset: usize, bytes: &[u8]) -> Self {
        let start = self.json["bufferViews"][view]["byteOffset"]
            .as_u64()
            .expect("a number");
        let start = start as usize + offset;
        self.bin[start..start + bytes.len()].copy_from_slice(bytes);
        self
    }

    /// The JSON text.
    pub(crate) fn to_text(&self) -> String {
        let mut text = self.json.to_string();
        for (old, new) in &self.replaced {
            assert!(text.contains(old), "no {old} in {text}");
            text = text.replace(old, new);
        }
        text
    }

    /// As a .glb file.
    pub(crate) fn to_glb(&self) -> Vec<u8> {
        let mut file = self.clone();
        if let Some(buffer) = file
            .json
            .pointer_mut("/buffers/0")
            .and_then(Value::as_object_mut)
        {
            buffer.remove("uri");
        }
        glb(&[
            (*b"JSON", file.to_text().into_bytes()),
            (*b"BIN\0", file.bin),
        ])
    }
}

/// A .glb file of these chunks, padded as they must be.
pub(crate) fn glb(chunks: &[([u8; 4], Vec<u8>)]) -> Vec<u8> {
    let mut body = Vec::new();
    for (kind, content) in chunks {
        let size = content.len().next_multiple_of(4);
        body.extend((size as u32).to_le_bytes());
        body.extend(kind);
        body.extend(content);
        let padding = if kind == b"JSON" { b' ' } else { 0 };
        body.resize(body.len().next_multiple_of(4), padding);
    }
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((body.len() as u32 + 12).to_le_bytes());
    bytes.extend(body);
    bytes
}
