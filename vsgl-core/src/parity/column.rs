//! One column of two resources, entry by entry.

use super::meaning::{Group, Kind, Meaning};
use super::place::Layout;
use super::tolerance::{Tolerance, Values};
use super::ulps::ulps;
use super::verdict::{ColumnVerdict, DIFFERENT, UNJUDGED, Worst};
use crate::data::{Column, Scalar};

/// One column on both sides, of one length.
pub(super) struct Pair {
    name: &'static str,
    lanes: usize,
    scalar: Scalar,
    meaning: Meaning,
    tested: Vec<u32>,
    reference: Vec<u32>,
}

impl Pair {
    pub(super) fn new(meaning: Meaning, tested: &Column<'_>, reference: &Column<'_>) -> Self {
        Self {
            name: reference.name,
            lanes: reference.lanes.max(1),
            scalar: reference.scalar,
            meaning,
            tested: bytemuck::pod_collect_to_vec(tested.bytes),
            reference: bytemuck::pod_collect_to_vec(reference.bytes),
        }
    }

    pub(super) fn layout(&self) -> Layout {
        self.meaning.layout
    }

    /// Groups with the number of their first lane.
    fn groups(&self) -> impl Iterator<Item = (usize, &Group)> {
        self.meaning.groups.iter().scan(0, |first, group| {
            let place = *first;
            *first += group.lanes;
            Some((place, group))
        })
    }

    /// Both sides of each entry.
    fn entries(&self) -> impl Iterator<Item = (&[u32], &[u32])> {
        let tested = self.tested.chunks_exact(self.lanes);
        tested.zip(self.reference.chunks_exact(self.lanes))
    }

    /// Lane of the first decision of an entry that differs.
    fn decision(&self, (tested, reference): (&[u32], &[u32])) -> Option<usize> {
        let lanes = self
            .groups()
            .flat_map(|(first, group)| (first..first + group.lanes).map(|l| (l, group.kind)));
        lanes
            .into_iter()
            .find(|&(lane, kind)| differ(kind, tested[lane], reference[lane]))
            .map(|(lane, _)| lane)
    }

    /// Which entries hold a decision that differs.
    pub(super) fn decisions(&self) -> Vec<bool> {
        self.entries().map(|e| self.decision(e).is_some()).collect()
    }

    /// Lights that entries refer to which differ, on either side.
    pub(super) fn lights_in_doubt(&self, differing: &[bool]) -> Vec<bool> {
        let mut lights = Vec::new();
        if !self.meaning.groups.iter().any(|g| g.kind == Kind::Light) {
            return lights;
        }
        // Beyond all lights: no light, or nonsense, which is a difference already.
        let most = crate::settings::Settings::LIGHTS_MAX;
        for ((tested, reference), _) in self.entries().zip(differing).filter(|(_, d)| **d) {
            for &light in tested.iter().chain(reference).filter(|l| **l <= most) {
                let light = light as usize;
                if lights.len() <= light {
                    lights.resize(light + 1, false);
                }
                lights[light] = true;
            }
        }
        lights
    }

    /// Compares; values of entries in `doubt` are not judged.
    pub(super) fn judge(
        &self,
        tolerance: &Tolerance,
        head: &[u32],
        doubt: &[bool],
    ) -> ColumnVerdict {
        let floor = tolerance.values.floor();
        let sizes: Vec<f64> = self
            .groups()
            .map(|(first, group)| self.mean_size(first, group.lanes))
            .collect();
        let mut tally = Tally::new(tolerance.values);
        for (entry, (tested, reference)) in self.entries().enumerate() {
            let mut worst = 0.0f64;
            let mut differs = false;
            let decision = self.decision((tested, reference));
            if let Some(lane) = decision {
                tally.decisions += 1;
                tally.note(Rank::Decision, entry, lane);
                (worst, differs) = (f64::INFINITY, true);
            }
            let judged = decision.is_none() && !doubt.get(entry).copied().unwrap_or(false);
            let excused = !judged && self.has_values();
            tally.unjudged += usize::from(excused);
            for ((first, group), &mean) in self.groups().zip(&sizes) {
                if matches!(group.kind, Kind::Decision | Kind::Light) {
                    continue;
                }
                let number = |bits: &u32| f32::from_bits(*bits);
                let lanes = first..first + group.lanes;
                let sizes = reference[lanes.clone()].iter().map(number);
                let largest = sizes.map(|r| f64::from(r.abs())).fold(0.0, f64::max);
                for lane in lanes {
                    let (t, r) = (number(&tested[lane]), number(&reference[lane]));
                    let distance = ulps(t, r);
                    if distance > 0 && !(t.is_finite() && r.is_finite()) {
                        tally.broken += 1;
                        tally.note(Rank::Broken, entry, lane);
                        (worst, differs) = (f64::INFINITY, true);
                        continue;
                    }
                    if !judged {
                        continue;
                    }
                    let size = match group.kind {
                        Kind::Vector => largest.max(floor * mean),
                        Kind::Points => largest.max(mean),
                        Kind::Magnitudes => f64::from(r.abs()),
                        _ => f64::from(r.abs()).max(floor * mean),
                    };
                    let error = match distance {
                        0 => 0.0,
                        _ => (f64::from(t) - f64::from(r)).abs() / size,
                    };
                    tally.value(distance, error, tolerance.values);
                    if distance > 0 {
                        differs = true;
                        worst = worst.max(error);
                        tally.note(Rank::Value(error), entry, lane);
                    }
                }
            }
            tally.differing += usize::from(differs);
            tally.errors.push(match worst {
                f64::INFINITY => DIFFERENT,
                _ if excused => UNJUDGED,
                error => error as f32,
            });
        }
        self.verdict(tally, tolerance, head)
    }

