//! Reading textures, with exact loads and our own interpolation.

use super::surface::mix;
use crate::data::{NEAREST, SECOND_SET, SceneData, TextureRecord};

/// Where a texture is read at a point of a triangle, given by the weights of its second and third corner: u and v of the
/// image.
pub fn coordinates(
    scene: &SceneData,
    record: &TextureRecord,
    triangle: usize,
    u: f32,
    v: f32,
) -> [f32; 2] {
    let c = if record.mode & SECOND_SET != 0 {
        &scene.corner_texcoord_second[triangle]
    } else {
        &scene.corner_texcoord[triangle]
    };
    let s = (c[0] + (c[2] - c[0]) * u) + (c[4] - c[0]) * v;
    let t = (c[1] + (c[3] - c[1]) * u) + (c[5] - c[1]) * v;
    let (to_u, to_v) = (record.to_u, record.to_v);
    [
        (to_u[0] * s + to_u[1] * t) + to_u[2],
        (to_v[0] * s + to_v[1] * t) + to_v[2],
    ]
}

/// Four channels 0..=1 at a point of a triangle. `srgb` decodes red, green and blue before they are interpolated.
pub fn sample(
    scene: &SceneData,
    texture: u32,
    triangle: usize,
    u: f32,
    v: f32,
    srgb: bool,
) -> [f32; 4] {
    let record = scene.texture[texture as usize];
    let [u, v] = coordinates(scene, &record, triangle, u, v);
    let x = u * record.width as f32 - 0.5;
    let y = v * record.height as f32 - 0.5;
    if record.mode & NEAREST != 0 {
        return scaled(
            load(scene, &record, (x + 0.5).floor(), (y + 0.5).floor(), srgb),
            srgb,
        );
    }
    let (left, top) = (x.floor(), y.floor());
    let (s, t) = (x - left, y - top);
    let corner = |dx: f32, dy: f32| load(scene, &record, left + dx, top + dy, srgb);
    let (a, b, c, d) = (
        corner(0.0, 0.0),
        corner(1.0, 0.0),
        corner(0.0, 1.0),
        corner(1.0, 1.0),
    );
    let mixed = std::array::from_fn(|i| mix(mix(a[i], b[i], s), mix(c[i], d[i], s), t));
    scaled(mixed, srgb)
}

/// Channels that hold codes, divided by 255. After interpolation: before, a driver takes the factor out of the sums, and
/// what is left of one minus a metallic factor near one is a rounding.
fn scaled(texel: [f32; 4], srgb: bool) -> [f32; 4] {
    std::array::from_fn(|i| {
        if srgb && i < 3 {
            texel[i]
        } else {
            texel[i] * (1.0 / 255.0)
        }
    })
}

/// A texel: linear colour where sRGB is decoded, codes 0..=255 elsewhere.
fn load(scene: &SceneData, record: &TextureRecord, x: f32, y: f32, srgb: bool) -> [f32; 4] {
    let column = wrap(x, record.width, record.mode & 3);
    let row = wrap(y, record.height, record.mode >> 2 & 3);
    let code = scene.texel[(record.first + row * record.width + column) as usize].to_le_bytes();
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
    use super::wrap;

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
