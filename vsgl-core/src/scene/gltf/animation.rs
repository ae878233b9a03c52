//! What animations make of the nodes at one moment.

use super::accessor::Vectors;
use super::buffers::Buffers;
use super::document::{Document, lookup};
use super::fault::{Fault, Result};
use glam::{DQuat, DVec4};
use gltf::json::animation::{Animation, Channel, Interpolation, Property};
use gltf::json::validation::Checked;
use gltf::json::{Accessor, Index};
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Nodes that are not as the file writes them.
#[derive(Default)]
pub(super) struct Pose {
    nodes: HashMap<usize, Change>,
}

/// What stands in the place of a node's own.
#[derive(Default)]
pub(super) struct Change {
    pub(super) translation: Option<[f64; 3]>,
    pub(super) rotation: Option<[f64; 4]>,
    pub(super) scale: Option<[f64; 3]>,
    pub(super) weights: Option<Vec<f32>>,
}

impl Pose {
    /// What node `index` is changed to.
    pub(super) fn of(&self, index: usize) -> Option<&Change> {
        self.nodes.get(&index)
    }

    /// The pose `time` seconds after the beginning of all animations of the file; where two move the same, the first has
    /// its way. Before its first key and after its last an animation stands still.
    pub(super) fn at(document: &Document, buffers: &Buffers<'_>, time: f64) -> Result<Self> {
        let mut nodes: HashMap<usize, Change> = HashMap::new();
        let mut moved = HashMap::new();
        for (i, animation) in document.root.animations.iter().enumerate() {
            for (k, channel) in animation.channels.iter().enumerate() {
                let Checked::Valid(property) = channel.target.path else {
                    continue;
                };
                let node = channel.target.node.value();
                let here = || format!("animations[{i}].channels[{k}]");
                let place = || format!("{}.target.node", here());
                lookup(&document.root.nodes, "nodes", node, place)?;
                let Entry::Vacant(entry) = moved.entry((node, property as u8)) else {
                    continue;
                };
                entry.insert(());
                let curve = Curve {
                    document,
                    buffers,
                    animation,
                    place: format!("animations[{i}]"),
                };
                curve.set(
                    channel,
                    property,
                    time,
                    nodes.entry(node).or_default(),
                    here,
                )?;
            }
        }
        Ok(Self { nodes })
    }
}

/// The curves of an animation.
struct Curve<'a> {
    document: &'a Document,
    buffers: &'a Buffers<'a>,
    animation: &'a Animation,
    /// JSON path of the animation.
    place: String,
}