    fn has_values(&self) -> bool {
        let ids = |g: &Group| matches!(g.kind, Kind::Decision | Kind::Light);
        !self.meaning.groups.iter().all(ids)
    }

    /// Mean size of the reference's numbers in some lanes.
    fn mean_size(&self, first: usize, lanes: usize) -> f64 {
        let (mut sum, mut count) = (0.0, 0usize);
        for (_, reference) in self.entries() {
            for &bits in &reference[first..first + lanes] {
                let number = f32::from_bits(bits);
                if number.is_finite() {
                    sum += f64::from(number.abs());
                    count += 1;
                }
            }
        }
        sum / count.max(1) as f64
    }

    fn verdict(&self, tally: Tally, tolerance: &Tolerance, head: &[u32]) -> ColumnVerdict {
        let entries = self.tested.len() / self.lanes;
        let shares = |over: usize, share: f64| over as f64 <= share * tally.judged as f64;
        let values = match tolerance.values {
            Values::Bits | Values::Relative { .. } => tally.over[0] == 0,
            Values::Shares { steps, .. } => steps
                .iter()
                .zip(&tally.over)
                .all(|(step, &over)| shares(over, step.1)),
        };
        let decisions = tally.decisions as f64 <= tolerance.decisions * entries as f64;
        let worst = tally
            .worst
            .map(|(_, entry, lane)| self.worst(head, entry, lane));
        ColumnVerdict {
            name: self.name,
            entries,
            lanes: self.lanes,
            differing: tally.differing,
            differing_components: tally.components,
            decisions: tally.decisions,
            unjudged: tally.unjudged,
            broken: tally.broken,
            over: tally.over[0],
            ulps: tally.ulps,
            relative: tally.relative,
            mean_relative: tally.sum / tally.judged.max(1) as f64,
            worst,
            errors: tally.errors,
            passed: values && decisions && tally.broken == 0,
        }
    }

    fn worst(&self, head: &[u32], entry: usize, lane: usize) -> Worst {
        let number = |side: &[u32]| {
            let bits = side[entry * self.lanes + lane];
            match self.scalar {
                Scalar::U32 => f64::from(bits),
                Scalar::F32 => f64::from(f32::from_bits(bits)),
            }
        };
        let group = self.groups().find(|(first, g)| lane < first + g.lanes);
        let name = match group {
            Some((_, Group { name, lanes: 1, .. })) => (*name).to_owned(),
            Some((first, group)) => format!("{}[{}]", group.name, lane - first),
            None => String::new(),
        };
        Worst {
            entry,
            place: self.meaning.layout.place(head, entry),
            lane,
            name,
            tested: number(&self.tested),
            reference: number(&self.reference),
        }
    }
}

/// Whether a decision differs; false of lanes that hold none.
fn differ(kind: Kind, tested: u32, reference: u32) -> bool {
    let (t, r) = (f32::from_bits(tested), f32::from_bits(reference));
    match kind {
        Kind::Decision | Kind::Light => tested != reference,
        Kind::Whole => t.is_finite() && r.is_finite() && t.floor() != r.floor(),
        Kind::Level => t.is_finite() && r.is_finite() && tested >> 23 != reference >> 23,
        Kind::Numbers | Kind::Magnitudes | Kind::Vector | Kind::Points => false,
    }
}

/// How bad a difference is.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
enum Rank {
    Value(f64),
    Decision,
    Broken,
}

/// What was found so far.
#[derive(Default)]
struct Tally {
    differing: usize,
    components: usize,
    decisions: usize,
    unjudged: usize,
    broken: usize,
    judged: usize,
    /// Values above each step of the tolerance.
    over: Vec<usize>,
    ulps: u32,
    relative: f64,
    sum: f64,
    worst: Option<(Rank, usize, usize)>,
    errors: Vec<f32>,
}

impl Tally {
    fn new(values: Values) -> Self {
        let steps = match values {
            Values::Bits | Values::Relative { .. } => 1,
            Values::Shares { steps, .. } => steps.len().max(1),
        };
        Self {
            over: vec![0; steps],
            ..Self::default()
        }
    }

    /// Keeps the first of the worst.
    fn note(&mut self, rank: Rank, entry: usize, lane: usize) {
        if self.worst.is_none_or(|(worst, ..)| rank > worst) {
            self.worst = Some((rank, entry, lane));
        }
    }

    fn value(&mut self, ulps: u32, error: f64, values: Values) {
        self.judged += 1;
        self.components += usize::from(ulps > 0);
        self.ulps = self.ulps.max(ulps);
        self.relative = self.relative.max(error);
        self.sum += error;
        match values {
            Values::Bits => self.over[0] += usize::from(ulps > 0),
            Values::Relative { limit, .. } => self.over[0] += usize::from(error > limit),
            Values::Shares { steps, .. } => {
                let over = self.over.iter_mut().zip(steps);
                over.for_each(|(over, step)| *over += usize::from(error > step.0));
            }
        }
    }
}
