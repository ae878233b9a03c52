//! needs: data/index, data/point_sender, data/receivers, data/sums, data/vsgls_read, phase/direct, phase/interleave, phase/occlusion, phase/reflect, phase/sampled
// Light to the eye from every sample: `direct` of the lights themselves, `vsgls` and `vpls` of one bounce. A dispatch for each
// band of samples and each group of lights; sums wait in `waiting` for the next group, so that their order is that of the lights.

override GLOSSY_RECEIVERS: bool = true;
override GLOSSY_SENDERS: bool = true;
override ANISOTROPIC_RECEIVERS: bool = false;
override ANISOTROPIC_SENDERS: bool = false;
override RAYS: bool = true;
override MASKS: bool = true;
// Some of the virtual lights shine by themselves. They are the last, and their light is direct.
override EMITTERS: bool = true;
// Sums over a share of the lights stay in `waiting` for reconstruction.
override LEAVES_SUMS: bool = false;
// Rays are drawn later, by what lights bring.
override SAMPLED: bool = false;
override EMISSION: u32 = 0u;
override DIFFUSE: u32 = 0u;
override GLOSSY: u32 = 0u;

struct Params {
    eye: vec3<f32>,
    // By how much ray origins are lifted at least.
    lift: f32,
    // All samples; those of this dispatch, in the order of shares.
    count: u32,
    first: u32,
    end: u32,
    nodes: u32,
    // Direct lights, room for clusters, or texels; those of this dispatch.
    lights: u32,
    first_light: u32,
    end_light: u32,
    // The first texel that shines by itself, where texels are lights.
    first_emitter: u32,
    // Samples in a row and rows, and shares of the lights along a side.
    width: u32,
    height: u32,
    side: u32,
    // Texels along a side of a shadow map.
    map_side: u32,
}

