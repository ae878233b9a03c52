//! Sound files to begin with.

use crate::file::{File, floats, glb, shorts};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use vsgl_tests::assets::assets;

/// A file taken apart.
#[derive(Clone)]
pub(crate) struct Seed {
    pub(crate) name: String,
    pub(crate) json: Value,
    /// Binary data in the file itself, which is a .glb file then.
    pub(crate) bin: Option<Vec<u8>>,
    /// Files beside it.
    pub(crate) beside: Vec<(String, Vec<u8>)>,
    /// Changes of the finished bytes.
    pub(crate) patch: Vec<Patch>,
}

/// A change of the finished bytes.
#[derive(Clone, Copy)]
pub(crate) enum Patch {
    /// This bit of the file flips.
    Flip(u64),
    /// The file ends after this share of its bytes.
    Cut(f32),
    /// These four bytes become another number.
    Word(u64, u32),
}

impl Seed {
    fn of(name: &str, file: &File) -> [Self; 2] {
        let seed = |bin: Option<Vec<u8>>| {
            let mut json = file.json.clone();
            let mut beside = Vec::new();
            match &bin {
                Some(_) => drop(
                    json["buffers"][0]
                        .as_object_mut()
                        .and_then(|map| map.remove("uri")),
                ),
                None => beside.push(("s.bin".to_owned(), file.bin.clone())),
            }
            Self {
                name: name.into(),
                json,
                bin,
                beside,
                patch: Vec::new(),
            }
        };
        [seed(None), seed(Some(file.bin.clone()))]
    }

    /// The bytes of the scene file.
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let text = self.json.to_string().into_bytes();
        let mut bytes = match &self.bin {
            Some(bin) => glb(&[(*b"JSON", text), (*b"BIN\0", bin.clone())]),
            None => text,
        };
        for patch in &self.patch {
            let length = bytes.len() as u64;
            match *patch {
                Patch::Flip(bit) => bytes[(bit / 8 % length) as usize] ^= 1 << (bit % 8),
                Patch::Cut(share) => bytes.truncate((length as f32 * share) as usize),
                Patch::Word(at, value) => {
                    let at = (at % length) as usize & !3;
                    let end = bytes.len().min(at + 4);
                    bytes[at..end].copy_from_slice(&value.to_le_bytes()[..end - at]);
                }
            }
            if bytes.is_empty() {
                break;
            }
        }
        bytes
    }

    /// Writes the file and those beside it; the path of the scene file.
    pub(crate) fn write(&self, folder: &Path) -> PathBuf {
        for (name, bytes) in &self.beside {
            let path = folder.join(name);
            fs::create_dir_all(path.parent().expect("a folder")).expect("writable");
            fs::write(path, bytes).expect("writable");
        }
        let path = folder.join(if self.bin.is_some() {
            "scene.glb"
        } else {
            "scene.gltf"
        });
        fs::write(&path, self.to_bytes()).expect("writable");
        path
    }

    /// Keeps the file in the folder that `VSGL_FUZZ_KEEP` names.
    pub(crate) fn keep(&self, number: u64) {
        if let Some(folder) = std::env::var_os("VSGL_FUZZ_KEEP") {
            let folder = Path::new(&folder).join(number.to_string());
            fs::create_dir_all(&folder).expect("writable");
            self.write(&folder);
        }
    }
}

/// Scenes made in code, with as much in them as a small file can have.
pub(crate) fn made() -> Vec<Seed> {
    let mut seeds = Vec::new();
    seeds.extend(Seed::of("sound", &File::sound()));
    seeds.extend(Seed::of("everything", &everything()));
    seeds
}

