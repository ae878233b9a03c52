//! Polynomials from tables of coefficients.

/// Polynomial with the given coefficients, from that of the highest power down, at `x`: `p = p·x + c` to the end.
///
/// Where a fit has a leading coefficient of 1 the table says so: multiplying by 1 changes no bit.
/// Shaders repeat it as one function for each table, see [`crate::constants`].
///
/// ```
/// use vsgl_core::math::polynomial::horner;
/// assert_eq!(horner([2.0, -3.0, 1.0], 4.0), 21.0);
/// ```
#[inline(always)]
#[must_use]
pub fn horner<const N: usize>(coefficients: [f32; N], x: f32) -> f32 {
    const { assert!(N > 0) }
    let mut p = coefficients[0];
    let mut i = 1;
    while i < N {
        p = p * x + coefficients[i];
        i += 1;
    }
    p
}
