//! needs: data/index, data/view, geom/traverse, phase/footprint, phase/surface, phase/gbuffer
// The G-buffer: which triangle each sample sees, then the surface there.

override GLOSSY: bool = true;
override TEXTURES: bool = true;
override NORMAL_MAPS: bool = true;
override COLORS: bool = true;
override UNLIT_ONES: bool = true;
override ANISOTROPY: bool = true;
override MASKS: bool = true;
override EMISSION: bool = true;

struct Params {
    view: View,
    nodes: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> node: array<BvhNode>;
@group(0) @binding(2) var<storage, read> corner: array<array<f32, 9>>;
@group(0) @binding(3) var<storage, read> corner_normal: array<array<f32, 9>>;
@group(0) @binding(4) var texels: texture_2d_array<u32>;
@group(0) @binding(5) var<storage, read> triangle: array<u32>;
@group(0) @binding(6) var<storage, read_write> triangle_out: array<u32>;
// Columns position, normal, diffuse, specular, tangent, one after the other.
@group(0) @binding(7) var<storage, read_write> surface_out: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> grazing_out: array<f32>;
@group(0) @binding(9) var<storage, read_write> emission_out: array<f32>;
@group(0) @binding(10) var<uniform> columns: TexelLayout;

@compute @workgroup_size(INVOCATIONS)
fn visibility(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let view = params.view;
    let i = item_index(invocation, groups);
    if i >= view.samples_x * view.samples_y {
        return;
    }
    let ray = gbuffer_ray(view, i % view.samples_x, i / view.samples_x);
    triangle_out[i] = traverse_closest_hit(params.nodes, ray, F32_MAX).triangle;
}

@compute @workgroup_size(INVOCATIONS)
fn surface(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let view = params.view;
    let count = view.samples_x * view.samples_y;
    let i = item_index(invocation, groups);
    if i >= count {
        return;
    }
    let id = triangle[i];
    var depth = 0.0;
    var seen: Surface;
    if id != NO_TRIANGLE {
        let ray = gbuffer_ray(view, i % view.samples_x, i / view.samples_x);
        let found = triangle_cross(ray.origin, ray.direction, corner[id]);
        depth = found.t;
        let hit = Hit(id, found.t, found.u, found.v);
        let across = gbuffer_step_across(view) * hit.t;
        let down = gbuffer_step_down(view) * hit.t;
        seen = surface_at_hit(place_at_hit(hit, ray.direction, across, down), ray.direction);
    }
    surface_out[i] = vec4(seen.position, depth);
    surface_out[count + i] = vec4(seen.normal, seen.dielectric_f90);
    surface_out[2u * count + i] = vec4(seen.diffuse, seen.dielectric_f0);
    if GLOSSY {
        surface_out[3u * count + i] = vec4(seen.f0, seen.alpha);
        grazing_out[i] = seen.f90;
    }
    if ANISOTROPY {
        surface_out[4u * count + i] = vec4(seen.tangent, seen.across);
    }
    if EMISSION {
        emission_out[3u * i] = seen.emission.x;
        emission_out[3u * i + 1u] = seen.emission.y;
        emission_out[3u * i + 2u] = seen.emission.z;
    }
}
