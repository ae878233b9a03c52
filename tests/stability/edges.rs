//! Contracts of the lobe integrals at the edge: finite, not negative, within exact bounds, monotone, symmetric, and without
//! steps at branches.

use crate::directions::{cosine, direction, pair, sharpness};
use proptest::prelude::*;
use vsgl_core::sg::{SHARPNESS_MAX, SgLobe, cosine as clamped, hemisphere, lobe, vmf};

/// Rounding of a sum of a few terms.
const ROUNDING: f32 = 1e-6;

type OfCosine = fn(f32, f32) -> f32;

const HEMISPHERES: [OfCosine; 3] = [
    hemisphere::integral_2018,
    hemisphere::integral_2022,
    hemisphere::integral,
];
const INTERPOLATED: [OfCosine; 3] = [
    clamped::interpolated_2024,
    clamped::interpolated_v13,
    clamped::interpolated_v14,
];
const SUPERSEDED: [OfCosine; 6] = [
    clamped::constant,
    clamped::sg_2015,
    clamped::sg_iwasaki_2012,
    clamped::sg_product,
    clamped::lobes_2018,
    clamped::lobes_2022,
];

fn next_up(x: f32) -> f32 {
    f32::from_bits(x.to_bits() + 1)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn integrals_are_in_range(k in sharpness(), z in cosine()) {
        let (whole, top) = (lobe::integral(k), clamped::upper(k));
        prop_assert!(whole > 0.0 && whole <= 12.566_371);
        prop_assert!(lobe::log_integral(k).is_finite());
        for f in HEMISPHERES {
            let value = f(k, z);
            prop_assert!(value >= 0.0 && value <= hemisphere::upper(k) * (1.0 + ROUNDING));
            prop_assert!(value >= hemisphere::lower(k) * (1.0 - ROUNDING));
            prop_assert!((value + f(k, -z) - whole).abs() <= 2.0 * ROUNDING * whole);
        }
        let share = hemisphere::share_2022(k, z);
        prop_assert!((0.0..=1.0 + ROUNDING).contains(&share));
        for f in INTERPOLATED {
            let value = f(k, z);
            prop_assert!(value >= clamped::lower(k) * (1.0 - ROUNDING) && value <= top * (1.0 + ROUNDING));
            // The odd part is exact.
            prop_assert!((value - f(k, -z) - clamped::odd_part(k, z)).abs() <= 2.0 * ROUNDING * top);
        }
        for f in SUPERSEDED {
            let value = f(k, z);
            prop_assert!(value.is_finite() && value >= 0.0);
        }
        let log = clamped::log_interpolated(k, z);
        prop_assert!(log.is_finite() && log <= top.ln() + 1e-5 && log >= clamped::log_lower(k) * (1.0 + ROUNDING) - 1e-5);
        let mean = clamped::mean_clamped_cosine(k, z);
        prop_assert!((0.0..=1.0 + ROUNDING).contains(&mean));
    }

    #[test]
    fn integrals_grow_with_the_cosine(k in sharpness(), a in cosine(), b in cosine()) {
        let (low, high) = (a.min(b), a.max(b));
        for f in HEMISPHERES {
            prop_assert!(f(k, low) <= f(k, high) + ROUNDING * hemisphere::upper(k));
        }
        for f in INTERPOLATED {
            prop_assert!(f(k, low) <= f(k, high) + ROUNDING * clamped::upper(k));
        }
        let mean = clamped::mean_clamped_cosine;
        prop_assert!(mean(k, low) <= mean(k, high) + ROUNDING);
    }

    #[test]
    fn integrals_fall_with_the_sharpness(a in sharpness(), b in sharpness()) {
        let (low, high) = (a.min(b), a.max(b));
        for f in [lobe::integral, hemisphere::upper, hemisphere::lower, clamped::upper, clamped::lower] {
            prop_assert!(f(high) <= f(low) * (1.0 + ROUNDING));
        }
    }

    #[test]
    fn there_is_no_step(k in sharpness(), z in cosine()) {
        // Neighbouring arguments: rounding apart, the same value.
        let next = next_up(k.min(1e30));
        let k = k.min(1e30);
        for f in [lobe::integral, hemisphere::upper, clamped::upper] {
            prop_assert!((f(next) / f(k) - 1.0).abs() < 2.0 * ROUNDING);
        }
        for f in HEMISPHERES {
            prop_assert!((f(next, z) - f(k, z)).abs() < 2.0 * ROUNDING * hemisphere::upper(k));
        }
        for f in INTERPOLATED {
            prop_assert!((f(next, z) - f(k, z)).abs() < 2.0 * ROUNDING * clamped::upper(k));
        }
        let (a, b) = (vmf::mean(k), vmf::mean(next));
        prop_assert!((a.length - b.length).abs() <= ROUNDING * a.length.max(1e-37));
        prop_assert!((a.complement - b.complement).abs() <= ROUNDING * a.complement);
    }

    #[test]
    fn products_are_symmetric_and_within_bounds((a, b) in pair(), ka in sharpness(), kb in sharpness()) {
        let p = lobe::product(a, ka, b, kb);
        let q = lobe::product(b, kb, a, ka);
        prop_assert_eq!(p.log_amplitude.to_bits(), q.log_amplitude.to_bits());
        prop_assert_eq!(p.sharpness.to_bits(), q.sharpness.to_bits());
        prop_assert!((p.axis.length() - 1.0).abs() < 1e-5);
        let (ca, cb) = (ka.min(SHARPNESS_MAX), kb.min(SHARPNESS_MAX));
        prop_assert!(p.sharpness >= 0.0 && p.sharpness <= (ca + cb) * (1.0 + ROUNDING));
        prop_assert!(p.log_amplitude <= 0.0 && p.log_amplitude >= -2.0 * ca.min(cb) * (1.0 + ROUNDING) - f32::MIN_POSITIVE);
        let inner = lobe::inner_product(a, ka, b, kb);
        prop_assert!((0.0..=12.566_372).contains(&inner));
        prop_assert!(lobe::log_inner_product(a, ka, b, kb).is_finite());
        prop_assert!(lobe::inner_product_sharp(a, ka, b, kb) >= 0.0);
        let (sharpness, log_amplitude) = lobe::product_by_chord(ka, kb, (a - b).length_squared());
        prop_assert!(sharpness >= 0.0 && sharpness.is_finite() && log_amplitude <= 0.0 && log_amplitude.is_finite());
    }

    #[test]
    fn a_lobe_is_within_its_peak((a, b) in pair(), k in -1e30f32..f32::MAX) {
        let lobe = SgLobe::new(a, k);
        prop_assert!((0.0..=SHARPNESS_MAX).contains(&lobe.sharpness));
        let value = lobe.evaluate(b);
        prop_assert!((0.0..=1.0).contains(&value));
        prop_assert!(lobe.integral() > 0.0);
    }

    #[test]
    fn mean_lengths_and_convolutions(a in sharpness(), b in sharpness(), c in sharpness()) {
        let mean = vmf::mean(a);
        prop_assert!((0.0..=1.0).contains(&mean.length) && (0.0..=1.0).contains(&mean.complement));
        prop_assert_eq!(vmf::convolve(a, b).to_bits(), vmf::convolve(b, a).to_bits());
        let blurred = vmf::convolve(a, b);
        prop_assert!(blurred >= 0.0 && blurred <= a.min(b).min(SHARPNESS_MAX) * 1.000_07);
        // Sharper lobes blur less.
        let (low, high) = (b.min(c), b.max(c));
        prop_assert!(vmf::convolve(a, low) <= vmf::convolve(a, high) * 1.000_13);
        for f in [
            vmf::sharpness,
            vmf::sharpness_exact,
            vmf::sharpness_banerjee_2005,
            vmf::sharpness_toksvig_2005,
        ] {
            prop_assert!((0.0..=SHARPNESS_MAX).contains(&f(mean)));
            prop_assert!((0.0..=SHARPNESS_MAX).contains(&f(vmf::MeanLength::from_length(mean.length))));
        }
        for f in [vmf::mean_banerjee_2005, vmf::mean_toksvig_2005] {
            let m = f(a);
            prop_assert!((0.0..=1.0).contains(&m.length) && (0.0..=1.0).contains(&m.complement));
        }
    }

    #[test]
    fn frames_are_orthonormal(z in direction()) {
        let (x, y) = vsgl_core::math::vec::orthonormal_basis(z);
        prop_assert!((x.cross(y) - z).length() < 2e-6);
    }
}
