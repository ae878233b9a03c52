//! Lamps and cameras that move: what flickers.

use vsgl_core::glam::Vec3;
use vsgl_core::settings::Clustering;
use vsgl_tests::assets::assets;
use vsgl_tests::coherence::{Flicker, Frames, camera_moved, lamps_moved};
use vsgl_tests::render::Shot;
use vsgl_tests::view;

/// A step of a frame: 1.5 cm and a quarter of a degree.
const WAY: Vec3 = Vec3::new(0.012, 0.004, -0.008);
const TURN: f32 = 0.0044;

/// Frames of a lamp that moves by shares of a step.
fn lamp(shot: &Shot, frames: u32, step: f32) -> Vec<Shot> {
    let frame = |i: u32| lamps_moved(shot, WAY, TURN, i as f32 * step);
    (0..frames).map(frame).collect()
}

/// Clusterings that are compared.
fn clusterings() -> impl Iterator<Item = Clustering> {
    let all = Clustering::ALL.iter().copied();
    // Whole maps have no number of lights that could grow.
    all.filter(|&clustering| clustering != Clustering::Whole)
}

fn flicker(shots: &[Shot], settings: &str, reference: &Frames) -> Flicker {
    Frames::render(shots, settings).against(reference)
}

#[test]
fn clusters_stay_where_the_light_stays() {
    let base = Shot::sample("cornell")
        .size(32, 16)
        .with("rsm=64 lights=100 occlusion=none");
    let reference = |shots: &[Shot]| Frames::render(shots, "method=vpl");
    let (wide, fine) = (lamp(&base, 5, 1.0), lamp(&base, 5, 0.125));
    let (of_wide, of_fine) = (reference(&wide), reference(&fine));
    for clustering in clusterings() {
        let settings = format!("clustering={clustering}");
        let (wide, fine) = (
            flicker(&wide, &settings, &of_wide),
            flicker(&fine, &settings, &of_fine),
        );
        println!(
            "{clustering}: error {:.4}, change {:.4}, {:.4} with an eighth of the step",
            wide.error, wide.change, fine.change
        );
        // Errors of frames that have nothing in common would change by √2 of their size, whatever the step.
        assert!(wide.change < 0.8 * wide.error, "{clustering}: {wide:?}");
        // Of what moves evenly an eighth is left, of clusters that jump more.
        assert!(fine.change < 0.25 * wide.change, "{clustering}: {fine:?}");
    }
}

/// Frames of one motion, and the words that go with all of them.
struct Motion {
    name: String,
    shots: Vec<Shot>,
    settings: &'static str,
}

fn motions() -> Vec<Motion> {
    let mut all = Vec::new();
    let base = |shot: Shot| {
        let mut shot = shot.size(48, 24).with("rsm=192 occlusion=none");
        shot.threads = 2;
        shot
    };
    let mut scenes: Vec<(String, Shot)> = ["cornell", "columns"]
        .map(|name| (name.to_owned(), base(Shot::sample(name))))
        .into();
    if let Some(root) = assets("", "flicker of a scene by others") {
        scenes.push(("room_spot".into(), base(view::shot(&root, "room_spot"))));
    }
    for (name, shot) in &scenes {
        all.push(Motion {
            name: format!("{name}, lamp"),
            shots: lamp(shot, 5, 1.0),
            settings: "",
        });
    }
    let shots: Vec<Shot> = (0..5)
        .map(|i| camera_moved(&scenes[1].1, WAY, TURN, i as f32))
        .collect();
    for settings in ["pdf=flux", "pdf=brsm"] {
        all.push(Motion {
            name: format!("columns, camera, {settings}"),
            shots: shots.clone(),
            settings,
        });
    }
    all
}

/// Numbers of lights that the table interpolates between.
const LIGHTS: [u32; 4] = [64, 256, 1024, 4096];

/// Change where the error is `error`, by the straight lines through logarithms of both at growing numbers of lights.
fn change_at(error: f64, found: &[Flicker]) -> Option<f64> {
    found.windows(2).find_map(|pair| {
        let [a, b] = [pair[0], pair[1]];
        let share = (error / a.error).ln() / (b.error / a.error).ln();
        (0.0..=1.0)
            .contains(&share)
            .then(|| a.change * (b.change / a.change).powf(share))
    })
}

/// The table of `docs/vsgl.md`.
#[test]
#[ignore = "takes minutes: scripts/flicker-table"]
fn table() {
    // The harness has begun a line.
    println!();
    println!(
        "| motion | clustering | 256 lights: error, change | 8 × 8 | 1024 lights | 8 × 8 | change at equal error |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    for motion in motions() {
        let reference = Frames::render(&motion.shots, "method=vpl");
        let boxed = reference.boxed();
        let mut equal = None;
        for clustering in clusterings() {
            let mut found = Vec::new();
            let mut words = String::new();
            for lights in LIGHTS {
                let settings = format!(
                    "lights={lights} clustering={clustering} {}",
                    motion.settings
                );
                let frames = Frames::render(&motion.shots, &settings);
                let (pixel, eight) = (frames.against(&reference), frames.boxed().against(&boxed));
                if lights == 256 || lights == 1024 {
                    for f in [pixel, eight] {
                        let [error, change] = [f.error, f.change].map(|v| 100.0 * v);
                        words += &format!(" {error:.2}, {change:.2} |");
                    }
                }
                found.push(pixel);
            }
            // What the partition has with 256 lights.
            let wanted = *equal.get_or_insert(found[1].error);
            let at = change_at(wanted, &found)
                .map_or("–".to_owned(), |change| format!("{:.2}", 100.0 * change));
            println!("| {} | `{clustering}` |{words} {at} |", motion.name);
        }
    }
}
