//! needs: data/words, phase/footprint
// Colours of vertices. Twin of `vsgl-core/src/phase/color.rs`.

fn color_of_vertices(place: Place) -> vec4<f32> {
    let at = columns.corner_color + 12u * place.triangle;
    let a = vec4(words_vec3(at), words_f32(at + 3u));
    let b = vec4(words_vec3(at + 4u), words_f32(at + 7u));
    let c = vec4(words_vec3(at + 8u), words_f32(at + 11u));
    return (a + (b - a) * place.u) + (c - a) * place.v;
}
