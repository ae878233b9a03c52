//! Reflectance: Fresnel, microfacet distributions and the glTF material model.

pub mod albedo;
pub mod fresnel;
pub mod ggx;
pub mod gltf;
