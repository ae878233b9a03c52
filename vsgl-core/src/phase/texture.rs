//! Reading textures, with exact loads and our own interpolation.

use super::footprint::Place;
use super::surface::mix;
use crate::data::{MIPS, NEAREST, SECOND_SET, SceneData, TextureRecord};
use crate::math::elementary::log;

/// Most reads along the longer axis of a footprint.
pub const TAPS: u32 = 8;
/// Largest square of a footprint's axis \[texels²\]: more texels there are not.
pub const AXIS_MAX: f32 = 1e30;
/// From the natural logarithm of a square to the binary logarithm of its root.
pub const HALF_LOG2_E: f32 = 0.721_347_5;

/// Texture coordinates of the image at the first corner of a triangle, and by how much those of the second and third differ.
pub fn corners(scene: &SceneData, record: &TextureRecord, triangle: u32) -> [[f32; 2]; 3] {
    let c = if record.mode & SECOND_SET != 0 {
        &scene.corner_texcoord_second[triangle as usize]
    } else {
        &scene.corner_texcoord[triangle as usize]
    };
    let (to_u, to_v) = (record.to_u, record.to_v);
    let turn = |s: f32, t: f32| [to_u[0] * s + to_u[1] * t, to_v[0] * s + to_v[1] * t];
    let first = turn(c[0], c[1]);
    [
        [first[0] + to_u[2], first[1] + to_v[2]],
        turn(c[2] - c[0], c[3] - c[1]),
        turn(c[4] - c[0], c[5] - c[1]),
    ]
}

/// Which texels stand for a footprint: a row of places in one image, or between two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Middle of the row, in texture coordinates.
    pub at: [f32; 2],
    /// From its one end to the other.
    pub along: [f32; 2],
    /// Number of places, 1 to [`TAPS`].
    pub taps: u32,
    /// Image: 0 the full one, 1 that of half its size …
    pub level: f32,
}

/// The texels to read at a place: so many places along the longer axis of its footprint, and images so small, that places
/// lie as far apart as texels do.
///
/// Source: Heckbert 1989, "Fundamentals of Texture Mapping and Image Warping", section 3 (footprints are ellipses); McCormack,
/// Perry, Farkas and Jouppi 1999, "Feline: Fast Elliptical Lines for Anisotropic Texture Mapping" (places along their axis).
pub fn reach(scene: &SceneData, record: &TextureRecord, place: &Place) -> Reach {
    let [a, b, c] = corners(scene, record, place.triangle);
    let at = [
        (a[0] + b[0] * place.u) + c[0] * place.v,
        (a[1] + b[1] * place.u) + c[1] * place.v,
    ];
    let point = Reach {
        at,
        along: [0.0; 2],
        taps: 1,
        level: 0.0,
    };
    if record.mode & MIPS == 0 {
        return point;
    }
    let (x, y) = (place.footprint.x, place.footprint.y);
    let to_x = [b[0] * x[0] + c[0] * x[1], b[1] * x[0] + c[1] * x[1]];
    let to_y = [b[0] * y[0] + c[0] * y[1], b[1] * y[0] + c[1] * y[1]];
    let (width, height) = (record.width as f32, record.height as f32);
    let squared = |to: [f32; 2]| {
        let (s, t) = (to[0] * width, to[1] * height);
        (s * s + t * t).min(AXIS_MAX)
    };
    let (x2, y2) = (squared(to_x), squared(to_y));
    let longer = x2.max(y2);
    let shorter = x2.min(y2).max(1.0);
    let most = TAPS as f32;
    let taps = (longer / shorter).sqrt().ceil().clamp(1.0, most);
    let last = (record.levels - 1) as f32;
    let level = HALF_LOG2_E * log((longer / (taps * taps)).max(1.0));
    Reach {
        at,
        along: if x2 < y2 { to_y } else { to_x },
        taps: taps as u32,
        level: level.max(0.0).min(last),
    }
}

/// Four channels 0..=1 over the footprint of a place. `srgb` decodes red, green and blue before they are interpolated.
pub fn sample(scene: &SceneData, texture: u32, place: &Place, srgb: bool) -> [f32; 4] {
    let record = scene.texture[texture as usize];
    let reach = reach(scene, &record, place);
    let share = 1.0 / reach.taps as f32;
    let mut sum = [0.0; 4];
    for tap in 0..reach.taps {
        let from_middle = (tap as f32 + 0.5) * share - 0.5;
        let u = reach.at[0] + reach.along[0] * from_middle;
        let v = reach.at[1] + reach.along[1] * from_middle;
        let texel = between(scene, &record, u, v, reach.level, srgb);
        sum = std::array::from_fn(|i| sum[i] + texel[i]);
    }
    // Divided, not multiplied by a share: the mean of equal codes is that code, so that a factor of one stays one.
    scaled(sum.map(|c| c / reach.taps as f32), srgb)
}

/// At one place: a mean of the two images about `level`. Codes are not scaled yet.
fn between(
    scene: &SceneData,
    record: &TextureRecord,
    u: f32,
    v: f32,
    level: f32,
    srgb: bool,
) -> [f32; 4] {
    let whole = level.floor();
    let share = level - whole;
    let larger = filtered(scene, record, &image(record, whole as u32), u, v, srgb);
    if share == 0.0 {
        return larger;
    }
    let smaller = filtered(scene, record, &image(record, whole as u32 + 1), u, v, srgb);
    std::array::from_fn(|i| mix(larger[i], smaller[i], share))
}

