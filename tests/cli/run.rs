//! Running the program, and looking at what it leaves.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// Flags that make a picture in no time, also without optimisation.
pub(crate) const SMALL: &str = "--size 16x9 --rsm 16 --lights 8";

/// How a run ended.
pub(crate) struct Ran {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Ran {
    /// Standard output of a run that must have succeeded.
    pub(crate) fn ok(self) -> String {
        assert_eq!(
            self.code,
            Some(0),
            "stdout: {}\nstderr: {}",
            self.out,
            self.err
        );
        self.out
    }

    /// The JSON document that a successful run printed.
    pub(crate) fn json(self) -> Value {
        let out = self.ok();
        let parsed = serde_json::from_str(&out);
        parsed.unwrap_or_else(|e| panic!("not one JSON document: {e}\n{out}"))
    }

    /// Message of a run that must have failed with this code, and must have printed no result.
    pub(crate) fn failed(self, code: i32) -> String {
        assert_eq!(
            self.code,
            Some(code),
            "stdout: {}\nstderr: {}",
            self.out,
            self.err
        );
        assert!(!self.err.contains("panicked"), "{}", self.err);
        assert!(self.err.contains("error"), "no message: {}", self.err);
        self.err
    }
}

/// An empty folder that the program runs in.
pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), content).expect("writable");
    }

    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// Names of all that lies in the folder, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).expect("readable");
        let name = |entry: std::io::Result<std::fs::DirEntry>| entry.map(|e| e.file_name());
        let names = entries.map(|e| name(e).expect("readable").to_string_lossy().into_owned());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }

    /// The program with these arguments, separated by blanks; it finds no Vulkan driver.
    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = self.command_with_drivers(arguments);
        command
            .env("VK_DRIVER_FILES", "/nonexistent")
            .env("VK_ICD_FILENAMES", "/nonexistent")
            .env_remove("VK_ADD_DRIVER_FILES");
        command
    }

    /// As [`Folder::command`], with the drivers of this machine.
    pub(crate) fn command_with_drivers(&self, arguments: &str) -> Command {
        let mut command = Command::new(program());
        command
            .args(arguments.split_whitespace())
            .current_dir(self.0.path())
            .env_remove("VSGL_ADAPTER")
            // Without, Mesa complains on standard error.
            .env("XDG_RUNTIME_DIR", self.0.path())
            .stdin(Stdio::null());
        command
    }

    /// Runs the program with these arguments, separated by blanks, without drivers.
    pub(crate) fn run(&self, arguments: &str) -> Ran {
        Ran::of(&mut self.command(arguments))
    }
}

impl Ran {
    /// Runs a command to its end.
    pub(crate) fn of(command: &mut Command) -> Self {
        let output = command.output().expect("the program starts");
        Self {
            code: output.status.code(),
            out: String::from_utf8_lossy(&output.stdout).into_owned(),
            err: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }
}

pub(crate) fn program() -> &'static Path {
    Path::new(env!("CARGO_BIN_EXE_vsgl-under-test"))
}
