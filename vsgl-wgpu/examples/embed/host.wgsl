// What the camera or the lamp sees.

struct Eye {
    view_projection: mat4x4<f32>,
}

@group(0) @binding(0) var<uniform> eye: Eye;

struct Corner {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) base: vec4<f32>,
    @location(3) material: vec4<f32>,
}

struct Inside {
    @builtin(position) place: vec4<f32>,
    @location(0) normal: vec3<f32>,
    @location(1) base: vec4<f32>,
    @location(2) material: vec4<f32>,
}

struct Seen {
    @location(0) normal: vec4<f32>,
    @location(1) base: vec4<f32>,
    @location(2) material: vec4<f32>,
}

@vertex
fn draw_corner(corner: Corner) -> Inside {
    let place = eye.view_projection * vec4(corner.position, 1.0);
    return Inside(place, corner.normal, corner.base, corner.material);
}

@fragment
fn draw(inside: Inside) -> Seen {
    return Seen(vec4(inside.normal, 0.0), inside.base, inside.material);
}

// The picture: the lamp's own light with a shadow map, and the light of one bounce.

struct Lamp {
    camera_to_world: mat4x4<f32>,
    world_to_lamp: mat4x4<f32>,
    position: vec3<f32>,
    cos_inner: f32,
    axis: vec3<f32>,
    cos_outer: f32,
    intensity: vec3<f32>,
    exposure: f32,
}

@group(0) @binding(1) var<uniform> lamp: Lamp;
@group(0) @binding(2) var depth: texture_depth_2d;
@group(0) @binding(3) var normal: texture_2d<f32>;
@group(0) @binding(4) var base: texture_2d<f32>;
@group(0) @binding(5) var material: texture_2d<f32>;
@group(0) @binding(6) var lamp_depth: texture_depth_2d;
@group(0) @binding(7) var indirect: texture_2d<f32>;

@vertex
fn compose_corner(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(index & 1u) * 4.0 - 1.0, f32(index & 2u) * 2.0 - 1.0, 0.0, 1.0);
}

@fragment
fn compose(@builtin(position) place: vec4<f32>) -> @location(0) vec4<f32> {
    let at = vec2<u32>(place.xy);
    let size = vec2<f32>(textureDimensions(depth));
    let d = textureLoad(depth, at, 0);
    if d == 0.0 {
        return vec4(0.0, 0.0, 0.0, 1.0);
    }
    let uv = place.xy / size;
    let clip = vec4(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, d, 1.0);
    let world = lamp.camera_to_world * clip;
    let position = world.xyz / world.w;

    let apart = lamp.position - position;
    let light = normalize(apart);
    let cosine = -dot(light, lamp.axis);
    let t = clamp((cosine - lamp.cos_outer) / (lamp.cos_inner - lamp.cos_outer), 0.0, 1.0);
    let front = textureLoad(normal, at, 0).xyz;
    let facing = max(dot(front, light), 0.0);
    // Off the surface, by about a texel of the map.
    let seen = lamp.world_to_lamp * vec4(position + front * 0.04, 1.0);
    let map = vec2<f32>(textureDimensions(lamp_depth));
    let texel = (seen.xy / seen.w * vec2(0.5, -0.5) + 0.5) * map;
    let nearest = textureLoad(lamp_depth, vec2<u32>(clamp(texel, vec2(0.0), map - 1.0)), 0);
    let open = select(0.0, 1.0, seen.z / seen.w <= nearest + 1e-4);
    let metallic = textureLoad(material, at, 0).z;
    let albedo = textureLoad(base, at, 0).xyz * (1.0 - metallic);
    let direct = albedo / 3.14159265 * lamp.intensity * (t * t * facing * open / dot(apart, apart));

    let light_all = (direct + textureLoad(indirect, at, 0).xyz) * lamp.exposure;
    return vec4(light_all / (1.0 + light_all), 1.0);
}
