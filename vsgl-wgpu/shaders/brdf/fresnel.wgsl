// Fresnel reflectance by Schlick's approximation: twin of `vsgl-core/src/brdf/fresnel.rs`.

fn fresnel_schlick_weight(cosine: f32) -> f32 {
    let c = 1.0 - clamp(cosine, 0.0, 1.0);
    let square = c * c;
    return square * square * c;
}

fn fresnel_schlick(f0: vec3<f32>, f90: vec3<f32>, cosine: f32) -> vec3<f32> {
    return f0 + (f90 - f0) * fresnel_schlick_weight(cosine);
}

fn fresnel_half_cosine(view: vec3<f32>, light: vec3<f32>) -> f32 {
    let sum = view + light;
    return min(0.5 * sqrt(dot(sum, sum)), 1.0);
}

fn fresnel_f0_of_index(index: f32) -> f32 {
    let root = (index - 1.0) / (index + 1.0);
    return root * root;
}
