//! How often points are drawn on each triangle.

/// Share of the draws that goes to area; the rest goes to triangles alike, large or small.
const BY_AREA: f64 = 0.5;

/// Shares of the triangles with these corners, each with those before it, in 2⁻³².
///
/// Half of the draws goes by area, and half to every triangle alike: triangles are small where there is much to see. A triangle
/// without area gets none.
pub(super) fn of(corner: &[[f32; 9]]) -> Vec<u32> {
    let areas: Vec<f64> = corner.iter().map(area).collect();
    let total: f64 = areas.iter().sum();
    let count = areas.iter().filter(|&&a| a > 0.0).count();
    let mut passed = 0.0;
    let share = |&area: &f64| {
        if area > 0.0 {
            passed += BY_AREA * (area / total) + (1.0 - BY_AREA) / count as f64;
        }
        // A cast stops at the largest.
        (passed * 4_294_967_296.0) as u32
    };
    areas.iter().map(share).collect()
}

/// Area of a triangle \[m²\]; zero if it is too large for a number.
fn area(corner: &[f32; 9]) -> f64 {
    let c = corner.map(f64::from);
    let edge = [c[3] - c[0], c[4] - c[1], c[5] - c[2]];
    let other = [c[6] - c[0], c[7] - c[1], c[8] - c[2]];
    let normal = [
        edge[1] * other[2] - edge[2] * other[1],
        edge[2] * other[0] - edge[0] * other[2],
        edge[0] * other[1] - edge[1] * other[0],
    ];
    let square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    let area = 0.5 * square.sqrt();
    if area.is_finite() { area } else { 0.0 }
}
