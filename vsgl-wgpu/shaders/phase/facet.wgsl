//! needs: phase/occlusion, phase/splat
// A triangle over the texels of a shadow map whose middles it covers. Twin of `vsgl-core/src/phase/facet.rs`.

struct Patch {
    left: u32,
    top: u32,
    right: u32,
    bottom: u32,
}

// Where the middles of texels may be covered by a triangle with these corners as the map sees them.
fn facet_bounds(corners: Corners, side: u32) -> Patch {
    let a = corners.a;
    let b = corners.b;
    let c = corners.c;
    let least = min(min(a, b), c);
    let most = max(max(a, b), c);
    let quarter = (least.x >= 0.0 || most.x <= 0.0) && (least.y >= 0.0 || most.y <= 0.0);
    let all = f32(side);
    var low = vec2(0.0);
    var high = vec2(0.0);
    if quarter && least.z > 0.0 {
        let p = occlusion_place(a, side);
        let q = occlusion_place(b, side);
        let r = occlusion_place(c, side);
        low = min(min(p, q), r);
        high = max(max(p, q), r);
    } else {
        let middle = (least + most) * 0.5;
        let half = (most - least) * 0.5;
        let square = dot(middle, middle);
        let reach = dot(half, half);
        let away = square - reach;
        var wide = all;
        if away > 0.1 * square {
            wide = sqrt(reach / away) * (FACET_STEEPEST * all);
        }
        let at = vec3(middle.x, middle.y, max(middle.z, 0.0));
        let texel = occlusion_place(select(vec3(0.0, 0.0, 1.0), at, dot(at, at) > 0.0), side);
        low = texel - wide;
        high = texel + wide;
    }
    let begin = min(max(ceil(low - 0.5), vec2(0.0)), vec2(all));
    let last = min(max(floor(high - 0.5) + 1.0, begin), vec2(all));
    let end = min(last, begin + FACET_WIDEST);
    let right = select(begin.x, end.x, most.z > 0.0);
    return Patch(u32(begin.x), u32(begin.y), u32(right), u32(end.y));
}

struct Facet {
    normal: vec3<f32>,
    height: f32,
    edges: array<vec3<f32>, 3>,
}

// The triangle with these corners as the map sees them.
fn facet_new(corners: Corners) -> Facet {
    let a = corners.a;
    let b = corners.b;
    let c = corners.c;
    let normal = cross(b - a, c - a);
    return Facet(normal, dot(a, normal), array(cross(b, c), cross(c, a), cross(a, b)));
}

struct Meeting {
    depth: f32,
    u: f32,
    v: f32,
}

// What the middle of a texel sees of it, by its unit direction.
fn facet_meet(facet: Facet, d: vec3<f32>) -> Meeting {
    let slope = dot(d, facet.normal);
    let faces = slope * facet.height > 0.0;
    let t = facet.height / select(1.0, slope, faces);
    let e = dot(d, facet.edges[0]);
    let f = dot(d, facet.edges[1]);
    let g = dot(d, facet.edges[2]);
    let inside = (e >= 0.0 && f >= 0.0 && g >= 0.0) || (e <= 0.0 && f <= 0.0 && g <= 0.0);
    let whole = (e + f) + g;
    let sum = select(whole, 1.0, whole == 0.0);
    return Meeting(select(F32_MAX, t, faces && inside), f / sum, g / sum);
}
