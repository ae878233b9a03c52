//! needs: data/host, data/index, data/scene
// A G-buffer from textures of a host.

override GLOSSY: bool = true;
// Whether `place` holds positions, or depths.
override POSITIONS: bool = false;
// Whether normals are stored as 0 ..= 1.
override BIASED: bool = false;
// Whether `materials` holds the factors.
override MATERIALS: bool = true;
// Whether there is a scene, for shadow rays.
override SCENE: bool = true;
// Rays of a host's scene may meet masks, which its materials say.
const MASKS: bool = true;

struct Params {
    host: Host,
    eye: vec3<f32>,
    padding: f32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var place: texture_2d<f32>;
@group(0) @binding(2) var normals: texture_2d<f32>;
@group(0) @binding(3) var colors: texture_2d<f32>;
@group(0) @binding(4) var materials: texture_2d<f32>;
@group(0) @binding(5) var<storage, read> node: array<BvhNode>;
@group(0) @binding(6) var<storage, read> corner: array<array<f32, 9>>;
@group(0) @binding(7) var<storage, read_write> triangle_out: array<u32>;
// Columns position, normal, diffuse, specular, one after the other.
@group(0) @binding(8) var<storage, read_write> surface_out: array<vec4<f32>>;
@group(0) @binding(9) var<storage, read_write> grazing_out: array<f32>;
@group(0) @binding(10) var texels: texture_2d_array<u32>;
@group(0) @binding(11) var<uniform> columns: TexelLayout;

@compute @workgroup_size(INVOCATIONS)
fn import_gbuffer(
    @builtin(global_invocation_id) invocation: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let host = params.host;
    let count = host.width * host.height;
    let i = item_index(invocation, groups);
    if i >= count {
        return;
    }
    var found = host_surface(host, vec2(i % host.width, i / host.width));
    var id = NO_TRIANGLE;
    if found.seen {
        // Without a scene no ray starts here, and any triangle will do.
        id = 0u;
        let apart = found.position - params.eye;
        found.normal = select(found.normal, -found.normal, dot(found.normal, apart) > 0.0);
        if SCENE {
            let there = host_on_scene(host, params.eye, found);
            id = there.triangle;
            found.position = there.position;
        }
    }
    triangle_out[i] = id;
    if id == NO_TRIANGLE {
        surface_out[i] = vec4(0.0);
        surface_out[count + i] = vec4(0.0);
        surface_out[2u * count + i] = vec4(0.0);
        if GLOSSY {
            surface_out[3u * count + i] = vec4(0.0);
            grazing_out[i] = 0.0;
        }
        return;
    }
    let apart = found.position - params.eye;
    let base = min(found.base, vec3(1.0));
    surface_out[i] = vec4(found.position, sqrt(dot(apart, apart)));
    surface_out[count + i] = vec4(found.normal, 1.0);
    surface_out[2u * count + i] = vec4((1.0 - found.metallic) * base, host.dielectric_f0);
    if GLOSSY {
        let dielectric = vec3(host.dielectric_f0);
        let f0 = dielectric + (base - dielectric) * found.metallic;
        surface_out[3u * count + i] = vec4(f0, found.alpha);
        grazing_out[i] = 1.0;
    }
}
