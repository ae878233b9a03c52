//! Parts of a picture of paths: merged, gone on from, and refused.

use crate::run::{Folder, Ran};
use vsgl_cli::input;
use vsgl_core::math::sobol::hash;

const PATHS: &str = "--method path --spp 52 --size 16x9";

/// Cuts blocks of eight of 52 samples at random into parts.
fn split(seed: u32) -> Vec<(u32, u32)> {
    let mut ends: Vec<u32> = (1..=6)
        .filter(|&block| hash(hash(seed) ^ block).is_multiple_of(2))
        .map(|block| 8 * block)
        .collect();
    ends.push(52);
    let starts = std::iter::once(0).chain(ends.iter().copied());
    starts.zip(ends.iter().copied()).collect()
}

fn render(folder: &Folder, arguments: &str) -> Ran {
    folder.run(&format!("render {PATHS} {arguments}"))
}

#[test]
fn merged_parts_are_the_file_of_one_run() {
    let folder = Folder::new();
    render(&folder, "-o whole.exr -o whole.png --exposure 1").ok();
    let mut kinds = 0;
    for seed in 0..8 {
        let mut parts = split(seed);
        kinds |= 1 << parts.len();
        parts.sort_by_key(|&(start, _)| hash(start ^ hash(!seed)));
        let mut names = Vec::new();
        for (start, end) in parts {
            let name = format!("{seed}-{start}.exr");
            let threads = 1 + start % 3;
            let flags = format!("-o {name} --samples {start}:{end} --threads {threads}");
            let report = render(&folder, &flags).ok();
            assert!(
                report.contains(&format!("samples {start}:{end} of 52")),
                "{report}"
            );
            names.push(name);
        }
        if names.len() == 1 {
            // All samples are the whole picture.
            assert!(folder.bytes(&names[0]) == folder.bytes("whole.exr"));
            continue;
        }
        // In two steps, of which the first leaves gaps.
        let some = names.len() / 2;
        let first = names[..some].join(" ");
        folder
            .run(&format!("merge {first} -o some.exr --allow-missing"))
            .ok();
        for names in [
            names.join(" "),
            format!("some.exr {}", names[some..].join(" ")),
        ] {
            folder
                .run(&format!("merge {names} -o m.exr -o m.png --exposure 1"))
                .ok();
            assert!(
                folder.bytes("m.exr") == folder.bytes("whole.exr"),
                "{names}"
            );
            assert!(
                folder.bytes("m.png") == folder.bytes("whole.png"),
                "{names}"
            );
        }
    }
    assert!(kinds & !0b110 != 0, "no split into three or more parts");
}

#[test]
fn the_reported_command_makes_the_same_part() {
    let folder = Folder::new();
    let flags = "-o a.exr --samples 8:16 --max-depth 4 --light-sampling uniform --json";
    let document = render(&folder, flags).json();
    assert_eq!(document["samples"], serde_json::json!([[8, 16]]));
    let part = folder.bytes("a.exr");
    std::fs::remove_file(folder.path("a.exr")).expect("written");
    let command = document["command"].as_str().expect("a string");
    folder
        .run(command.strip_prefix("vsgl ").expect("of this program"))
        .ok();
    assert!(folder.bytes("a.exr") == part, "{command}");
}

#[test]
fn a_part_shows_the_mean_of_its_samples() {
    let folder = Folder::new();
    render(&folder, "-o first.exr --samples 0:16").ok();
    folder
        .run("render --method path --spp 16 --size 16x9 -o few.exr")
        .ok();
    let picture = |name: &str| input::read(&folder.path(name)).expect("readable").picture;
    assert_eq!(picture("first.exr"), picture("few.exr"));
}

