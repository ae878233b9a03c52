//! Help, manual pages and completions.

use crate::run::Folder;
use std::io::Read;
use std::process::Stdio;

#[test]
fn each_command_shows_examples_and_exit_codes() {
    let folder = Folder::new();
    for command in ["render", "merge", "info", "compare", "parity"] {
        let help = folder.run(&format!("{command} --help")).ok();
        assert!(
            help.contains("Examples:") && help.contains("Exit codes:"),
            "{command}"
        );
        assert_eq!(
            help.matches(&format!("\n  vsgl {command}")).count().min(3),
            3,
            "{command}"
        );
        let short = folder.run(&format!("{command} -h")).ok();
        assert!(short.len() < help.len() && !short.contains("Exit codes:"));
    }
    let help = folder.run("--help").ok();
    for code in [
        "0  ", "1  ", "2  ", "3  ", "4  ", "5  ", "6  ", "70 ", "130",
    ] {
        assert!(help.contains(code), "no exit code {code}");
    }
    assert!(folder.run("--version").ok().starts_with("vsgl "));
}

#[test]
fn examples_of_the_help_are_understood() {
    let folder = Folder::new();
    folder.write("room.glb", "");
    for command in ["render", "info", "parity"] {
        let help = folder.run(&format!("{command} --help")).ok();
        for line in help
            .lines()
            .filter(|l| l.starts_with("  vsgl ") && l.contains("room.glb"))
        {
            let arguments = line.trim().trim_start_matches("vsgl ");
            // Everything is in order but the file.
            let message = folder.run(arguments).failed(3);
            assert!(message.contains("room.glb"), "{line}: {message}");
        }
    }
}

#[test]
fn manual_pages_and_completions_name_every_flag() {
    let folder = Folder::new();
    let page = folder.run("man render").ok();
    assert!(
        page.contains(".TH") && page.contains("only\\-added\\-lights"),
        "{page}"
    );
    assert!(folder.run("man").ok().contains("compare"));
    folder.run("man nonsense").failed(2);
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = folder.run(&format!("completions {shell}")).ok();
        assert!(script.contains("only-added-lights"), "{shell}");
    }
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let folder = Folder::new();
    let mut child = folder
        .command("completions bash")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let mut message = String::new();
    let mut err = child.stderr.take().expect("piped");
    err.read_to_string(&mut message).expect("text");
    let status = child.wait().expect("it ends");
    assert_eq!((status.code(), message.as_str()), (Some(0), ""));
}
