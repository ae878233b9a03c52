//! Colours that stand for numbers.

use crate::output::srgb;

/// Colour of a share 0..=1 on a scale from near black over violet, red and orange to pale yellow.
///
/// Lightness rises evenly with the share, as the eye sees it, so that equal steps look equal, also without colour
/// vision and in a grey print.
pub fn scale(share: f32) -> [u8; 3] {
    let t = share.clamp(0.0, 1.0);
    let lightness = 0.15 + 0.82 * t;
    // Saturation is low at both ends, where the screen has none to give.
    let chroma = 0.03 + 0.56 * t * (1.0 - t);
    let hue = (295.0 + 165.0 * t).to_radians();
    oklch(lightness, chroma.min(0.16), hue)
}

/// Colour of a signed share -1..=1: near black at zero, to pale blue below and to pale orange above, as light on both sides.
pub fn signed(share: f32) -> [u8; 3] {
    let t = share.abs().min(1.0);
    let lightness = 0.15 + 0.8 * t;
    let chroma = 0.6 * t * (1.05 - t);
    let hue: f32 = if share < 0.0 { 255.0 } else { 55.0 };
    oklch(lightness, chroma.min(0.15), hue.to_radians())
}

/// A colour for the `index`-th of many things: neighbours in the count differ clearly in hue and lightness.
pub fn category(index: u32) -> [u8; 3] {
    // Steps of the golden angle never repeat; the lightness cycles on its own.
    let hue = (f64::from(index) * 137.507_764)
        .rem_euclid(360.0)
        .to_radians();
    let lightness = 0.55 + 0.13 * (index % 4) as f32;
    oklch(lightness, 0.13, hue as f32)
}

/// The sRGB code of a colour in OKLCh; what a screen cannot show loses saturation until it can.
///
/// Source: Ottosson 2020, "A perceptual color space for image processing".
fn oklch(lightness: f32, chroma: f32, hue: f32) -> [u8; 3] {
    let mut chroma = chroma;
    loop {
        let linear = oklab(lightness, chroma * hue.cos(), chroma * hue.sin());
        if chroma < 1e-3 || linear.iter().all(|c| (-1e-3..=1.001).contains(c)) {
            return linear.map(srgb::code);
        }
        chroma *= 0.97;
    }
}

fn oklab(lightness: f32, a: f32, b: f32) -> [f32; 3] {
    let cube = |v: f32| v * v * v;
    let l = cube(lightness + 0.396_337_78 * a + 0.215_803_76 * b);
    let m = cube(lightness - 0.105_561_346 * a - 0.063_854_17 * b);
    let s = cube(lightness - 0.089_484_18 * a - 1.291_485_5 * b);
    [
        4.076_741_7 * l - 3.307_711_6 * m + 0.230_969_94 * s,
        -1.268_438 * l + 2.609_757_4 * m - 0.341_319_38 * s,
        -0.004_196_086_3 * l - 0.703_418_6 * m + 1.707_614_7 * s,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use vsgl_core::metrics::luminance;

    #[test]
    fn the_scale_gets_lighter_all_the_way() {
        let mut last = -1.0;
        for step in 0..=100 {
            let linear = scale(step as f32 / 100.0).map(|c| srgb::decode(f32::from(c) / 255.0));
            let light = luminance(linear).cbrt();
            assert!(light > last - 2e-3, "step {step}: {light} after {last}");
            last = light;
        }
        assert!(last > 0.9);
        assert_eq!(scale(-1.0), scale(0.0));
        assert_eq!(scale(7.0), scale(1.0));
    }

    #[test]
    fn signs_are_equally_light_and_of_other_colours() {
        for step in 0..=10 {
            let share = step as f32 / 10.0;
            let light = |share| {
                let linear = signed(share).map(|c| srgb::decode(f32::from(c) / 255.0));
                luminance(linear).cbrt()
            };
            assert!((light(share) - light(-share)).abs() < 0.03, "{share}");
        }
        let [[r, _, b], [s, _, c]] = [signed(0.6), signed(-0.6)];
        assert!(r > b && c > s);
        assert_eq!(signed(-7.0), signed(-1.0));
    }

    #[test]
    fn white_and_grey_have_no_hue() {
        let [r, g, b] = oklch(1.0, 0.0, 1.0);
        assert!(r >= 254 && g >= 254 && b >= 254);
        let [r, g, b] = oklch(0.5, 0.0, 1.0);
        assert!(r.abs_diff(g) <= 1 && g.abs_diff(b) <= 1);
    }

    #[test]
    fn neighbouring_categories_differ() {
        for index in 0..1000 {
            let (a, b) = (category(index), category(index + 1));
            let distance: u32 = (0..3).map(|i| u32::from(a[i].abs_diff(b[i]))).sum();
            assert!(distance > 60, "{index}: {a:?} {b:?}");
        }
    }
}
