//! Two resources of one type, column by column.

use super::column::Pair;
use super::meaning::meaning;
use super::place::Layout;
use super::tolerance::Tolerance;
use super::verdict::Comparison;
use crate::data::{Column, Columns, GBuffer};
use crate::error::{Error, Result};

/// Where a resource came from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    /// Name of the backend.
    pub backend: String,
    /// What it ran on, and how: adapter, driver, strict or ordinary.
    pub device: String,
}

impl Origin {
    /// Backend and device.
    pub fn new(backend: impl Into<String>, device: impl Into<String>) -> Self {
        Self {
            backend: backend.into(),
            device: device.into(),
        }
    }
}

impl std::fmt::Display for Origin {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}, {}", self.backend, self.device)
    }
}

/// A resource with its origin.
#[derive(Clone, Copy, Debug)]
pub struct Side<'a, T> {
    /// Where it came from.
    pub origin: &'a Origin,
    /// The resource.
    pub value: &'a T,
}

/// Compares two resources of one type.
///
/// `agree` says which pixels of a picture follow from equal decisions before it, one entry a pixel, as [`agreement`]
/// finds them; values of the others are not judged. Sizes that differ are a finding, not an error.
///
/// # Errors
/// [`Error::Comparison`] if both sides have one origin or are one resource: that would prove nothing.
pub fn compare<T: Columns>(
    tested: &Side<'_, T>,
    reference: &Side<'_, T>,
    tolerance: &Tolerance,
    agree: Option<&[bool]>,
) -> Result<Comparison> {
    if tested.origin == reference.origin || std::ptr::eq(tested.value, reference.value) {
        return Err(Error::Comparison {
            resource: T::NAME,
            problem: format!(
                "both sides come from {}: compare two backends",
                tested.origin
            ),
        });
    }
    let (head, other) = (reference.value.head(), tested.value.head());
    let mut found = Comparison {
        resource: T::NAME,
        head: head.clone(),
        tested: tested.origin.clone(),
        reference: reference.origin.clone(),
        tolerance: *tolerance,
        misfits: Vec::new(),
        columns: Vec::new(),
    };
    if head != other {
        found
            .misfits
            .push(format!("head {other:?} instead of {head:?}"));
        return Ok(found);
    }
    let (t, r) = (tested.value.columns(), reference.value.columns());
    let pairs = pairs(T::NAME, &t, &r, &mut found.misfits);
    let doubts = Doubts::new(&pairs, agree);
    let judge = |pair: &Pair| pair.judge(tolerance, &head, doubts.of(pair.layout()));
    found.columns = pairs.iter().map(judge).collect();
    Ok(found)
}

/// Which pixels show the same triangle through all their samples, in both pictures; `aa` samples along a side of each.
pub fn agreement(tested: &GBuffer, reference: &GBuffer, aa: u32) -> Vec<bool> {
    let (aa, width) = (aa.max(1) as usize, reference.width as usize);
    let (columns, rows) = (width / aa, reference.height as usize / aa);
    let same = |index: usize| {
        let id = reference.triangle.get(index);
        id.is_some() && id == tested.triangle.get(index)
    };
    let pixel = |p: usize| {
        let (x, y) = (p % columns * aa, p / columns * aa);
        (0..aa * aa).all(|s| same((y + s / aa) * width + x + s % aa))
    };
    (0..columns * rows).map(pixel).collect()
}

/// The columns that both sides have in one size. The others are noted.
fn pairs(
    resource: &str,
    tested: &[Column<'_>],
    reference: &[Column<'_>],
    notes: &mut Vec<String>,
) -> Vec<Pair> {
    let shape = |c: &Column<'_>| (c.name, c.lanes, c.scalar);
    let entries = |c: &Column<'_>| c.bytes.len() / (4 * c.lanes.max(1));
    if tested.len() != reference.len() {
        let (t, r) = (tested.len(), reference.len());
        notes.push(format!("{t} columns instead of {r}"));
    }
    let mut pairs = Vec::new();
    for (t, r) in tested.iter().zip(reference) {
        if shape(t) != shape(r) {
            let problem = format!("column `{}` in the place of `{}`", t.name, r.name);
            notes.push(problem);
        } else if t.bytes.len() != r.bytes.len() {
            let (name, t, r) = (r.name, entries(t), entries(r));
            notes.push(format!("column `{name}` has {t} entries instead of {r}"));
        } else {
            pairs.push(Pair::new(meaning(resource, r), t, r));
        }
    }
    pairs
}

/// Entries whose values follow from decisions that differ, for each order of entries.
struct Doubts(Vec<(Layout, Vec<bool>)>);

impl Doubts {
    fn new(pairs: &[Pair], agree: Option<&[bool]>) -> Self {
        let mut doubts = Self(Vec::new());
        if let Some(agree) = agree {
            doubts.mark(Layout::Picture, agree.iter().map(|agree| !agree).collect());
        }
        for pair in pairs {
            let differing = pair.decisions();
            let lights = pair.lights_in_doubt(&differing);
            doubts.mark(pair.layout(), differing);
            doubts.mark(Layout::Lights, lights);
        }
        doubts
    }

    fn mark(&mut self, layout: Layout, marks: Vec<bool>) {
        let place = self.0.iter().position(|(l, _)| *l == layout);
        let place = place.unwrap_or_else(|| {
            self.0.push((layout, Vec::new()));
            self.0.len() - 1
        });
        let all = &mut self.0[place].1;
        if all.len() < marks.len() {
            all.resize(marks.len(), false);
        }
        all.iter_mut().zip(marks).for_each(|(a, m)| *a |= m);
    }

    fn of(&self, layout: Layout) -> &[bool] {
        let found = self.0.iter().find(|(l, _)| *l == layout);
        found
            .filter(|_| layout != Layout::Entries)
            .map_or(&[], |(_, marks)| marks)
    }
}
