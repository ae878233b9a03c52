//! needs: data/scene
// Columns of the scene that are words of an integer texture: exact loads, and no storage buffer each.
//
// Reads `texels` and `columns`, which the entry binds.

fn words_at(index: u32) -> u32 {
    let column = index % TEXEL_SIDE;
    let row = index / TEXEL_SIDE;
    let rows = columns.rows;
    return textureLoad(texels, vec2(column, row % rows), row / rows, 0).x;
}

fn words_f32(index: u32) -> f32 {
    return bitcast<f32>(words_at(index));
}

fn words_vec3(index: u32) -> vec3<f32> {
    return vec3(words_f32(index), words_f32(index + 1u), words_f32(index + 2u));
}

fn words_material(triangle: u32) -> MaterialRecord {
    let at = columns.material + MATERIAL_WORDS * words_at(columns.triangle_material + triangle);
    return MaterialRecord(
        words_vec3(at),
        words_f32(at + 3u),
        words_vec3(at + 4u),
        words_f32(at + 7u),
        words_f32(at + 8u),
        words_f32(at + 9u),
        words_f32(at + 10u),
        words_at(at + 11u),
        words_vec3(at + 12u),
        words_f32(at + 15u),
        words_f32(at + 16u),
        words_f32(at + 17u),
        words_f32(at + 18u),
        words_at(at + 19u),
        words_at(at + 20u),
        words_at(at + 21u),
        words_at(at + 22u),
        words_at(at + 23u),
        words_at(at + 24u),
        words_at(at + 25u),
        vec2(0u),
    );
}

fn words_texture(texture: u32) -> TextureRecord {
    let at = columns.texture + TEXTURE_WORDS * texture;
    return TextureRecord(
        words_at(at),
        words_at(at + 1u),
        words_at(at + 2u),
        words_at(at + 3u),
        words_vec3(at + 4u),
        words_at(at + 7u),
        words_vec3(at + 8u),
        words_at(at + 11u),
    );
}
