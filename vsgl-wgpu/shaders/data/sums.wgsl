//! needs: phase/reflect
// What shading leaves for reconstruction: columns sums and emitted, three times four numbers a sample, in `waiting`, which the
// entry binds beside `params` with `count`. Twin of `SampleSums` in `vsgl-core/src/data/radiance.rs`.

struct Left {
    sums: Sums,
    total: f32,
}

fn sums_place(i: u32, emitted: bool) -> u32 {
    return 3u * (select(0u, params.count, emitted) + i);
}

fn left_at(i: u32, emitted: bool) -> Left {
    let at = sums_place(i, emitted);
    let diffuse = waiting[at];
    return Left(Sums(diffuse.xyz, waiting[at + 1u].xyz, waiting[at + 2u].xyz), diffuse.w);
}

// Without what is too faint: `lit` of `vsgl-core/src/phase/reconstruct.rs`.
fn sums_lit_part(sums: vec3<f32>) -> vec3<f32> {
    return select(sums, vec3(0.0), sums < vec3(FAINT));
}

fn left_lit(left: Left) -> Left {
    let sums = left.sums;
    let lit = Sums(sums_lit_part(sums.diffuse), sums_lit_part(sums.near), sums_lit_part(sums.grazing));
    return Left(lit, left.total);
}

fn leave_at(i: u32, left: Left, emitted: bool) {
    let at = sums_place(i, emitted);
    waiting[at] = vec4(left.sums.diffuse, left.total);
    waiting[at + 1u] = vec4(left.sums.near, 0.0);
    waiting[at + 2u] = vec4(left.sums.grazing, 0.0);
}