impl Curve<'_> {
    fn set(
        &self,
        channel: &Channel,
        property: Property,
        time: f64,
        change: &mut Change,
        here: impl Fn() -> String,
    ) -> Result<()> {
        match property {
            Property::Translation => change.translation = self.value(channel, time, here, mix)?,
            Property::Scale => change.scale = self.value(channel, time, here, mix)?,
            Property::Rotation => change.rotation = self.value(channel, time, here, turn)?,
            Property::MorphTargetWeights => change.weights = self.weights(channel, time, here)?,
        }
        Ok(())
    }

    /// The value of a curve of `N` numbers; `between` is what a linear one does. None for a curve without keys.
    fn value<const N: usize>(
        &self,
        channel: &Channel,
        time: f64,
        here: impl Fn() -> String,
        between: fn([f64; N], [f64; N], f64) -> [f64; N],
    ) -> Result<Option<[f64; N]>> {
        let (sampler, kind, times) = self.sampler(channel, here)?;
        let place = || format!("{}.output", self.path(channel));
        let output = self.vectors::<N>(sampler, place)?;
        let Some(step) = Step::at(&times, time) else {
            return Ok(None);
        };
        self.check(output.len(), times.len() * per_key(kind), channel)?;
        let key = |index: u32| output.get(index).map(f64::from);
        let value = match kind {
            Interpolation::Step => key(step.before),
            Interpolation::Linear => between(key(step.before), key(step.after), step.share),
            Interpolation::CubicSpline => {
                let [w0, v0, w1, v1] = step.hermite();
                let parts = [
                    (3 * step.before + 1, w0),
                    (3 * step.before + 2, v0),
                    (3 * step.after + 1, w1),
                    (3 * step.after, v1),
                ];
                let parts = parts.map(|(index, weight)| key(index).map(|x| x * weight));
                std::array::from_fn(|i| parts.iter().map(|part| part[i]).sum())
            }
        };
        Ok(Some(value))
    }

    /// The weights of morph targets: all those of a key stand one behind the other.
    fn weights(
        &self,
        channel: &Channel,
        time: f64,
        here: impl Fn() -> String,
    ) -> Result<Option<Vec<f32>>> {
        /// More morph targets than anybody has.
        const MOST: usize = 1 << 12;
        let (sampler, kind, times) = self.sampler(channel, here)?;
        let place = || format!("{}.output", self.path(channel));
        let output = self.vectors::<1>(sampler, place)?;
        let Some(step) = Step::at(&times, time) else {
            return Ok(None);
        };
        let parts = times.len() * per_key(kind);
        let count = output.len() / parts;
        self.check(output.len(), parts, channel)?;
        let count = count.min(MOST) as u32;
        let stride = (output.len() / parts) as u32;
        let key = |part: u32, target: u32| f64::from(output.get(part * stride + target)[0]);
        let value = |target| match kind {
            Interpolation::Step => key(step.before, target),
            Interpolation::Linear => {
                let (a, b) = (key(step.before, target), key(step.after, target));
                a + (b - a) * step.share
            }
            Interpolation::CubicSpline => {
                let [w0, v0, w1, v1] = step.hermite();
                let before = key(3 * step.before + 1, target) * w0;
                let leaving = key(3 * step.before + 2, target) * v0;
                let after = key(3 * step.after + 1, target) * w1;
                before + leaving + after + key(3 * step.after, target) * v1
            }
        };
        Ok(Some(
            (0..count).map(|target| value(target) as f32).collect(),
        ))
    }

    /// Accessor of the values, kind and times of the keys of a channel.
    fn sampler(
        &self,
        channel: &Channel,
        here: impl Fn() -> String,
    ) -> Result<(Index<Accessor>, Interpolation, Vectors<'_, 1>)> {
        let samplers = &self.animation.samplers;
        let place = || format!("{}.sampler", here());
        let sampler = lookup(samplers, "samplers", channel.sampler.value(), place)?;
        let Checked::Valid(kind) = sampler.interpolation else {
            let place = format!("{}.interpolation", self.path(channel));
            return Err(Fault::new(place, "is not one of glTF 2.0", BROKEN));
        };
        let place = || format!("{}.input", self.path(channel));
        let times = self.vectors(sampler.input, place)?;
        // Three times as many are still numbers of 32 bits.
        if times.len() > 1 << 30 {
            let place = format!("{}.input", self.path(channel));
            return Err(Fault::new(
                place,
                "has more keys than can be told apart",
                BROKEN,
            ));
        }
        Ok((sampler.output, kind, times))
    }

    fn vectors<const N: usize>(
        &self,
        index: Index<Accessor>,
        place: impl FnOnce() -> String,
    ) -> Result<Vectors<'_, N>> {
        Vectors::new(self.document, self.buffers, index, place)
    }

    fn check(&self, values: usize, needed: usize, channel: &Channel) -> Result<()> {
        if values >= needed && values <= u32::MAX as usize {
            return Ok(());
        }
        Err(Fault::new(
            format!("{}.output", self.path(channel)),
            format!("{values} values where the keys need {needed}"),
            BROKEN,
        ))
    }

    fn path(&self, channel: &Channel) -> String {
        format!("{}.samplers[{}]", self.place, channel.sampler.value())
    }
}

const BROKEN: &str = "the file is broken; export it again";

/// Values that stand at each key.
fn per_key(kind: Interpolation) -> usize {
    match kind {
        Interpolation::Step | Interpolation::Linear => 1,
        Interpolation::CubicSpline => 3,
    }
}

/// The two keys around a moment.
#[derive(Debug, PartialEq)]
struct Step {
    before: u32,
    after: u32,
    /// How far it is from the first to the second, 0..=1.
    share: f64,
    /// Seconds from the first to the second.
    length: f64,
}

impl Step {
    /// None without keys.
    fn at(times: &Vectors<'_, 1>, time: f64) -> Option<Self> {
        let time_of = |index: u32| f64::from(times.get(index)[0]);
        let last = (times.len() as u32).checked_sub(1)?;
        // The first key later than the moment, if any.
        let (mut low, mut high) = (0, last + 1);
        while low < high {
            let middle = low + (high - low) / 2;
            if time_of(middle) <= time {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        let (before, after) = (low.saturating_sub(1), low.min(last));
        let length = time_of(after) - time_of(before);
        let share = (time - time_of(before)) / length;
        Some(Self {
            before,
            after,
            share: if length > 0.0 {
                share.clamp(0.0, 1.0)
            } else {
                0.0
            },
            length: if length > 0.0 { length } else { 0.0 },
        })
    }

    /// Weights of the first value, of what leaves it, of the second value, of what reaches it.
    ///
    /// Source: glTF 2.0 specification, appendix C.5 (cubic spline interpolation).
    fn hermite(&self) -> [f64; 4] {
        let t = self.share;
        let (square, cube) = (t * t, t * t * t);
        [
            2.0 * cube - 3.0 * square + 1.0,
            self.length * (cube - 2.0 * square + t),
            3.0 * square - 2.0 * cube,
            self.length * (cube - square),
        ]
    }
}

fn mix<const N: usize>(a: [f64; N], b: [f64; N], share: f64) -> [f64; N] {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * share)
}

/// The shorter way from one rotation to another, at an even pace.
fn turn(a: [f64; 4], b: [f64; 4], share: f64) -> [f64; 4] {
    let unit = |q: [f64; 4]| DVec4::from_array(q).try_normalize();
    match (unit(a), unit(b)) {
        (Some(a), Some(b)) => DQuat::from_vec4(a)
            .slerp(DQuat::from_vec4(b), share)
            .to_array(),
        _ => a,
    }
}
