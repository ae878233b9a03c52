//! Ctrl-C.
#![cfg(unix)]

use crate::run::Folder;
use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use vsgl_cli::part;

/// Starts a run, waits for a line of its progress that begins with these words, and interrupts it. Its exit code and the rest of
/// its messages.
fn interrupted(folder: &Folder, arguments: &str, at: &str) -> (Option<i32>, String) {
    let mut child = folder
        .command(&format!("{arguments} --progress always"))
        .stderr(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut err = BufReader::new(child.stderr.take().expect("piped"));
    let mut line = String::new();
    while !line.starts_with(at) {
        line.clear();
        let read = err.read_line(&mut line).expect("text");
        assert!(read > 0, "it ended before `{at}`");
    }
    let signal = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(signal.expect("kill is there").success());
    let start = Instant::now();
    let status = child.wait().expect("it ends");
    let mut rest = String::new();
    err.read_to_string(&mut rest).expect("text");
    assert!(
        start.elapsed() < Duration::from_secs(60),
        "{:?}",
        start.elapsed()
    );
    (status.code(), rest)
}

#[test]
fn ctrl_c_ends_with_130_and_leaves_no_file() {
    let folder = Folder::new();
    let slow = "--size 1000x1000 --method vpl --rsm 64";
    let (code, rest) = interrupted(
        &folder,
        &format!("render -o a.png -o a.exr {slow}"),
        "shade",
    );
    assert_eq!(code, Some(130), "{rest}");
    assert!(rest.contains("interrupted"), "{rest}");
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

#[test]
fn ctrl_c_leaves_the_paths_so_far_which_go_on() {
    let folder = Folder::new();
    let slow = "render -o a.exr -o a.png --size 16x9 --method path --spp 24000 --threads 1";
    let (code, rest) = interrupted(&folder, slow, "trace 10 %");
    assert_eq!(code, Some(130), "{rest}");
    assert!(rest.contains("--resume goes on"), "{rest}");
    assert_eq!(folder.names(), ["a.exr", "a.png"]);
    let part = part::read(&folder.path("a.exr")).expect("a part");
    let (samples, sums) = (part.about.samples, part.sums.expect("not whole"));
    assert!((2400..24_000).contains(&samples.count()), "{samples}");
    assert_eq!(samples.count(), sums.samples());
    assert_eq!((samples.first(), part.about.of), (0, 24_000));
    folder.run(&format!("{slow} --resume")).ok();
    let once = slow.replace("a.", "once.");
    folder.run(&once).ok();
    for suffix in ["exr", "png"] {
        let (a, once) = (format!("a.{suffix}"), format!("once.{suffix}"));
        assert!(folder.bytes(&a) == folder.bytes(&once), "{suffix}");
    }
}

#[test]
fn ctrl_c_leaves_the_reference_of_a_sweep_so_far_which_goes_on() {
    let folder = Folder::new();
    let sweep =
        "sweep --backend cpu --size 16x9 --rsm 16 --spp 24000 --runs 1 --grid lights=4 --threads 1";
    let (code, rest) = interrupted(&folder, &format!("{sweep} -o s"), "trace 20 %");
    assert_eq!(code, Some(130), "{rest}");
    assert!(rest.contains("reference-a.exr"), "{rest}");
    let part = part::read(&folder.path("s/reference-a.exr")).expect("a part");
    let samples = part.about.samples;
    assert!((2400..12_000).contains(&samples.count()), "{samples}");
    folder.run(&format!("{sweep} -o s")).ok();
    folder.run(&format!("{sweep} -o once")).ok();
    for name in ["reference-a.exr", "reference-b.exr", "reference.exr"] {
        let (s, once) = (format!("s/{name}"), format!("once/{name}"));
        assert!(folder.bytes(&s) == folder.bytes(&once), "{name}");
    }
}

#[test]
fn ctrl_c_leaves_the_points_of_a_sweep_so_far_which_can_be_looked_at() {
    let folder = Folder::new();
    // The first line of a point begins with its backend; the last points take long.
    let sweep = "sweep -o s --backend cpu --size 320x180 --rsm 64 --spp 2 --runs 1 --grid lights=1,4096 --longest 9999";
    let (code, rest) = interrupted(&folder, sweep, "cpu: lights 1");
    assert_eq!(code, Some(130), "{rest}");
    let page = String::from_utf8(folder.bytes("s/report.html")).expect("text");
    assert!(page.contains("1 of 2 points"), "{page}");
    let lines = String::from_utf8(folder.bytes("s/sweep.jsonl")).expect("text");
    assert_eq!(lines.lines().count(), 2);
}
