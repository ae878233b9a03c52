//! needs: data/scene
// Reading textures, with exact loads and our own interpolation. Twin of `vsgl-core/src/phase/texture.rs`.
//
// Reads `texels` and `params.texels`, which the entry binds.

fn texture_word(index: u32) -> u32 {
    let column = index % TEXEL_SIDE;
    let row = index / TEXEL_SIDE;
    let rows = params.texels.rows;
    return textureLoad(texels, vec2(column, row % rows), row / rows, 0).x;
}

fn texture_record(texture: u32) -> TextureRecord {
    let at = params.texels.texture + 4u * texture;
    return TextureRecord(texture_word(at), texture_word(at + 1u), texture_word(at + 2u), texture_word(at + 3u));
}

// Four channels 0..=1 at a texture coordinate. `srgb` decodes red, green and blue before they are interpolated.
fn texture_sample(texture: u32, u: f32, v: f32, srgb: bool) -> vec4<f32> {
    let record = texture_record(texture);
    let x = u * f32(record.width) - 0.5;
    let y = v * f32(record.height) - 0.5;
    if (record.mode & 16u) != 0u {
        return texture_scaled(texture_load(record, floor(x + 0.5), floor(y + 0.5), srgb), srgb);
    }
    let left = floor(x);
    let top = floor(y);
    let s = x - left;
    let t = y - top;
    let a = texture_load(record, left, top, srgb);
    let b = texture_load(record, left + 1.0, top, srgb);
    let c = texture_load(record, left, top + 1.0, srgb);
    let d = texture_load(record, left + 1.0, top + 1.0, srgb);
    let upper = a + (b - a) * s;
    let lower = c + (d - c) * s;
    return texture_scaled(upper + (lower - upper) * t, srgb);
}

fn texture_scaled(texel: vec4<f32>, srgb: bool) -> vec4<f32> {
    let scaled = texel * (1.0 / 255.0);
    return select(scaled, vec4(texel.xyz, scaled.w), srgb);
}


fn texture_load(record: TextureRecord, x: f32, y: f32, srgb: bool) -> vec4<f32> {
    let column = texture_wrap(x, record.width, record.mode & 3u);
    let row = texture_wrap(y, record.height, (record.mode >> 2u) & 3u);
    let word = texture_word(params.texels.texel + record.first + row * record.width + column);
    let code = vec4(word & 255u, (word >> 8u) & 255u, (word >> 16u) & 255u, word >> 24u);
    if srgb {
        return vec4(texture_srgb(code.x), texture_srgb(code.y), texture_srgb(code.z), f32(code.w));
    }
    return vec4<f32>(code);
}

fn texture_srgb(code: u32) -> f32 {
    return bitcast<f32>(texture_word(params.texels.srgb + code));
}

// Index of a texel, 0 .. size, for any coordinate.
fn texture_wrap(x: f32, size: u32, mode: u32) -> u32 {
    let extent = f32(size);
    var inside = x;
    if mode == 0u {
        inside = x - floor(x / extent) * extent;
    } else if mode == 1u {
        let double = 2.0 * extent;
        let phase = x - floor(x / double) * double;
        inside = select(double - 1.0 - phase, phase, phase < extent);
    }
    // The clamp also catches rounding and what is not a number.
    return min(u32(min(max(inside, 0.0), extent)), size - 1u);
}
