//! needs: math/vec, phase/lift
// A shadow map above a cluster's target. Twin of `vsgl-core/src/phase/occlusion.rs`.

struct MapFrame {
    centre: vec3<f32>,
    x: vec3<f32>,
    y: vec3<f32>,
    z: vec3<f32>,
}

// The frame above a target.
fn map_frame_new(position: vec3<f32>, normal: vec3<f32>, least: f32) -> MapFrame {
    let basis = vec_orthonormal_basis(normal);
    return MapFrame(position + normal * surface_lift(least, position), basis.x, basis.y, normal);
}

// Components of a direction along the axes.
fn map_frame_turn(frame: MapFrame, direction: vec3<f32>) -> vec3<f32> {
    return vec3(dot(frame.x, direction), dot(frame.y, direction), dot(frame.z, direction));
}

// A point as the map sees it.
fn map_frame_local(frame: MapFrame, point: vec3<f32>) -> vec3<f32> {
    return map_frame_turn(frame, point - frame.centre);
}

// Where a direction with `z >= 0` lies on a map, in texels from its corner.
fn occlusion_place(d: vec3<f32>, side: u32) -> vec2<f32> {
    let sum = (abs(d.x) + abs(d.y)) + d.z;
    let u = (d.x + d.y) / sum;
    let v = (d.x - d.y) / sum;
    let half = 0.5 * f32(side);
    return vec2(u * half + half, v * half + half);
}

// Unit direction of the middle of a texel; `step` is two over the side of the map.
fn occlusion_direction(column: u32, row: u32, step: f32) -> vec3<f32> {
    let u = (f32(column) + 0.5) * step - 1.0;
    let v = (f32(row) + 0.5) * step - 1.0;
    let x = 0.5 * (u + v);
    let y = 0.5 * (u - v);
    let z = (1.0 - abs(x)) - abs(y);
    return vec_normalize(vec3(x, y, max(z, 0.0)));
}

struct Probe {
    first: vec2<u32>,
    next: u32,
    share: vec2<f32>,
    limit: vec4<f32>,
    hidden: bool,
}

// Least depth that is open in a texel, for a receiver's plane at a distance.
fn occlusion_limit(column: u32, row: u32, step: f32, facing: vec3<f32>, plane: f32, distance: f32) -> f32 {
    let d = occlusion_direction(column, row, step);
    let slope = dot(d, facing);
    let crossed = plane / select(-1.0, slope, slope < 0.0);
    let t = select(distance, crossed, slope < 0.0);
    return max(min(t, distance), 0.5 * distance) * (1.0 - OCCLUSION_BIAS);
}

// Looks up a receiver.
fn occlusion_probe(frame: MapFrame, position: vec3<f32>, normal: vec3<f32>, side: u32) -> Probe {
    let seen = map_frame_local(frame, position);
    let facing = map_frame_turn(frame, normal);
    let distance = sqrt(dot(seen, seen));
    let plane = dot(seen, facing);
    let hidden = seen.z <= 0.0 || plane >= 0.0;
    let at = occlusion_place(select(seen, vec3(0.0, 0.0, 1.0), hidden), side);
    let last = f32(side) - 1.0;
    let u = max(min(at.x - 0.5, last), 0.0);
    let v = max(min(at.y - 0.5, last), 0.0);
    let most = max(last - 1.0, 0.0);
    let column = min(floor(u), most);
    let row = min(floor(v), most);
    let first = vec2(u32(column), u32(row));
    let next = u32(min(last, 1.0));
    let step = 2.0 / f32(side);
    let limit = vec4(
        occlusion_limit(first.x, first.y, step, facing, plane, distance),
        occlusion_limit(first.x + next, first.y, step, facing, plane, distance),
        occlusion_limit(first.x, first.y + next, step, facing, plane, distance),
        occlusion_limit(first.x + next, first.y + next, step, facing, plane, distance),
    );
    return Probe(first, next, vec2(u - column, v - row), limit, hidden);
}

// Share of the light that passes, from the depths of the four texels.
fn occlusion_open(probe: Probe, depth: vec4<f32>) -> f32 {
    let passes = select(vec4(0.0), vec4(1.0), depth >= probe.limit);
    let above = passes.x + (passes.y - passes.x) * probe.share.x;
    let below = passes.z + (passes.w - passes.z) * probe.share.x;
    let share = above + (below - above) * probe.share.y;
    return select(share, 0.0, probe.hidden);
}
