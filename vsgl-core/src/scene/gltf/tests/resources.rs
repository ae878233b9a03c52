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
