//! Paths of light against the path tracer of others: both are right in the mean, so they differ by noise alone.
//!
//! Means over tiles of 40x36 pixels of the pictures, forty of them, from eight independent pictures of ours; the references'
//! own noise is taken to be that of ours at their 4096 samples. A tile whose means are further apart than nine of its standard
//! errors and a hundredth of its light is wrong: a sound tracer has one among the 320 with a chance below 0.02 (Student's t with 7
//! degrees of freedom) when its seeds are changed, and never while they are not.

use vsgl_core::data::Image;
use vsgl_core::metrics::{Plane, luminance};
use vsgl_tests::assets::assets;
use vsgl_tests::chance::{Estimate, pictures};
use vsgl_tests::view::{VIEWS, reference, shot};

const PICTURES: u32 = 8;
const SAMPLES: u32 = 8;
const ERRORS: f64 = 9.0;
/// Samples of the references.
const THEIRS: f64 = 4096.0;
const TILE: (u32, u32) = (40, 36);

/// Means of a plane over the tiles.
fn tiles(width: u32, height: u32, value: impl Fn(usize) -> f64) -> Vec<f64> {
    let (across, down) = (width / TILE.0, height / TILE.1);
    let mut tiles = vec![0.0; (across * down) as usize];
    for y in 0..down * TILE.1 {
        for x in 0..across * TILE.0 {
            let tile = y / TILE.1 * across + x / TILE.0;
            tiles[tile as usize] += value((y * width + x) as usize) / f64::from(TILE.0 * TILE.1);
        }
    }
    tiles
}

#[test]
fn paths_differ_from_those_of_others_by_noise_alone() {
    let Some(_) = assets("ground-truth", "paths against those of others") else {
        return;
    };
    let root = assets("", "paths").expect("the folder of the ground truth is in it");
    for name in VIEWS {
        let shot = shot(&root, name).with(&format!("method=path spp={SAMPLES}"));
        let images = pictures(&shot, &shot.plan(), PICTURES);
        type Layer = fn(&Image) -> Vec<[f32; 3]>;
        let layers: [(&str, Layer); 2] = [
            ("direct", |i| i.direct.clone()),
            ("indirect", Image::indirect),
        ];
        for (kind, layer) in layers {
            let theirs: Plane = reference(&root, name, kind);
            let (width, height) = (theirs.width(), theirs.height());
            let ours: Vec<Vec<f64>> = images
                .iter()
                .map(|image| {
                    let layer = layer(image);
                    tiles(width, height, |i| luminance(layer[i]))
                })
                .collect();
            let theirs = tiles(width, height, |i| theirs.values()[i]);
            let mean = theirs.iter().sum::<f64>() / theirs.len() as f64;
            let (mut worst, mut sum) = (0.0f64, [0.0f64; 2]);
            for (tile, theirs) in theirs.iter().enumerate() {
                let values: Vec<f64> = ours.iter().map(|tiles| tiles[tile]).collect();
                let found = Estimate::of(&values);
                let samples = f64::from(PICTURES * SAMPLES);
                let error = found.error * (1.0 + samples / THEIRS).sqrt();
                let apart = (found.mean - theirs).abs();
                worst = worst.max(apart / (ERRORS * error + 0.01 * theirs + 1e-4 * mean));
                sum = [sum[0] + found.mean, sum[1] + theirs];
            }
            let energy = 100.0 * (sum[0] / sum[1] - 1.0);
            println!(
                "{name} {kind}: energy {energy:+.2} %, worst tile {worst:.2} of what is allowed"
            );
            assert!(
                worst < 1.0,
                "{name} {kind}: a tile is {worst:.2} times too far off"
            );
        }
    }
}
