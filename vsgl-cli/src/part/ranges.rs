//! Which samples a part holds.

use serde_json::{Value, json};
use std::fmt;
use std::ops::Range;

/// Ranges of samples, in order, apart from each other.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ranges(Vec<Range<u32>>);

impl Ranges {
    /// One range; none if it is empty.
    #[must_use]
    pub fn of(range: Range<u32>) -> Self {
        Self(Vec::from_iter((!range.is_empty()).then_some(range)))
    }

    /// The ranges.
    pub fn iter(&self) -> impl Iterator<Item = Range<u32>> + '_ {
        self.0.iter().cloned()
    }

    /// Whether there is no sample.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Number of samples.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.0.iter().map(|r| r.end - r.start).sum()
    }

    /// The first sample; of none the last number.
    #[must_use]
    pub fn first(&self) -> u32 {
        self.0.first().map_or(u32::MAX, |r| r.start)
    }

    /// The samples of both.
    #[must_use]
    pub fn common(&self, other: &Self) -> Self {
        let of = |a: &Range<u32>, b: &Range<u32>| a.start.max(b.start)..a.end.min(b.end);
        let pairs = self
            .0
            .iter()
            .flat_map(|a| other.0.iter().map(move |b| of(a, b)));
        Self(pairs.filter(|r| !r.is_empty()).collect())
    }

    /// The samples of either; none if they have some in common.
    #[must_use]
    pub fn joined(&self, other: &Self) -> Option<Self> {
        if !self.common(other).is_empty() {
            return None;
        }
        let mut all: Vec<Range<u32>> = self.iter().chain(other.iter()).collect();
        all.sort_by_key(|r| r.start);
        let mut joined: Vec<Range<u32>> = Vec::new();
        for range in all {
            match joined.last_mut() {
                Some(last) if last.end == range.start => last.end = range.end,
                _ => joined.push(range),
            }
        }
        Some(Self(joined))
    }

    /// What of a range is not in here.
    #[must_use]
    pub fn rest(&self, range: Range<u32>) -> Self {
        let mut rest = Vec::new();
        let mut next = range.start;
        for held in &self.0 {
            rest.push(next..held.start.min(range.end));
            next = next.max(held.end);
        }
        rest.push(next..range.end);
        rest.retain(|r| !r.is_empty());
        Self(rest)
    }

    /// What is missing of so many samples.
    #[must_use]
    pub fn missing(&self, of: u32) -> Self {
        self.rest(0..of)
    }

    /// As JSON: a list of pairs.
    #[must_use]
    pub fn json(&self) -> Value {
        self.0.iter().map(|r| json!([r.start, r.end])).collect()
    }

    /// None if it is no list of ranges in order.
    pub(super) fn from_json(json: &Value) -> Option<Self> {
        let range = |pair: &Value| {
            let [start, end] = pair.as_array()?.as_slice() else {
                return None;
            };
            let number = |value: &Value| u32::try_from(value.as_u64()?).ok();
            Some(number(start)?..number(end)?)
        };
        let ranges: Vec<_> = json.as_array()?.iter().map(range).collect::<Option<_>>()?;
        let sound = ranges.iter().all(|r| !r.is_empty())
            && ranges.windows(2).all(|w| w[0].end < w[1].start);
        sound.then_some(Self(ranges))
    }
}

impl fmt::Display for Ranges {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ranges: Vec<_> = self
            .0
            .iter()
            .map(|r| format!("{}:{}", r.start, r.end))
            .collect();
        match ranges[..] {
            [] => f.write_str("none"),
            _ => f.write_str(&ranges.join(", ")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ranges(text: &str) -> Ranges {
        let one = |word: &str| {
            let (start, end) = word.split_once(':').expect("a range");
            start.parse().expect("a number")..end.parse().expect("a number")
        };
        Ranges(text.split_whitespace().map(one).collect())
    }

    #[test]
    fn ranges_join_where_they_meet() {
        let joined = ranges("0:8 24:32").joined(&ranges("8:16"));
        assert_eq!(joined, Some(ranges("0:16 24:32")));
        assert_eq!(ranges("0:8 24:32").joined(&ranges("31:40")), None);
        assert_eq!(
            ranges("0:8 24:32").common(&ranges("4:30")),
            ranges("4:8 24:30")
        );
        assert_eq!(
            ranges("8:16").joined(&Ranges::default()),
            Some(ranges("8:16"))
        );
    }

    #[test]
    fn what_is_missing_is_found() {
        assert_eq!(ranges("8:16 24:32").missing(40), ranges("0:8 16:24 32:40"));
        assert_eq!(ranges("0:40").missing(40), Ranges::default());
        assert_eq!(ranges("0:8 24:32").rest(8..28), ranges("8:24"));
        assert_eq!(ranges("0:8").rest(16..24), ranges("16:24"));
        assert_eq!(ranges("8:16 24:32").to_string(), "8:16, 24:32");
        assert_eq!(ranges("8:16 24:32").count(), 16);
    }

    #[test]
    fn json_round_trips_and_nonsense_is_refused() {
        let some = ranges("0:8 16:24");
        assert_eq!(Ranges::from_json(&some.json()), Some(some));
        for bad in [
            json!(5),
            json!([[8, 0]]),
            json!([[0, 8], [4, 12]]),
            json!([[0]]),
            json!([["a", 1]]),
            json!([[0, 5_000_000_000u64]]),
        ] {
            assert_eq!(Ranges::from_json(&bad), None, "{bad}");
        }
    }
}
