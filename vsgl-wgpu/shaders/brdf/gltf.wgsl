//! needs: brdf/fresnel, brdf/ggx
// The metallic-roughness reflectance of glTF 2.0: twin of `vsgl-core/src/brdf/gltf.rs`.
// Its `Surface` is called `GltfSurface`: shaders have one space of names, and the phases have a surface too.

struct GltfSurface {
    base_color: vec3<f32>,
    metallic: f32,
    alpha: f32,
    dielectric_f0: vec3<f32>,
    dielectric_f90: f32,
}

fn gltf_surface_f0(own: GltfSurface) -> vec3<f32> {
    return own.dielectric_f0 + (own.base_color - own.dielectric_f0) * own.metallic;
}

fn gltf_surface_f90(own: GltfSurface) -> vec3<f32> {
    return vec3(own.dielectric_f90 + (1.0 - own.dielectric_f90) * own.metallic);
}

fn gltf_surface_diffuse_albedo(own: GltfSurface) -> vec3<f32> {
    return own.base_color * (1.0 - own.metallic);
}

fn gltf_surface_diffuse_weight(own: GltfSurface, cosine: f32) -> f32 {
    let f0 = max(max(own.dielectric_f0.x, own.dielectric_f0.y), own.dielectric_f0.z);
    return 1.0 - (f0 + (own.dielectric_f90 - f0) * fresnel_schlick_weight(cosine));
}

fn gltf_surface_diffuse(own: GltfSurface, view: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    return gltf_surface_diffuse_albedo(own)
        * (gltf_surface_diffuse_weight(own, fresnel_half_cosine(view, light)) * (1.0 / PI));
}

fn gltf_surface_specular(own: GltfSurface, view: vec3<f32>, light: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    return fresnel_schlick(gltf_surface_f0(own), gltf_surface_f90(own), fresnel_half_cosine(view, light))
        * ggx_reflectance(view, light, normal, own.alpha);
}

fn gltf_surface_reflected(own: GltfSurface, view: vec3<f32>, light: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    let cosine = max(dot(light, normal), 0.0);
    let seen = select(0.0, cosine, dot(view, normal) > 0.0);
    return (gltf_surface_diffuse(own, view, light) + gltf_surface_specular(own, view, light, normal)) * seen;
}
