//! Reflectance: Fresnel, microfacet distributions and the glTF material model.

pub mod albedo;
pub mod beckmann;
pub mod fresnel;
pub mod ggx;
pub mod ggx_local;
pub mod gltf;
pub mod roughness;
mod visible;
