//! Which triangles share which vertices.

use std::collections::HashMap;

/// Triangles with indices into a list of only those vertices that they use, and that list.
pub(super) fn compact(mut triangles: Vec<[u32; 3]>, vertices: usize) -> (Vec<[u32; 3]>, Vec<u32>) {
    let mut sources = Vec::new();
    let corners = triangles.as_flattened_mut();
    // A table as long as the attributes pays only if much of it is used.
    if vertices / 8 <= corners.len() {
        let mut places = vec![u32::MAX; vertices];
        for corner in corners.iter_mut() {
            let place = &mut places[*corner as usize];
            if *place == u32::MAX {
                *place = sources.len() as u32;
                sources.push(*corner);
            }
            *corner = *place;
        }
    } else {
        let mut places = HashMap::new();
        for corner in corners.iter_mut() {
            let place = *places.entry(*corner).or_insert_with(|| {
                sources.push(*corner);
                (sources.len() - 1) as u32
            });
            *corner = place;
        }
    }
    (triangles, sources)
}

/// Triangles that share no vertex, so that each can have its own normal.
pub(super) fn unshared(triangles: Vec<[u32; 3]>) -> (Vec<[u32; 3]>, Vec<u32>) {
    let own = |i: u32| [3 * i, 3 * i + 1, 3 * i + 2];
    let numbered = (0..triangles.len() as u32).map(own).collect();
    (numbered, triangles.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_vertices_in_use_are_kept_however_many_there_are() {
        let triangles = vec![[7, 3, 9], [9, 3, 4]];
        for vertices in [10, 1_000_000] {
            let (numbered, sources) = compact(triangles.clone(), vertices);
            assert_eq!(numbered, [[0, 1, 2], [2, 1, 3]]);
            assert_eq!(sources, [7, 3, 9, 4]);
        }
    }

    #[test]
    fn unshared_triangles_have_their_own_corners() {
        let (numbered, sources) = unshared(vec![[7, 3, 9], [9, 3, 4]]);
        assert_eq!(numbered, [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(sources, [7, 3, 9, 9, 3, 4]);
    }
}
