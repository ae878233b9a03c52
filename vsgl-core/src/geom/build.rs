//! Building the hierarchy, once for all backends.

use super::traverse::{BvhNode, STACK};
use glam::Vec3;

/// A hierarchy over triangles.
#[derive(Clone, Debug, Default)]
pub struct Bvh {
    /// Nodes, root first; the two children of an inner node are neighbours.
    pub nodes: Vec<BvhNode>,
    /// The triangles in the order that leaves count in.
    pub order: Vec<u32>,
}

/// Planes that are tried along an axis, and one more.
const BINS: usize = 16;
/// Most triangles of a leaf.
pub const LEAF: usize = 8;
/// Cost of a step to the children, in tests of a triangle.
const STEP: f32 = 3.0;
/// Longest path from the root, in inner nodes.
const DEPTH: u32 = STACK as u32 - 2;

/// Builds the hierarchy over triangles given by their corners.
///
/// Serial and deterministic. Each split is the cheapest of 15 planes along each axis by the surface area heuristic; where
/// no plane parts the triangles, as with copies in one place, or where the tree is already deep, the range is halved.
/// So the time is bounded by `n log n` whatever the triangles are, and no path from the root is longer than the stack
/// of the traversal: local clustering, which is faster on ordinary scenes, takes time `n²` on copies.
///
/// Source: Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".
pub fn build(corners: &[[f32; 9]]) -> Bvh {
    if corners.is_empty() {
        return Bvh::default();
    }
    let mut items: Vec<Item> = corners.iter().zip(0..).map(Item::of).collect();
    let mut nodes = vec![BvhNode::default()];
    let mut open = vec![Range {
        node: 0,
        start: 0,
        end: items.len(),
        depth: 0,
    }];
    nodes.reserve(items.len() / 2);
    while let Some(range) = open.pop() {
        let part = &mut items[range.start..range.end];
        let around = part
            .iter()
            .fold(Aabb::EMPTY, |all, item| all.with(&item.aabb));
        let middle = split(part, &around, range.depth).map(|middle| range.start + middle);
        let (first, count) = match middle {
            None => (range.start, range.end - range.start),
            Some(_) => (nodes.len(), 0),
        };
        nodes[range.node] = BvhNode {
            min: around.min.to_array(),
            first: first as u32,
            max: around.max.to_array(),
            count: count as u32,
        };
        if let Some(middle) = middle {
            let child = |node, start, end| Range {
                node,
                start,
                end,
                depth: range.depth + 1,
            };
            // The left one is taken from the stack first: what is near in space stays near in memory.
            open.push(child(first + 1, middle, range.end));
            open.push(child(first, range.start, middle));
            nodes.extend([BvhNode::default(); 2]);
        }
    }
    Bvh {
        nodes,
        order: items.iter().map(|item| item.triangle).collect(),
    }
}

/// Triangles that a node is to hold.
struct Range {
    node: usize,
    start: usize,
    end: usize,
    depth: u32,
}

/// A triangle's box.
#[derive(Clone, Copy)]
struct Item {
    aabb: Aabb,
    triangle: u32,
}

impl Item {
    fn of((corner, triangle): (&[f32; 9], u32)) -> Self {
        let point = |i: usize| Vec3::new(corner[i], corner[i + 1], corner[i + 2]);
        let (a, b, c) = (point(0), point(3), point(6));
        Self {
            aabb: Aabb {
                min: a.min(b).min(c),
                max: a.max(b).max(c),
            },
            triangle,
        }
    }

    /// Halved before the sum, which may not fit otherwise.
    fn centre(&self) -> Vec3 {
        0.5 * self.aabb.min + 0.5 * self.aabb.max
    }
}

#[derive(Clone, Copy)]
struct Aabb {
    min: Vec3,
    max: Vec3,
}

impl Aabb {
    const EMPTY: Self = Self {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };

    fn with(&self, other: &Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// Half of the surface; zero if nothing is inside.
    fn area(&self) -> f32 {
        let d = (self.max - self.min).max(Vec3::ZERO);
        d.x * d.y + d.y * d.z + d.z * d.x
    }
}

/// Orders the items so that those of the left child come first, and returns how many they are; none for a leaf.
fn split(items: &mut [Item], around: &Aabb, depth: u32) -> Option<usize> {
    let count = items.len();
    if count == 1 {
        return None;
    }
    // Halving what is left must still fit below.
    let best = if depth + count.ilog2() + 1 < DEPTH {
        cheapest(items)
    } else {
        None
    };
    let halves = (count > LEAF).then_some(count / 2);
    let Some(best) = best else {
        return halves;
    };
    let whole = around.area() * count as f32;
    if count <= LEAF && around.area() * STEP + best.cost >= whole {
        return None;
    }
    let left = partition(items, |item| best.grid.bin(item)[best.axis] < best.bin);
    // Rounding cannot empty a side, since both had items when they were counted.
    Some(left)
}

/// A plane, and what it costs: the sum of the areas on both sides, each times its number of triangles.
struct Plane {
    grid: Grid,
    axis: usize,
    /// First bin on the right.
    bin: usize,
    cost: f32,
}

/// Equal parts of the box around the centres, along each axis.
#[derive(Clone, Copy)]
struct Grid {
    low: Vec3,
    scale: Vec3,
}

impl Grid {
    fn over(low: Vec3, high: Vec3) -> Self {
        let extent = high - low;
        let scale = |e: f32| {
            let scale = BINS as f32 / e;
            if scale.is_finite() { scale } else { 0.0 }
        };
        Self {
            low,
            scale: Vec3::new(scale(extent.x), scale(extent.y), scale(extent.z)),
        }
    }

