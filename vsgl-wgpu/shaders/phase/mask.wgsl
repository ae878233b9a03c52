//! needs: data/words, phase/color, phase/footprint, phase/texture
// Where a surface with an alpha mask is. Twin of `vsgl-core/src/phase/mask.rs`.
//
// Reads the constant MASKS of the entry.

fn mask_covers(triangle: u32, u: f32, v: f32) -> bool {
    if !MASKS {
        return true;
    }
    let material = words_material(triangle);
    if material.alpha_cutoff < 0.0 {
        return true;
    }
    let place = Place(triangle, max(min(u, 1.0), 0.0), max(min(v, 1.0), 0.0), vec2(0.0), vec2(0.0));
    var alpha = material.alpha;
    if material.base_color_texture != NO_TEXTURE {
        alpha = alpha * texture_sample(material.base_color_texture, place, false).w;
    }
    if columns.corner_color != NO_WORDS {
        alpha = alpha * color_of_vertices(place).w;
    }
    return alpha >= material.alpha_cutoff;
}
