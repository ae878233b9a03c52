//! needs: data/index, data/receivers, data/sums, data/vsgls_read, phase/interleave, phase/reflect, phase/sampled
// Rays from every sample to lights chosen by what they bring, after `vsgls` in `entry/shade` has left the sums. A dispatch for
// each band of samples, each group of rays and each group of lights.

override GLOSSY_RECEIVERS: bool = true;
override GLOSSY_SENDERS: bool = true;
override ANISOTROPIC_RECEIVERS: bool = false;
override ANISOTROPIC_SENDERS: bool = false;
override EMITTERS: bool = true;
override MASKS: bool = true;
override EMISSION: u32 = 0u;
override DIFFUSE: u32 = 0u;
override GLOSSY: u32 = 0u;

struct Params {
    eye: vec3<f32>,
    lift: f32,
    // As in `entry/shade`.
    count: u32,
    first: u32,
    end: u32,
    nodes: u32,
    lights: u32,
    first_light: u32,
    end_light: u32,
    width: u32,
    height: u32,
    side: u32,
    // Rays of a sample; those of this dispatch.
    rays: u32,
    first_ray: u32,
    end_ray: u32,
    // 1: of the lights that shine by themselves; 0: of the others.
    emitted: u32,
    padding: vec2<u32>,
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
@group(0) @binding(6) var<storage, read> lights: array<vec4<f32>>;
@group(0) @binding(7) var<uniform> clusters: Count;
// Columns sums, emitted. Until the last dispatch the fourth number of the third holds the running sum, not the number of rays.
@group(0) @binding(8) var<storage, read_write> waiting: array<vec4<f32>>;
@group(0) @binding(9) var texels: texture_2d_array<u32>;
@group(0) @binding(10) var<uniform> columns: TexelLayout;

// The first light that shines by itself: they are the last of the list.
fn first_emitter() -> u32 {
    var low = 0u;
    var high = clusters.value;
    if !EMITTERS {
        return high;
    }
    while low < high {
        let middle = (low + high) / 2u;
        if all(diffuse_vsgl_at(middle).light == vec3(0.0)) {
            high = middle;
        } else {
            low = middle + 1u;
        }
    }
    return low;
}

@compute @workgroup_size(INVOCATIONS)
fn sampled(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let index = params.first + item_index(invocation, groups);
    if index >= params.end {
        return;
    }
    let shares = Shares(params.side, params.width, params.height);
    let place = shares_sample(shares, index);
    if place.x >= params.width || place.y >= params.height {
        return;
    }
    let i = place.y * params.width + place.x;
    let at = sums_place(i, params.emitted == 1u);
    let total = waiting[at].w;
    if triangle[i] == NO_TRIANGLE || total <= 0.0 {
        return;
    }
    let emitters = first_emitter();
    let low = select(0u, emitters, params.emitted == 1u);
    let high = select(emitters, clusters.value, params.emitted == 1u);
    let stride = shares_count(shares);
    let offset = sampled_offset(shares, place);
    let step = sampled_step(total, params.rays);
    var passed = 0.0;
    if params.first_light > 0u {
        passed = waiting[at + 2u].w;
    }
    // Rays that found their light before this dispatch.
    var k = params.first_ray;
    while k < params.end_ray && sampled_threshold(k, offset, step) < passed {
        k++;
    }
    let seen = receiver_at(i);
    let colors = colors_at(i);
    let surfaces = surfaces_of(seen);
    let capacity = params.lights;
    var chosen: array<u32, RAYS_MAX>;
    var rays = 0u;
    let first = shares_first(max(low, params.first_light), shares_share(shares, place), stride);
    for (var j = first; j < min(params.end_light, high); j += stride) {
        var sums = reflect_diffuse(diffuse_vsgl_at(j), seen, surfaces);
        if GLOSSY_SENDERS {
            sums = reflect_specular(sums, specular_vsgl_at(j, capacity), seen, surfaces);
        }
        passed += sampled_contribution(colors, sums.diffuse, sums.near, sums.grazing);
        while k < params.end_ray && sampled_threshold(k, offset, step) < passed {
            chosen[rays] = j;
            rays++;
            k++;
        }
    }
    var open = 0.0;
    if params.first_light > 0u || params.first_ray > 0u {
        open = waiting[at + 1u].w;
    }
    let origin = origin_at(i, seen.position);
    var answer = 0.0;
    for (var ray = 0u; ray < rays; ray++) {
        var again = false;
        if ray > 0u {
            again = chosen[ray] == chosen[ray - 1u];
        }
        if !again {
            let point = target_at(chosen[ray], capacity, select(0u, SPECULAR_STRIDE, GLOSSY_SENDERS));
            answer = select(0.0, 1.0, is_open(origin, point.position, point.normal));
        }
        open += answer;
    }
    waiting[at + 1u].w = open;
    waiting[at + 2u].w = passed;
    if params.end_ray == params.rays && params.end_light >= params.lights {
        var asked = 0u;
        while asked < params.rays && sampled_threshold(asked, offset, step) < passed {
            asked++;
        }
        waiting[at + 2u].w = f32(asked);
    }
}
