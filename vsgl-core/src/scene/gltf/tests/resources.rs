use super::*;

#[test]
fn binary_files_hold_their_buffer() {
    let scene = load_bytes(&tempfile::tempdir().unwrap(), &File::triangle().glb()).unwrap();
    assert_eq!(scene.mesh.triangles, [[0, 1, 2]]);
}

#[test]
fn data_uris_and_encoded_names() {
    let file = File::triangle();
    let hex: String = file.bin.iter().map(|b| format!("%{b:02x}")).collect();
    let buffers = format!(
        r#"[{{"uri":"data:,{hex}","byteLength":{}}}]"#,
        file.bin.len()
    );
    assert_eq!(
        file.set("buffers", &buffers)
            .load()
            .unwrap()
            .mesh
            .triangles
            .len(),
        1
    );
    for name in ["a b.bin", "down/ünder.bin", "100%.bin"] {
        let file = File::triangle();
        let bin = file.bin.clone();
        let uri = name.replace(' ', "%20");
        let buffers = format!(r#"[{{"uri":"{uri}","byteLength":{}}}]"#, bin.len());
        let scene = file
            .set("buffers", &buffers)
            .beside(name, &bin)
            .load()
            .unwrap();
        assert_eq!(scene.mesh.triangles.len(), 1, "{name}");
    }
}

#[test]
fn no_file_outside_the_folder_is_read() {
    let outside = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(outside.path(), [0; 64]).unwrap();
    let path = outside.path().display().to_string();
    for uri in [
        path.clone(),
        format!("file://{path}"),
        format!("../{}", outside.path().file_name().unwrap().display()),
        format!("%2e%2e/{}", outside.path().file_name().unwrap().display()),
    ] {
        let buffers = format!(r#"[{{"uri":"{uri}","byteLength":44}}]"#);
        refused_at("buffers[0].uri", File::triangle().set("buffers", &buffers));
    }
}

#[cfg(unix)]
#[test]
fn links_do_not_lead_out_either() {
    let outside = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(outside.path(), [0; 64]).unwrap();
    let file = File::triangle().set("buffers", r#"[{"uri":"l.bin","byteLength":44}]"#);
    std::os::unix::fs::symlink(outside.path(), file.path("l.bin")).unwrap();
    refused_at("buffers[0].uri", file);
    let file = File::triangle().set("buffers", r#"[{"uri":"l.bin","byteLength":44}]"#);
    std::os::unix::fs::symlink("/dev/zero", file.path("l.bin")).unwrap();
    refused_at("buffers[0].uri", file);
}

#[test]
fn missing_and_short_buffers_are_named() {
    let (_, message) = refused(
        File::triangle()
            .set("buffers", r#"[{"uri":"gone.bin","byteLength":44}]"#)
            .load(),
    );
    assert!(message.contains("gone.bin"), "{message}");
    refused_at(
        "buffers[0]",
        File::triangle().set("buffers", r#"[{"uri":"t.bin","byteLength":4400000000000}]"#),
    );
    refused_at(
        "buffers[0]",
        File::triangle().set("buffers", r#"[{"byteLength":44}]"#),
    );
    refused_at(
        "bufferViews[0].buffer",
        File::triangle().set("buffers", "[]"),
    );
    let pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 44\n";
    let file = File::triangle().set("buffers", r#"[{"uri":"p.bin","byteLength":44}]"#);
    let (_, message) = refused(file.beside("p.bin", pointer).load());
    assert!(
        message.contains("p.bin") && message.contains("git lfs pull"),
        "{message}"
    );
}

#[test]
fn buffers_that_nothing_uses_are_not_read() {
    let scene = File::triangle()
        .set("nodes", "[{}]")
        .set("buffers", r#"[{"uri":"gone"}]"#);
    assert!(scene.load().is_ok());
}

#[test]
fn folders_missing_and_empty_files() {
    let folder = tempfile::tempdir().unwrap();
    let (_, message) = refused(load(folder.path()));
    assert!(message.contains("folder"), "{message}");
    let (_, message) = refused(load(&folder.path().join("none.gltf")));
    assert!(message.contains("no such file"), "{message}");
    let (_, message) = refused(load_bytes(&folder, b""));
    assert!(message.contains("empty"), "{message}");
}

#[test]
fn too_many_bytes() {
    let limits = Limits {
        file_bytes: 100,
        ..Limits::default()
    };
    let (_, message) = refused(File::triangle().load_within(&limits));
    assert!(message.contains("file_bytes"), "{message}");
}

/// The triangle with its corners and indices packed, in a file that requires it.
fn meshopt(corners: &[u8], indices: &[u8]) -> File {
    let mut file = File::triangle();
    file.bin = [corners, indices].concat();
    let packed = |start: usize, length: usize, rest: &str| {
        format!(
            r#"{{"buffer":1,"byteLength":36,"extensions":{{"EXT_meshopt_compression":
                {{"buffer":0,"byteOffset":{start},"byteLength":{length},"count":3,{rest}}}}}}}"#
        )
    };
    let views = [
        packed(
            0,
            corners.len(),
            r#""byteStride":12,"mode":"ATTRIBUTES","filter":"EXPONENTIAL""#,
        ),
        packed(
            corners.len(),
            indices.len(),
            r#""byteStride":2,"mode":"TRIANGLES""#,
        ),
    ];
    let buffers = format!(
        r#"[{{"uri":"t.bin","byteLength":{}}},{{"byteLength":72,"extensions":{{"EXT_meshopt_compression":{{"fallback":true}}}}}}]"#,
        file.bin.len()
    );
    file.set("bufferViews", &format!("[{}]", views.join(",")))
        .set("buffers", &buffers)
        .set("extensionsRequired", r#"["EXT_meshopt_compression"]"#)
}

/// Corners (0,0,0), (1,0,0), (0,1,0) as mantissas: only two bytes ever change, and back.
fn packed_corners() -> Vec<u8> {
    let mut bytes = vec![0xa0];
    for byte in 0..12 {
        match byte {
            // +1, -1, 0.
            0 => bytes.extend([1, 0b00_10_01_00, 0, 0, 0]),
            // 0, 0, +1.
            4 => bytes.extend([1, 0b00_00_10_00, 0, 0, 0]),
            _ => bytes.push(0),
        }
    }
    bytes.extend([0; 32]);
    bytes
}

const PACKED_INDICES: [u8; 18] = [0xe1, 0xf0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];

#[test]
fn packed_views_are_unpacked() {
    let scene = meshopt(&packed_corners(), &PACKED_INDICES).load().unwrap();
    let expected = File::triangle().load().unwrap();
    assert_eq!(scene.mesh.positions, expected.mesh.positions);
    assert_eq!(scene.mesh.triangles, expected.mesh.triangles);
    assert!(scene.warnings.is_empty());
}

#[test]
fn broken_packed_views_are_refused() {
    let corners = packed_corners();
    let here = "bufferViews[0].extensions.EXT_meshopt_compression";
    refused_at(here, meshopt(&corners[1..], &PACKED_INDICES));
    refused_at(
        "bufferViews[1].extensions.EXT_meshopt_compression",
        meshopt(&corners, &PACKED_INDICES[..17]),
    );
    let file = || meshopt(&corners, &PACKED_INDICES);
    let views = file().json["bufferViews"].clone();
    for (from, to, place) in [
        (r#""buffer":0"#, r#""buffer":7"#, ".buffer"),
        (r#""byteOffset":0"#, r#""byteOffset":99999"#, ""),
        (r#""count":3"#, r#""count":4000000000"#, ".count"),
        (r#""mode":"ATTRIBUTES""#, r#""mode":"X""#, ".mode"),
    ] {
        let views = views.replacen(from, to, 1);
        refused_at(&format!("{here}{place}"), file().set("bufferViews", &views));
    }
    // A promise of more than the limit is not kept, whatever the data say.
    let views = views.replacen(r#""count":3"#, r#""count":100000000"#, 1);
    let (_, message) = refused(file().set("bufferViews", &views).load());
    assert!(message.contains("file_bytes"), "{message}");
}
