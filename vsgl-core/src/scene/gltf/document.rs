//! The JSON of a file as typed values.

use super::fault::{Fault, Result, printable, quoted};
use super::limits::Limits;
use super::warnings::Warnings;
use gltf::json::{Root, Scene, Value, deserialize};

/// Extensions that are read, or that ask nothing of a reader.
const SUPPORTED: &[&str] = &[
    super::instancing::NAME,
    super::meshopt::NAME,
    "EXT_texture_webp",
    #[cfg(feature = "draco")]
    super::draco::NAME,
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// A parsed file.
pub(super) struct Document {
    pub(super) root: Root,
    /// The nodes untyped: the typed form rounds their numbers to f32.
    pub(super) nodes: Value,
}

impl Document {
    /// Parses, and refuses versions and required extensions that are not known.
    pub(super) fn parse(json: &[u8], limits: &Limits, warnings: &mut Warnings) -> Result<Self> {
        check_size(json, limits)?;
        let mut value: Value = deserialize::from_slice(json).map_err(|e| malformed(&e))?;
        check_version(&value)?;
        let nodes = value.get_mut("nodes").map(Value::take).unwrap_or_default();
        drop(value);
        let root: Root = match deserialize::from_slice(json) {
            Ok(root) => root,
            Err(e) => without_loose_channels(json).ok_or_else(|| malformed(&e))?,
        };
        check_required(&root.extensions_required)?;
        for name in ignored(&root) {
            warnings.add(format!("extension {} is ignored", quoted(name)));
        }
        Ok(Self { root, nodes })
    }

    /// Index of the scene that is to be shown: the one asked for, else the default of the file, else the first; none in a
    /// file without scenes.
    pub(super) fn scene(
        &self,
        wanted: Option<&str>,
        warnings: &mut Warnings,
    ) -> Result<Option<usize>> {
        let Root {
            scene,
            scenes,
            nodes,
            ..
        } = &self.root;
        if let Some(wanted) = wanted {
            return self.scene_called(wanted).map(Some);
        }
        let index = match scene {
            Some(scene) => scene.value(),
            None if !scenes.is_empty() => 0,
            None => {
                if !nodes.is_empty() {
                    warnings.add("the file has no scene: all nodes are shown");
                }
                return Ok(None);
            }
        };
        lookup(scenes, "scenes", index, || "scene".into())?;
        if scenes.len() > 1 {
            let count = scenes.len();
            warnings.add(format!(
                "scene {index} of {count} is shown; another can be chosen"
            ));
        }
        Ok(Some(index))
    }

    /// By name, and if none has it by index.
    fn scene_called(&self, wanted: &str) -> Result<usize> {
        let scenes = &self.root.scenes;
        let named = |scene: &Scene| scene.name.as_deref() == Some(wanted);
        let by_index = || wanted.parse().ok().filter(|&index| index < scenes.len());
        scenes
            .iter()
            .position(named)
            .or_else(by_index)
            .ok_or_else(|| {
                let name = |(i, scene): (usize, &Scene)| match &scene.name {
                    Some(name) => format!("{i} {}", quoted(name)),
                    None => i.to_string(),
                };
                let names: Vec<_> = scenes.iter().enumerate().take(LISTED).map(name).collect();
                let remedy = match names.is_empty() {
                    true => "it has none; leave the choice out".to_owned(),
                    false if scenes.len() > LISTED => {
                        format!("its scenes are {}, …", names.join(", "))
                    }
                    false => format!("its scenes are {}", names.join(", ")),
                };
                Fault::setting(
                    "scene",
                    format!("the file has no scene {}", quoted(wanted)),
                    remedy,
                )
            })
    }

    /// Names of the scenes; empty for those without.
    pub(super) fn scene_names(&self) -> Vec<String> {
        let scenes = self.root.scenes.iter();
        let name = |s: &Scene| s.name.as_deref().map(printable).unwrap_or_default();
        scenes.map(name).collect()
    }

    /// Extensions that the file uses, and those of them that are not read.
    pub(super) fn extensions(&self) -> (Vec<String>, Vec<String>) {
        /// More names help nobody.
        const MOST: usize = 256;
        let used = self.root.extensions_used.iter().take(MOST);
        let ignored = ignored(&self.root).take(MOST);
        (
            used.map(|name| printable(name)).collect(),
            ignored.map(|name| printable(name)).collect(),
        )
    }
}

/// The file without those channels of animations that move no node: the specification allows them, the parser does not.
fn without_loose_channels(json: &[u8]) -> Option<Root> {
    let mut value: Value = deserialize::from_slice(json).ok()?;
    for animation in value.get_mut("animations")?.as_array_mut()? {
        let channels = animation.get_mut("channels")?.as_array_mut()?;
        channels.retain(|channel| !channel["target"]["node"].is_null());
    }
    deserialize::from_value(value).ok()
}

/// So many names at most are listed in a message.
const LISTED: usize = 12;

fn ignored(root: &Root) -> impl Iterator<Item = &String> {
    let used = root.extensions_used.iter();
    used.filter(|name| !SUPPORTED.contains(&name.as_str()))
}

/// Element `index` of a list of the file. `list` is the list's name, `place` where the index stands.
pub(super) fn lookup<'a, T>(
    items: &'a [T],
    list: &str,
    index: usize,
    place: impl FnOnce() -> String,
) -> Result<&'a T> {
    items.get(index).ok_or_else(|| {
        Fault::new(
            place(),
            format!("{list}[{index}] does not exist: there are {}", items.len()),
            "the file is broken; export it again",
        )
    })
}

