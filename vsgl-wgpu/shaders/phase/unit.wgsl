// Fractions from integers. Twin of `unit` in `vsgl-core/src/phase/pdf.rs`, apart from what binds a density.

// 0 ≤ x < 1 from the upper 24 bits.
fn pdf_unit(bits: u32) -> f32 {
    return f32(bits >> 8u) * (1.0 / 16777216.0);
}
