//! needs: data/view, geom/ray
// What the camera sees through one sample. Twin of `vsgl-core/src/phase/gbuffer.rs`.

// Ray through the sample in column `x` and row `y`; its direction has length 1 along the view axis.
fn gbuffer_ray(view: View, x: u32, y: u32) -> Ray {
    let scale = 2.0 * view.tan_half_fov / f32(view.height);
    let across = (gbuffer_place(view, x) - 0.5 * f32(view.width)) * scale;
    let upwards = (0.5 * f32(view.height) - gbuffer_place(view, y)) * scale;
    return ray_new(view.eye, (view.forward + view.right * across) + view.up * upwards);
}

fn gbuffer_place(view: View, sample: u32) -> f32 {
    let pixel = (sample / view.aa) * view.stride;
    return f32(pixel) + (f32(sample % view.aa) + 0.5) / f32(view.aa);
}

// By how much directions of rays differ from one sample of a pixel to the next.
fn gbuffer_step_across(view: View) -> vec3<f32> {
    return view.right * (2.0 * view.tan_half_fov / f32(view.height) / f32(view.aa));
}

fn gbuffer_step_down(view: View) -> vec3<f32> {
    return view.up * -(2.0 * view.tan_half_fov / f32(view.height) / f32(view.aa));
}
