//! Files: only regular ones, only in the scene's folder, only so many bytes.

use super::fault::{Fault, Result, quoted};
use super::uri::{self, Target};
use std::cell::Cell;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The scene's folder, and how much may still be read.
pub(super) struct Files {
    folder: PathBuf,
    /// The folder without links, to judge by where a file really is.
    real_folder: PathBuf,
    budget: u64,
    left: Cell<u64>,
    read: Cell<u64>,
}

impl Files {
    /// Files in the folder of `scene`.
    pub(super) fn beside(scene: &Path, budget: u64) -> Result<Self> {
        let folder = match scene.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let real_folder = folder.canonicalize().map_err(|e| unreadable(&e))?;
        Ok(Self {
            folder: folder.into(),
            real_folder,
            budget,
            left: Cell::new(budget),
            read: Cell::new(0),
        })
    }

    /// All bytes of a file that the user named.
    pub(super) fn read(&self, path: &Path) -> Result<Vec<u8>> {
        // Asked before opening: to open a pipe would wait for its writer.
        let metadata = fs::metadata(path).map_err(|e| unreadable(&e))?;
        if !metadata.is_file() {
            return Err(Fault::new(
                "file",
                if metadata.is_dir() {
                    "is a folder"
                } else {
                    "is not a regular file"
                },
                "name a .gltf or .glb file",
            ));
        }
        if metadata.len() > self.left.get() {
            return Err(self.too_large());
        }
        let mut bytes = Vec::new();
        File::open(path)
            .and_then(|file| file.take(self.left.get() + 1).read_to_end(&mut bytes))
            .map_err(|e| unreadable(&e))?;
        self.count(bytes.len() as u64)?;
        if bytes.starts_with(b"version https://git-lfs") {
            return Err(Fault::new(
                "file",
                "is the stand-in of Git LFS for a file that was not fetched",
                "run `git lfs pull` where it comes from",
            ));
        }
        Ok(bytes)
    }

    /// The bytes that an address stands for; `place` is where in the JSON it stands.
    pub(super) fn resolve(&self, uri: &str, place: &str) -> Result<Vec<u8>> {
        let paths = match uri::parse(uri, place)? {
            Target::Data(bytes) => {
                self.count(bytes.len() as u64)?;
                return Ok(bytes);
            }
            Target::File(paths) => paths,
        };
        let found = paths
            .iter()
            .map(|path| self.folder.join(path))
            .find_map(|path| path.canonicalize().ok().map(|real| (path, real)));
        let Some((path, real)) = found else {
            return Err(Fault::new(
                format!("{place}.uri"),
                "no such file",
                "put it there, or correct the address",
            )
            .in_file(&self.folder.join(&paths[0])));
        };
        if !real.starts_with(&self.real_folder) {
            return Err(Fault::new(
                format!("{place}.uri"),
                format!("{} is a link out of the scene's folder", quoted(uri)),
                "copy the file into the scene's folder",
            ));
        }
        self.read(&real).map_err(|fault| fault.in_file(&path))
    }

    /// Bytes of all files and data that were read so far.
    pub(super) fn bytes_read(&self) -> u64 {
        self.read.get()
    }

    fn count(&self, bytes: u64) -> Result<()> {
        self.charge(bytes)?;
        self.read.set(self.read.get() + bytes);
        Ok(())
    }

    /// Counts bytes that are read, or made of what was read.
    pub(super) fn charge(&self, bytes: u64) -> Result<()> {
        let left = self.left.get().checked_sub(bytes);
        self.left.set(left.ok_or_else(|| self.too_large())?);
        Ok(())
    }

    fn too_large(&self) -> Fault {
        Fault::new(
            "file",
            format!(
                "the files of the scene hold more than {} MiB",
                self.budget >> 20
            ),
            "split the scene, or raise the limit `file_bytes`",
        )
    }
}

fn unreadable(error: &io::Error) -> Fault {
    let problem = match error.kind() {
        io::ErrorKind::NotFound => "no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "reading it is not permitted".to_owned(),
        _ => format!("cannot be read: {error}"),
    };
    Fault::new(
        "file",
        problem,
        "name a .gltf or .glb file that can be read",
    )
}
