//! needs: data/emitters, data/texel
// The map of the surfaces that shine. Twin of `vsgl-core/src/phase/emit.rs`.

// Which point a texel of the map holds; `points` or more where there is none.
fn emit_point(index: u32, texels: u32, points: u32) -> u32 {
    if points <= texels {
        return index;
    }
    return (index * points + points / 2u) / texels;
}

fn emit_texel(emitter: EmitterRecord, texels: u32, points: u32) -> Texel {
    let times = max(f32(points) / f32(texels), 1.0);
    var made = rsm_empty();
    made.position = vec4(emitter.position, emitter.area * times);
    made.normal = vec4(emitter.normal, 0.0);
    made.diffuse = vec4(emitter.flux * times, 0.0);
    made.tangent = vec4(1.0, 0.0, 0.0, 1.0);
    return made;
}
