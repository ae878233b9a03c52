// Virtual spherical Gaussian lights. Twins of `vsgl-core/src/data/vsgls.rs`.
//
// The three columns lie one after the other, each with room for `capacity` lights, so that shading binds them as one.

struct DiffuseVsgl {
    position: vec3<f32>,
    variance: f32,
    axis: vec3<f32>,
    sharpness: f32,
    intensity: vec3<f32>,
    complement: f32,
    light: vec3<f32>,
    f0: f32,
    covariance: array<f32, 6>,
    f90: f32,
    bulge: f32,
}

struct SpecularVsgl {
    position: vec3<f32>,
    variance: f32,
    axis: vec3<f32>,
    complement: f32,
    mirror: vec3<f32>,
    complement_mirror: f32,
    light: vec3<f32>,
    sharpness_lobe: f32,
    f0: vec3<f32>,
    alpha: f32,
    f90: vec3<f32>,
    bulge: f32,
    covariance: array<f32, 6>,
    across: f32,
    turn: f32,
}

struct Target {
    position: vec3<f32>,
    normal: vec3<f32>,
}

// In units of four numbers: entries of each column.
const DIFFUSE_STRIDE: u32 = 6u;
const SPECULAR_STRIDE: u32 = 8u;
const TARGET_STRIDE: u32 = 2u;
