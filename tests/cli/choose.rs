//! `--budget` and `--target-error`: settings that the program chooses.

use crate::run::Folder;

const SMALL: &str = "render --backend cpu --size 64x40 --rsm 64 -o a.png";

#[test]
fn what_was_chosen_is_told_and_can_be_repeated() {
    let folder = Folder::new();
    for goal in ["--budget 10s", "--target-error 90%"] {
        let document = folder.run(&format!("{SMALL} {goal} --json")).json();
        let choice = &document["choice"];
        for outcome in ["predicted", "measured"] {
            for quantity in ["seconds", "error_percent"] {
                let value = choice[outcome][quantity].as_f64();
                assert!(value.is_some_and(|v| v > 0.0), "{choice:#}");
            }
        }
        // What anything can reach is reached.
        let measured = &choice["measured"];
        assert!(measured["seconds"].as_f64().is_some_and(|s| s < 10.0));
        assert!(
            measured["error_percent"].as_f64().is_some_and(|e| e < 95.0),
            "{choice:#}"
        );
        // The command says what was chosen, and no goal: it makes the same picture.
        let command = document["command"].as_str().expect("text");
        assert!(!command.contains("--budget") && !command.contains("--target-error"));
        let picture = folder.bytes("a.png");
        let repeat = command.strip_prefix("vsgl ").expect("our command");
        folder.run(repeat).ok();
        assert_eq!(folder.bytes("a.png"), picture);
    }
    let text = folder.run(&format!("{SMALL} --budget 10s")).ok();
    for word in ["chosen ", "predicted", "mape"] {
        assert!(text.contains(word), "no {word} in\n{text}");
    }
}

#[test]
fn what_is_given_is_not_chosen_and_what_is_out_of_reach_is_told() {
    let folder = Folder::new();
    let fixed = "--lights 12 --occlusion none";
    let ran = folder
        .run(&format!("{SMALL} {fixed} --budget 1us"))
        .failed(2);
    assert!(ran.contains("200ms"), "{ran}");
    let ran = folder.run(&format!("{SMALL} {fixed} --budget 0.001ms"));
    assert!(ran.err.contains("not enough"), "{}", ran.err);
    let text = ran.ok();
    assert!(
        text.contains("--lights 12") && text.contains("--occlusion none"),
        "{text}"
    );
}

#[test]
fn goals_that_make_no_sense_are_refused_before_any_work() {
    let folder = Folder::new();
    for (words, told) in [
        ("--budget 1s --target-error 5%", "--target-error"),
        ("--budget -1s", "--budget"),
        ("--budget nan", "--budget"),
        ("--target-error 0%", "--target-error"),
        ("--budget 1s --method path", "--method"),
        ("--budget 1s --method vpl", "--method"),
        ("--budget 1s --stride 2", "--stride"),
        ("--budget 1s --size 7x7", "--size"),
        ("--budget 1s --only-added-lights", "no indirect light"),
    ] {
        let message = folder.run(&format!("{SMALL} {words}")).failed(2);
        assert!(message.contains(told), "{words}: {message}");
    }
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}
