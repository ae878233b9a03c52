//! Visible normals of any distribution: densities and weights from the distribution `D` and the projected area
//! `s = |cos| (1 + 2 Λ)`, finite at grazing views.
//!
//! Source: Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", equation 2; Heitz and
//! d'Eon 2014, "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals".

/// Density \[1/sr\] of visible normals, `D max(v·h, 0) · 2/(v_z + s_v)`, for a distribution `d` at the normal `h`.
#[inline(always)]
pub(super) fn normal_density(d: f32, view_half: f32, view_cosine: f32, view_area: f32) -> f32 {
    d * view_half.max(0.0) * (2.0 / (view_cosine + view_area).max(1e-18))
}

/// Density \[1/sr\] of the view's reflections off visible normals, `D/(2 (v_z + s_v))`.
#[inline(always)]
pub(super) fn reflected_density(d: f32, view_cosine: f32, view_area: f32) -> f32 {
    d * (0.5 / (view_cosine + view_area).max(1e-18))
}

/// `G₂/G₁` of a reflection drawn by visible normals, 0 … 1, from cosines and projected areas of view and light.
#[inline(always)]
pub(super) fn sample_weight(
    view_cosine: f32,
    light_cosine: f32,
    view_area: f32,
    light_area: f32,
) -> f32 {
    let (v, o) = (view_cosine.max(0.0), light_cosine.max(0.0));
    let both = (o * view_area + light_area * v).max(1e-30);
    (o * (v + view_area) / both).min(1.0)
}
