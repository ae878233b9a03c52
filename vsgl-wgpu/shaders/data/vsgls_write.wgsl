//! needs: data/vsgls
// Stores of virtual lights into `lights`, which the entry binds as four numbers each. See `data/vsgls_read`.

fn diffuse_vsgl_write(j: u32, light: DiffuseVsgl) {
    let at = DIFFUSE_STRIDE * j;
    let c = light.covariance;
    lights[at] = vec4(light.position, light.variance);
    lights[at + 1u] = vec4(light.axis, light.sharpness);
    lights[at + 2u] = vec4(light.intensity, light.complement);
    lights[at + 3u] = vec4(light.light, light.f0);
    lights[at + 4u] = vec4(c[0], c[1], c[2], c[3]);
    lights[at + 5u] = vec4(c[4], c[5], light.f90, light.bulge);
}

fn specular_vsgl_write(j: u32, capacity: u32, light: SpecularVsgl) {
    let at = DIFFUSE_STRIDE * capacity + SPECULAR_STRIDE * j;
    let c = light.covariance;
    lights[at] = vec4(light.position, light.variance);
    lights[at + 1u] = vec4(light.axis, light.complement);
    lights[at + 2u] = vec4(light.mirror, light.complement_mirror);
    lights[at + 3u] = vec4(light.light, light.sharpness_lobe);
    lights[at + 4u] = vec4(light.f0, light.alpha);
    lights[at + 5u] = vec4(light.f90, light.bulge);
    lights[at + 6u] = vec4(c[0], c[1], c[2], c[3]);
    lights[at + 7u] = vec4(c[4], c[5], light.across, light.turn);
}

// `specular_stride` is zero without specular lights.
fn target_write(j: u32, capacity: u32, specular_stride: u32, point: Target) {
    let at = (DIFFUSE_STRIDE + specular_stride) * capacity + TARGET_STRIDE * j;
    lights[at] = vec4(point.position, 0.0);
    lights[at + 1u] = vec4(point.normal, 0.0);
}
