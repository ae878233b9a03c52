// From the samples of a pixel to the pixel. Twin of `vsgl-core/src/phase/resolve.rs`; the loop over samples, which reads what
// the entry binds, is there.

struct Pixel {
    direct: vec3<f32>,
    indirect_diffuse: vec3<f32>,
    indirect_glossy: vec3<f32>,
    albedo: vec3<f32>,
    normal: vec3<f32>,
    depth: f32,
}