/// One image of a texture.
struct Image {
    first: u32,
    width: u32,
    height: u32,
}

fn image(record: &TextureRecord, level: u32) -> Image {
    let mut image = Image {
        first: record.first,
        width: record.width,
        height: record.height,
    };
    for i in 0..level {
        image = Image {
            first: if i == 0 {
                record.smaller
            } else {
                image.first + image.width * image.height
            },
            width: half(image.width),
            height: half(image.height),
        };
    }
    image
}

/// Size of the next smaller image.
pub fn half(size: u32) -> u32 {
    (size / 2).max(1)
}

/// Four texels about a place, or the nearest one, as the sampler says.
fn filtered(
    scene: &SceneData,
    record: &TextureRecord,
    image: &Image,
    u: f32,
    v: f32,
    srgb: bool,
) -> [f32; 4] {
    let x = u * image.width as f32 - 0.5;
    let y = v * image.height as f32 - 0.5;
    let texel = |x: f32, y: f32| load(scene, record, image, x, y, srgb);
    if record.mode & NEAREST != 0 {
        return texel((x + 0.5).floor(), (y + 0.5).floor());
    }
    let (left, top) = (x.floor(), y.floor());
    let (s, t) = (x - left, y - top);
    let a = texel(left, top);
    let b = texel(left + 1.0, top);
    let c = texel(left, top + 1.0);
    let d = texel(left + 1.0, top + 1.0);
    std::array::from_fn(|i| mix(mix(a[i], b[i], s), mix(c[i], d[i], s), t))
}

/// Channels that hold codes, divided by 255. After interpolation: before, a driver takes the factor out of the sums, and
/// what is left of one minus a metallic factor near one is a rounding. At most 1, which the mean of several places may pass by
/// one: a metal must not reflect less than nothing as a Lambert surface.
fn scaled(texel: [f32; 4], srgb: bool) -> [f32; 4] {
    std::array::from_fn(|i| {
        let one = if srgb && i < 3 {
            texel[i]
        } else {
            texel[i] * (1.0 / 255.0)
        };
        one.min(1.0)
    })
}

/// A texel: linear colour where sRGB is decoded, codes 0..=255 elsewhere.
fn load(
    scene: &SceneData,
    record: &TextureRecord,
    image: &Image,
    x: f32,
    y: f32,
    srgb: bool,
) -> [f32; 4] {
    let column = wrap(x, image.width, record.mode & 3);
    let row = wrap(y, image.height, record.mode >> 2 & 3);
    let code = scene.texel[(image.first + row * image.width + column) as usize].to_le_bytes();
    let channel = |i: usize| {
        if srgb && i < 3 {
            scene.srgb[usize::from(code[i])]
        } else {
            f32::from(code[i])
        }
    };
    std::array::from_fn(channel)
}

/// Index of a texel, 0 .. size, for any finite or infinite coordinate.
fn wrap(x: f32, size: u32, mode: u32) -> u32 {
    let extent = size as f32;
    let inside = match mode {
        0 => x - (x / extent).floor() * extent,
        1 => {
            let phase = x - (x / (2.0 * extent)).floor() * (2.0 * extent);
            if phase < extent {
                phase
            } else {
                2.0 * extent - 1.0 - phase
            }
        }
        _ => x,
    };
    // The clamp also catches rounding and what is not a number.
    (inside.max(0.0) as u32).min(size - 1)
}

#[cfg(test)]
mod tests {
    use super::{sample, wrap};
    use crate::data::{MIPS, SceneData, TextureRecord};
    use crate::phase::footprint::{Footprint, Place};

    /// A white texture of 2^`levels` texels a side at a right triangle over it.
    fn white(levels: u32) -> SceneData {
        let size = 1 << levels;
        let texels = (0..=levels).map(|level| 1usize << (2 * level)).sum();
        SceneData {
            corner_texcoord: vec![[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]],
            texture: vec![TextureRecord {
                width: size,
                height: size,
                mode: MIPS,
                to_u: [1.0, 0.0, 0.0],
                to_v: [0.0, 1.0, 0.0],
                smaller: size * size,
                levels: levels + 1,
                ..TextureRecord::default()
            }],
            texel: vec![u32::MAX; texels],
            srgb: vec![1.0; 256],
            ..SceneData::default()
        }
    }

    #[test]
    fn white_is_white_over_any_footprint() {
        let scene = white(6);
        for i in 0..400 {
            let step = |n: u32| ((i * n) % 97) as f32 / 97.0;
            let place = Place {
                triangle: 0,
                u: step(13),
                v: step(29),
                footprint: Footprint {
                    x: [step(31), step(7)],
                    y: [0.1 * step(3), 0.2 * step(11)],
                },
            };
            for srgb in [true, false] {
                for c in sample(&scene, 0, &place, srgb) {
                    assert!((1.0 - 3e-7..=1.0).contains(&c), "{place:?}: {c}");
                }
            }
        }
    }

    #[test]
    fn wrap_modes_at_the_edges_and_beyond() {
        let of = |mode| [-5.0, -1.0, 0.0, 3.0, 4.0, 7.0, 8.0].map(|x| wrap(x, 4, mode));
        assert_eq!(of(0), [3, 3, 0, 3, 0, 3, 0]);
        assert_eq!(of(1), [3, 0, 0, 3, 3, 0, 0]);
        assert_eq!(of(2), [0, 0, 0, 3, 3, 3, 3]);
        for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30] {
            for mode in 0..3 {
                assert!(wrap(x, 4, mode) < 4);
            }
        }
    }
}
