//! Small files, each with one point: what is drawn, what is refused, and what is not yet right.

use crate::assets;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use vsgl_core::glam::Vec4;
use vsgl_core::scene::{Scene, Slot, gltf};

enum Expected {
    /// Has no triangles, and says no more.
    Empty,
    /// Is refused with these words, as it should be.
    Refused(&'static str),
    /// Is drawn with these words among the warnings, as it should be.
    Warned(&'static str),
    /// Is drawn, or refused, with these words; a complete loader does better.
    NotYet(&'static str, &'static str),
}

use Expected::{Empty, NotYet, Refused, Warned};

/// Files that are not simply drawn without a warning about what they are for.
const EXPECTED: &[(&str, Expected)] = &[
    // Points and lines only.
    (
        "asset-generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_00.gltf",
        Empty,
    ),
    (
        "asset-generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_01.gltf",
        Empty,
    ),
    (
        "asset-generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_02.gltf",
        Empty,
    ),
    (
        "asset-generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_03.gltf",
        Empty,
    ),
    (
        "asset-generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_07.gltf",
        Empty,
    ),
    (
        "asset-generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_08.gltf",
        Empty,
    ),
    (
        "asset-generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_09.gltf",
        Empty,
    ),
    (
        "asset-generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_10.gltf",
        Empty,
    ),
    // Nothing, or lights alone.
    ("atteneder/Empty.gltf", Empty),
    ("lights-renderling/four_spotlights.glb", Empty),
    // Written for a later version of glTF, or for an extension that nobody has.
    (
        "asset-generator/Compatibility/Compatibility_04.gltf",
        Refused("2.1"),
    ),
    (
        "asset-generator/Compatibility/Compatibility_05.gltf",
        Refused("FAKE_materials_quantumRendering"),
    ),
    (
        "khronos/IridescenceSuzanne/IridescenceSuzanne.glb",
        Refused("KHR_materials_iridescence"),
    ),
    (
        "ktx2-AnisotropyBarnLamp/AnisotropyBarnLamp.gltf",
        Refused("images[1]"),
    ),
    // Broken on purpose.
    (
        "invalid-assimp/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb",
        Refused("POSITION"),
    ),
    (
        "invalid-assimp/IncorrectVertexArrays/Cube.gltf",
        Refused("35 corners"),
    ),
    (
        "invalid-assimp/IndexOutOfRange/AllIndicesOutOfRange.gltf",
        Refused("65535"),
    ),
    (
        "invalid-assimp/IndexOutOfRange/IndexOutOfRange.gltf",
        Refused("255"),
    ),
    (
        "invalid-assimp/MissingBin/BoxTextured.gltf",
        Refused("BoxTextured0.bin"),
    ),
    (
        "invalid-assimp/RecursiveNodes/RecursiveNodes.gltf",
        Refused("reached twice"),
    ),
    (
        "invalid-assimp/TestNoRootNode/SceneWithoutNodes.gltf",
        Refused("nodes"),
    ),
    (
        "invalid-assimp/wrongTypes/badArray.gltf",
        Refused("line 44"),
    ),
    (
        "invalid-assimp/wrongTypes/badNumber.gltf",
        Refused("line 132"),
    ),
    // Drawn without what is optional.
    (
        "khronos/MeshPrimitiveModes/MeshPrimitiveModes.gltf",
        Warned("points and lines"),
    ),
    (
        "generated/points_and_lines.gltf",
        Warned("points and lines"),
    ),
    (
        "khronos/InterpolationTest/InterpolationTest.glb",
        Warned("animations"),
    ),
    (
        "webp-draco-Room/room-transformed.glb",
        Warned("alpha blending"),
    ),
    (
        "khronos/ClearCoatTest/ClearCoatTest.glb",
        Warned("KHR_materials_clearcoat"),
    ),
    (
        "khronos/AttenuationTest/AttenuationTest.glb",
        Warned("KHR_materials_volume"),
    ),
    (
        "gltf-transform/BoxTextured.gltf",
        Warned("pbrSpecularGlossiness"),
    ),
    // To come.
    (
        "khronos/MultipleScenes/MultipleScenes.gltf",
        Warned("scene 1 of 2"),
    ),
    ("khronos/Cameras/Cameras.gltf", Warned("orthographic")),
    (
        "lights-playcanvas/geometry-camera-light.glb",
        Warned("orthographic"),
    ),
    (
        "generated/emissive_only.gltf",
        Warned("lights without intensity"),
    ),
    (
        "khronos/TextureTransformMultiTest/TextureTransformMultiTest.glb",
        Warned("KHR_materials_clearcoat"),
    ),
    (
        "lights-atteneder/LightsPoint.gltf",
        NotYet(
            "git lfs pull",
            "its buffer is a stand-in, not data: nothing to read",
        ),
    ),
    (
        "lights-atteneder/LightsSpot.gltf",
        NotYet(
            "git lfs pull",
            "its buffer is a stand-in, not data: nothing to read",
        ),
    ),
];

/// Warnings that the rest may have: they are not what these files are for.
const INCIDENTAL: &[&str] = &[
    "animations are ignored",
    "extension `KHR_materials_pbrSpecularGlossiness` is ignored",
];

#[test]
fn every_file_is_drawn_or_refused_as_it_should_be() {
    let Some(root) = assets("scenes-conformance", "134 conformance files") else {
        return;
    };
    let files = gltf_files(&root);
    let mut not_yet = Vec::new();
    let mut wrong = Vec::new();
    for file in &files {
        let name = file
            .strip_prefix(&root)
            .expect("below")
            .display()
            .to_string();
        let expected = EXPECTED.iter().find(|(n, _)| *n == name).map(|(_, e)| e);
        if let Some(NotYet(_, why)) = expected {
            not_yet.push(format!("{name}: {why}"));
        }
        if let Err(why) = outcome(file, &name, expected) {
            wrong.push(format!("{name}: {why}"));
        }
    }
    println!("{} files, {} not yet right:", files.len(), not_yet.len());
    println!("{}", not_yet.join("\n"));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let names: BTreeSet<String> = files
        .iter()
        .map(|f| f.strip_prefix(&root).expect("below").display().to_string())
        .collect();
    for (name, _) in EXPECTED {
        assert!(names.contains(*name), "no file {name}");
    }
}

fn outcome(file: &Path, name: &str, expected: Option<&Expected>) -> Result<(), String> {
    let start = Instant::now();
    let loaded = gltf::load(file);
    if start.elapsed() > Duration::from_secs(5) {
        return Err(format!("took {:?}", start.elapsed()));
    }
    let (triangles, said) = match &loaded {
        Ok(scene) => {
            check(scene, name);
            (Some(scene.mesh.triangles.len()), scene.warnings.join("; "))
        }
        Err(error) => (None, error.to_string()),
    };
    let fine = match expected {
        None => {
            let incidental = |w: &String| INCIDENTAL.iter().any(|known| w.starts_with(known));
            let quiet = loaded.is_ok_and(|scene| scene.warnings.iter().all(incidental));
            quiet && triangles > Some(0)
        }
        Some(Empty) => triangles == Some(0),
        Some(Refused(words)) => triangles.is_none() && said.contains(words),
        Some(Warned(words)) => triangles > Some(0) && said.contains(words),
        Some(NotYet(words, _)) => triangles != Some(0) && said.contains(words),
    };
    if fine {
        return Ok(());
    }
    Err(format!("{triangles:?} triangles; {said}"))
}

/// What every scene promises to its users.
pub(crate) fn check(scene: &Scene, name: &str) {
    let mesh = &scene.mesh;
    let vertices = mesh.positions.len();
    assert_eq!(mesh.normals.len(), vertices, "{name}");
    assert_eq!(mesh.triangles.len(), mesh.material.len(), "{name}");
    for side in [
        mesh.texcoords.len(),
        mesh.texcoords_second.len(),
        mesh.tangents.len(),
        mesh.colors.len(),
    ] {
        assert!(side == 0 || side == vertices, "{name}");
    }
    assert!(
        mesh.triangles
            .as_flattened()
            .iter()
            .all(|&v| (v as usize) < vertices),
        "{name}"
    );
    assert!(
        mesh.material
            .iter()
            .all(|&m| (m as usize) < scene.materials.len()),
        "{name}"
    );
    assert!(mesh.positions.iter().all(|p| p.is_finite()), "{name}");
    assert!(mesh.normals.iter().all(|n| n.is_normalized()), "{name}");
    for tangent in mesh.tangents.iter().filter(|t| **t != Vec4::ZERO) {
        assert!(tangent.truncate().is_normalized(), "{name}");
        assert!(tangent.w.abs() == 1.0, "{name}");
    }
    let share = |c: f32| (0.0..=1.0).contains(&c);
    let mut colors = mesh.colors.iter().flat_map(|c| c.to_array());
    assert!(colors.all(share), "{name}");
    assert!(mesh.texcoords.iter().all(|t| t.is_finite()), "{name}");
    for material in &scene.materials {
        for texture in Slot::ALL.iter().filter_map(|&slot| material.texture(slot)) {
            let sets = [&mesh.texcoords, &mesh.texcoords_second];
            assert!(!sets[texture.set as usize].is_empty(), "{name}");
            let texture = &scene.textures[texture.texture as usize];
            assert_eq!(
                texture.texels.len(),
                (texture.width * texture.height) as usize,
                "{name}"
            );
        }
    }
    let (low, high) = scene.bounds();
    assert!(
        (low + high).length() <= 1e-6 * (high - low).length(),
        "{name}: not centred"
    );
}

/// All .gltf and .glb files below a folder, in the order of their paths.
fn gltf_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a readable folder") {
            let path = entry.expect("a readable folder").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "gltf" || e == "glb") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}
