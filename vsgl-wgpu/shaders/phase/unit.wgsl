// Plain numbers of the density. Twin of `unit` and `top_level` in `vsgl-core/src/phase/pdf.rs`, apart from what binds a density.

// 0 ≤ x < 1 from the upper 24 bits.
fn pdf_unit(bits: u32) -> f32 {
    return f32(bits >> 8u) * (1.0 / 16777216.0);
}

// `size` is a power of two.
fn pdf_top_level(size: u32) -> u32 {
    return firstLeadingBit(size);
}
