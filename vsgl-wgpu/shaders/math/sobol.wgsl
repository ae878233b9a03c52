// Owen-scrambled Sobol points: twin of `vsgl-core/src/math/sobol.rs`.

fn sobol_hash(value: u32) -> u32 {
    var x = (value ^ (value >> 16u)) * 0x7feb352du;
    x = (x ^ (x >> 15u)) * 0x846ca68bu;
    return x ^ (x >> 16u);
}

fn sobol_combine(a: u32, b: u32) -> u32 {
    return sobol_hash(a ^ (b * 0x9e3779b9u + 0x7f4a7c15u));
}

fn sobol_scramble(bits: u32, seed: u32) -> u32 {
    var x = reverseBits(bits);
    x = x ^ (x * 0x3d20adeau);
    x = x + seed;
    x = x * ((seed >> 16u) | 1u);
    x = x ^ (x * 0x05526c56u);
    x = x ^ (x * 0x53a22864u);
    return reverseBits(x);
}

fn sobol_sobol(index: u32) -> vec2<u32> {
    var y = index;
    y = y ^ ((y & 0xaaaaaaaau) >> 1u);
    y = y ^ ((y & 0xccccccccu) >> 2u);
    y = y ^ ((y & 0xf0f0f0f0u) >> 4u);
    y = y ^ ((y & 0xff00ff00u) >> 8u);
    y = y ^ ((y & 0xffff0000u) >> 16u);
    return vec2(reverseBits(index), reverseBits(y));
}

fn sobol_point(index: u32, pair: u32, stream: u32) -> vec2<f32> {
    let seed = sobol_combine(stream, pair);
    let shuffled = sobol_scramble(index, seed);
    let at = sobol_sobol(shuffled);
    return vec2(
        sobol_fraction(sobol_scramble(at.x, sobol_hash(seed))),
        sobol_fraction(sobol_scramble(at.y, sobol_hash(~seed))),
    );
}

fn sobol_fraction(bits: u32) -> f32 {
    return f32(bits >> 8u) * (1.0 / 16777216.0);
}
