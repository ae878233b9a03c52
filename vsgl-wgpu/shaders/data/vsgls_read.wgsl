//! needs: data/vsgls
// Loads of virtual lights from `lights`, which the entry binds as four numbers each.

fn diffuse_vsgl_at(j: u32) -> DiffuseVsgl {
    let at = DIFFUSE_STRIDE * j;
    let a = lights[at];
    let b = lights[at + 1u];
    let c = lights[at + 2u];
    let d = lights[at + 3u];
    let e = lights[at + 4u];
    let f = lights[at + 5u];
    let covariance = array(e.x, e.y, e.z, e.w, f.x, f.y);
    return DiffuseVsgl(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w, d.xyz, d.w, covariance, f.z, f.w);
}

fn specular_vsgl_at(j: u32, capacity: u32) -> SpecularVsgl {
    let at = DIFFUSE_STRIDE * capacity + SPECULAR_STRIDE * j;
    let a = lights[at];
    let b = lights[at + 1u];
    let c = lights[at + 2u];
    let d = lights[at + 3u];
    let e = lights[at + 4u];
    let f = lights[at + 5u];
    let g = lights[at + 6u];
    let h = lights[at + 7u];
    let covariance = array(g.x, g.y, g.z, g.w, h.x, h.y);
    return SpecularVsgl(
        a.xyz, a.w, b.xyz, b.w, c.xyz, c.w, d.xyz, d.w, e.xyz, e.w, f.xyz, f.w, covariance, h.z, h.w,
    );
}

// `specular_stride` is zero without specular lights.
fn target_at(j: u32, capacity: u32, specular_stride: u32) -> Target {
    let at = (DIFFUSE_STRIDE + specular_stride) * capacity + TARGET_STRIDE * j;
    return Target(lights[at].xyz, lights[at + 1u].xyz);
}
