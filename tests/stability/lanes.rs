//! One text, two ways to run it: element by element, and sixteen at a time. Bits must agree, and lanes must pay.

use crate::directions::{alpha, cosine, direction, sharpness};
use proptest::prelude::*;
use std::hint::black_box;
use std::time::{Duration, Instant};
use vsgl_core::brdf::albedo::ggx_albedo;
use vsgl_core::brdf::{beckmann, roughness::Roughness};
use vsgl_core::glam::Vec3;
use vsgl_core::math::elementary as el;
use vsgl_core::sg::glossy::GlossyView;
use vsgl_core::sg::{cosine as clamped, hemisphere, lobe, vmf};

const LANES: usize = 16;
type Lanes = [f32; LANES];

/// Makes a function over lanes from an expression of two lanes.
macro_rules! over_lanes {
    ($($name:ident = |$x:ident, $y:ident| $body:expr;)*) => {
        mod vectorised {
            use super::*;
            $(
                #[multiversion::multiversion(targets("x86_64+avx2+fma"))]
                pub(super) fn $name(x: &Lanes, y: &Lanes) -> Lanes {
                    let (x, y) = (*x, *y);
                    let mut out = [0.0; LANES];
                    for i in 0..LANES {
                        let ($x, $y) = (x[i], y[i]);
                        out[i] = $body;
                    }
                    out
                }
            )*
        }
        mod scalar {
            use super::*;
            $(
                #[inline(never)]
                pub(super) fn $name($x: f32, $y: f32) -> f32 {
                    let _ = $y;
                    $body
                }
            )*
        }
        type Both = (&'static str, fn(&Lanes, &Lanes) -> Lanes, fn(f32, f32) -> f32);
        const ALL: &[Both] = &[$((stringify!($name), vectorised::$name, scalar::$name),)*];
    };
}

over_lanes! {
    exp = |x, y| el::exp(x * y);
    expm1 = |x, y| el::expm1(x * y);
    expm1_over_x = |x, y| el::expm1_over_x(-x.abs() * y.abs());
    log = |x, y| el::log(x) + y;
    erf = |x, y| el::erf(x * y);
    erfc = |x, y| el::erfc(x * y);
    erf_integral = |x, y| el::erf_integral((x * y).abs());
    erfc_integral = |x, y| el::erfc_integral((x * y).abs());
    erfc_scaled = |x, y| el::erfc_scaled((x * y).abs());
    erfc_inverse = |x, y| el::erfc_inverse(x.min(2.0)) + y;
    bessel_i0_scaled = |x, y| el::bessel_i0_scaled((x * y).abs());
    beckmann_normal = |x, y| beckmann::sample_visible_normal(Vec3::new(0.6, 0.0, 0.8 * y.abs()),
        Roughness::rotated(0.4, 0.1, 0.6, 0.8), x - x.floor(), y.abs().min(0.9)).x;
    sin_turns = |x, y| el::sin_cos_turns(x.min(10.0) * y).0;
    lobe_integral = |x, y| lobe::integral(x) * y;
    share_2022 = |x, y| hemisphere::share_2022(x, y);
    share = |x, y| hemisphere::share(x, y);
    log_integral = |x, y| hemisphere::log_integral(x, y);
    integral_2022 = |x, y| hemisphere::integral_2022(x, y);
    interpolated_2024 = |x, y| clamped::interpolated_2024(x, y);
    interpolated_v13 = |x, y| clamped::interpolated_v13(x, y);
    interpolated_v14 = |x, y| clamped::interpolated_v14(x, y);
    mean_clamped_cosine = |x, y| clamped::mean_clamped_cosine(x, y);
    convolve = |x, y| vmf::convolve(x, y.abs() * 100.0);
    sharpness_exact = |x, y| vmf::sharpness_exact(vmf::mean(x)) * y;
    product = |x, y| lobe::product(Vec3::new(0.6, 0.0, 0.8), x, Vec3::new(0.0, 0.6, -0.8), y.abs() * 10.0).log_amplitude;
    albedo = |x, y| ggx_albedo(y, x).b;
    glossy_blend = |x, y| {
        let view = Vec3::new((1.0 - y * y).max(0.0).sqrt(), 0.0, y.abs());
        GlossyView::new(view, Vec3::Z, 0.2).blended(Vec3::new(-0.6, 0.0, 0.8), x, x)
    };
    glossy = |x, y| {
        let view = Vec3::new((1.0 - y * y).max(0.0).sqrt(), 0.0, y.abs());
        GlossyView::new(view, Vec3::Z, 0.2).masked(Vec3::new(-0.6, 0.0, 0.8), x, x)
    };
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn bits_agree(x in prop::collection::vec(sharpness(), LANES), y in prop::collection::vec(cosine(), LANES)) {
        let x: Lanes = x.try_into().expect("sixteen");
        let y: Lanes = y.try_into().expect("sixteen");
        for (name, vectorised, scalar) in ALL {
            let lanes = vectorised(&x, &y);
            for i in 0..LANES {
                let one = scalar(x[i], y[i]);
                prop_assert!(lanes[i].to_bits() == one.to_bits(), "{} {:e} {:e}: {:e} {:e}", name, x[i], y[i], lanes[i], one);
            }
        }
    }

    #[test]
    fn glossy_bits_agree(views in prop::collection::vec((direction(), direction(), alpha(), sharpness()), LANES)) {
        let mut input = [[0.0f32; 8]; LANES];
        for (row, (view, axis, alpha, sharpness)) in input.iter_mut().zip(&views) {
            *row = [view.x, view.y, view.z, axis.x, axis.y, axis.z, *alpha, *sharpness];
        }
        let lanes = glossy_lanes(&input);
        for (value, row) in lanes.iter().zip(&input) {
            prop_assert_eq!(value.to_bits(), glossy_of(row).to_bits());
        }
    }
}

#[inline(always)]
fn glossy_of(row: &[f32; 8]) -> f32 {
    let view = Vec3::new(row[0], row[1], row[2]);
    let axis = Vec3::new(row[3], row[4], row[5]);
    GlossyView::new(view, Vec3::Z, row[6]).masked(axis, row[7], row[7] * 0.5)
}

#[multiversion::multiversion(targets("x86_64+avx2+fma"))]
fn glossy_lanes(rows: &[[f32; 8]; LANES]) -> Lanes {
    let rows = *rows;
    let mut out = [0.0; LANES];
    for i in 0..LANES {
        out[i] = glossy_of(&rows[i]);
    }
    out
}

fn shortest(mut f: impl FnMut()) -> Duration {
    (0..12)
        .map(|_| {
            let start = Instant::now();
            f();
            start.elapsed()
        })
        .min()
        .expect("twelve")
}

/// A rule broken in the text (an early return, a table, a call that is not inlined) makes lanes as slow as scalars, without a
/// warning of any kind.
#[test]
fn lanes_pay() {
    if cfg!(debug_assertions) || !cfg!(target_arch = "x86_64") {
        eprintln!("skipped 1 test: speed is judged with optimisation, on x86-64");
        return;
    }
    let x: Lanes = std::array::from_fn(|i| 10f32.powf(i as f32 * 0.5 - 2.0));
    let y: Lanes = std::array::from_fn(|i| (i as f32 - 7.5) / 8.0);
    for (name, vectorised, scalar) in ALL {
        let lanes = shortest(|| {
            for _ in 0..2000 {
                black_box(vectorised(black_box(&x), black_box(&y)));
            }
        });
        let single = shortest(|| {
            for _ in 0..2000 {
                for i in 0..LANES {
                    black_box(scalar(black_box(x[i]), black_box(y[i])));
                }
            }
        });
        let ratio = single.as_secs_f64() / lanes.as_secs_f64();
        eprintln!(
            "{name:22} {ratio:5.1} times, {:6.2} ns a lane",
            lanes.as_secs_f64() * 1e9 / (2000.0 * LANES as f64)
        );
        // Elementary functions alone are bounded by the call; 2.5 still tells vectors from scalars.
        assert!(
            ratio > 2.5,
            "{name} does not vectorise: only {ratio:.1} times as fast as one by one"
        );
    }
}
