//! Virtual spherical Gaussian lights.

use super::columns::{Element, Scalar, columns};

columns! {
    /// Clusters of virtual point lights. All columns run side by side, one entry a cluster.
    pub struct Vsgls = "vsgls" {
        head {
            /// Number of clusters.
            count,
        }
        /// The Lambert part of each cluster.
        diffuse: DiffuseVsgl,
        /// The specular part of each cluster. Empty without glossy senders.
        specular: SpecularVsgl,
        /// The point that stands for each cluster in visibility.
        target: Target,
        /// The texel that `target` was taken from, an index into the columns of the RSM.
        texel: u32,
        /// Exact partition: the cluster of each texel of the RSM, `u32::MAX` for none. Empty otherwise.
        label: u32,
        /// Filtered kernels: map, column and row of the centre, side of the square that has the kernel's share of the
        /// density were it spread evenly, in texels. Empty otherwise.
        kernel: [f32; 4],
    }
}

/// Light that a cluster sends by its Lambert part.
///
/// With emission `cosine` the radiant intensity towards `ω` is `intensity (1 - F) B(s, ω·axis)/A(s)`, the clamped
/// cosine averaged over the cluster's normals. With emission `sg` it is `intensity G(ω; axis, sharpness)`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct DiffuseVsgl {
    /// Mean position \[m\].
    pub position: [f32; 3],
    /// Positional variance along one axis in the surface \[m²\].
    pub variance: f32,
    /// Mean normal direction, unit; with emission `sg` the axis of the lobe.
    pub axis: [f32; 3],
    /// Sharpness of the distribution of normals; with emission `sg` of the lobe.
    pub sharpness: f32,
    /// Radiant intensity along the axis of a flat cluster \[W/sr\]: reflected flux over π; with `sg` flux over the
    /// integral of the lobe.
    pub intensity: [f32; 3],
    /// One minus the vMF mean length of `sharpness`.
    pub complement: f32,
    /// Unit direction to the light; zero where the cluster shines by itself.
    pub light: [f32; 3],
    /// Dielectric reflectance at normal incidence, mean.
    pub f0: f32,
    /// Covariance of positions, xx yy zz xy xz yz \[m²\].
    pub covariance: [f32; 6],
    /// Dielectric reflectance at grazing incidence, mean.
    pub f90: f32,
    /// How far along `axis` the surfaces' planes lie above the mean position, in the mean \[m\]: positive on a bulge,
    /// negative in a hollow, zero on a plane. Light leaves as from there.
    pub bulge: f32,
}

/// Light that a cluster sends by its specular part.
///
/// With emission `cosine` (section 3 of the derivation) the sender is shaded like a receiver, as GGX under the lobe
/// of directions that the light comes from. With emission `sg` it is the lobe `f0 G(ω; mirror, sharpness_lobe)`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SpecularVsgl {
    /// Mean position \[m\].
    pub position: [f32; 3],
    /// Positional variance along one axis in the surface \[m²\].
    pub variance: f32,
    /// Mean normal direction, unit.
    pub axis: [f32; 3],
    /// One minus the mean length of the normals.
    pub complement: f32,
    /// Mean mirrored direction of the light, unit.
    pub mirror: [f32; 3],
    /// One minus the mean length of the mirrored directions alone.
    pub complement_mirror: f32,
    /// Unit direction to the light.
    pub light: [f32; 3],
    /// Sharpness of the mirrored directions blurred by the lobe of the surface.
    pub sharpness_lobe: f32,
    /// Arriving flux times `F0` \[W\]; with emission `sg` the radiant intensity on the axis of the lobe \[W/sr\].
    pub f0: [f32; 3],
    /// GGX `alpha`: root of the mean square. Along the tangent where surfaces have two roughnesses.
    pub alpha: f32,
    /// Arriving flux times `F90` \[W\].
    pub f90: [f32; 3],
    /// As [`DiffuseVsgl::bulge`] \[m\].
    pub bulge: f32,
    /// Covariance of positions, xx yy zz xy xz yz \[m²\].
    pub covariance: [f32; 6],
    /// GGX roughness across the tangent. Zero where the plan has no anisotropic senders; likewise `turn`.
    pub across: f32,
    /// Direction of the tangent about `axis`, see [`turn_of`](crate::sg::anisotropic::turn_of).
    pub turn: f32,
}

/// A real point of a cluster's surface, drawn by weight: the mean of a curved cluster lies inside the object.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Target {
    /// Position \[m\].
    pub position: [f32; 3],
    /// Zero.
    pub padding: f32,
    /// Unit geometric normal on the lit side.
    pub normal: [f32; 3],
    /// Zero.
    pub padding_normal: f32,
}

impl Vsgls {
    /// Number of the first cluster that shines by itself; those after it do too. The number of clusters where none does.
    pub fn first_emitter(&self) -> usize {
        let shines = |light: &DiffuseVsgl| light.light == [0.0; 3];
        self.diffuse
            .iter()
            .position(shines)
            .unwrap_or(self.diffuse.len())
    }
}

impl Element for DiffuseVsgl {
    const SCALAR: Scalar = Scalar::F32;
}
impl Element for SpecularVsgl {
    const SCALAR: Scalar = Scalar::F32;
}
impl Element for Target {
    const SCALAR: Scalar = Scalar::F32;
}