struct Count {
    value: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> node: array<BvhNode>;
@group(0) @binding(2) var<storage, read> corner: array<array<f32, 9>>;
@group(0) @binding(3) var<storage, read> triangle: array<u32>;
// Columns position, normal, diffuse, specular, tangent of the G-buffer.
@group(0) @binding(4) var<storage, read> receiver: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read> grazing: array<f32>;
@group(0) @binding(6) var<storage, read> direct_light: array<LightRecord>;
@group(0) @binding(7) var<storage, read> lights: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read> sender: array<vec4<f32>>;
// Number of clusters.
@group(0) @binding(9) var<uniform> clusters: Count;
// Columns direct, indirect_diffuse, indirect_glossy.
@group(0) @binding(10) var<storage, read_write> radiance_out: array<f32>;
// Sums of the samples of this band over the lights so far; those of all samples where they stay: columns sums, emitted.
@group(0) @binding(11) var<storage, read_write> waiting: array<vec4<f32>>;
@group(0) @binding(12) var texels: texture_2d_array<u32>;
@group(0) @binding(13) var<uniform> columns: TexelLayout;


// Shadow maps of the clusters, one after the other.
@group(0) @binding(15) var<storage, read> depth: array<f32>;

fn write(column: u32, i: u32, value: vec3<f32>) {
    let at = 3u * (column * params.count + i);
    radiance_out[at] = value.x;
    radiance_out[at + 1u] = value.y;
    radiance_out[at + 2u] = value.z;
}

@compute @workgroup_size(INVOCATIONS)
fn direct(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = params.first + item_index(invocation, groups);
    if i >= params.end {
        return;
    }
    var sum = vec3(0.0);
    if params.first_light > 0u {
        sum = vec3(radiance_out[3u * i], radiance_out[3u * i + 1u], radiance_out[3u * i + 2u]);
    }
    if triangle[i] != NO_TRIANGLE {
        let seen = receiver_at(i);
        let colors = colors_at(i);
        let facing = surface_geometric_normal(triangle[i], params.eye - seen.position);
        for (var j = params.first_light; j < params.end_light; j++) {
            sum += direct_radiance(params.nodes, params.lift, direct_light[j], seen, facing, colors);
        }
    }
    write(0u, i, sum);
}

// The sums over the lights before this dispatch.
fn sums_before(i: u32) -> Sums {
    if params.first_light == 0u {
        return Sums();
    }
    let at = 3u * (i - params.first);
    return Sums(waiting[at].xyz, waiting[at + 1u].xyz, waiting[at + 2u].xyz);
}

// Light of surfaces that shine comes to that of the lights.
fn write_emitted(i: u32, total: Sums) {
    let colors = colors_at(i);
    var sum = vec3(radiance_out[3u * i], radiance_out[3u * i + 1u], radiance_out[3u * i + 2u]);
    sum = sum + colors_diffuse(colors, total.diffuse);
    if GLOSSY_RECEIVERS {
        sum = sum + colors_glossy(colors, total.near, total.grazing);
    }
    write(0u, i, sum);
}

// Keeps the sums for the next dispatch, or makes the result of them after the last.
fn write_sums(i: u32, total: Sums, emitting: bool) {
    if params.end_light < params.lights {
        let at = 3u * (i - params.first);
        waiting[at] = vec4(total.diffuse, 0.0);
        waiting[at + 1u] = vec4(total.near, 0.0);
        waiting[at + 2u] = vec4(total.grazing, 0.0);
    } else if EMITTERS && emitting {
        write_emitted(i, total);
    } else {
        write_indirect(i, total);
    }
}

fn write_indirect(i: u32, total: Sums) {
    let colors = colors_at(i);
    write(1u, i, colors_diffuse(colors, total.diffuse));
    if GLOSSY_RECEIVERS {
        write(2u, i, colors_glossy(colors, total.near, total.grazing));
    }
}

// What waits of a sample before this dispatch.
fn left_before(i: u32, emitting: bool) -> Left {
    var left: Left;
    if LEAVES_SUMS {
        if params.first_light > 0u {
            left = left_at(i, emitting);
        }
    } else {
        left.sums = sums_before(i);
    }
    return left;
}

// What is left of a sample after this dispatch.
fn leave(i: u32, left: Left, emitting: bool) {
    if !LEAVES_SUMS {
        write_sums(i, left.sums, emitting);
        return;
    }
    // After the last of the lights.
    if params.end_light >= params.lights {
        leave_at(i, left_lit(left), emitting);
    } else {
        leave_at(i, left, emitting);
    }
    if EMITTERS && !emitting && params.first_light == 0u {
        leave_at(i, Left(), true);
    }
}

// The sample of an invocation, and the lights that it takes.
struct Taken {
    sample: u32,
    share: u32,
    stride: u32,
    inside: bool,
}

fn taken_by(index: u32) -> Taken {
    if !LEAVES_SUMS {
        return Taken(index, 0u, 1u, true);
    }
    let shares = Shares(params.side, params.width, params.height);
    let place = shares_sample(shares, index);
    let inside = place.x < params.width && place.y < params.height;
    let sample = place.y * params.width + place.x;
    return Taken(sample, shares_share(shares, place), shares_count(shares), inside);
}

// Whether the last light before this dispatch shines by itself.
fn emits_before(taken: Taken) -> bool {
    let before = min(params.first_light, clusters.value);
    if !EMITTERS || before <= taken.share || triangle[taken.sample] == NO_TRIANGLE {
        return false;
    }
    let last = taken.share + (before - 1u - taken.share) / taken.stride * taken.stride;
    return all(diffuse_vsgl_at(last).light == vec3(0.0));
}

@compute @workgroup_size(INVOCATIONS)
fn vsgls(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let index = params.first + item_index(invocation, groups);
    if index >= params.end {
        return;
    }
    let taken = taken_by(index);
    if !taken.inside {
        return;
    }
    let i = taken.sample;
    var emitting = emits_before(taken);
    var left = left_before(i, emitting);
    if triangle[i] != NO_TRIANGLE {
        let seen = receiver_at(i);
        var origin = vec3(0.0);
        if RAYS {
            origin = origin_at(i, seen.position);
        }
        var colors: Colors;
        if SAMPLED {
            colors = colors_at(i);
        }
        let surfaces = surfaces_of(seen);
        let capacity = params.lights;
        let first = shares_first(params.first_light, taken.share, taken.stride);
        for (var j = first; j < min(params.end_light, clusters.value); j += taken.stride) {
            let light = diffuse_vsgl_at(j);
            if EMITTERS && !emitting && all(light.light == vec3(0.0)) {
                if LEAVES_SUMS {
                    leave_at(i, left_lit(left), false);
                } else {
                    write_indirect(i, left.sums);
                }
                left = Left();
                emitting = true;
            }
            var sums = reflect_diffuse(light, seen, surfaces);
            if GLOSSY_SENDERS {
                sums = reflect_specular(sums, specular_vsgl_at(j, capacity), seen, surfaces);
            }
            if SAMPLED {
                left.total += sampled_contribution(colors, sums.diffuse, sums.near, sums.grazing);
            }
            if RAYS {
                if !sums_lit(sums) {
                    continue;
                }
                let point = target_at(j, capacity, select(0u, SPECULAR_STRIDE, GLOSSY_SENDERS));
                if !is_open(origin, point.position, point.normal) {
                    continue;
                }
            }
            left.sums = sums_add(left.sums, sums);
        }
    }
    leave(i, left, emitting);
}

// Share of a cluster's light that reaches a receiver, by its map.
fn open_by_map(map: u32, point: Target, position: vec3<f32>, facing: vec3<f32>) -> f32 {
    let side = params.map_side;
    let frame = map_frame_new(point.position, point.normal, params.lift);
    let probe = occlusion_probe(frame, position, facing, side);
    if probe.hidden {
        return 0.0;
    }
    let first = (map * side + probe.first.y) * side + probe.first.x;
    let below = first + probe.next * side;
    let four = vec4(depth[first], depth[first + probe.next], depth[below], depth[below + probe.next]);
    return occlusion_open(probe, four);
}

// As `vsgls`, with shadow maps instead of rays: a kernel of its own, since both together bind too many buffers.
@compute @workgroup_size(INVOCATIONS)
fn vsgls_with_maps(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let index = params.first + item_index(invocation, groups);
    if index >= params.end {
        return;
    }
    let taken = taken_by(index);
    if !taken.inside {
        return;
    }
    let i = taken.sample;
    var emitting = emits_before(taken);
    var left = left_before(i, emitting);
    if triangle[i] != NO_TRIANGLE {
        let seen = receiver_at(i);
        let facing = surface_geometric_normal(triangle[i], params.eye - seen.position);
        let surfaces = surfaces_of(seen);
        let capacity = params.lights;
        let first = shares_first(params.first_light, taken.share, taken.stride);
        for (var j = first; j < min(params.end_light, clusters.value); j += taken.stride) {
            let light = diffuse_vsgl_at(j);
            if EMITTERS && !emitting && all(light.light == vec3(0.0)) {
                if LEAVES_SUMS {
                    leave_at(i, left_lit(left), false);
                } else {
                    write_indirect(i, left.sums);
                }
                left = Left();
                emitting = true;
            }
            var sums = reflect_diffuse(light, seen, surfaces);
            if GLOSSY_SENDERS {
                sums = reflect_specular(sums, specular_vsgl_at(j, capacity), seen, surfaces);
            }
            if sums_lit(sums) {
                let point = target_at(j, capacity, select(0u, SPECULAR_STRIDE, GLOSSY_SENDERS));
                let open = open_by_map(j, point, seen.position, facing);
                left.sums = sums_add(left.sums, sums_scale(sums, open));
            }
        }
    }
    leave(i, left, emitting);
}

@compute @workgroup_size(INVOCATIONS)
fn vpls(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = params.first + item_index(invocation, groups);
    if i >= params.end {
        return;
    }
    var total = sums_before(i);
    var emitting = false;
    if triangle[i] != NO_TRIANGLE {
        let seen = receiver_at(i);
        var origin = vec3(0.0);
        if RAYS {
            origin = origin_at(i, seen.position);
        }
        emitting = EMITTERS && params.first_light > params.first_emitter;
        for (var j = params.first_light; j < params.end_light; j++) {
            if EMITTERS && j == params.first_emitter {
                write_indirect(i, total);
                total = Sums();
                emitting = true;
            }
            let light = sender_at(j);
            if !light.lit {
                continue;
            }
            var incoming: Incoming;
            if ANISOTROPIC_SENDERS {
                incoming = shade_incoming_anisotropic_point(light.point, seen.position);
            } else {
                incoming = shade_incoming_point(light.point, seen.position);
            }
            let sums = reflect_point(Sums(), incoming, seen);
            if RAYS {
                if !sums_lit(sums) || !is_open(origin, light.point.position, light.facing) {
                    continue;
                }
            }
            total = sums_add(total, sums);
        }
    }
    write_sums(i, total, emitting);
}
