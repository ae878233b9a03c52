//! Building the hierarchy, once for all backends.

use super::traverse::{BvhNode, STACK};
use glam::Vec3;
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use std::time::Duration;

/// A hierarchy over triangles.
#[derive(Clone, Debug, Default)]
pub struct Bvh {
    /// Nodes, root first; the two children of an inner node are neighbours.
    pub nodes: Vec<BvhNode>,
    /// The triangles in the order that leaves count in.
    pub order: Vec<u32>,
}

/// Builds the hierarchy over triangles given by their corners.
///
/// Serial and deterministic. No path from the root is longer than the stack of the traversal: where the builder
/// makes a deeper tree (many copies of one triangle do it), a balanced one over the same order is taken.
pub fn build(corners: &[[f32; 9]]) -> Bvh {
    if corners.is_empty() {
        return Bvh::default();
    }
    let boxes: Vec<Aabb> = corners.iter().map(box_of).collect();
    let mut time = Duration::ZERO;
    let tree = build_bvh2(&boxes, BvhBuildParams::fast_build(), &mut time);
    let nodes: Vec<BvhNode> = tree
        .nodes
        .iter()
        .map(|node| {
            let (min, max) = (node.aabb().min, node.aabb().max);
            BvhNode {
                min: [min.x, min.y, min.z],
                first: node.first_index,
                max: [max.x, max.y, max.z],
                count: node.prim_count,
            }
        })
        .collect();
    let order = order_of(&tree, corners.len());
    if depth(&nodes) < STACK {
        Bvh { nodes, order }
    } else {
        balanced(&boxes, order)
    }
}

fn box_of(corner: &[f32; 9]) -> Aabb {
    let mut aabb = Aabb::empty();
    for point in corner.chunks_exact(3) {
        aabb.extend(Vec3::new(point[0], point[1], point[2]).into());
    }
    aabb
}

fn order_of(tree: &Bvh2, count: usize) -> Vec<u32> {
    debug_assert_eq!(tree.primitive_indices.len(), count);
    tree.primitive_indices.clone()
}

/// Inner nodes on the longest path from the root.
fn depth(nodes: &[BvhNode]) -> usize {
    let mut open = vec![(0usize, 0usize)];
    let mut deepest = 0;
    while let Some((index, above)) = open.pop() {
        let node = nodes[index];
        deepest = deepest.max(above);
        if node.count == 0 {
            open.push((node.first as usize, above + 1));
            open.push((node.first as usize + 1, above + 1));
        }
    }
    deepest
}

/// A tree that halves the order again and again, leaves of at most four.
fn balanced(boxes: &[Aabb], order: Vec<u32>) -> Bvh {
    let mut nodes = vec![BvhNode::default()];
    let mut open = vec![(0usize, 0usize, order.len())];
    while let Some((index, start, end)) = open.pop() {
        let mut around = Aabb::empty();
        for &triangle in &order[start..end] {
            around = around.union(&boxes[triangle as usize]);
        }
        let (min, max) = (around.min, around.max);
        let mut node = BvhNode {
            min: [min.x, min.y, min.z],
            first: start as u32,
            max: [max.x, max.y, max.z],
            count: (end - start) as u32,
        };
        if end - start > 4 {
            let middle = start + (end - start) / 2;
            node.first = nodes.len() as u32;
            node.count = 0;
            open.push((nodes.len(), start, middle));
            open.push((nodes.len() + 1, middle, end));
            nodes.extend([BvhNode::default(); 2]);
        }
        nodes[index] = node;
    }
    Bvh { nodes, order }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_triangle_is_in_one_leaf_and_copies_do_not_deepen_the_tree() {
        let spread = |i: usize| {
            let (x, y) = ((i % 37) as f32, (i / 37) as f32);
            [x, y, 0.0, x + 0.9, y, 0.1, x, y + 0.9, 0.2]
        };
        for corners in [
            (0..1000).map(spread).collect::<Vec<_>>(),
            vec![spread(3); 3000],
            vec![spread(0)],
        ] {
            let bvh = build(&corners);
            let mut seen = vec![0; corners.len()];
            for node in bvh.nodes.iter().filter(|n| n.count > 0) {
                for &triangle in &bvh.order[node.first as usize..(node.first + node.count) as usize]
                {
                    seen[triangle as usize] += 1;
                }
            }
            assert!(seen.iter().all(|&n| n == 1));
            assert!(depth(&bvh.nodes) < STACK);
            let boxes: Vec<Aabb> = corners.iter().map(box_of).collect();
            let fallback = balanced(&boxes, bvh.order);
            assert!(depth(&fallback.nodes) <= 12);
        }
    }
}
