//! needs: data/words, math/elementary, phase/footprint
// Reading textures, with exact loads and our own interpolation. Twin of `vsgl-core/src/phase/texture.rs`.

// Texture coordinates of the image at the first corner of a triangle, and by how much those of the second and third differ.
struct TextureCorners {
    a: vec2<f32>,
    b: vec2<f32>,
    c: vec2<f32>,
}

fn texture_corners(record: TextureRecord, triangle: u32) -> TextureCorners {
    let second = (record.mode & SECOND_SET) != 0u;
    let column = select(columns.corner_texcoord, columns.corner_texcoord_second, second);
    let at = column + 6u * triangle;
    let first = vec2(words_f32(at), words_f32(at + 1u));
    let b = vec2(words_f32(at + 2u), words_f32(at + 3u)) - first;
    let c = vec2(words_f32(at + 4u), words_f32(at + 5u)) - first;
    let a = texture_turn(record, first);
    return TextureCorners(
        vec2(a.x + record.to_u.z, a.y + record.to_v.z),
        texture_turn(record, b),
        texture_turn(record, c),
    );
}

fn texture_turn(record: TextureRecord, st: vec2<f32>) -> vec2<f32> {
    return vec2(
        record.to_u.x * st.x + record.to_u.y * st.y,
        record.to_v.x * st.x + record.to_v.y * st.y,
    );
}

// Which texels stand for a footprint.
struct Reach {
    at: vec2<f32>,
    along: vec2<f32>,
    taps: u32,
    level: f32,
}

fn texture_reach(record: TextureRecord, place: Place) -> Reach {
    let corners = texture_corners(record, place.triangle);
    let at = (corners.a + corners.b * place.u) + corners.c * place.v;
    if (record.mode & MIPS) == 0u {
        return Reach(at, vec2(0.0), 1u, 0.0);
    }
    let to_x = corners.b * place.x.x + corners.c * place.x.y;
    let to_y = corners.b * place.y.x + corners.c * place.y.y;
    let x2 = texture_squared(record, to_x);
    let y2 = texture_squared(record, to_y);
    let longer = max(x2, y2);
    let shorter = max(min(x2, y2), 1.0);
    let most = f32(TAPS);
    let taps = max(min(ceil(sqrt(longer / shorter)), most), 1.0);
    let last = f32(record.levels - 1u);
    let level = HALF_LOG2_E * elementary_log(max(longer / (taps * taps), 1.0));
    return Reach(at, select(to_x, to_y, x2 < y2), u32(taps), min(max(level, 0.0), last));
}

// Square of a way between texture coordinates, in texels.
fn texture_squared(record: TextureRecord, to: vec2<f32>) -> f32 {
    let s = to.x * f32(record.width);
    let t = to.y * f32(record.height);
    return min(s * s + t * t, AXIS_MAX);
}

// Four channels 0..=1 over the footprint of a place. `srgb` decodes red, green and blue before they are interpolated.
fn texture_sample(texture: u32, place: Place, srgb: bool) -> vec4<f32> {
    let record = words_texture(texture);
    let reach = texture_reach(record, place);
    let share = 1.0 / f32(reach.taps);
    var sum = vec4(0.0);
    for (var tap = 0u; tap < reach.taps; tap++) {
        let from_middle = (f32(tap) + 0.5) * share - 0.5;
        sum += texture_between(record, reach.at + reach.along * from_middle, reach.level, srgb);
    }
    return texture_scaled(sum / f32(reach.taps), srgb);
}

// At one place: a mean of the two images about `level`.
fn texture_between(record: TextureRecord, st: vec2<f32>, level: f32, srgb: bool) -> vec4<f32> {
    let whole = floor(level);
    let share = level - whole;
    let larger = texture_filtered(record, texture_image(record, u32(whole)), st, srgb);
    if share == 0.0 {
        return larger;
    }
    let smaller = texture_filtered(record, texture_image(record, u32(whole) + 1u), st, srgb);
    return larger + (smaller - larger) * share;
}

// One image of a texture.
struct TextureImage {
    first: u32,
    width: u32,
    height: u32,
}

fn texture_image(record: TextureRecord, level: u32) -> TextureImage {
    var image = TextureImage(record.first, record.width, record.height);
    for (var i = 0u; i < level; i++) {
        image = TextureImage(
            select(image.first + image.width * image.height, record.smaller, i == 0u),
            texture_half(image.width),
            texture_half(image.height),
        );
    }
    return image;
}

fn texture_half(size: u32) -> u32 {
    return max(size / 2u, 1u);
}

// Four texels about a place, or the nearest one, as the sampler says.
fn texture_filtered(record: TextureRecord, image: TextureImage, st: vec2<f32>, srgb: bool) -> vec4<f32> {
    let x = st.x * f32(image.width) - 0.5;
    let y = st.y * f32(image.height) - 0.5;
    if (record.mode & NEAREST) != 0u {
        return texture_load(record, image, floor(x + 0.5), floor(y + 0.5), srgb);
    }
    let left = floor(x);
    let top = floor(y);
    let s = x - left;
    let t = y - top;
    let a = texture_load(record, image, left, top, srgb);
    let b = texture_load(record, image, left + 1.0, top, srgb);
    let c = texture_load(record, image, left, top + 1.0, srgb);
    let d = texture_load(record, image, left + 1.0, top + 1.0, srgb);
    let upper = a + (b - a) * s;
    let lower = c + (d - c) * s;
    return upper + (lower - upper) * t;
}

fn texture_scaled(texel: vec4<f32>, srgb: bool) -> vec4<f32> {
    let scaled = texel * (1.0 / 255.0);
    return min(select(scaled, vec4(texel.xyz, scaled.w), srgb), vec4(1.0));
}

fn texture_load(record: TextureRecord, image: TextureImage, x: f32, y: f32, srgb: bool) -> vec4<f32> {
    let column = texture_wrap(x, image.width, record.mode & 3u);
    let row = texture_wrap(y, image.height, (record.mode >> 2u) & 3u);
    let word = words_at(columns.texel + image.first + row * image.width + column);
    let code = vec4(word & 255u, (word >> 8u) & 255u, (word >> 16u) & 255u, word >> 24u);
    if srgb {
        return vec4(texture_srgb(code.x), texture_srgb(code.y), texture_srgb(code.z), f32(code.w));
    }
    return vec4<f32>(code);
}

fn texture_srgb(code: u32) -> f32 {
    return bitcast<f32>(words_at(columns.srgb + code));
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
