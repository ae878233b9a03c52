//! Files made in code, read by the loader.

mod geometry;
mod hostile;
mod images;
mod materials;
mod moments;
#[cfg(feature = "draco")]
mod packed;
mod resources;
mod shapes;
mod things;

use super::{Limits, Options, load, load_with};
use crate::scene::Scene;
use crate::{Error, Result};
use std::collections::BTreeMap;
use std::path::PathBuf;
use tempfile::TempDir;

/// A glTF file of one triangle in the xy plane, to be changed piece by piece.
struct File {
    folder: TempDir,
    /// Members of the JSON object as text.
    json: BTreeMap<&'static str, String>,
    bin: Vec<u8>,
}

/// Corners of the triangle.
const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

impl File {
    /// The triangle: accessor 0 its corners, 1 its indices (16 bits).
    fn triangle() -> Self {
        let mut file = Self {
            folder: tempfile::tempdir().unwrap(),
            json: BTreeMap::new(),
            bin: Vec::new(),
        };
        file.json = BTreeMap::from([
            ("asset", r#"{"version":"2.0"}"#.into()),
            ("scene", "0".into()),
            ("scenes", r#"[{"nodes":[0]}]"#.into()),
            ("nodes", r#"[{"mesh":0}]"#.into()),
            (
                "meshes",
                r#"[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]"#.into(),
            ),
        ]);
        file.floats(&CORNERS, "VEC3");
        file.accessor(&bytes_of(&[0u16, 1, 2]), 5123, 3, "SCALAR");
        file
    }

    /// Puts another text in the place of a member.
    fn set(mut self, member: &'static str, text: &str) -> Self {
        self.json.insert(member, text.into());
        self
    }

    /// Adds an accessor of floats in a buffer view of its own.
    fn floats<const N: usize>(&mut self, values: &[[f32; N]], kind: &str) {
        self.accessor(&bytes_of(values.as_flattened()), 5126, values.len(), kind);
    }

    /// Adds an accessor with a buffer view of its own.
    fn accessor(&mut self, bytes: &[u8], component: u32, count: usize, kind: &str) {
        let view = self.view(bytes);
        self.push("accessors", &format!(
            r#"{{"bufferView":{view},"componentType":{component},"count":{count},"type":"{kind}"}}"#
        ));
    }

    /// Adds a buffer view; returns its index.
    fn view(&mut self, bytes: &[u8]) -> usize {
        let view = format!(
            r#"{{"buffer":0,"byteOffset":{},"byteLength":{}}}"#,
            self.bin.len(),
            bytes.len()
        );
        self.bin.extend_from_slice(bytes);
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        self.push("bufferViews", &view)
    }

    /// Adds to a list; returns the index.
    fn push(&mut self, member: &'static str, item: &str) -> usize {
        let list = self.json.entry(member).or_insert_with(|| "[]".into());
        list.pop();
        if list.len() > 1 {
            list.push(',');
        }
        list.push_str(item);
        list.push(']');
        list.matches("},{").count()
    }

    /// The JSON text; the buffer is `t.bin` unless the file says otherwise.
    fn text(&self) -> String {
        let mut json = self.json.clone();
        json.entry("buffers")
            .or_insert_with(|| format!(r#"[{{"uri":"t.bin","byteLength":{}}}]"#, self.bin.len()));
        let members: Vec<_> = json.iter().map(|(k, v)| format!("\"{k}\":{v}")).collect();
        format!("{{{}}}", members.join(","))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a file beside the scene.
    fn beside(self, name: &str, bytes: &[u8]) -> Self {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
        self
    }

    fn load(self) -> Result<Scene> {
        self.load_within(&Limits::default())
    }

    fn load_within(self, limits: &Limits) -> Result<Scene> {
        self.load_as(&Options::within(limits))
    }

    fn load_as(self, options: &Options) -> Result<Scene> {
        let text = self.text();
        let bin = self.bin.clone();
        let file = self.beside("t.bin", &bin).beside("t.gltf", text.as_bytes());
        load_with(&file.path("t.gltf"), options)
    }

    /// As a .glb file with the binary data inside.
    fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json.insert(
            "buffers",
            format!(r#"[{{"byteLength":{}}}]"#, self.bin.len()),
        );
        let members: Vec<_> = json.iter().map(|(k, v)| format!("\"{k}\":{v}")).collect();
        let mut text = format!("{{{}}}", members.join(","));
        while text.len() % 4 != 0 {
            text.push(' ');
        }
        let mut glb = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
        for (kind, bytes) in [(b"JSON", text.as_bytes()), (b"BIN\0", &self.bin)] {
            glb.extend((bytes.len() as u32).to_le_bytes());
            glb.extend(kind);
            glb.extend(bytes);
        }
        let length = (glb.len() as u32).to_le_bytes();
        glb[8..12].copy_from_slice(&length);
        glb
    }
}

fn bytes_of<T: bytemuck::NoUninit>(values: &[T]) -> Vec<u8> {
    bytemuck::cast_slice(values).to_vec()
}

/// Writes a file of these bytes into the folder, and reads it.
fn load_bytes(folder: &TempDir, bytes: &[u8]) -> Result<Scene> {
    let path = folder.path().join("t.glb");
    std::fs::write(&path, bytes).unwrap();
    load(&path)
}

/// Place and whole message of a refusal.
#[track_caller]
fn refused(result: Result<Scene>) -> (String, String) {
    match result {
        Ok(scene) => panic!("accepted: {} triangles", scene.mesh.triangles.len()),
        Err(error) => {
            let message = error.to_string();
            match error {
                Error::Scene {
                    file,
                    place,
                    problem,
                    remedy,
                } => {
                    assert!(!file.is_empty() && !problem.is_empty() && !remedy.is_empty());
                    (place, message)
                }
                _ => panic!("{message}"),
            }
        }
    }
}

/// Asserts that the file is refused at this place.
#[track_caller]
fn refused_at(place: &str, file: File) {
    let (at, message) = refused(file.load());
    assert_eq!(at, place, "{message}");
}

fn world(scene: &Scene, vertex: usize) -> glam::DVec3 {
    scene.origin + scene.mesh.positions[vertex].as_dvec3()
}
