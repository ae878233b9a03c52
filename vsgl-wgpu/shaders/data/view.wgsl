// Camera, size and samples of a picture. Twin of `View` in `vsgl-core/src/render.rs`.

struct View {
    eye: vec3<f32>,
    tan_half_fov: f32,
    forward: vec3<f32>,
    width: u32,
    right: vec3<f32>,
    height: u32,
    up: vec3<f32>,
    aa: u32,
    stride: u32,
    // Samples in a row, and rows, of what is rendered.
    samples_x: u32,
    samples_y: u32,
    padding: u32,
}
