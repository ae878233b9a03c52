//! needs: data/index, data/lights, data/vsgls_read, math/vec, phase/importance, phase/reflect
// What texels reflect towards their light of what the camera's lights send. Twin of `receiver` and `reflected` in
// `vsgl-core/src/phase/importance.rs`, and of the loop in `vsgl-cpu/src/phase/importance.rs`.

override GLOSSY_RECEIVERS: bool = true;
override GLOSSY_SENDERS: bool = true;
override ANISOTROPIC_RECEIVERS: bool = false;
override ANISOTROPIC_SENDERS: bool = false;
override EMISSION: u32 = 0u;
override DIFFUSE: u32 = 0u;
override GLOSSY: u32 = 0u;

struct Params {
    // Texels along a side of a map, and of all maps.
    size: u32,
    texels: u32,
    // Room for lights.
    capacity: u32,
    // Texels of this dispatch.
    first: u32,
    end: u32,
}

struct Count {
    value: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// Columns position, normal, diffuse, specular, grazing, tangent of the maps.
@group(0) @binding(1) var<storage, read> texel: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> map: array<MapRecord>;
@group(0) @binding(3) var<storage, read> lights: array<vec4<f32>>;
// Number of lights.
@group(0) @binding(4) var<uniform> clusters: Count;
@group(0) @binding(5) var<storage, read_write> reflected_out: array<f32>;

fn importance_receiver(i: u32) -> Receiver {
    let position = texel[i].xyz;
    let normal = texel[params.texels + i];
    let record = map[i / (params.size * params.size)];
    var view = normal.xyz;
    if record.kind != MAP_EMITTERS {
        view = vec_normalize(map_record_to_light(record, position));
    }
    var alpha = 1.0;
    if GLOSSY_RECEIVERS {
        alpha = texel[3u * params.texels + i].w;
    }
    var tangent = vec4(0.0);
    if ANISOTROPIC_RECEIVERS {
        tangent = texel[5u * params.texels + i];
    }
    let f0 = texel[2u * params.texels + i].w;
    return Receiver(position, normal.xyz, view, f0, normal.w, alpha, tangent.xyz, tangent.w);
}

fn importance_reflected(i: u32, total: Sums) -> f32 {
    let lambert = total.diffuse * (texel[2u * params.texels + i].xyz * FRAC_1_PI);
    var specular = vec3(0.0);
    if GLOSSY_RECEIVERS {
        let f0 = texel[3u * params.texels + i].xyz;
        let f90 = texel[4u * params.texels + i].xyz;
        specular = total.near * f0 + total.grazing * f90;
    }
    return clamp(vec_luminance(lambert + specular), 0.0, IMPORTANCE_MAX);
}

@compute @workgroup_size(INVOCATIONS)
fn importance(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = params.first + item_index(invocation, groups);
    if i >= params.end {
        return;
    }
    var flux = vec_luminance(texel[2u * params.texels + i].xyz);
    if GLOSSY_RECEIVERS {
        flux += texel[4u * params.texels + i].w;
    }
    if flux <= 0.0 {
        reflected_out[i] = 0.0;
        return;
    }
    let seen = importance_receiver(i);
    let surfaces = surfaces_of(seen);
    var total = Sums();
    let first = importance_first_light(i % params.size, i / params.size % params.size);
    for (var j = first; j < clusters.value; j += INTERLEAVE * INTERLEAVE) {
        var sums = reflect_diffuse(diffuse_vsgl_at(j), seen, surfaces);
        if GLOSSY_SENDERS {
            sums = reflect_specular(sums, specular_vsgl_at(j, params.capacity), seen, surfaces);
        }
        total = sums_add(total, sums);
    }
    reflected_out[i] = importance_reflected(i, total);
}
