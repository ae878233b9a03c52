//! What is in a file, for `vsgl info`: materials, textures, scenes, extensions, bytes.

use super::count;
use crate::job::Job;
use serde_json::{Value, json};
use vsgl_core::scene::{ImageSource, Material, Scene, Slot, Texture};

/// Longest list that people get to see in full.
const LIST_MAX: usize = 12;

/// Lines for people.
pub(super) fn text(job: &Job) -> String {
    let scene = &job.scene;
    let source = &scene.source;
    let mut out = String::new();
    if source.bytes > 0 {
        out += &format!(
            "contents  {} read, {} in memory, {}\n",
            size(source.bytes),
            size(scene.memory_bytes()),
            count(source.unique_triangles as usize, "unique triangle"),
        );
    }
    for (title, names) in [
        ("used", &source.extensions_used),
        ("ignored", &source.extensions_ignored),
    ] {
        if !names.is_empty() {
            out += &format!("  extensions {title}: {}\n", names.join(", "));
        }
    }
    let mut list = |title: &str, lines: Vec<String>| {
        if lines.is_empty() {
            return;
        }
        out += &format!("{title}\n");
        for (index, line) in lines.iter().take(LIST_MAX).enumerate() {
            out += &format!("  {index} {line}\n");
        }
        if lines.len() > LIST_MAX {
            out += &format!("  and {} more\n", lines.len() - LIST_MAX);
        }
    };
    let shown = |(index, name): (usize, &String)| {
        let name = if name.is_empty() {
            "without a name"
        } else {
            name
        };
        let shown = if source.scene == Some(index) {
            ", shown"
        } else {
            ""
        };
        format!("{name}{shown}")
    };
    list(
        "scenes",
        source.scenes.iter().enumerate().map(shown).collect(),
    );
    list(
        "materials",
        scene.materials.iter().map(material_text).collect(),
    );
    let texture = |(image, texture): (ImageSource, &Texture)| {
        let ImageSource {
            name,
            format,
            bytes,
        } = image;
        format!(
            "{name}: {}x{}, {format}, {}",
            texture.width,
            texture.height,
            size(bytes)
        )
    };
    list("textures", images(scene).map(texture).collect());
    out
}

/// Adds it to a document.
pub(super) fn add(document: &mut Value, job: &Job) {
    let scene = &job.scene;
    let source = &scene.source;
    let part = |(index, name): (usize, &String)| json!({"name": name, "shown": source.scene == Some(index)});
    let texture = |(image, texture): (ImageSource, &Texture)| {
        json!({
            "name": image.name,
            "format": image.format,
            "bytes": image.bytes,
            "width": texture.width,
            "height": texture.height,
        })
    };
    document["triangles"] = json!({
        "drawn": scene.mesh.triangles.len(),
        "unique": source.unique_triangles,
    });
    document["bytes"] = json!({"files": source.bytes, "memory": scene.memory_bytes()});
    document["extensions"] = json!({
        "used": source.extensions_used,
        "ignored": source.extensions_ignored,
    });
    document["scenes"] = source.scenes.iter().enumerate().map(part).collect();
    document["materials"] = scene.materials.iter().map(material_json).collect();
    document["textures"] = images(scene).map(texture).collect();
}

/// Textures with what they were; those made in code were nothing.
fn images(scene: &Scene) -> impl Iterator<Item = (ImageSource, &Texture)> {
    let known = scene.source.images.iter().cloned();
    let known = known.chain(std::iter::repeat_with(ImageSource::default));
    known.zip(&scene.textures)
}

fn material_text(material: &Material) -> String {
    let slots: Vec<_> = slots(material).map(|(word, _)| word).collect();
    let kind = match material {
        m if m.unlit => "unlit",
        m if m.metallic == 0.0 => "dielectric",
        _ => "metallic-roughness",
    };
    let mut line = format!(
        "{}: {kind}, roughness {}",
        material.name, material.roughness
    );
    if !slots.is_empty() {
        line += &format!(", textures: {}", slots.join(", "));
    }
    line
}

fn material_json(material: &Material) -> Value {
    let textures = slots(material).map(|(word, texture)| (word.to_owned(), json!(texture)));
    json!({
        "name": material.name,
        "base_color": material.base_color,
        "alpha": material.alpha,
        "alpha_cutoff": material.alpha_cutoff,
        "metallic": material.metallic,
        "roughness": material.roughness,
        "specular": material.specular,
        "specular_color": material.specular_color,
        "ior": material.ior,
        "emission": material.emission,
        "double_sided": material.double_sided,
        "unlit": material.unlit,
        "anisotropy": material.anisotropy,
        "textures": textures.collect::<serde_json::Map<_, _>>(),
    })
}

/// What the material reads textures for, and which.
fn slots(material: &Material) -> impl Iterator<Item = (&'static str, u32)> {
    Slot::ALL.into_iter().filter_map(|slot| {
        let word = match slot {
            Slot::BaseColor => "base_color",
            Slot::MetallicRoughness => "metallic_roughness",
            Slot::Normal => "normal",
            Slot::Emissive => "emissive",
            Slot::Specular => "specular",
            Slot::SpecularColor => "specular_color",
            Slot::Anisotropy => "anisotropy",
        };
        Some((word, material.texture(slot)?.texture))
    })
}

/// A number of bytes that is easy to read.
fn size(bytes: u64) -> String {
    match bytes {
        0..10_000 => format!("{bytes} bytes"),
        10_000..10_000_000 => format!("{} kB", bytes / 1000),
        _ => format!("{} MB", bytes / 1_000_000),
    }
}
