//! Folding a list in an order that the workgroups of a GPU keep.
//!
//! Rounding depends on the order of a sum, so the order is part of every text that adds up more than a few values: a list
//! is cut into blocks, [`halve`] folds each, and [`lanes`] folds what the blocks gave. Entries that do not exist are left
//! out, not added as zeros.

/// Folds a list by halving: entry `i` takes in entry `i + half`, for `half` from the greatest power of two below the
/// count down to one. Overwrites the list; nothing for an empty one.
#[inline(always)]
pub fn halve<T: Copy>(values: &mut [T], merge: impl Fn(T, T) -> T) -> Option<T> {
    let mut count = values.len();
    while count > 1 {
        let half = count.next_power_of_two() / 2;
        let (low, high) = values[..count].split_at_mut(half);
        for (a, b) in low.iter_mut().zip(high) {
            *a = merge(*a, *b);
        }
        count = half;
    }
    values.first().copied()
}

/// Folds a list of any length on `LANES` lanes: entry `i` is taken in by lane `i % LANES` in ascending order, then
/// [`halve`] folds the lanes. Nothing for an empty list.
#[inline(always)]
pub fn lanes<const LANES: usize, T: Copy>(
    values: impl IntoIterator<Item = T>,
    merge: impl Fn(T, T) -> T,
) -> Option<T> {
    let mut lanes: Vec<T> = Vec::new();
    for (i, value) in values.into_iter().enumerate() {
        if i < LANES {
            lanes.push(value);
        } else {
            lanes[i % LANES] = merge(lanes[i % LANES], value);
        }
    }
    halve(&mut lanes, merge)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Strings show who took in whom.
    fn shown(count: usize, fold: impl Fn(Vec<&'static str>) -> Option<&'static str>) -> String {
        let names = (0..count).map(|i| &*i.to_string().leak()).collect();
        fold(names).unwrap_or("nothing").to_owned()
    }

    fn merge(a: &'static str, b: &'static str) -> &'static str {
        format!("({a}+{b})").leak()
    }

    #[test]
    fn halving_leaves_out_what_does_not_exist() {
        let by = |count| shown(count, |mut v| halve(&mut v, merge));
        assert_eq!(by(0), "nothing");
        assert_eq!(by(1), "0");
        assert_eq!(by(3), "((0+2)+1)");
        assert_eq!(by(4), "((0+2)+(1+3))");
        assert_eq!(by(6), "(((0+4)+2)+((1+5)+3))");
    }

    #[test]
    fn lanes_take_their_entries_in_order() {
        let by = |count| shown(count, |v| lanes::<2, _>(v, merge));
        assert_eq!(by(0), "nothing");
        assert_eq!(by(1), "0");
        assert_eq!(by(5), "(((0+2)+4)+(1+3))");
    }
}
