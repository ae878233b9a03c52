//! Changes of a file that know what JSON, numbers, addresses and images are.

use super::seeds::{Patch, Seed};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use vsgl_tests::random::Random;

/// What members the objects at each place have in some file: values by name, by place without indices.
pub(crate) struct Vocabulary(BTreeMap<String, BTreeMap<String, Vec<Value>>>);

/// Values kept for a member.
const KEPT: usize = 24;

impl Vocabulary {
    pub(crate) fn of(seeds: &[Seed]) -> Self {
        let mut all = Self(BTreeMap::new());
        for seed in seeds {
            for (place, pointers) in places(&seed.json) {
                for pointer in pointers.iter().take(KEPT) {
                    if let Some(Value::Object(map)) = seed.json.pointer(pointer) {
                        all.learn(&place, map);
                    }
                }
            }
        }
        all
    }

    fn learn(&mut self, place: &str, map: &Map<String, Value>) {
        let known = self.0.entry(place.to_owned()).or_default();
        for (key, value) in map {
            let values = known.entry(key.clone()).or_default();
            if values.len() < KEPT && value.to_string().len() < 3_000 && !values.contains(value) {
                values.push(value.clone());
            }
        }
    }

    fn any(&self, place: &str, random: &mut Random) -> Option<(String, Value)> {
        let members = self.0.get(place)?;
        let (key, values) = members.iter().nth(below(random, members.len()))?;
        Some((
            key.clone(),
            values.get(below(random, values.len()))?.clone(),
        ))
    }
}

/// A number below `count`, 0 if that is 0.
fn below(random: &mut Random, count: usize) -> usize {
    (random.bits() % count.max(1) as u64) as usize
}

/// All values of a document: JSON pointers, by the same without indices.
fn places(json: &Value) -> BTreeMap<String, Vec<String>> {
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut open = vec![(String::new(), String::new(), json)];
    while let Some((place, pointer, value)) = open.pop() {
        match value {
            Value::Array(items) => {
                // Long lists are more of the same.
                for (i, item) in items.iter().enumerate().take(40) {
                    open.push((format!("{place}/*"), format!("{pointer}/{i}"), item));
                }
            }
            Value::Object(map) => {
                for (key, item) in map {
                    let escaped = key.replace('~', "~0").replace('/', "~1");
                    open.push((
                        format!("{place}/{key}"),
                        format!("{pointer}/{escaped}"),
                        item,
                    ));
                }
            }
            _ => {}
        }
        found.entry(place).or_default().push(pointer);
    }
    found
}

/// The file with one to four changes.
pub(crate) fn mutant(seed: &Seed, vocabulary: &Vocabulary, random: &mut Random) -> Seed {
    let mut mutant = seed.clone();
    let changes = random.pick(&[1, 1, 1, 2, 2, 4]);
    for _ in 0..changes {
        match below(random, 100) {
            0..62 => change_json(&mut mutant.json, vocabulary, random),
            62..82 => change_numbers(&mut mutant, random),
            82..94 => change_image(&mut mutant, random),
            94..96 => mutant.patch.push(Patch::Flip(random.bits())),
            96..97 => mutant.patch.push(Patch::Cut(random.unit())),
            97..99 => mutant
                .patch
                .push(Patch::Word(random.bits() % 64, edge(random) as u32)),
            _ => shuffle_files(&mut mutant, random),
        }
    }
    mutant
}

fn change_json(json: &mut Value, vocabulary: &Vocabulary, random: &mut Random) {
    let places = places(json);
    // By place first, so that a long list weighs no more than a short one.
    let Some((place, pointers)) = places.iter().nth(below(random, places.len())) else {
        return;
    };
    let pointer = &pointers[below(random, pointers.len())];
    let donor = &pointers[below(random, pointers.len())];
    let donor = json.pointer(donor).cloned().unwrap_or_default();
    let Some(value) = json.pointer_mut(pointer) else {
        return;
    };
    if below(random, 24) == 0 {
        *value = other_kind(random);
        return;
    }
    match value {
        Value::Number(number) => *value = other_number(number.as_f64().unwrap_or(0.0), random),
        Value::String(text) => *value = other_text(text, random),
        Value::Array(items) => change_list(items, donor, random),
        Value::Object(map) => change_object(map, vocabulary.any(place, random), random),
        Value::Bool(flag) => *flag = !*flag,
        Value::Null => *value = other_kind(random),
    }
}

/// Whole numbers around which programs stumble.
fn edge(random: &mut Random) -> u64 {
    let power = 1u64 << below(random, 64);
    match below(random, 4) {
        0 => power,
        1 => power - 1,
        2 => power.wrapping_add(1),
        _ => u64::MAX - below(random, 2) as u64,
    }
}

