//! needs: data/index, phase/camera_map
// What the camera sees as a reflective shadow map of its own.

override GLOSSY: bool = true;
override ANISOTROPY: bool = true;

struct Params {
    map: MapRecord,
    // Texels along a side.
    side: u32,
    // Samples in a row, and rows, of the G-buffer.
    width: u32,
    height: u32,
    padding: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> triangle: array<u32>;
// Columns position, normal, diffuse, specular, tangent of the G-buffer.
@group(0) @binding(2) var<storage, read> receiver: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> grazing: array<f32>;
@group(0) @binding(4) var<storage, read_write> triangle_out: array<u32>;
// Columns position, normal, diffuse, specular, grazing, tangent.
@group(0) @binding(5) var<storage, read_write> texel_out: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> map_out: array<MapRecord>;

@compute @workgroup_size(INVOCATIONS)
fn camera_map(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let i = item_index(invocation, groups);
    let side = params.side;
    if i >= side * side {
        return;
    }
    if i == 0u {
        map_out[0] = params.map;
    }
    let x = camera_map_sample(i % side, side, params.width);
    let y = camera_map_sample(i / side, side, params.height);
    let at = y * params.width + x;
    let samples = params.width * params.height;
    let id = triangle[at];
    var seen = rsm_empty();
    if id != NO_TRIANGLE {
        var specular = vec4(0.0, 0.0, 0.0, 1.0);
        var at_grazing = 0.0;
        var tangent = vec4(0.0);
        if GLOSSY {
            specular = receiver[3u * samples + at];
            at_grazing = grazing[at];
        }
        if ANISOTROPY {
            tangent = receiver[4u * samples + at];
        }
        seen = camera_map_texel(
            params.map,
            receiver[at].xyz,
            receiver[samples + at],
            receiver[2u * samples + at],
            specular,
            at_grazing,
            tangent,
        );
    }
    let texels = side * side;
    triangle_out[i] = id;
    texel_out[i] = seen.position;
    texel_out[texels + i] = seen.normal;
    texel_out[2u * texels + i] = seen.diffuse;
    if GLOSSY {
        texel_out[3u * texels + i] = seen.specular;
        texel_out[4u * texels + i] = seen.grazing;
    }
    if ANISOTROPY {
        texel_out[5u * texels + i] = seen.tangent;
    }
}
