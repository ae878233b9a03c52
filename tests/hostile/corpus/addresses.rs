//! Addresses of buffers and images that lead elsewhere, and things that are no files.

use super::Fate::{self, Drawn, Either, Refused};
use super::{Case, Thing};
use crate::file::File;
use serde_json::json;

/// Stands beside the scene's folder; see [`crate::run`].
pub(crate) const SECRET: &str = "secret.bin";

pub(super) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let uris: &[(&str, Fate)] = &[
        ("", Refused("buffers[0]")),
        (".", Refused("is a folder")),
        ("./", Refused("is a folder")),
        ("..", Refused("buffers[0]")),
        ("/", Refused("buffers[0]")),
        ("../secret.bin", Refused("buffers[0]")),
        ("a/../../secret.bin", Refused("buffers[0]")),
        ("./.././secret.bin", Refused("buffers[0]")),
        ("%2e%2e/secret.bin", Refused("buffers[0]")),
        ("%2E%2E%2Fsecret.bin", Refused("buffers[0]")),
        ("..%2fsecret.bin", Refused("buffers[0]")),
        ("%252e%252e%252fsecret.bin", Refused("buffers[0]")),
        ("..\\secret.bin", Refused("buffers[0]")),
        ("..%5csecret.bin", Refused("buffers[0]")),
        ("....//secret.bin", Refused("buffers[0]")),
        ("%c0%ae%c0%ae/secret.bin", Refused("buffers[0]")),
        ("\u{ff0e}\u{ff0e}/secret.bin", Refused("buffers[0]")),
        ("secret.bin", Refused("no such file")),
        ("/etc/passwd", Refused("buffers[0]")),
        ("//etc/passwd", Refused("buffers[0]")),
        ("%2fetc%2fpasswd", Refused("buffers[0]")),
        ("file:///etc/passwd", Refused("buffers[0]")),
        ("file:s.bin", Refused("buffers[0]")),
        ("FILE:///etc/passwd", Refused("buffers[0]")),
        ("file%3A///etc/passwd", Refused("buffers[0]")),
        ("http://127.0.0.1:9/a.bin", Refused("buffers[0]")),
        ("https://example.org/a.bin", Refused("buffers[0]")),
        ("ftp://example.org/a.bin", Refused("buffers[0]")),
        ("\\\\server\\share\\a.bin", Refused("buffers[0]")),
        ("C:\\a.bin", Refused("buffers[0]")),
        ("C:a.bin", Refused("buffers[0]")),
        ("/dev/zero", Refused("buffers[0]")),
        ("/dev/stdin", Refused("buffers[0]")),
        ("/proc/self/mem", Refused("buffers[0]")),
        ("/proc/self/fd/0", Refused("buffers[0]")),
        ("s.bin%00.png", Refused("buffers[0]")),
        ("s.bin\u{0}", Refused("buffers[0]")),
        ("s.bin?a=1", Refused("buffers[0]")),
        ("s.bin#a", Refused("buffers[0]")),
        ("%", Refused("buffers[0]")),
        ("%zz", Refused("buffers[0]")),
        ("s%2", Refused("buffers[0]")),
        ("%ff%fe", Refused("buffers[0]")),
        ("\u{1b}[31mred", Refused("buffers[0]")),
        ("%1b%5b31mred", Refused("buffers[0]")),
        ("a\u{202e}nib.s", Refused("buffers[0]")),
        ("s.bin/", Either),
        ("s.bin/a", Refused("buffers[0]")),
        ("./s.bin", Drawn),
        ("a/../s.bin", Drawn),
        ("a//../s.bin", Either),
        ("%73.bin", Drawn),
        ("s.gltf", Refused("")),
        ("data:", Refused("buffers[0]")),
        ("data:,", Refused("buffers[0]")),
        ("data:;base64", Refused("buffers[0]")),
        ("data:;base64,", Refused("buffers[0]")),
        ("data:;base64,%%%%", Refused("buffers[0]")),
        ("data:;base64,AAAA=AAAA", Refused("buffers[0]")),
        ("data:;base64,A", Refused("buffers[0]")),
        ("data:;base64,====", Refused("buffers[0]")),
        ("data:;base64,AAAA\n", Refused("buffers[0]")),
        ("data:;base64,\u{e4}\u{f6}", Refused("buffers[0]")),
        ("data:;base32,AAAA", Refused("buffers[0]")),
        ("data:text/html,<script>", Refused("buffers[0]")),
        ("data:,%41%4", Refused("buffers[0]")),
        ("javascript:alert(1)", Refused("buffers[0]")),
    ];
    for (uri, fate) in uris {
        let file = File::sound().set("/buffers/0/uri", json!(uri));
        cases.push(Case::of(format!("address {uri:?}"), &file, *fate).with("a", Thing::Folder));
    }
    for (name, length) in [
        ("4,000 characters", 4_000),
        ("a million characters", 1_000_000),
    ] {
        for (part, kind) in [
            ("a", "name"),
            ("a/", "path"),
            ("../", "way up"),
            ("%2e%2e%2f", "coded way up"),
        ] {
            let file = File::sound().set("/buffers/0/uri", json!(part.repeat(length / part.len())));
            cases.push(Case::of(
                format!("{kind} of {name}"),
                &file,
                Refused("buffers[0]"),
            ));
        }
    }
    let file = File::sound().set(
        "/buffers/0/uri",
        json!(format!("data:;base64,{}", "A".repeat(40 << 20))),
    );
    cases.push(Case::of(
        "40 MB inside the address",
        &file,
        Refused("nothing to draw"),
    ));
    let file = File::sound().set(
        "/buffers/0/uri",
        json!(format!("data:,{}", "%00".repeat(10 << 20))),
    );
    cases.push(Case::of(
        "10 MB of percent signs",
        &file,
        Refused("nothing to draw"),
    ));
    cases.extend(images());
    #[cfg(unix)]
    cases.extend(things());
    cases
}