fn everything() -> File {
    let mut file = File::sound();
    let ones = |n: usize, v: f32| floats(&vec![v; n]);
    let tangents = file.accessor(&floats(&[1.0, 0.0, 0.0, 1.0].repeat(8)), 5126, 8, "VEC4");
    let colors = file.accessor(&shorts(&[40_000; 32]), 5123, 8, "VEC4");
    let moved = file.accessor(&ones(24, 0.01), 5126, 8, "VEC3");
    let joints = file.accessor(&shorts(&[0, 1, 0, 0].repeat(8)), 5123, 8, "VEC4");
    let weights = file.accessor(&floats(&[0.5, 0.5, 0.0, 0.0].repeat(8)), 5126, 8, "VEC4");
    let identity = [
        1.0f32, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    ];
    let matrices = file.accessor(&floats(&identity.repeat(2)), 5126, 2, "MAT4");
    let places = file.accessor(&floats(&[0.0, 0.0, 0.0, 3.0, 0.0, 0.0]), 5126, 2, "VEC3");
    let times = file.accessor(&floats(&[0.0, 1.0]), 5126, 2, "SCALAR");
    let sparse_at = file.view(&shorts(&[1, 2]));
    let sparse_to = file.view(&ones(6, 0.3));
    let sparse = file.push(
        "accessors",
        json!({"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
        "sparse": {"count": 2, "indices": {"bufferView": sparse_at, "componentType": 5123},
                   "values": {"bufferView": sparse_to}}}),
    );
    let transform = json!({"KHR_texture_transform": {"offset": [0.1, 0.2], "scale": [2, 3], "rotation": 0.3, "texCoord": 1}});
    let texture = json!({"index": 0, "extensions": transform});
    file.push("materials", json!({
        "name": "all",
        "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.8, 0.7, 0.9], "baseColorTexture": texture,
            "metallicRoughnessTexture": {"index": 0, "texCoord": 1}, "metallicFactor": 0.5, "roughnessFactor": 0.3},
        "normalTexture": {"index": 0, "scale": 0.7}, "occlusionTexture": {"index": 0, "strength": 0.5},
        "emissiveTexture": texture, "emissiveFactor": [0.2, 0.1, 0.3],
        "alphaMode": "MASK", "alphaCutoff": 0.3, "doubleSided": true,
        "extensions": {
            "KHR_materials_emissive_strength": {"emissiveStrength": 4.0},
            "KHR_materials_ior": {"ior": 1.4},
            "KHR_materials_specular": {"specularFactor": 0.8, "specularTexture": {"index": 0},
                "specularColorFactor": [1, 0.9, 0.8], "specularColorTexture": {"index": 0}},
            "KHR_materials_anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": 0.4, "anisotropyTexture": {"index": 0}},
        },
    }));
    file.push(
        "materials",
        json!({"alphaMode": "BLEND", "extensions": {"KHR_materials_unlit": {}}}),
    );
    file.push(
        "textures",
        json!({"source": 0, "extensions": {"EXT_texture_webp": {"source": 0}}}),
    );
    let attributes = json!({"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "TEXCOORD_1": 2, "TANGENT": tangents,
        "COLOR_0": colors, "JOINTS_0": joints, "WEIGHTS_0": weights});
    let target = json!({"POSITION": moved, "NORMAL": moved, "TANGENT": moved});
    file.push(
        "meshes",
        json!({"weights": [0.5], "primitives": [
            {"attributes": attributes, "indices": 3, "material": 1, "targets": [target]},
            {"attributes": {"POSITION": sparse}, "indices": 3, "material": 2, "mode": 5},
            {"attributes": {"POSITION": sparse, "TEXCOORD_0": 2}, "material": 1, "mode": 6},
        ]}),
    );
    file.push(
        "skins",
        json!({"joints": [4, 5], "inverseBindMatrices": matrices, "skeleton": 4}),
    );
    let nodes = [
        json!({"mesh": 1, "skin": 0, "weights": [0.2]}),
        json!({"children": [5], "translation": [0.1, 0, 0]}),
        json!({"scale": [1, -1, 1]}),
        json!({"mesh": 0, "translation": [0, 0, -1], "extensions": {"EXT_mesh_gpu_instancing": {"attributes":
            {"TRANSLATION": places}}}}),
        json!({"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1], "children": [8],
            "extensions": {"KHR_lights_punctual": {"light": 1}}}),
        json!({"rotation": [0, 0.6, 0, 0.8], "camera": 1, "extensions": {"KHR_lights_punctual": {"light": 2}}}),
    ];
    for node in nodes {
        file.push("nodes", node);
    }
    file.push(
        "cameras",
        json!({"type": "orthographic", "name": "flat",
        "orthographic": {"xmag": 2, "ymag": 2, "znear": 0.1, "zfar": 9}}),
    );
    file.push(
        "animations",
        json!({
            "channels": [{"sampler": 0, "target": {"node": 4, "path": "translation"}}],
            "samplers": [{"input": times, "output": places, "interpolation": "LINEAR"}],
        }),
    );
    file.push("scenes", json!({"nodes": [0], "name": "other"}));
    file.set("/scenes/0/nodes", json!([0, 1, 2, 3, 4, 6, 7]))
        .set(
            "/extensions/KHR_lights_punctual/lights/-",
            json!({"type": "point", "intensity": 3, "range": 9}),
        )
        .set(
            "/extensions/KHR_lights_punctual/lights/-",
            json!({"type": "directional", "intensity": 1}),
        )
        .set("/extensionsRequired", json!([]))
}

/// The conformance files that are small; none without `VSGL_ASSETS`.
pub(crate) fn found() -> Vec<Seed> {
    let Some(root) = assets("scenes-conformance", "changed conformance files") else {
        return Vec::new();
    };
    let mut seeds = Vec::new();
    let mut folders = vec![root];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("readable") {
            let path = entry.expect("readable").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                seeds.extend(apart(&path));
            }
        }
    }
    seeds.sort_by(|a, b| a.name.cmp(&b.name));
    seeds
}

/// Takes a file apart that others made; none if it is too large to be changed often.
fn apart(path: &Path) -> Option<Seed> {
    const MOST: usize = 600_000;
    let bytes = fs::read(path).ok()?;
    let (text, bin) = match path.extension()?.to_str()? {
        "gltf" => (bytes.clone(), None),
        "glb" if bytes.len() > 20 => {
            let size = u32::from_le_bytes(bytes[12..16].try_into().ok()?) as usize;
            let bin = bytes.get(28 + size..).unwrap_or_default();
            (bytes.get(20..20 + size)?.to_vec(), Some(bin.to_vec()))
        }
        _ => return None,
    };
    if text.len() > 120_000 || bytes.len() > MOST {
        return None;
    }
    let json: Value = serde_json::from_slice(&text).ok()?;
    let lists =
        ["buffers", "images"].map(|list| json[list].as_array().cloned().unwrap_or_default());
    let mut beside = Vec::new();
    for item in lists.iter().flatten() {
        let uri = item["uri"].as_str().unwrap_or("data:");
        if !uri.starts_with("data:") {
            let name = uri.replace("%20", " ");
            beside.push((
                name.clone(),
                fs::read(path.parent()?.join(name)).unwrap_or_default(),
            ));
        }
    }
    let total: usize = beside.iter().map(|(_, bytes)| bytes.len()).sum();
    let name = path.file_name()?.to_string_lossy().into_owned();
    (total <= MOST).then_some(Seed {
        name,
        json,
        bin,
        beside,
        patch: Vec::new(),
    })
}
