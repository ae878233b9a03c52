//! How many triangles lie in one place.

use super::traverse::BvhNode;
use glam::Vec3;

/// Places at which [`overlap`] counts.
const PLACES: usize = 512;

/// The most triangles whose leaves hold one point, counted at the centres of up to 512 leaves; counting ends above
/// `most`.
///
/// A ray through such a point tests about as many triangles, however good the hierarchy is: thousands of copies in one
/// place make pictures thousands of times slower. In ordinary scenes it is below a hundred.
pub fn overlap(nodes: &[BvhNode], most: u64) -> u64 {
    let leaves: Vec<&BvhNode> = nodes.iter().filter(|node| node.count > 0).collect();
    let mut worst = 0;
    for leaf in leaves.iter().step_by(leaves.len().div_ceil(PLACES).max(1)) {
        let centre = 0.5 * (Vec3::from_array(leaf.min) + Vec3::from_array(leaf.max));
        worst = worst.max(stabbed(nodes, centre, most));
        if worst > most {
            break;
        }
    }
    worst
}

/// Triangles of the leaves that hold the point; counting ends above `most`.
fn stabbed(nodes: &[BvhNode], point: Vec3, most: u64) -> u64 {
    let mut open: Vec<u32> = if nodes.is_empty() { vec![] } else { vec![0] };
    let mut count = 0;
    while let Some(index) = open.pop() {
        let node = &nodes[index as usize];
        let (min, max) = (Vec3::from_array(node.min), Vec3::from_array(node.max));
        if point.cmplt(min).any() || point.cmpgt(max).any() {
            continue;
        }
        if node.count == 0 {
            open.extend([node.first, node.first + 1]);
        } else {
            count += u64::from(node.count);
            if count > most {
                break;
            }
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::super::build;
    use super::*;

    fn triangle(x: f32, size: f32) -> [f32; 9] {
        [x, 0.0, 0.0, x + size, 0.0, 0.0, x, size, 0.3 * size]
    }

    #[test]
    fn copies_in_one_place_are_counted_and_neighbours_are_not() {
        let row: Vec<_> = (0..5000).map(|i| triangle(i as f32, 0.9)).collect();
        assert!(overlap(&build(&row).nodes, 1000) < 16);
        // One in ten is a copy of the same.
        let mut some = row.clone();
        for copy in some.iter_mut().step_by(10) {
            *copy = triangle(7.0, 0.9);
        }
        let found = overlap(&build(&some).nodes, 1000);
        assert!((500..520).contains(&found), "{found}");
        assert!(overlap(&build(&some).nodes, 100) > 100);
        let nested: Vec<_> = (0..3000)
            .map(|i| triangle(0.0, 1.0 + i as f32 * 1e-3))
            .collect();
        assert!(overlap(&build(&nested).nodes, 1000) > 1000);
        assert_eq!(overlap(&[], 10), 0);
    }
}