    fn bin(&self, item: &Item) -> [usize; 3] {
        let place = (item.centre() - self.low) * self.scale;
        // `as` turns what is no number into 0.
        place.to_array().map(|p| (p as usize).min(BINS - 1))
    }
}

/// The cheapest plane that leaves something on both sides; none if there is no such plane.
fn cheapest(items: &[Item]) -> Option<Plane> {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for item in items {
        let centre = item.centre();
        low = low.min(centre);
        high = high.max(centre);
    }
    let grid = Grid::over(low, high);
    let mut bins = [[(Aabb::EMPTY, 0u32); BINS]; 3];
    for item in items {
        let place = grid.bin(item);
        for axis in 0..3 {
            let (aabb, count) = &mut bins[axis][place[axis]];
            *aabb = aabb.with(&item.aabb);
            *count += 1;
        }
    }
    let mut best: Option<Plane> = None;
    for axis in (0..3).filter(|&axis| grid.scale[axis] > 0.0) {
        // From the right: what lies at and behind each plane.
        let mut behind = [(0.0f32, 0u32); BINS];
        let (mut aabb, mut count) = (Aabb::EMPTY, 0);
        for bin in (1..BINS).rev() {
            aabb = aabb.with(&bins[axis][bin].0);
            count += bins[axis][bin].1;
            behind[bin] = (aabb.area(), count);
        }
        let (mut aabb, mut count) = (Aabb::EMPTY, 0);
        for bin in 1..BINS {
            aabb = aabb.with(&bins[axis][bin - 1].0);
            count += bins[axis][bin - 1].1;
            let (area, rest) = behind[bin];
            let cost = aabb.area() * count as f32 + area * rest as f32;
            let cheaper = best.as_ref().is_none_or(|best| cost < best.cost);
            if count > 0 && rest > 0 && cheaper {
                best = Some(Plane {
                    grid,
                    axis,
                    bin,
                    cost,
                });
            }
        }
    }
    best
}

/// Puts the items of the left side first; returns how many they are.
fn partition(items: &mut [Item], is_left: impl Fn(&Item) -> bool) -> usize {
    let (mut start, mut end) = (0, items.len());
    loop {
        while start < end && is_left(&items[start]) {
            start += 1;
        }
        while start < end && !is_left(&items[end - 1]) {
            end -= 1;
        }
        if start == end {
            return start;
        }
        items.swap(start, end - 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Instant;

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

    fn right(x: f32, y: f32, size: f32) -> [f32; 9] {
        [x, y, 0.0, x + size, y, 0.1 * size, x, y + size, 0.2 * size]
    }

    /// Triangles that part badly, and the usual.
    fn sets() -> Vec<(&'static str, Vec<[f32; 9]>)> {
        let row = |count: i32, f: fn(i32) -> [f32; 9]| (0..count).map(f).collect::<Vec<_>>();
        vec![
            (
                "a field",
                row(1000, |i| right((i % 37) as f32, (i / 37) as f32, 0.9)),
            ),
            ("copies", vec![right(3.0, 4.0, 1.0); 30_000]),
            ("one", vec![right(0.0, 0.0, 1.0)]),
            (
                "nested",
                row(30_000, |i| right(0.0, 0.0, 1.0 + i as f32 * 1e-3)),
            ),
            (
                "powers",
                row(200, |i| {
                    right(2f32.powi(i / 2 - 60), 0.0, 2f32.powi(i / 2 - 62))
                }),
            ),
            (
                "shrinking gaps",
                row(30_000, |i| right((1.0 + i as f32).ln(), 0.0, 1e-4)),
            ),
            (
                "roundings",
                row(30_000, |i| {
                    right(f32::from_bits(0x3f80_0000 + i as u32), 0.0, 1e-7)
                }),
            ),
            (
                "far and wide",
                row(30_000, |i| {
                    right(1e9 * (i % 7) as f32, 1e9 * (i % 11) as f32, 1e-9)
                }),
            ),
            ("points", vec![[1e-40; 9]; 3000]),
        ]
    }

    #[test]
    fn every_triangle_is_in_one_leaf_and_no_path_is_too_long() {
        for (name, corners) in sets() {
            let start = Instant::now();
            let bvh = build(&corners);
            // Where time grows with the square, it takes minutes.
            assert!(
                start.elapsed().as_secs_f32() < 5.0,
                "{name}: {:?}",
                start.elapsed()
            );
            let mut seen = vec![0; corners.len()];
            for node in bvh.nodes.iter().filter(|n| n.count > 0) {
                assert!(node.count as usize <= LEAF, "{name}");
                for &triangle in &bvh.order[node.first as usize..(node.first + node.count) as usize]
                {
                    seen[triangle as usize] += 1;
                }
            }
            assert!(seen.iter().all(|&n| n == 1), "{name}");
            assert!(depth(&bvh.nodes) < STACK, "{name}: {}", depth(&bvh.nodes));
        }
    }

    #[test]
    fn boxes_hold_what_is_below() {
        for (name, corners) in sets() {
            let bvh = build(&corners);
            let inside = |outer: &BvhNode, min: [f32; 3], max: [f32; 3]| {
                (0..3).all(|k| outer.min[k] <= min[k] && max[k] <= outer.max[k])
            };
            for node in &bvh.nodes {
                let first = node.first as usize;
                if node.count == 0 {
                    for child in &bvh.nodes[first..first + 2] {
                        assert!(inside(node, child.min, child.max), "{name}");
                    }
                }
                for &triangle in &bvh.order[first..first + node.count as usize] {
                    let aabb = Item::of((&corners[triangle as usize], 0)).aabb;
                    assert!(
                        inside(node, aabb.min.to_array(), aabb.max.to_array()),
                        "{name}"
                    );
                }
            }
        }
    }
}
