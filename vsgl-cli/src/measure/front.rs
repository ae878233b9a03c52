//! Which combinations are worth it: none other is both faster and nearer to the truth.

/// Indices of the points that no other beats, fastest first; `points` are pairs of time and error. Of equal points the
/// first counts, and what is not a number is never worth it.
pub(crate) fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let numbers = |&i: &usize| points[i].0.is_finite() && points[i].1.is_finite();
    let mut order: Vec<usize> = (0..points.len()).filter(numbers).collect();
    order.sort_by(|&a, &b| {
        let (a, b) = (points[a], points[b]);
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let mut best = f64::INFINITY;
    order.retain(|&i| {
        let better = points[i].1 < best;
        best = best.min(points[i].1);
        better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beaten_points_are_not_on_the_front() {
        let points = [
            (3.0, 1.0),
            (1.0, 5.0),
            (2.0, 6.0),
            (2.0, 2.0),
            (1.0, 5.0),
            (f64::NAN, 0.0),
            (9.0, 1.0),
        ];
        assert_eq!(front(&points), [1, 3, 0]);
        assert_eq!(front(&[]), [0usize; 0]);
        assert_eq!(front(&[(1.0, f64::INFINITY)]), [0usize; 0]);
    }
}
