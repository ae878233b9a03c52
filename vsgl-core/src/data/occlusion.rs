//! What blocks the light of clusters: imperfect shadow maps.

use super::columns::columns;

columns! {
    /// A shadow map for each cluster, `side²` texels each, one map after the other, row-major.
    ///
    /// A map covers the hemisphere above its cluster's target; [`MapFrame`](crate::phase::occlusion::MapFrame) says which
    /// texel holds which direction.
    pub struct Occlusion = "occlusion" {
        head {
            /// Number of maps: that of the clusters.
            maps,
            /// Texels along a side of a map.
            side,
        }
        /// Distance from the target to the nearest surface in the direction of the texel \[m\]; `f32::MAX` where there is
        /// none.
        depth: f32,
    }
}