/// The same for images: another part of the program reads them.
fn images() -> Vec<Case> {
    let of = |uri: &str, fate| {
        let file = File::sound().set("/images/0", json!({"uri": uri}));
        Case::of(format!("image at {uri:?}"), &file, fate)
    };
    vec![
        of("../secret.bin", Refused("images[0]")),
        of("%2e%2e%2fsecret.bin", Refused("images[0]")),
        of("/etc/passwd", Refused("images[0]")),
        of("file:///etc/passwd", Refused("images[0]")),
        of("/dev/zero", Refused("images[0]")),
        of("missing.png", Refused("images[0]")),
        of("s.bin", Refused("images[0]")),
        of("s.gltf", Refused("images[0]")),
        of("data:image/png;base64,", Refused("images[0]")),
        of("data:image/png;base64,iVBORw0KGgo=", Refused("images[0]")),
        of("\u{1b}]0;title\u{7}.png", Refused("images[0]")),
    ]
}

/// Links, pipes and folders.
#[cfg(unix)]
fn things() -> Vec<Case> {
    let beside = |name: &str, thing, fate| {
        let file = File::sound().set("/buffers/0/uri", json!("t.bin"));
        Case::of(name, &file, fate).with("t.bin", thing)
    };
    let link = |target: &str| Thing::Link(target.into());
    let alone = |name: &str, thing, fate| Case {
        name: name.into(),
        main: "s.gltf",
        things: vec![("s.gltf".into(), thing)],
        fate,
    };
    vec![
        beside(
            "a link out of the folder",
            link("../secret.bin"),
            Refused("link out of"),
        ),
        beside(
            "a link to a device",
            link("/dev/zero"),
            Refused("buffers[0]"),
        ),
        beside(
            "a link to the system",
            link("/etc/passwd"),
            Refused("buffers[0]"),
        ),
        beside("a link to a link out", link("u.bin"), Refused("buffers[0]"))
            .with("u.bin", link("../secret.bin")),
        beside("a link to itself", link("t.bin"), Refused("buffers[0]")),
        beside("a link to nothing", link("nothing"), Refused("buffers[0]")),
        beside("a link inside", link("s.bin"), Drawn),
        beside("a link to the folder", link("."), Refused("is a folder")),
        Case::of(
            "a folder that is a link out",
            &File::sound().set("/buffers/0/uri", json!("out/secret.bin")),
            Refused("buffers[0]"),
        )
        .with("out", link("..")),
        Case::of(
            "up again through a link",
            &File::sound().set("/buffers/0/uri", json!("out/../secret.bin")),
            Refused("buffers[0]"),
        )
        .with("out", link("..")),
        beside("a pipe", Thing::Pipe, Refused("regular file")),
        beside("a folder", Thing::Folder, Refused("folder")),
        beside(
            "a hollow file of 100 GB",
            Thing::Hollow(100 << 30),
            Refused("MiB"),
        ),
        beside("a hollow file of 300 MB", Thing::Hollow(300 << 20), Either),
        alone("the scene is a pipe", Thing::Pipe, Refused("regular file")),
        alone("the scene is a folder", Thing::Folder, Refused("folder")),
        alone(
            "the scene is a device",
            Thing::Link("/dev/zero".into()),
            Refused("regular file"),
        ),
        alone(
            "the scene is missing",
            Thing::Link("nothing".into()),
            Refused("no such file"),
        ),
        alone(
            "the scene is a hollow file of 100 GB",
            Thing::Hollow(100 << 30),
            Refused("MiB"),
        ),
        alone(
            "the scene is a hollow file of 100 MB",
            Thing::Hollow(100 << 20),
            Refused("JSON"),
        ),
    ]
}