fn other_number(old: f64, random: &mut Random) -> Value {
    match below(random, 12) {
        // Another index, count or kind of component.
        0..5 => json!(below(random, 12)),
        5 => json!(random.pick(&[
            5120, 5121, 5122, 5123, 5125, 5126, 9728, 9987, 33071, 33648, 10497
        ])),
        6 => json!(edge(random)),
        7 => json!(-(below(random, 3) as i64)),
        8 => json!(random.pick(&[
            0.5, 1e-45, 1e-38, 1e-10, 1e10, 1e19, 1e38, 3.4e38, 1e39, 1e300, -1e38, -1e10, 3.15
        ])),
        9 => json!(old + random.pick(&[-1.0, 1.0])),
        10 => json!(old * random.pick(&[-1.0, 2.0, 0.5, 1e3, 1e-3])),
        _ => json!(old as i64 + random.pick(&[-1, 1, 2, 3, 100])),
    }
}

fn other_text(old: &str, random: &mut Random) -> Value {
    const TEXTS: &[&str] = &[
        "",
        ".",
        "..",
        "/",
        "../secret.bin",
        "%2e%2e/secret.bin",
        "/etc/passwd",
        "file:///etc/passwd",
        "/dev/zero",
        "data:",
        "data:;base64,AAAA",
        "data:image/png;base64,iVBORw0KGgo=",
        "data:,%",
        "s.bin",
        "scene.gltf",
        "missing",
        "SCALAR",
        "VEC2",
        "VEC3",
        "VEC4",
        "MAT2",
        "MAT3",
        "MAT4",
        "OPAQUE",
        "MASK",
        "BLEND",
        "perspective",
        "orthographic",
        "spot",
        "point",
        "directional",
        "image/png",
        "image/jpeg",
        "image/webp",
        "LINEAR",
        "STEP",
        "CUBICSPLINE",
        "translation",
        "rotation",
        "scale",
        "weights",
        "\u{1b}[2J",
        "\u{0}",
        "2.0",
        "1.0",
        "2.1",
        "KHR_lights_punctual",
        "KHR_mesh_quantization",
        "KHR_texture_transform",
        "EXT_mesh_gpu_instancing",
        "EXT_texture_webp",
        "KHR_materials_anisotropy",
        "KHR_draco_mesh_compression",
        "EXT_meshopt_compression",
    ];
    match below(random, 8) {
        0 => json!(old.repeat(1 + below(random, 50))),
        1 => json!(
            old.chars()
                .take(below(random, old.len()))
                .collect::<String>()
        ),
        2 => json!(format!("{old}\u{fffd}")),
        _ => json!(random.pick(TEXTS)),
    }
}

fn change_list(items: &mut Vec<Value>, donor: Value, random: &mut Random) {
    let count = items.len();
    match below(random, 8) {
        0 => items.clear(),
        1 => items.truncate(below(random, count)),
        2 if count > 0 => {
            let item = items[below(random, count)].clone();
            items.push(item);
        }
        3 if count > 0 && count < 200 => {
            let item = items[below(random, count)].clone();
            items.extend(vec![item; 1 + below(random, 300)]);
        }
        4 if count > 1 => items.swap(below(random, count), count - 1),
        5 if count > 0 => drop(items.remove(below(random, count))),
        6 => items.push(donor),
        _ => items.push(other_number(1.0, random)),
    }
}

fn change_object(
    map: &mut Map<String, Value>,
    known: Option<(String, Value)>,
    random: &mut Random,
) {
    let keys: Vec<String> = map.keys().cloned().collect();
    let key = keys.get(below(random, keys.len())).cloned();
    match (below(random, 8), key) {
        // A member that objects at this place have elsewhere.
        (0..5, _) => {
            if let Some((key, value)) = known {
                map.insert(key, value);
            }
        }
        (5, Some(key)) => drop(map.remove(&key)),
        (6, Some(key)) => {
            let value = map.remove(&key).unwrap_or_default();
            map.insert(other_key(&key, random), value);
        }
        (_, Some(key)) => drop(map.insert(key, other_kind(random))),
        (_, None) => drop(map.insert("POSITION".into(), json!(0))),
    }
}

fn other_key(old: &str, random: &mut Random) -> String {
    const KEYS: &[&str] = &[
        "POSITION",
        "NORMAL",
        "TANGENT",
        "TEXCOORD_0",
        "TEXCOORD_1",
        "TEXCOORD_4294967295",
        "TEXCOORD_9999999999",
        "COLOR_0",
        "COLOR_1",
        "JOINTS_0",
        "JOINTS_1",
        "WEIGHTS_0",
        "WEIGHTS_1",
        "_A",
        "",
        "extensions",
        "extras",
        "TRANSLATION",
        "ROTATION",
        "SCALE",
    ];
    match below(random, 3) {
        0 => old.to_uppercase(),
        _ => random.pick(KEYS).to_owned(),
    }
}

fn other_kind(random: &mut Random) -> Value {
    match below(random, 9) {
        0 => json!(null),
        1 => json!(true),
        2 => json!("x"),
        3 => json!([]),
        4 => json!({}),
        5 => json!([[]]),
        6 => json!({"index": 0}),
        7 => json!(1e30),
        _ => other_number(0.0, random),
    }
}

