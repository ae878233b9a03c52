//! Differences between pictures.

use vsgl_core::data::Image;
use vsgl_core::metrics::{Errors, Metric, Plane, compare, luminance};

/// Errors of the indirect light of a picture, pixel by pixel; see [`vsgl_core::metrics`].
///
/// # Panics
/// If the pictures differ in size or nothing can be compared.
pub fn indirect_errors(test: &Image, reference: &Image) -> Errors {
    let plane = |image: &Image| {
        Plane::luminance(image.width, image.height, &image.indirect()).expect("one value a pixel")
    };
    compare(&plane(test), &plane(reference), 1)
        .expect("pictures of one size")
        .expect("some reference light")
}

/// Mean absolute percentage error of the indirect light [%].
pub fn indirect_mape(test: &Image, reference: &Image) -> f64 {
    indirect_errors(test, reference).get(Metric::Mape)
}

/// Relative differences of luminance between two layers, ascending. Differences below a thousandth of the mean are taken
/// against that.
///
/// # Panics
/// If the layers differ in length, or the reference is black.
pub fn relative_differences(test: &[[f32; 3]], reference: &[[f32; 3]]) -> Vec<f64> {
    assert_eq!(test.len(), reference.len());
    let mean = reference.iter().map(|&c| luminance(c)).sum::<f64>() / reference.len() as f64;
    assert!(mean > 0.0, "a black reference shows nothing");
    let one = |(&a, &b): (&[f32; 3], &[f32; 3])| {
        let (a, b) = (luminance(a), luminance(b));
        (a - b).abs() / b.max(1e-3 * mean)
    };
    let mut all: Vec<f64> = test.iter().zip(reference).map(one).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// The value that a share of ascending values does not pass.
pub fn quantile(ascending: &[f64], share: f64) -> f64 {
    ascending[((ascending.len() - 1) as f64 * share).round() as usize]
}

/// What is wrong with the light in a picture: a layer that is not finite, or negative.
pub fn fault(image: &Image) -> Option<String> {
    let layers = [
        ("direct", &image.direct),
        ("indirect_diffuse", &image.indirect_diffuse),
        ("indirect_glossy", &image.indirect_glossy),
        ("albedo", &image.albedo),
    ];
    for (name, layer) in layers {
        for (i, rgb) in layer.iter().enumerate() {
            if !rgb.iter().all(|c| c.is_finite() && *c >= 0.0) {
                return Some(format!("{name} of pixel {i} is {rgb:?}"));
            }
        }
    }
    let finite = |v: &[f32; 3]| v.iter().all(|c| c.is_finite());
    if !image.normal.iter().all(finite) {
        return Some("a normal is not finite".into());
    }
    let depth = image.depth.iter().find(|d| !d.is_finite() || **d < 0.0);
    depth.map(|d| format!("a depth is {d}"))
}
