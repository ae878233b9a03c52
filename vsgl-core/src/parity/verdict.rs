//! What a comparison found.

use super::compare::Origin;
use super::place::Place;
use super::tolerance::Tolerance;

/// Entry of [`ColumnVerdict::errors`] where a decision differs, or a number is not finite.
pub const DIFFERENT: f32 = f32::INFINITY;
/// Entry of [`ColumnVerdict::errors`] whose values were not judged, since a decision that governs them differs.
pub const UNJUDGED: f32 = -1.0;

/// Two resources of one type, compared.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Name of the resource.
    pub resource: &'static str,
    /// Integers of the reference's head: sizes and counts.
    pub head: Vec<u32>,
    /// Where the tested side came from.
    pub tested: Origin,
    /// Where the reference came from.
    pub reference: Origin,
    /// What was tolerated.
    pub tolerance: Tolerance,
    /// Differences of size and shape, a line each; columns that they concern are not compared.
    pub misfits: Vec<String>,
    /// The columns that could be compared.
    pub columns: Vec<ColumnVerdict>,
}

impl Comparison {
    /// Whether everything is within the tolerance.
    pub fn passed(&self) -> bool {
        self.misfits.is_empty() && self.columns.iter().all(|c| c.passed)
    }

    /// The verdict on the column of this name.
    pub fn column(&self, name: &str) -> Option<&ColumnVerdict> {
        self.columns.iter().find(|c| c.name == name)
    }

    /// What is over the tolerance, a line each, with the resource's name; empty if it passed.
    pub fn failures(&self) -> Vec<String> {
        let misfits = self
            .misfits
            .iter()
            .map(|m| format!("{}: {m}", self.resource));
        let failed = self.columns.iter().filter(|c| !c.passed);
        let columns = failed.map(|c| format!("{}.{}: {}", self.resource, c.name, c.describe()));
        misfits.chain(columns).collect()
    }
}

/// One column, compared.
#[derive(Clone, Debug)]
pub struct ColumnVerdict {
    /// Name of the column.
    pub name: &'static str,
    /// Number of entries.
    pub entries: usize,
    /// Numbers in an entry.
    pub lanes: usize,
    /// Entries with any difference in what was judged.
    pub differing: usize,
    /// Numbers that differ, of those that were judged.
    pub differing_components: usize,
    /// Entries whose decisions, in this column, differ.
    pub decisions: usize,
    /// Entries whose values were not judged, since a decision that governs them differs.
    pub unjudged: usize,
    /// Numbers that are NaN on one side or both, or infinite on one alone.
    pub broken: usize,
    /// Numbers that are over the limit; with [`super::Values::Shares`] over the first.
    pub over: usize,
    /// Greatest distance of two values in representable numbers.
    pub ulps: u32,
    /// Greatest relative error of a value; see [`super::Values`].
    pub relative: f64,
    /// Mean relative error over the values judged.
    pub mean_relative: f64,
    /// The greatest difference: a number that is not finite, else a decision, else the value furthest off.
    pub worst: Option<Worst>,
    /// Greatest relative error in each entry, or [`DIFFERENT`], or [`UNJUDGED`].
    pub errors: Vec<f32>,
    /// Whether it is within the tolerance.
    pub passed: bool,
}

/// The greatest difference of a column.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// Index of the entry.
    pub entry: usize,
    /// Where it lies.
    pub place: Place,
    /// Which number of the entry.
    pub lane: usize,
    /// What that number is: a name, and which of a vector's or colour's numbers; empty if the column's name says it.
    pub name: String,
    /// The tested number; integers up to 2³² are exact.
    pub tested: f64,
    /// The reference.
    pub reference: f64,
}

impl ColumnVerdict {
    /// Most of it in a line.
    pub fn describe(&self) -> String {
        let mut line = format!("{} of {} differ", self.differing, self.entries);
        if self.broken > 0 {
            line += &format!(", {} numbers not finite", self.broken);
        }
        if self.unjudged > 0 {
            line += &format!(", {} not judged", self.unjudged);
        }
        if self.ulps > 0 {
            line += &format!(", {} ulp, relative {:.2e}", self.ulps, self.relative);
        }
        if let Some(worst) = &self.worst {
            let name = if worst.name.is_empty() { "" } else { " " };
            line += &format!(
                ", worst at {}:{name}{} {} for {}",
                worst.place,
                worst.name,
                number(worst.tested),
                number(worst.reference)
            );
        }
        line
    }
}

/// The fewest digits that tell the number from all others of its kind.
fn number(value: f64) -> String {
    let single = value as f32;
    let size = value.abs();
    match f64::from(single) == value || value.is_nan() {
        true if value != 0.0 && !(1e-4..1e7).contains(&size) => format!("{single:e}"),
        true => single.to_string(),
        false => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_of_a_single() {
        for (value, text) in [
            (f64::from(0.1f32), "0.1"),
            (f64::from(2.5e-7f32), "2.5e-7"),
            (-3.0, "-3"),
            (0.0, "0"),
            (4_294_967_295.0, "4294967295"),
            (16_777_217.0, "16777217"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(number(value), text);
        }
    }
}
