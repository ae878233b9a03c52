//! Files that exist only when they are complete.

use crate::exit::{Failure, Result};
use std::fs::{self, File, OpenOptions};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Temporary files of this process, for [`remove_all`].
static OPEN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// A file to be: made beside its place under another name before the work starts, so that a bad path is found then,
/// and put into its place when complete. Dropped before that, it leaves nothing.
#[derive(Debug)]
pub struct Pending {
    path: PathBuf,
    temporary: PathBuf,
    file: Option<File>,
}

impl Pending {
    /// Makes the temporary file, and the folder if need be.
    ///
    /// # Errors
    /// [`Failure::Output`] if there can be no such file.
    pub fn create(path: &Path) -> Result<Self> {
        Self::named(path, "partial")
    }

    /// Writes another file into the place, while this one is still to be.
    ///
    /// # Errors
    /// As [`Pending::create`] and [`Pending::write`].
    pub fn write_before<E: std::fmt::Display>(
        &self,
        content: impl FnOnce(&mut BufWriter<File>) -> std::result::Result<(), E>,
    ) -> Result<()> {
        Self::named(&self.path, "saved")?.write(content)
    }

    fn named(path: &Path, suffix: &str) -> Result<Self> {
        let fail = |problem: &dyn std::fmt::Display| {
            Failure::output(
                path,
                problem,
                "give a file in a folder that you may write to",
            )
        };
        let name = path.file_name().ok_or_else(|| fail(&"no file name"))?;
        if path.is_dir() {
            return Err(fail(&"a folder of this name exists"));
        }
        let folder = folder_of(path);
        fs::create_dir_all(folder).map_err(|e| fail(&e))?;
        let temporary = folder.join(format!(
            ".{}.{}.{suffix}",
            name.to_string_lossy(),
            std::process::id()
        ));
        let mut options = OpenOptions::new();
        let file = options.write(true).create_new(true).open(&temporary);
        let file = file.map_err(|e| fail(&e))?;
        open().push(temporary.clone());
        Ok(Self {
            path: path.to_owned(),
            temporary,
            file: Some(file),
        })
    }

    /// Where the file will be.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the content and puts the file into its place.
    ///
    /// # Errors
    /// [`Failure::Output`] if anything of that fails; the place is unchanged then.
    pub fn write<E: std::fmt::Display>(
        mut self,
        content: impl FnOnce(&mut BufWriter<File>) -> std::result::Result<(), E>,
    ) -> Result<()> {
        let remedy = "check that the disk has room and the folder is still writable";
        let path = self.path.clone();
        let fail = |problem: &dyn std::fmt::Display| Failure::output(&path, problem, remedy);
        let file = self.file.take().ok_or_else(|| fail(&"written twice"))?;
        let mut writer = BufWriter::new(file);
        content(&mut writer).map_err(|e| fail(&e))?;
        writer.flush().map_err(|e| fail(&e))?;
        drop(writer);
        fs::rename(&self.temporary, &self.path).map_err(|e| fail(&e))
    }
}

impl Drop for Pending {
    fn drop(&mut self) {
        // Also runs after the rename, when nothing of this name is left.
        let _ = fs::remove_file(&self.temporary);
        open().retain(|path| *path != self.temporary);
    }
}

/// Removes the temporary files of this process; for an exit that runs no destructors.
pub fn remove_all() {
    for path in open().drain(..) {
        let _ = fs::remove_file(path);
    }
}

fn open() -> std::sync::MutexGuard<'static, Vec<PathBuf>> {
    OPEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The folder that a path lies in; `.` for a bare name.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io;

    fn entries(folder: &Path) -> usize {
        fs::read_dir(folder).map_or(0, Iterator::count)
    }

    #[test]
    fn a_file_appears_only_when_complete() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("new/a.txt");
        let pending = Pending::create(&path).expect("creatable");
        assert!(!path.exists());
        let written = pending.write(|w| w.write_all(b"text"));
        written.expect("writable");
        assert_eq!(fs::read(&path).expect("readable"), b"text");
        assert_eq!(entries(&folder.path().join("new")), 1);
    }

    #[test]
    fn a_failed_or_dropped_file_leaves_what_was_there() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").expect("writable");
        drop(Pending::create(&path).expect("creatable"));
        let pending = Pending::create(&path).expect("creatable");
        let written = pending.write(|w| {
            w.write_all(b"half")?;
            Err(io::Error::other("no more"))
        });
        assert_eq!(written.map_err(|f| f.code()), Err(5));
        assert_eq!(fs::read(&path).expect("readable"), b"old");
        assert_eq!(entries(folder.path()), 1);
    }

    #[test]
    fn what_is_saved_on_the_way_is_complete_too() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.txt");
        let pending = Pending::create(&path).expect("creatable");
        for text in ["some", "more"] {
            let saved = pending.write_before(|w| w.write_all(text.as_bytes()));
            saved.expect("writable");
            assert_eq!(fs::read(&path).expect("readable"), text.as_bytes());
        }
        pending.write(|w| w.write_all(b"all")).expect("writable");
        assert_eq!(fs::read(&path).expect("readable"), b"all");
        assert_eq!(entries(folder.path()), 1);
    }

    #[test]
    fn impossible_places_are_refused_at_once() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("file");
        fs::write(&file, "").expect("writable");
        for path in [file.join("a.png"), folder.path().to_owned()] {
            let code = Pending::create(&path).map_err(|f| f.code()).map(|_| ());
            assert_eq!(code, Err(5), "{}", path.display());
        }
    }
}
