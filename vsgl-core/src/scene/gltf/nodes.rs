//! The tree of nodes, flattened.

use super::animation::{Change, Pose};
use super::document::{Document, lookup};
use super::fault::{Fault, Result};
use glam::{DMat4, DQuat, DVec3, DVec4, Vec3};
use gltf::json::{Node, Value};

/// Largest distance from the scene's origin that is accepted \[m\]: with more, squares of squares leave the range of f32.
pub(super) const LARGEST: f64 = 1e9;

/// A node with its transform to the world.
pub(super) struct Placed<'a> {
    pub(super) index: usize,
    pub(super) node: &'a Node,
    /// Weights of the morph targets of its mesh, if they are not the mesh's own.
    pub(super) weights: Option<&'a [f32]>,
    pub(super) world: DMat4,
}

impl Placed<'_> {
    /// Where the node is, relative to `origin`; none if it is too far off.
    pub(super) fn position(&self, origin: DVec3) -> Option<Vec3> {
        let position = self.world.w_axis.truncate() - origin;
        (position.abs().max_element() <= LARGEST).then(|| position.as_vec3())
    }
}

/// The nodes of the scene.
pub(super) struct Tree<'a> {
    /// Those that hold anything, in the order of the file.
    pub(super) placed: Vec<Placed<'a>>,
    /// Transforms to the world of all of them, by the index of the file; none for nodes of other scenes. Empty in a
    /// file without skins, which alone ask for it.
    pub(super) worlds: Vec<Option<DMat4>>,
}

/// Goes from the roots of a scene, which exists, to all its nodes; without one from every node that has no parent.
pub(super) fn walk<'a>(
    document: &'a Document,
    scene: Option<usize>,
    pose: &'a Pose,
) -> Result<Tree<'a>> {
    let root = &document.root;
    let mut worlds = vec![
        None;
        if root.skins.is_empty() {
            0
        } else {
            root.nodes.len()
        }
    ];
    let mut seen = Seen(vec![false; document.root.nodes.len()]);
    let mut placed = Vec::new();
    // A stack of our own: depth is the file's to choose.
    let mut waiting = Vec::new();
    for (index, place) in roots(document, scene) {
        seen.enter(index, || place.clone())?;
        waiting.push((index, DMat4::IDENTITY));
    }
    while let Some((index, parent)) = waiting.pop() {
        let node = &document.root.nodes[index];
        let change = pose.of(index);
        let world = parent * local(document, index, change)?;
        if !world.is_finite() {
            return Err(Fault::new(
                format!("nodes[{index}]"),
                "its transform, composed with those above it, is not finite",
                "the file is broken; export it again",
            ));
        }
        for child in node.children.iter().flatten() {
            seen.enter(child.value(), || format!("nodes[{index}].children"))?;
            waiting.push((child.value(), world));
        }
        if let Some(slot) = worlds.get_mut(index) {
            *slot = Some(world);
        }
        if node.mesh.is_some() || node.camera.is_some() || node.extensions.is_some() {
            let moved = change.and_then(|change| change.weights.as_deref());
            placed.push(Placed {
                index,
                node,
                weights: moved.or(node.weights.as_deref()),
                world,
            });
        }
    }
    placed.sort_by_key(|p| p.index);
    Ok(Tree { placed, worlds })
}

/// Which nodes have been reached.
struct Seen(Vec<bool>);

impl Seen {
    /// Notes a node; refuses one that does not exist, or that was there before: nodes must form trees.
    fn enter(&mut self, index: usize, place: impl Fn() -> String) -> Result<()> {
        lookup(&self.0, "nodes", index, &place)?;
        if std::mem::replace(&mut self.0[index], true) {
            return Err(Fault::new(
                place(),
                format!("nodes[{index}] is reached twice: nodes must form trees"),
                "the file is broken; export it again",
            ));
        }
        Ok(())
    }
}

/// Where to begin, with its place in the JSON: a scene, which exists, or every node without a parent.
fn roots(document: &Document, scene: Option<usize>) -> Vec<(usize, String)> {
    let root = &document.root;
    let Some(index) = scene else {
        return parentless(&root.nodes);
    };
    let place = format!("scenes[{index}].nodes");
    let nodes = root.scenes[index].nodes.iter();
    nodes.map(|node| (node.value(), place.clone())).collect()
}

fn parentless(nodes: &[Node]) -> Vec<(usize, String)> {
    let mut is_child = vec![false; nodes.len()];
    for child in nodes.iter().flat_map(|n| n.children.iter().flatten()) {
        if let Some(flag) = is_child.get_mut(child.value()) {
            *flag = true;
        }
    }
    let roots = (0..nodes.len()).filter(|&i| !is_child[i]);
    roots.map(|i| (i, "nodes".into())).collect()
}

/// The transform of a node to its parent's space, in the precision of the JSON text.
fn local(document: &Document, index: usize, change: Option<&Change>) -> Result<DMat4> {
    let node = &document.nodes[index];
    if let Some(m) = numbers::<16>(&node["matrix"]) {
        // Animations leave such nodes alone.
        return Ok(DMat4::from_cols_array(&m));
    }
    let translation = change.and_then(|c| c.translation);
    let translation = translation.or_else(|| numbers(&node["translation"]));
    let translation = translation.map_or(DVec3::ZERO, DVec3::from_array);
    let scale = change.and_then(|c| c.scale);
    let scale = scale.or_else(|| numbers(&node["scale"]));
    let scale = scale.map_or(DVec3::ONE, DVec3::from_array);
    let rotation = change.and_then(|c| c.rotation);
    let rotation = rotation.or_else(|| numbers(&node["rotation"]));
    let rotation = rotation.map_or(DVec4::W, DVec4::from_array);
    let unit = rotation.try_normalize().ok_or_else(|| {
        Fault::new(
            format!("nodes[{index}].rotation"),
            format!("{rotation} is no rotation"),
            "a unit quaternion is expected",
        )
    })?;
    Ok(DMat4::from_scale_rotation_translation(
        scale,
        DQuat::from_vec4(unit),
        translation,
    ))
}

/// An array of exactly `N` numbers. The typed parser has already refused anything else that is there.
fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let array = value.as_array().filter(|array| array.len() == N)?;
    let mut numbers = [0.0; N];
    for (number, value) in numbers.iter_mut().zip(array) {
        *number = value.as_f64()?;
    }
    Some(numbers)
}
