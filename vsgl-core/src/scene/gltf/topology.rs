//! Lists, strips and fans of triangles.

/// How consecutive vertices make triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Topology {
    List,
    Strip,
    Fan,
}

impl Topology {
    /// Number of whole triangles from `count` vertices.
    pub(super) fn triangles(self, count: usize) -> usize {
        match self {
            Self::List => count / 3,
            Self::Strip | Self::Fan => count.saturating_sub(2),
        }
    }

    /// Which vertices triangle `index` has.
    ///
    /// Source: glTF 2.0 specification, 3.7.2.1. Every second triangle of a strip is turned, so that all face one way.
    pub(super) fn triangle(self, index: usize) -> [usize; 3] {
        match self {
            Self::List => [3 * index, 3 * index + 1, 3 * index + 2],
            Self::Strip => [index, index + 1 + index % 2, index + 2 - index % 2],
            Self::Fan => [index + 1, index + 2, 0],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Topology::{Fan, List, Strip};

    #[test]
    fn a_strip_keeps_its_orientation() {
        let t: Vec<_> = (0..Strip.triangles(5)).map(|i| Strip.triangle(i)).collect();
        assert_eq!(t, [[0, 1, 2], [1, 3, 2], [2, 3, 4]]);
    }

    #[test]
    fn a_fan_turns_about_its_first_vertex() {
        let t: Vec<_> = (0..Fan.triangles(5)).map(|i| Fan.triangle(i)).collect();
        assert_eq!(t, [[1, 2, 0], [2, 3, 0], [3, 4, 0]]);
    }

    #[test]
    fn too_few_vertices_make_no_triangle() {
        for count in 0..3 {
            for topology in [List, Strip, Fan] {
                assert_eq!(topology.triangles(count), 0);
            }
        }
        assert_eq!(List.triangles(8), 2);
    }
}
