//! Owen-scrambled Sobol points, in pairs, from integers alone: the same bits on every backend.
//!
//! A path of light needs many numbers a sample. Each pair of them is a point of its own scrambled and shuffled copy of the
//! two-dimensional Sobol sequence: within a pair points are spread as well as they can be, for any number of them that is a
//! power of two and nearly so for others; pairs know nothing of each other. Sample `k` is the same however many there are.
//!
//! Source: Sobol 1967, "On the distribution of points in a cube and the approximate evaluation of integrals"; Owen 1995,
//! "Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences"; Laine and Karras 2011, "Stratified Sampling for Stochastic
//! Transparency" (a hash that permutes as Owen's scrambling does); Burley 2020, "Practical Hash-based Owen Scrambling"
//! (shuffling the order of points, padding by pairs).

/// A number whose bits all depend on those of `x`. A permutation of 32-bit numbers.
///
/// Source: Wellons 2018, "Prospecting for Hash Functions", `lowbias32`.
#[inline(always)]
#[must_use]
pub fn hash(x: u32) -> u32 {
    let x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    let x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// A number that stands for both: `a` and `b` in this order.
#[inline(always)]
#[must_use]
pub fn combine(a: u32, b: u32) -> u32 {
    hash(a ^ b.wrapping_mul(0x9e37_79b9).wrapping_add(0x7f4a_7c15))
}

/// Nested uniform scrambling of the bits of a fraction: a bit is flipped or not by a hash of those above it.
///
/// Source: Laine and Karras 2011, with the constants of Burley 2020, listing 1.
#[inline(always)]
#[must_use]
pub fn scramble(fraction: u32, seed: u32) -> u32 {
    let x = fraction.reverse_bits();
    let x = x ^ x.wrapping_mul(0x3d20_adea);
    let x = x.wrapping_add(seed);
    let x = x.wrapping_mul((seed >> 16) | 1);
    let x = x ^ x.wrapping_mul(0x0552_6c56);
    let x = x ^ x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

/// Point `index` of the two-dimensional Sobol sequence, as fractions of 2³².
///
/// The second coordinate is the reversed index times Pascal's triangle modulo 2, which is the Kronecker power of a 2 × 2 matrix:
/// five steps instead of a table.
#[inline(always)]
#[must_use]
pub fn sobol(index: u32) -> [u32; 2] {
    let y = index;
    let y = y ^ ((y & 0xaaaa_aaaa) >> 1);
    let y = y ^ ((y & 0xcccc_cccc) >> 2);
    let y = y ^ ((y & 0xf0f0_f0f0) >> 4);
    let y = y ^ ((y & 0xff00_ff00) >> 8);
    let y = y ^ ((y & 0xffff_0000) >> 16);
    [index.reverse_bits(), y.reverse_bits()]
}

/// A pair of numbers, 0 ≤ x < 1, for sample `index` of the stream `seed`; `pair` counts the pairs that a sample asks for.
///
/// ```
/// use vsgl_core::math::sobol::point;
/// // The first sixteen points have one in each sixteenth of the unit square's columns.
/// let mut columns: Vec<u32> = (0..16).map(|i| (point(i, 0, 7)[0] * 16.0) as u32).collect();
/// columns.sort();
/// assert!(columns.into_iter().eq(0..16));
/// ```
#[inline(always)]
#[must_use]
pub fn point(index: u32, pair: u32, seed: u32) -> [f32; 2] {
    let seed = combine(seed, pair);
    // Scrambling the index shuffles the order: every aligned block of a power of two becomes another one.
    let shuffled = scramble(index, seed);
    let [x, y] = sobol(shuffled);
    [
        fraction(scramble(x, hash(seed))),
        fraction(scramble(y, hash(!seed))),
    ]
}

/// The upper 24 bits as a number below one.
#[inline(always)]
#[must_use]
pub fn fraction(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_coordinate_is_that_of_sobol() {
        // Direction numbers of the polynomial x + 1.
        let mut directions = [1u32 << 31; 32];
        for i in 1..32 {
            directions[i] = directions[i - 1] ^ (directions[i - 1] >> 1);
        }
        for index in [0, 1, 2, 3, 5, 100, 0xdead_beef, u32::MAX] {
            let set = (0..32).filter(|b| index >> b & 1 == 1);
            let expected = set.fold(0, |sum, b| sum ^ directions[b]);
            assert_eq!(sobol(index)[1], expected, "{index}");
        }
    }

    /// Every elementary box of area 1/2ᵐ holds one of 2ᵐ points, scrambled or not, shuffled or not.
    #[test]
    fn points_of_a_power_of_two_fill_all_elementary_boxes() {
        for (pair, seed) in [(0, 0), (3, 99), (7, 0x1234_5678)] {
            for m in [4u32, 7] {
                let count = 1u32 << m;
                for first in [0, count * 5] {
                    for across in 0..=m {
                        let mut seen = vec![false; count as usize];
                        for i in first..first + count {
                            let [x, y] = point(i, pair, seed);
                            let column = (x * (1u32 << across) as f32) as u32;
                            let row = (y * (1u32 << (m - across)) as f32) as u32;
                            let at = (row << across | column) as usize;
                            assert!(!seen[at], "pair {pair}, {count} points, {across}");
                            seen[at] = true;
                        }
                    }
                }
            }
        }
    }

    /// Sums over pairs of different number are independent: the product of two coordinates has the mean 1/4, within five
    /// standard errors of independent numbers.
    #[test]
    fn pairs_know_nothing_of_each_other() {
        let n = 4096;
        let seeds = 64;
        for (a, b) in [(0, 1), (1, 2), (4, 9)] {
            let mut sum = 0.0f64;
            for seed in 0..seeds {
                for i in 0..n {
                    let (x, y) = (point(i, a, seed)[0], point(i, b, seed)[1]);
                    sum += f64::from(x) * f64::from(y);
                }
            }
            let count = f64::from(n * seeds);
            // The variance of a product of two uniform numbers is 7/144.
            let error = (7.0 / 144.0 / count).sqrt();
            assert!((sum / count - 0.25).abs() < 5.0 * error, "{a} {b}");
        }
    }

    #[test]
    fn streams_differ() {
        let first: Vec<_> = (0..64).map(|seed| point(0, 0, seed)).collect();
        let mut cells = std::collections::BTreeSet::new();
        for [x, y] in &first {
            cells.insert(((x * 64.0) as u32, (y * 64.0) as u32));
        }
        assert!(cells.len() > 60, "{} of 64", cells.len());
    }
}
