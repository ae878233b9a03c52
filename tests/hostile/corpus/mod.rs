//! Files that mean harm, made by code, each with a name that says how.

mod accessors;
mod addresses;
mod bombs;
mod containers;
mod images;
mod nodes;
mod things;
mod triangles;

use crate::file::File;
pub(crate) use addresses::SECRET;
use std::fs;
use std::path::{Path, PathBuf};

/// What must come of a file, besides no harm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fate {
    /// An error that says this.
    Refused(&'static str),
    /// A picture.
    Drawn,
    /// The one or the other: both can be defended.
    Either,
}

/// What lies in the scene's folder.
pub(crate) enum Thing {
    Bytes(Vec<u8>),
    Made(Made),
    /// A file of so many zeros that takes no room.
    Hollow(u64),
    Folder,
    #[cfg(unix)]
    Link(String),
    #[cfg(unix)]
    Pipe,
}

/// A scene file with what lies beside it.
pub(crate) struct Case {
    pub(crate) name: String,
    /// Name of the scene file.
    pub(crate) main: &'static str,
    pub(crate) things: Vec<(String, Thing)>,
    pub(crate) fate: Fate,
}

/// What makes things: all of them at once would need much memory.
type Made = Box<dyn Fn() -> Vec<u8> + Send + Sync>;

impl Case {
    /// A file without anything beside it.
    pub(crate) fn new(main: &'static str, bytes: Vec<u8>, fate: Fate) -> Self {
        Self::bytes("", main, bytes, fate)
    }

    fn bytes(name: impl Into<String>, main: &'static str, bytes: Vec<u8>, fate: Fate) -> Self {
        Self {
            name: name.into(),
            main,
            things: vec![(main.into(), Thing::Bytes(bytes))],
            fate,
        }
    }

    /// A .gltf file with its buffer beside it.
    fn of(name: impl Into<String>, file: &File, fate: Fate) -> Self {
        let text = file.to_text().into_bytes();
        Self::bytes(name, "s.gltf", text, fate).with("s.bin", Thing::Bytes(file.bin.clone()))
    }

    /// A .gltf file that is made when it is written.
    fn later(
        name: impl Into<String>,
        file: impl Fn() -> File + Send + Sync + 'static,
        fate: Fate,
    ) -> Self {
        let file = std::sync::Arc::new(file);
        let other = file.clone();
        Self {
            name: name.into(),
            main: "s.gltf",
            things: vec![
                (
                    "s.gltf".into(),
                    Thing::Made(Box::new(move || file().to_text().into_bytes())),
                ),
                ("s.bin".into(), Thing::Made(Box::new(move || other().bin))),
            ],
            fate,
        }
    }

    /// A .glb file.
    fn glb(name: impl Into<String>, file: &File, fate: Fate) -> Self {
        Self::bytes(name, "s.glb", file.to_glb(), fate)
    }

    /// A .glb file that is made when it is written.
    fn glb_later(name: impl Into<String>, file: fn() -> File, fate: Fate) -> Self {
        Self {
            name: name.into(),
            main: "s.glb",
            things: vec![(
                "s.glb".into(),
                Thing::Made(Box::new(move || file().to_glb())),
            )],
            fate,
        }
    }

    fn with(mut self, name: &str, thing: Thing) -> Self {
        self.things.push((name.into(), thing));
        self
    }

    /// Writes everything into an empty folder; the path of the scene file.
    pub(crate) fn write(&self, folder: &Path) -> PathBuf {
        for (name, thing) in &self.things {
            let path = folder.join(name);
            fs::create_dir_all(path.parent().expect("a folder")).expect("writable");
            match thing {
                Thing::Bytes(bytes) => fs::write(&path, bytes).expect("writable"),
                Thing::Made(made) => fs::write(&path, made()).expect("writable"),
                Thing::Hollow(length) => {
                    let file = fs::File::create(&path).expect("writable");
                    file.set_len(*length).expect("room");
                }
                Thing::Folder => fs::create_dir_all(&path).expect("writable"),
                #[cfg(unix)]
                Thing::Link(target) => std::os::unix::fs::symlink(target, &path).expect("writable"),
                #[cfg(unix)]
                Thing::Pipe => {
                    let made = std::process::Command::new("mkfifo").arg(&path).status();
                    assert!(made.expect("mkfifo is there").success());
                }
            }
        }
        folder.join(self.main)
    }
}

/// All of them, those that need much room or time last.
pub(crate) fn all() -> Vec<Case> {
    let mut cases = Vec::new();
    for part in [
        containers::cases,
        addresses::cases,
        accessors::cases,
        triangles::cases,
        nodes::cases,
        images::cases,
        things::cases,
        bombs::cases,
    ] {
        cases.extend(part());
    }
    cases
}
