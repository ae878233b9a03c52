//! Distance of two floats, counted in representable numbers.

/// How many steps from one representable number to the next lead from `a` to `b`; +0 and −0 are one number.
///
/// Infinity is one step beyond the largest number. A NaN on either side is `u32::MAX` away from everything, itself
/// included.
pub fn ulps(a: f32, b: f32) -> u32 {
    if a.is_nan() || b.is_nan() {
        return u32::MAX;
    }
    place(a).abs_diff(place(b))
}

/// Rank of a number among all, 0 for both zeros.
fn place(x: f32) -> i32 {
    let magnitude = (x.to_bits() & 0x7fff_ffff) as i32;
    if x.is_sign_negative() {
        -magnitude
    } else {
        magnitude
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_one_apart_also_across_zero() {
        let tiny = f32::from_bits(1);
        for (a, b, distance) in [
            (1.0, 1.0, 0),
            (0.0, -0.0, 0),
            (1.0, 1.0f32.next_up(), 1),
            (2.0, 2.0f32.next_down(), 1),
            (tiny, -tiny, 2),
            (f32::MAX, f32::INFINITY, 1),
            (f32::NEG_INFINITY, f32::INFINITY, 2 * 0x7f80_0000),
        ] {
            assert_eq!((ulps(a, b), ulps(b, a)), (distance, distance), "{a} {b}");
        }
        assert_eq!(ulps(f32::NAN, f32::NAN), u32::MAX);
        assert_eq!(ulps(f32::NAN, 1.0), u32::MAX);
    }
}
