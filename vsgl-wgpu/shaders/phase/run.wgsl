//! needs: phase/occlusion, phase/splat
// Runs of small triangles. Twin of `vsgl-core/src/phase/run.rs`.
//
// Reads `share` and `corner`, which the entry binds.

struct Run {
    centre: vec3<f32>,
    radius: f32,
    first: u32,
    count: u32,
    every: u32,
}

// Whether draws fall on a triangle so often that it is in no run.
fn run_wide(low: u32, high: u32, stride: u32) -> bool {
    return (high - low) / RUN_DRAWS >= stride;
}

// The run of a triangle that is not wide.
fn run_of(low: u32, stride: u32, points: u32) -> u32 {
    return min(low / stride, max(points, 1u) - 1u);
}

// First of `triangles` in a run.
fn run_first(triangles: u32, index: u32, stride: u32) -> u32 {
    let before = max(index * stride, 1u) - 1u;
    let found = min(splat_find(triangles, before) + 1u, triangles);
    return select(found, 0u, index == 0u);
}

// The run of a draw, of `points` at distances of `stride`.
fn run_new(triangles: u32, index: u32, points: u32, stride: u32) -> Run {
    let begin = run_first(triangles, index, stride);
    var end = triangles;
    if index + 1u < points {
        end = run_first(triangles, index + 1u, stride);
    }
    if end > begin {
        var low = 0u;
        if end > 1u {
            low = share[end - 2u];
        }
        if run_wide(low, share[end - 1u], stride) {
            end -= 1u;
        }
    }
    let all = max(end, begin) - begin;
    let every = max((all + (RUN_MAX - 1u)) / RUN_MAX, 1u);
    let count = (all + (every - 1u)) / every;
    var least = vec3(F32_MAX);
    var most = vec3(-F32_MAX);
    for (var i = 0u; i < count; i++) {
        let c = corner[begin + i * every];
        let p = vec3(c[0], c[1], c[2]);
        let q = vec3(c[3], c[4], c[5]);
        let r = vec3(c[6], c[7], c[8]);
        least = min(least, min(min(p, q), r));
        most = max(most, max(max(p, q), r));
    }
    var half = vec3(0.0);
    var centre = vec3(0.0);
    if count > 0u {
        half = (most - least) * 0.5;
        centre = least + half;
    }
    return Run(centre, sqrt(dot(half, half)), begin, count, every);
}

// Whether a map draws its triangles; otherwise draws that fall on them stand for them.
fn run_is_apart(run: Run, frame: MapFrame, side: u32) -> bool {
    let seen = map_frame_local(frame, run.centre);
    let distance = sqrt(dot(seen, seen));
    let near = run.radius * f32(side) > RUN_APART * distance;
    return run.count > 0u && near && seen.z + run.radius > 0.0;
}
