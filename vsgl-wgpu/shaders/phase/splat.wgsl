//! needs: math/sobol, math/vec, phase/occlusion, phase/unit
// Surfaces as points of a shadow map. Twin of `vsgl-core/src/phase/splat.rs`.
//
// Reads `share` and `corner`, which the entry binds.

// An integer as the nearest number, by exact steps.
fn splat_number(value: u32) -> f32 {
    return f32(value >> 8u) * 256.0 + f32(value & 255u);
}

// Where draw `index` of a map falls among the shares.
fn splat_draw(map: u32, index: u32, stride: u32) -> u32 {
    return index * stride + sobol_hash(2u * map) % stride;
}

// First of `count` shares beyond a draw.
fn splat_find(count: u32, wanted: u32) -> u32 {
    var low = 0u;
    var high = count;
    while low < high {
        let middle = low + (high - low) / 2u;
        if share[middle] > wanted {
            high = middle;
        } else {
            low = middle + 1u;
        }
    }
    return low;
}

struct Point {
    u: f32,
    v: f32,
    area: f32,
    clip: bool,
}

// The point of a triangle that a draw falls on.
fn splat_random_point(map: u32, index: u32, draw: u32, low: u32, high: u32, stride: u32) -> Point {
    let width = splat_number(high - low);
    let along = min(splat_number(draw - low) / width, 1.0);
    let across = pdf_unit(reverseBits(index) + sobol_hash(2u * map + 1u));
    let root = sqrt(along);
    let area = splat_number(stride) / width;
    return Point(root - root * across, root * across, area, area <= 1.0);
}

struct Slot {
    cuts: u32,
    first: u32,
    slots: u32,
    area: f32,
    everywhere: bool,
}

struct Corners {
    a: vec3<f32>,
    b: vec3<f32>,
    c: vec3<f32>,
}

// Number of draws of a map below a share.
fn splat_draws_below(share_end: u32, start: u32, stride: u32) -> u32 {
    let beyond = max(share_end, start + 1u) - start - 1u;
    return select(0u, beyond / stride + 1u, share_end > start);
}

// Solid angle of a triangle from the origin, too small where it is large.
fn splat_solid_angle(corners: Corners) -> f32 {
    let a = vec_normalize(corners.a);
    let b = vec_normalize(corners.b);
    let c = vec_normalize(corners.c);
    let normal = cross(b - a, c - a);
    return 0.5 * sqrt(dot(normal, normal));
}

// The slot of a draw, for a triangle with these corners as the map sees them.
fn splat_slot(
    map: u32,
    index: u32,
    low: u32,
    high: u32,
    stride: u32,
    corners: Corners,
    side: u32,
) -> Slot {
    let start = sobol_hash(2u * map) % stride;
    let before = splat_draws_below(low, start, stride);
    let slots = max(splat_draws_below(high, start, stride) - before, 1u);
    let texels = splat_solid_angle(corners) * f32(side * side) * (0.5 * FRAC_1_PI);
    let wanted = ceil(sqrt(texels * SPLAT_PIECES));
    let most = floor(sqrt(splat_number(slots * SPLAT_PIECES_MAX)));
    let cuts = max(min(wanted, most), 1.0);
    let everywhere = high - low >= stride;
    let part = 1.0 / (cuts * cuts);
    let more = splat_number(stride) / splat_number(max(high - low, 1u));
    return Slot(
        u32(cuts),
        index - min(before, index),
        slots,
        select(part * more, part, everywhere),
        everywhere,
    );
}

// The middle of a piece: row `r` of the cut triangle has `2r + 1` pieces.
fn splat_piece(slot: Slot, index: u32) -> Point {
    let row = floor(sqrt(splat_number(index)));
    let rank = index - u32(row) * u32(row);
    let upright = (rank & 1u) == 0u;
    let along = row + select(SPLAT_THIRD, SPLAT_TWO_THIRDS, upright);
    let across = splat_number(rank >> 1u) + select(SPLAT_TWO_THIRDS, SPLAT_THIRD, upright);
    let cuts = splat_number(slot.cuts);
    return Point((along - across) / cuts, across / cuts, slot.area, slot.everywhere);
}

