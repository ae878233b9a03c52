//! needs: data/index, phase/resolve
// From the samples of a pixel to the pixel.

override GLOSSY: bool = true;
override EMISSION: bool = true;
override BOUNCE: bool = true;
override BOUNCE_GLOSSY: bool = true;

struct Params {
    // Pixels in a row, and rows.
    width: u32,
    height: u32,
    // Samples along a side of a pixel, samples in a row, and all samples.
    aa: u32,
    samples_x: u32,
    samples: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> triangle: array<u32>;
// Columns position, normal, diffuse, specular of the G-buffer.
@group(0) @binding(2) var<storage, read> receiver: array<vec4<f32>>;
// Columns direct, indirect_diffuse, indirect_glossy.
@group(0) @binding(3) var<storage, read> radiance: array<f32>;
// Columns direct, indirect_diffuse, indirect_glossy, albedo, normal, depth.
@group(0) @binding(4) var<storage, read_write> image_out: array<f32>;
@group(0) @binding(5) var<storage, read> emission: array<f32>;

fn layer(column: u32, i: u32) -> vec3<f32> {
    let at = 3u * (column * params.samples + i);
    return vec3(radiance[at], radiance[at + 1u], radiance[at + 2u]);
}

fn write(column: u32, i: u32, value: vec3<f32>) {
    let at = 3u * (column * (params.width * params.height) + i);
    image_out[at] = value.x;
    image_out[at + 1u] = value.y;
    image_out[at + 2u] = value.z;
}

@compute @workgroup_size(INVOCATIONS)
fn resolve(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let pixels = params.width * params.height;
    let i = item_index(invocation, groups);
    if i >= pixels {
        return;
    }
    let x = i % params.width;
    let y = i / params.width;
    let aa = params.aa;
    var pixel: Pixel;
    var hits = 0.0;
    let share = 1.0 / (f32(aa) * f32(aa));
    for (var row = 0u; row < aa; row++) {
        for (var column = 0u; column < aa; column++) {
            let sample = (y * aa + row) * params.samples_x + (x * aa + column);
            if triangle[sample] == NO_TRIANGLE {
                continue;
            }
            hits += 1.0;
            pixel.direct += layer(0u, sample);
            if EMISSION {
                pixel.direct += vec3(emission[3u * sample], emission[3u * sample + 1u], emission[3u * sample + 2u]);
            }
            if BOUNCE {
                pixel.indirect_diffuse += layer(1u, sample);
            }
            if BOUNCE_GLOSSY {
                pixel.indirect_glossy += layer(2u, sample);
            }
            pixel.albedo += receiver[2u * params.samples + sample].xyz;
            if GLOSSY {
                pixel.albedo += receiver[3u * params.samples + sample].xyz;
            }
            pixel.normal += receiver[params.samples + sample].xyz;
            pixel.depth += receiver[sample].w;
        }
    }
    write(0u, i, pixel.direct * share);
    write(1u, i, pixel.indirect_diffuse * share);
    write(2u, i, pixel.indirect_glossy * share);
    write(3u, i, pixel.albedo * share);
    write(4u, i, pixel.normal * share);
    image_out[15u * pixels + i] = pixel.depth / max(hits, 1.0);
}