#[test]
fn parts_that_do_not_fit_are_code_6() {
    let folder = Folder::new();
    for (name, flags) in [
        ("a", "--samples 0:16"),
        ("b", "--samples 8:24"),
        ("c", "--samples 16:52"),
        ("seed", "--samples 16:52 --seed 1"),
        ("light", "--samples 16:52 --point 0,1,0:1"),
        ("size", "--samples 16:52 --size 17x9"),
        ("depth", "--samples 16:52 --max-depth 4"),
        ("more", "--samples 16:56 --spp 56"),
        ("whole", ""),
    ] {
        render(&folder, &format!("-o {name}.exr {flags}")).ok();
    }
    folder
        .run("render -o other.exr --rsm 16 --lights 8 --size 16x9")
        .ok();
    folder.write("broken.exr", &folder.bytes("c.exr")[..2000]);
    let before = folder.names();
    for (parts, words) in [
        ("a.exr b.exr", &["a.exr", "b.exr", "8:16"][..]),
        ("a.exr a.exr", &["0:16"]),
        ("a.exr", &["a.exr", "16:52", "--allow-missing"]),
        ("a.exr seed.exr", &["seed.exr", "seed"]),
        ("a.exr light.exr", &["light.exr", "light"]),
        ("a.exr size.exr", &["size.exr", "size"]),
        ("a.exr depth.exr", &["depth.exr", "settings"]),
        ("a.exr more.exr", &["more.exr", "52", "56", "--spp"]),
        ("a.exr whole.exr", &["whole.exr", "no sums"]),
        ("a.exr other.exr", &["other.exr", "paths"]),
    ] {
        let message = folder.run(&format!("merge {parts} -o m.exr")).failed(6);
        for word in words {
            assert!(message.contains(word), "{parts}: no `{word}` in {message}");
        }
    }
    let message = folder.run("merge a.exr broken.exr -o m.exr").failed(3);
    assert!(message.contains("broken.exr"), "{message}");
    folder.run("merge a.exr none.exr -o m.exr").failed(3);
    folder.run("merge a.exr c.exr -o m.jpg").failed(2);
    folder.run("merge -o m.exr").failed(2);
    assert_eq!(folder.names(), before);
}

#[test]
fn going_on_ends_at_the_file_of_one_run() {
    let folder = Folder::new();
    render(&folder, "-o whole.exr -o whole.png").ok();
    let whole = folder.bytes("whole.exr");
    // From nothing, from a beginning, from the middle, from all.
    for from in ["", "0:8", "16:40", "0:52"] {
        if !from.is_empty() {
            render(&folder, &format!("-o a.exr --samples {from}")).ok();
        }
        render(&folder, "-o a.exr -o a.png --resume").ok();
        assert!(folder.bytes("a.exr") == whole, "{from}");
        assert!(folder.bytes("a.png") == folder.bytes("whole.png"), "{from}");
        std::fs::remove_file(folder.path("a.exr")).expect("written");
    }
    // Within a part.
    render(&folder, "-o part.exr --samples 8:32").ok();
    let part = folder.bytes("part.exr");
    render(&folder, "-o a.exr --samples 8:16").ok();
    render(&folder, "-o a.exr --samples 8:32 --resume").ok();
    assert!(folder.bytes("a.exr") == part);
    // More samples than were planned.
    render(&folder, "-o a.exr --samples 8:16 --spp 16").ok();
    render(&folder, "-o a.exr --samples 8:32 --resume").ok();
    assert!(folder.bytes("a.exr") == part);
}

#[test]
fn what_cannot_be_gone_on_from_is_refused() {
    let folder = Folder::new();
    render(&folder, "-o part.exr --samples 8:16").ok();
    render(&folder, "-o whole.exr").ok();
    render(&folder, "-o odd.exr --samples 8:12 --spp 12").ok();
    let before: Vec<_> = folder.names().iter().map(|n| folder.bytes(n)).collect();
    for (code, flags, words) in [
        (
            6,
            "-o part.exr --resume --seed 1",
            &["part.exr", "seed"][..],
        ),
        (6, "-o part.exr --resume --samples 0:8", &["8:16", "0:8"]),
        (6, "-o whole.exr --resume --spp 60", &["whole.exr", "sums"]),
        (6, "-o odd.exr --resume", &["odd.exr", "block of 8"]),
        (2, "-o a.png --resume", &["--resume", ".exr"]),
        (2, "-o a.png --samples 0:8", &["--samples", ".exr"]),
        (2, "-o a.exr --samples 0:7", &["0:7", "multiples of 8"]),
        (2, "-o a.exr --samples 4:8", &["4:8", "multiples of 8"]),
        (2, "-o a.exr --samples 0:60", &["0:60", "0:52"]),
        (2, "-o a.exr --samples 8:8", &["--samples", "A:B"]),
        (2, "-o a.exr --resume --method vsgl", &["--method path"]),
    ] {
        let message = render(&folder, flags).failed(code);
        for word in words {
            assert!(message.contains(word), "{flags}: no `{word}` in {message}");
        }
    }
    let after: Vec<_> = folder.names().iter().map(|n| folder.bytes(n)).collect();
    assert!(before == after, "{:?}", folder.names());
}