/// Refuses JSON that would take far more memory parsed than written.
fn check_size(json: &[u8], limits: &Limits) -> Result<()> {
    if json.len() as u64 > limits.json_bytes {
        return Err(Fault::new(
            "JSON",
            format!("more than {} bytes", limits.json_bytes),
            "put data into a file of its own, or raise the limit `json_bytes`",
        ));
    }
    let (mut objects, mut values) = (0u64, 0u64);
    let (mut in_string, mut escaped) = (false, false);
    for &byte in json {
        if in_string {
            in_string = escaped || byte != b'"';
            escaped = !escaped && byte == b'\\';
        } else {
            in_string = byte == b'"';
            objects += u64::from(byte == b'{');
            values += u64::from(byte == b',' || byte == b'[');
        }
    }
    // An object holds a handful of values on average, however large the scene.
    if objects > limits.objects || values / 8 > limits.objects {
        return Err(Fault::new(
            "JSON",
            format!("more than {} objects", limits.objects),
            "split the scene, or raise the limit `objects`",
        ));
    }
    Ok(())
}

fn malformed(error: &gltf::json::Error) -> Fault {
    let position = format!("line {} column {}", error.line(), error.column());
    let text = error.to_string();
    let problem = text
        .strip_suffix(&format!(" at {position}"))
        .unwrap_or(&text);
    Fault::new(
        format!("JSON, {position}"),
        printable(problem),
        "a glTF 2.0 file is expected; export it again",
    )
}

fn check_version(value: &Value) -> Result<()> {
    let asset = &value["asset"];
    let version = asset["version"]
        .as_str()
        .ok_or_else(|| Fault::new("asset.version", "is missing", "a glTF 2.0 file is expected"))?;
    let least = asset["minVersion"].as_str().unwrap_or("2.0");
    if !version.starts_with("2.") || least != "2.0" {
        return Err(Fault::new(
            "asset",
            format!(
                "version {}, readable from {}",
                quoted(version),
                quoted(least)
            ),
            "export it as glTF 2.0",
        ));
    }
    Ok(())
}

fn check_required(names: &[String]) -> Result<()> {
    let unknown: Vec<String> = names
        .iter()
        .filter(|name| !SUPPORTED.contains(&name.as_str()))
        .take(8)
        .map(|name| quoted(name))
        .collect();
    if unknown.is_empty() {
        return Ok(());
    }
    Err(Fault::new(
        "extensionsRequired",
        format!("{} not supported", unknown.join(", ")),
        "export the scene without",
    ))
}
