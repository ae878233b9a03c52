//! Large pictures a band at a time, so that what is between a loop and its columns is never held for all of them.

use std::ops::Range;

/// About how many samples or pixels a band has: enough for many threads, and little beside a large picture.
pub(crate) const SAMPLES: usize = 1 << 18;

/// The rows of a picture, from the top, in bands.
pub(crate) fn rows(width: u32, height: u32) -> impl Iterator<Item = Range<u32>> {
    let rows = (SAMPLES as u32 / width.max(1)).max(1);
    (0..height)
        .step_by(rows as usize)
        .map(move |first| first..height.min(first.saturating_add(rows)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_follow_each_other_to_the_end() {
        for (width, height) in [(1, 1), (1920, 1080), (1 << 20, 3), (3, 1 << 20), (7, 0)] {
            let rows: Vec<u32> = rows(width, height).flatten().collect();
            assert!(rows.into_iter().eq(0..height), "{width}x{height}");
        }
    }
}
