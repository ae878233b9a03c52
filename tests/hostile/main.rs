//! No file can hurt: files that mean harm, and sound files changed at random.

mod corpus;
mod file;
mod fuzz;
mod outputs;
mod png;
mod run;

use corpus::{Case, Fate};
use run::{Ran, run};
use std::fs;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Small, but with all that the defaults do.
const PICTURE: &[&str] = &["--size", "64x36", "--backend", "cpu", "--progress", "never"];

/// Every file is loaded and drawn by the program, within bounds of time and memory, and comes to what it should.
#[test]
fn files_that_mean_harm_do_none() {
    let filter = std::env::var("VSGL_HOSTILE").unwrap_or_default();
    let mut cases = corpus::all();
    cases.retain(|case| case.name.contains(&filter));
    let next = AtomicUsize::new(0);
    let faults = Mutex::new(Vec::new());
    let slowest = Mutex::new((0.0, 0, String::new()));
    // Two at a time: more would need more memory than small machines have, and take time from each other.
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
                    for (seconds, peak, what) in judged(case, &faults) {
                        let mut worst = slowest.lock().expect("no panic");
                        worst.0 = f64::max(worst.0, seconds);
                        worst.1 = u64::max(worst.1, peak);
                        if !filter.is_empty() || seconds > 1.5 || peak > 500_000 {
                            println!("{seconds:.2} s {} MB: {what}", peak / 1000);
                        }
                    }
                }
            });
        }
    });
    let (seconds, peak, _) = slowest.into_inner().expect("no panic");
    println!(
        "{} files, at most {seconds:.2} s and {} MB",
        cases.len(),
        peak / 1000
    );
    let faults = faults.into_inner().expect("no panic");
    assert!(
        faults.is_empty(),
        "{} faults:\n{}",
        faults.len(),
        faults.join("\n")
    );
}

/// Runs `info` and `render`; notes what is wrong, and tells what they took.
fn judged(case: &Case, faults: &Mutex<Vec<String>>) -> Vec<(f64, u64, String)> {
    let outer = tempfile::tempdir().expect("a temporary folder");
    let folder = outer.path().join("scene");
    fs::create_dir(&folder).expect("writable");
    // A sound buffer, and a word that must never be shown.
    fs::write(outer.path().join(corpus::SECRET), b"TREASURE".repeat(1_000)).expect("writable");
    let path = case.write(&folder);
    let work = outer.path().join("work");
    fs::create_dir(&work).expect("writable");
    let scene = path.to_str().expect("a path of ASCII");
    let mut took = Vec::new();
    let note = |command: &str, problem: String| {
        let mut faults = faults.lock().expect("no panic");
        faults.push(format!("{} ({command}): {problem}", case.name));
    };
    // Each way to tell about it is asked about half of the files.
    let plain = case.name.len().is_multiple_of(2) || case.name.starts_with("names");
    let info = if plain { "info" } else { "info --json" };
    for command in [info, "render"] {
        let mut words: Vec<&str> = command.split(' ').collect();
        words.push(scene);
        if command == "render" {
            words.extend(PICTURE);
            words.extend(["-o", "a.png", "-o", "a.exr"]);
        }
        let ran = run(&work, &words);
        if let Some(problem) = ran.fault() {
            note(command, problem);
        } else if let Some(problem) = unexpected(case.fate, command, &ran) {
            note(command, problem);
        }
        if ran.out.contains("TREASURE") || ran.err.contains("TREASURE") {
            note(command, "what lies outside is shown".into());
        }
        let left = names(&work);
        let expected: &[&str] = if command == "render" && ran.code == Some(0) {
            &["a.exr", "a.png"]
        } else {
            &[]
        };
        if left != expected {
            note(command, format!("leaves {left:?}"));
        }
        took.push((
            ran.seconds,
            ran.peak.unwrap_or(0),
            format!("{} ({command})", case.name),
        ));
    }
    took
}

/// What is wrong with how a run ended, if it ended as runs may.
fn unexpected(fate: Fate, command: &str, ran: &Ran) -> Option<String> {
    match fate {
        Fate::Either => None,
        Fate::Drawn if ran.code == Some(0) => None,
        Fate::Drawn => Some(format!("should be drawn: {}", ran.err)),
        // What is found when a picture is to be made.
        Fate::Refused("nothing to draw" | "one place") if command.starts_with("info") => None,
        Fate::Refused(words) => {
            let fits =
                ran.code == Some(3) && ran.refusal().is_some_and(|line| line.contains(words));
            (!fits).then(|| format!("should be refused with `{words}`: {}", ran.err))
        }
    }
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("readable");
    let mut names: Vec<String> = entries
        .map(|e| {
            e.expect("readable")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}