/// The bytes of a buffer: floats at their edges, or anything.
fn change_numbers(mutant: &mut Seed, random: &mut Random) {
    let buffers = mutant
        .beside
        .iter_mut()
        .filter(|(name, _)| name.ends_with(".bin"));
    let mut buffers: Vec<&mut Vec<u8>> = buffers
        .map(|(_, bytes)| bytes)
        .chain(mutant.bin.as_mut())
        .collect();
    let index = below(random, buffers.len());
    let Some(bytes) = buffers.get_mut(index).filter(|bytes| bytes.len() >= 8) else {
        return;
    };
    match below(random, 10) {
        0 => bytes.truncate(below(random, bytes.len())),
        1 => bytes.extend([0; 16]),
        2..4 => {
            let at = below(random, bytes.len());
            bytes[at] = random.bits() as u8;
        }
        4 => {
            // A stretch of one number.
            let value = edge_float(random).to_le_bytes();
            let start = below(random, bytes.len() / 4);
            let count = 1 + below(random, 64);
            for word in bytes.chunks_exact_mut(4).skip(start).take(count) {
                word.copy_from_slice(&value);
            }
        }
        5 => {
            // All floats of a stretch by a factor.
            let factor = random.pick(&[1e-30f32, 1e-10, 1e-3, -1.0, 1e3, 1e10, 1e30]);
            let start = below(random, bytes.len() / 4);
            let count = 1 + below(random, 4_096);
            for word in bytes.chunks_exact_mut(4).skip(start).take(count) {
                let value = f32::from_le_bytes([word[0], word[1], word[2], word[3]]) * factor;
                word.copy_from_slice(&value.to_le_bytes());
            }
        }
        _ => {
            for _ in 0..1 + below(random, 4) {
                let at = below(random, bytes.len() / 4 - 1) * 4;
                bytes[at..at + 4].copy_from_slice(&edge_float(random).to_le_bytes());
            }
        }
    }
}

fn edge_float(random: &mut Random) -> f32 {
    random.pick(&[
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        f32::MIN,
        1e38,
        1e30,
        1e20,
        -1e19,
        1e15,
        1e10,
        1e9,
        1e7,
        1e6,
        1.0,
        0.0,
        -0.0,
        -1.0,
        1e-6,
        1e-10,
        1e-19,
        1e-20,
        1e-30,
        f32::MIN_POSITIVE,
        1e-40,
        1e-45,
    ])
}

/// The bytes of an image, wherever it lies.
fn change_image(mutant: &mut Seed, random: &mut Random) {
    let beside = mutant.beside.iter_mut().map(|(_, bytes)| bytes);
    let mut holders: Vec<&mut Vec<u8>> = beside.chain(mutant.bin.as_mut()).collect();
    let signs: [&[u8]; 3] = [b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"RIFF"];
    let found = |bytes: &[u8]| {
        signs
            .iter()
            .find_map(|sign| bytes.windows(sign.len()).position(|w| w == *sign))
    };
    holders.retain(|bytes| found(bytes).is_some());
    let index = below(random, holders.len());
    let Some(bytes) = holders.get_mut(index) else {
        return;
    };
    let start = found(bytes).unwrap_or(0);
    let rest = bytes.len() - start;
    // Headers matter most, and lie in front.
    let reach = if below(random, 2) == 0 {
        rest.min(200)
    } else {
        rest
    };
    match below(random, 6) {
        0 => {
            let keep = start + below(random, reach);
            bytes.truncate(keep);
        }
        1 => {
            let at = start + below(random, reach);
            let byte = bytes[at];
            let count = 1 + below(random, 40);
            bytes.splice(at..at, vec![byte; count]);
        }
        _ => {
            for _ in 0..1 + below(random, 6) {
                let at = start + below(random, reach);
                bytes[at] = random.pick(&[0, 1, 2, 4, 16, 127, 128, 254, 255]);
            }
        }
    }
    if bytes[start..].starts_with(signs[0]) {
        repair(&mut bytes[start..]);
    }
}

/// Puts the checksums of a PNG file right, so that more than they are tested.
fn repair(bytes: &mut [u8]) {
    let mut at = 8;
    while let Some(header) = bytes.get(at..at + 8) {
        let length = u32::from_be_bytes([header[0], header[1], header[2], header[3]]) as usize;
        let Some(end) = at
            .checked_add(8 + length)
            .filter(|&end| end + 4 <= bytes.len())
        else {
            return;
        };
        let sum = crate::png::checksum(&bytes[at + 4..end]).to_be_bytes();
        bytes[end..end + 4].copy_from_slice(&sum);
        at = end + 4;
    }
}

fn shuffle_files(mutant: &mut Seed, random: &mut Random) {
    let count = mutant.beside.len();
    match below(random, 3) {
        0 if count > 0 => drop(mutant.beside.remove(below(random, count))),
        1 if count > 1 => {
            let (a, b) = (below(random, count), below(random, count));
            let bytes = mutant.beside[a].1.clone();
            mutant.beside[b].1 = bytes;
        }
        _ => mutant.bin = None,
    }
}
