//! The density from which kernel centres are drawn.

use super::columns::columns;

columns! {
    /// Density on the texels of a [`super::Rsm`] with its mip levels, for sampling clusters.
    pub struct Pdf = "pdf" {
        head {
            /// Texels along a side of level 0, a power of two.
            size,
            /// Number of maps.
            maps,
        }
        /// Weight of each texel of each level: level 0 of all maps, then level 1, down to one texel a map. Watts with the
        /// density `flux`; with others only those of one map are to be compared.
        /// A texel is the sum of the four below it, added `(a + b) + (c + d)`.
        weight: f32,
        /// Lights of each map, shared out by flux; they add up to the number asked for.
        share: u32,
    }
}
