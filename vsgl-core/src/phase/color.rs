//! Colours of vertices.

use super::footprint::Place;
use crate::data::SceneData;

/// Colour and opacity of the vertices at a place, between them. The scene must have the column.
pub fn of_vertices(scene: &SceneData, place: &Place) -> [f32; 4] {
    let c = &scene.corner_color[place.triangle as usize];
    std::array::from_fn(|i| (c[i] + (c[i + 4] - c[i]) * place.u) + (c[i + 8] - c[i]) * place.v)
}
