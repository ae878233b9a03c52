//! needs: data/words
// Reading textures, with exact loads and our own interpolation. Twin of `vsgl-core/src/phase/texture.rs`.

// Where a texture is read at a point of a triangle, given by the weights of its second and third corner.
fn texture_coordinates(record: TextureRecord, triangle: u32, u: f32, v: f32) -> vec2<f32> {
    let second = (record.mode & SECOND_SET) != 0u;
    let column = select(params.texels.corner_texcoord, params.texels.corner_texcoord_second, second);
    let at = column + 6u * triangle;
    let a = vec2(words_f32(at), words_f32(at + 1u));
    let b = vec2(words_f32(at + 2u), words_f32(at + 3u));
    let c = vec2(words_f32(at + 4u), words_f32(at + 5u));
    let st = (a + (b - a) * u) + (c - a) * v;
    let to_u = record.to_u;
    let to_v = record.to_v;
    return vec2((to_u.x * st.x + to_u.y * st.y) + to_u.z, (to_v.x * st.x + to_v.y * st.y) + to_v.z);
}

// Four channels 0..=1 at a point of a triangle. `srgb` decodes red, green and blue before they are interpolated.
fn texture_sample(texture: u32, triangle: u32, u: f32, v: f32, srgb: bool) -> vec4<f32> {
    let record = words_texture(texture);
    let st = texture_coordinates(record, triangle, u, v);
    let x = st.x * f32(record.width) - 0.5;
    let y = st.y * f32(record.height) - 0.5;
    if (record.mode & NEAREST) != 0u {
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
    let word = words_at(params.texels.texel + record.first + row * record.width + column);
    let code = vec4(word & 255u, (word >> 8u) & 255u, (word >> 16u) & 255u, word >> 24u);
    if srgb {
        return vec4(texture_srgb(code.x), texture_srgb(code.y), texture_srgb(code.z), f32(code.w));
    }
    return vec4<f32>(code);
}

fn texture_srgb(code: u32) -> f32 {
    return bitcast<f32>(words_at(params.texels.srgb + code));
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
