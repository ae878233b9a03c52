//! Ctrl-C.
#![cfg(unix)]

use crate::run::Folder;
use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

#[test]
fn ctrl_c_ends_with_130_and_leaves_no_file() {
    let folder = Folder::new();
    let slow = "--size 1000x1000 --method vpl --rsm 64 --progress always";
    let mut child = folder
        .command(&format!("render -o a.png -o a.exr {slow}"))
        .stderr(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut err = BufReader::new(child.stderr.take().expect("piped"));
    let mut line = String::new();
    while !line.starts_with("shade") {
        line.clear();
        let read = err.read_line(&mut line).expect("text");
        assert!(read > 0, "it ended before shading");
    }
    let signal = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(signal.expect("kill is there").success());
    let start = Instant::now();
    let status = child.wait().expect("it ends");
    let mut rest = String::new();
    err.read_to_string(&mut rest).expect("text");
    assert_eq!(status.code(), Some(130), "{rest}");
    assert!(
        start.elapsed() < Duration::from_secs(60),
        "{:?}",
        start.elapsed()
    );
    assert!(rest.contains("interrupted"), "{rest}");
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}