// The middle of a triangle that stands for `count` of its size.
fn splat_middle(count: u32) -> Point {
    return Point(SPLAT_THIRD, SPLAT_THIRD, splat_number(count), false);
}

struct Splat {
    point: vec3<f32>,
    distance: f32,
    normal: vec3<f32>,
    height: f32,
    edges: array<vec3<f32>, 3>,
    clip: bool,
    radius: f32,
    texel: vec2<u32>,
    reach: u32,
    above: bool,
}

// The splat of a point of a triangle with these corners as the map sees them.
fn splat_new(corners: Corners, point: Point, side: u32) -> Splat {
    let a = corners.a;
    let b = corners.b;
    let c = corners.c;
    let place = (a + (b - a) * point.u) + (c - a) * point.v;
    let normal = cross(b - a, c - a);
    let distance = sqrt(dot(place, place));
    let area = (sqrt(dot(normal, normal)) * 0.5) * point.area;
    let radius = sqrt(area * (SPLAT_OVERLAP * FRAC_1_PI));
    let above = place.z > 0.0 && distance > 0.0;
    let at = occlusion_place(select(vec3(0.0, 0.0, 1.0), place, above), side);
    let last = f32(side) - 1.0;
    let reach = (radius / max(distance, F32_MIN_POSITIVE)) * (SPLAT_TEXELS_A_RADIAN * f32(side));
    return Splat(
        place,
        distance,
        normal,
        dot(a, normal),
        array(cross(b, c), cross(c, a), cross(a, b)),
        point.clip,
        radius,
        vec2<u32>(max(min(floor(at), vec2(last)), vec2(0.0))),
        u32(min(ceil(reach), SPLAT_REACH)),
        above,
    );
}

// First column and row that a splat may cover.
fn splat_first(splat: Splat) -> vec2<u32> {
    return splat.texel - min(splat.texel, vec2(splat.reach));
}

// One beyond the last column and row.
fn splat_end(splat: Splat, side: u32) -> vec2<u32> {
    return min(splat.texel + splat.reach + 1u, vec2(side));
}

// Depth that a splat gives a texel; F32_MAX if it does not cover its middle.
fn splat_depth(splat: Splat, column: u32, row: u32, step: f32) -> f32 {
    let d = occlusion_direction(column, row, step);
    let slope = dot(d, splat.normal);
    let faces = slope * splat.height > 0.0;
    let crossed = splat.height / select(1.0, slope, faces);
    let t = select(splat.distance, crossed, faces);
    let apart = d * t - splat.point;
    let near = dot(apart, apart) <= splat.radius * splat.radius;
    let e = dot(d, splat.edges[0]);
    let f = dot(d, splat.edges[1]);
    let g = dot(d, splat.edges[2]);
    let inside = (e >= 0.0 && f >= 0.0 && g >= 0.0) || (e <= 0.0 && f <= 0.0 && g <= 0.0);
    let own = column == splat.texel.x && row == splat.texel.y;
    let free = max(min(t, splat.distance + splat.radius), splat.distance - splat.radius);
    let back = free + SPLAT_BACK * splat.radius;
    let clipped = faces && inside && (near || own);
    let whole = (faces && near) || own;
    return select(F32_MAX, select(back, t, splat.clip), select(whole, clipped, splat.clip));
}

// Corners of a triangle as a map sees them.
fn splat_corners(frame: MapFrame, triangle: u32) -> Corners {
    let c = corner[triangle];
    return Corners(
        map_frame_local(frame, vec3(c[0], c[1], c[2])),
        map_frame_local(frame, vec3(c[3], c[4], c[5])),
        map_frame_local(frame, vec3(c[6], c[7], c[8])),
    );
}
