//! The development scenes and those of the ground truth.

use crate::assets;
use std::time::{Duration, Instant};
use vsgl_core::scene::gltf;

struct Expected {
    file: &'static str,
    /// Triangles that the file draws, instances counted.
    triangles: usize,
    /// How many of them have no area, placed and rounded to f32; these are left out.
    flat: usize,
    textures: usize,
    lights: usize,
    cameras: usize,
}

const fn scene(
    file: &'static str,
    [triangles, flat]: [usize; 2],
    [textures, lights, cameras]: [usize; 3],
) -> Expected {
    Expected {
        file,
        triangles,
        flat,
        textures,
        lights,
        cameras,
    }
}

/// Textures are the images of base colour, metallic-roughness, normals and emission, and those of the extensions.
const SCENES: &[Expected] = &[
    scene("scenes/Sponza/Sponza.gltf", [262_087, 0], [49, 0, 4]),
    scene(
        "scenes/BreakfastRoom/BreakfastRoom.gltf",
        [262_687, 0],
        [3, 0, 3],
    ),
    scene("scenes/Bathroom/Bathroom.glb", [38_555, 2_897], [9, 0, 0]),
    scene("scenes/HotelRoom/HotelRoom.glb", [99_029, 0], [6, 0, 0]),
    scene("scenes/Zdm2/zdm2.glb", [58_772, 1_134], [0, 0, 0]),
    scene(
        "scenes/DepthOfField/DepthOfField.glb",
        [10_610, 0],
        [5, 1, 0],
    ),
    scene(
        "scenes/LightsPunctualLamp/LightsPunctualLamp.gltf",
        [6_000, 0],
        [6, 5, 0],
    ),
    scene(
        "scenes/StainedGlassLamp/StainedGlassLamp.gltf",
        [35_132, 0],
        [16, 0, 0],
    ),
    scene(
        "scenes/SpaceExploration/SpaceExploration.glb",
        [50_003, 0],
        [2, 0, 0],
    ),
    scene("scenes/ToyCar/ToyCar.gltf", [108_936, 0], [6, 0, 8]),
    scene("scenes/CornellBox/CornellBox.glb", [36, 0], [0, 0, 0]),
    scene("scenes/TpsLights/TpsLights.glb", [5_440, 0], [0, 20, 0]),
    scene("ground-truth/room_spot.glb", [2_242, 0], [0, 1, 1]),
    scene("ground-truth/many10k.glb", [10_424, 0], [0, 0, 1]),
];

/// The largest scene takes a quarter of a second on two cores.
const SLOWEST: Duration = Duration::from_secs(3);

#[test]
fn all_load_with_everything_that_is_in_them() {
    let tests = format!("{} development scenes", SCENES.len());
    let Some(_) = assets("scenes", &tests) else {
        return;
    };
    let root = assets("", &tests).expect("the folder of scenes is in it");
    for expected in SCENES {
        let start = Instant::now();
        let scene = gltf::load(&root.join(expected.file)).expect(expected.file);
        let time = start.elapsed();
        println!("{}: {:.3} s", expected.file, time.as_secs_f64());
        assert!(time < SLOWEST, "{}: {time:?}", expected.file);
        let drawn = expected.triangles - expected.flat;
        assert_eq!(scene.mesh.triangles.len(), drawn, "{}", expected.file);
        assert_eq!(scene.textures.len(), expected.textures, "{}", expected.file);
        assert_eq!(scene.lights.len(), expected.lights, "{}", expected.file);
        assert_eq!(scene.cameras.len(), expected.cameras, "{}", expected.file);
        crate::conformance::check(&scene, expected.file);
    }
}
