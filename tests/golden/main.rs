//! Small pictures as they were: a change that nobody meant shows here first.
//!
//! Each file of `golden/pictures` holds the layers of one picture of 64x36 pixels, as means over blocks of 4x4. With
//! `VSGL_BLESS=1` the files are written anew; the commit then says why they changed. A missing file is a failure.
//!
//! The comparison allows for 1e-4: within one machine the bits are the same by design, whatever its vector instructions
//! (see the tests of determinism), but the few sines and tangents of lights and cameras come from the system's
//! mathematics library, which may round the last bit elsewhere.

mod text;

use text::Layer;
use vsgl_core::data::Image;
use vsgl_core::settings::Preset;
use vsgl_tests::render::Shot;

/// Side of the blocks.
const BLOCK: u32 = 4;
/// Relative, with a thousandth of the layer's mean added to what it is relative to.
const TOLERANCE: f64 = 1e-4;

fn layers(image: &Image) -> Vec<Layer> {
    [
        ("direct", &image.direct),
        ("indirect_diffuse", &image.indirect_diffuse),
        ("indirect_glossy", &image.indirect_glossy),
    ]
    .map(|(name, pixels)| Layer {
        name: name.into(),
        values: means(image.width, image.height, pixels),
    })
    .into()
}

/// Means over blocks, red, green and blue of each.
fn means(width: u32, height: u32, pixels: &[[f32; 3]]) -> Vec<f64> {
    let mut values = Vec::new();
    for y in (0..height).step_by(BLOCK as usize) {
        for x in (0..width).step_by(BLOCK as usize) {
            let block = (0..BLOCK * BLOCK).map(|i| {
                let at = (y + i / BLOCK) * width + x + i % BLOCK;
                pixels[at as usize].map(f64::from)
            });
            let sum = block.fold([0.0; 3], |s, c| [s[0] + c[0], s[1] + c[1], s[2] + c[2]]);
            values.extend(sum.map(|c| c / f64::from(BLOCK * BLOCK)));
        }
    }
    values
}

fn golden(name: &str, shot: Shot) {
    let image = shot.size(64, 36).image();
    let found = layers(&image);
    let path = text::path(name);
    if std::env::var_os("VSGL_BLESS").is_some_and(|v| v == "1") {
        std::fs::write(&path, text::write(&found)).expect("a writable folder");
        println!("wrote {}", path.display());
        return;
    }
    let expected = std::fs::read_to_string(&path)
        .unwrap_or_else(|e| panic!("{}: {e}; VSGL_BLESS=1 writes it", path.display()));
    let expected = text::read(&expected);
    let worst = difference(&found, &expected);
    println!("{name}: {worst:.1e}");
    assert!(
        worst <= TOLERANCE,
        "{name}: off by {worst:.1e}; if that is meant, VSGL_BLESS=1 writes it anew"
    );
}

/// Greatest relative difference; infinite for NaN and for other layers.
fn difference(found: &[Layer], expected: &[Layer]) -> f64 {
    let mut worst = 0.0f64;
    if found.len() != expected.len() {
        return f64::INFINITY;
    }
    for (a, b) in found.iter().zip(expected) {
        if a.name != b.name || a.values.len() != b.values.len() {
            return f64::INFINITY;
        }
        let mean = b.values.iter().sum::<f64>() / b.values.len() as f64;
        for (x, y) in a.values.iter().zip(&b.values) {
            let apart = (x - y).abs() / (y.abs() + 1e-3 * mean).max(1e-30);
            worst = if apart.is_nan() {
                f64::INFINITY
            } else {
                worst.max(apart)
            };
        }
    }
    worst
}

#[test]
fn cornell() {
    golden(
        "cornell",
        Shot::sample("cornell").with("rsm=128 lights=256"),
    );
}

#[test]
fn glossy_floor_without_occlusion() {
    golden(
        "glossy-floor",
        Shot::sample("glossy-floor").with("rsm=128 lights=256 occlusion=none"),
    );
}

#[test]
fn two_lights_from_samples() {
    golden(
        "many-lights-2",
        Shot::sample("many-lights:2").with("rsm=64 lights=256 clustering=filtered"),
    );
}

#[test]
fn roughness_row_as_published() {
    let mut shot = Shot::sample("roughness-row");
    shot.settings = Preset::Paper2016.settings();
    golden("roughness-row-2016", shot.with("rsm=128 lights=256"));
}

#[test]
fn two_lights_as_published() {
    let mut shot = Shot::sample("cornell");
    shot.settings = Preset::Paper2015.settings();
    golden("cornell-2015", shot);
}

/// The comparison must find what it is there for.
#[test]
fn planted_faults_are_found() {
    let image = Shot::sample("cornell").size(64, 36).image();
    let right = layers(&image);
    let again = text::read(&text::write(&right));
    assert!(difference(&again, &right) < 1e-6, "written and read");
    let wrong = |change: fn(&mut Image)| {
        let mut image = image.clone();
        change(&mut image);
        difference(&layers(&image), &right)
    };
    let lit = |layer: &[[f32; 3]]| layer.iter().position(|c| c[1] > 0.0).expect("light");
    assert!(
        wrong(|image| image.direct.iter_mut().for_each(|c| c[0] *= 1.001)) > TOLERANCE,
        "a tint"
    );
    assert!(
        wrong(|image| image.indirect_diffuse.rotate_right(64)) > TOLERANCE,
        "a shifted row"
    );
    assert!(
        wrong(|image| image.indirect_glossy.fill([0.0; 3])) > TOLERANCE,
        "a lost layer"
    );
    let at = lit(&image.indirect_diffuse);
    let mut one = image.clone();
    one.indirect_diffuse[at][1] = f32::NAN;
    assert!(difference(&layers(&one), &right) > TOLERANCE, "a NaN");
    one = image.clone();
    one.indirect_diffuse[at][1] *= 1.1;
    assert!(
        difference(&layers(&one), &right) > TOLERANCE,
        "one pixel scaled"
    );
}
