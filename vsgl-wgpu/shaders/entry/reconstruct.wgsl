//! needs: data/index, phase/reconstruct
// From sums over a share of the virtual lights at each sample to the light of all of them.

override GLOSSY: bool = true;
override EMITTERS: bool = true;
override SAMPLED: bool = true;

struct Params {
    width: u32,
    height: u32,
    // Shares of the lights along a side, and the side over which visibility is taken together.
    side: u32,
    filter_side: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> triangle: array<u32>;
// Columns position, normal, diffuse, specular of the G-buffer.
@group(0) @binding(2) var<storage, read> receiver: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> grazing: array<f32>;
// Columns sums, emitted: three times four numbers a sample.
@group(0) @binding(4) var<storage, read> sums: array<vec4<f32>>;
// Column direct.
@group(0) @binding(5) var<storage, read> direct: array<f32>;
// Columns direct, indirect_diffuse, indirect_glossy.
@group(0) @binding(6) var<storage, read_write> radiance_out: array<f32>;

fn patch_at(i: u32) -> Patch {
    let count = params.width * params.height;
    var alpha = 1.0;
    if GLOSSY {
        alpha = receiver[3u * count + i].w;
    }
    return Patch(receiver[i].xyz, receiver[count + i].xyz, alpha);
}

fn colors_at(i: u32) -> Colors {
    let count = params.width * params.height;
    var f0 = vec3(0.0);
    var f90 = 0.0;
    if GLOSSY {
        f0 = receiver[3u * count + i].xyz;
        f90 = grazing[i];
    }
    return Colors(receiver[2u * count + i].xyz, f0, f90);
}

fn write(column: u32, i: u32, value: vec3<f32>) {
    let at = 3u * (column * (params.width * params.height) + i);
    radiance_out[at] = value.x;
    radiance_out[at + 1u] = value.y;
    radiance_out[at + 2u] = value.z;
}

// Visits all neighbours in a square of `side` share by share; takes visibilities, or sums over lights, or both.
fn visit(
    before: array<Gathered, 2>,
    own: vec2<u32>,
    side: u32,
    visibility: bool,
    all_lights: bool,
) -> array<Gathered, 2> {
    var light = before;
    let count = params.width * params.height;
    let here = patch_at(own.y * params.width + own.x);
    let shares = side * side;
    let kinds = select(1u, 2u, EMITTERS);
    var found = 0.0;
    for (var share = 0u; share < shares; share++) {
        let ahead_x = i32(reconstruct_ahead(side, own.x, share % side));
        let ahead_y = i32(reconstruct_ahead(side, own.y, share / side));
        var shared_sums: array<Gathered, 2>;
        var diffuse = 0.0;
        var specular = 0.0;
        for (var corner = 0u; corner < 4u; corner++) {
            let dx = ahead_x - i32((corner & 1u) * side);
            let dy = ahead_y - i32((corner >> 1u) * side);
            let tent = reconstruct_tent(side, dx) * reconstruct_tent(side, dy);
            let x = i32(own.x) + dx;
            let y = i32(own.y) + dy;
            let inside = x >= 0 && y >= 0 && x < i32(params.width) && y < i32(params.height);
            if !inside || tent <= 0.0 {
                continue;
            }
            let i = u32(y) * params.width + u32(x);
            if triangle[i] == NO_TRIANGLE {
                continue;
            }
            let alike = patch_likeness(here, patch_at(i));
            let weight = tent * alike.x;
            let weight_specular = tent * alike.y;
            if weight_specular <= 0.0 {
                continue;
            }
            for (var kind = 0u; kind < kinds; kind++) {
                let at = 3u * (kind * count + i);
                let a = sums[at];
                let b = sums[at + 1u];
                let c = sums[at + 2u];
                if visibility {
                    let total = weight * a.w;
                    light[kind].total += total;
                    light[kind].open += total * (b.w / max(c.w, 1.0));
                }
                shared_sums[kind].diffuse += a.xyz * weight;
                shared_sums[kind].near += b.xyz * weight_specular;
                shared_sums[kind].grazing += c.xyz * weight_specular;
            }
            diffuse += weight;
            specular += weight_specular;
        }
        if all_lights && specular > 0.0 {
            found += 1.0;
            for (var kind = 0u; kind < kinds; kind++) {
                light[kind].diffuse += shared_sums[kind].diffuse / diffuse;
                light[kind].near += shared_sums[kind].near / specular;
                light[kind].grazing += shared_sums[kind].grazing / specular;
            }
        }
    }
    if all_lights {
        let every = f32(shares) / max(found, 1.0);
        for (var kind = 0u; kind < kinds; kind++) {
            light[kind].diffuse *= every;
            light[kind].near *= every;
            light[kind].grazing *= every;
        }
    }
    return light;
}

fn visibility_of(gathered: Gathered) -> f32 {
    if SAMPLED {
        return gathered_visibility(gathered);
    }
    return 1.0;
}

@compute @workgroup_size(INVOCATIONS)
fn reconstruct(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    if i >= params.width * params.height {
        return;
    }
    var direct_light = vec3(0.0);
    var lambert = vec3(0.0);
    var glossy = vec3(0.0);
    if triangle[i] != NO_TRIANGLE {
        let own = vec2(i % params.width, i / params.width);
        var light: array<Gathered, 2>;
        if SAMPLED && params.side == params.filter_side {
            light = visit(light, own, params.side, true, true);
        } else {
            if SAMPLED {
                light = visit(light, own, params.filter_side, true, false);
            }
            light = visit(light, own, params.side, false, true);
        }
        let colors = colors_at(i);
        let open = visibility_of(light[0]);
        lambert = colors_diffuse(colors, light[0].diffuse) * open;
        glossy = colors_glossy(colors, light[0].near, light[0].grazing) * open;
        direct_light = vec3(direct[3u * i], direct[3u * i + 1u], direct[3u * i + 2u]);
        if EMITTERS {
            let seen = visibility_of(light[1]);
            direct_light = (direct_light + colors_diffuse(colors, light[1].diffuse) * seen)
                + colors_glossy(colors, light[1].near, light[1].grazing) * seen;
        }
    }
    write(0u, i, direct_light);
    write(1u, i, lambert);
    if GLOSSY {
        write(2u, i, glossy);
    }
}
