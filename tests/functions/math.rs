//! `math/`: elementary functions, vectors, moments.

use super::arguments::Kind::*;
use super::table::{Arguments, Entry, entry};
use vsgl_core::math::moments::{Moments, Scatter};
use vsgl_core::math::{elementary, sobol, vec};

pub(super) fn entries() -> Vec<Entry> {
    let mut all = elementary_functions();
    all.extend(vectors());
    all.extend(moments());
    all.extend(integers());
    all
}

fn elementary_functions() -> Vec<Entry> {
    const FILE: &str = "math/elementary";
    vec![
        entry(FILE, "elementary_exp", &[Signed(1e-9, 200.0)], |a| {
            elementary::exp(a.f(0))
        }),
        entry(FILE, "elementary_expm1", &[Signed(1e-20, 200.0)], |a| {
            elementary::expm1(a.f(0))
        }),
        entry(
            FILE,
            "elementary_expm1_over_x",
            &[Signed(1e-20, 1e12)],
            |a| elementary::expm1_over_x(a.f(0)),
        ),
        entry(
            FILE,
            "elementary_log",
            &[Positive(f32::MIN_POSITIVE, f32::MAX)],
            |a| elementary::log(a.f(0)),
        )
        .floor(1e-2),
        entry(FILE, "elementary_log", &[Even(0.5, 2.0)], |a| {
            elementary::log(a.f(0))
        })
        .floor(1e-2),
        entry(FILE, "elementary_erf", &[Signed(1e-12, 10.0)], |a| {
            elementary::erf(a.f(0))
        }),
        entry(FILE, "elementary_erfc", &[Even(-12.0, 12.0)], |a| {
            elementary::erfc(a.f(0))
        }),
        entry(
            FILE,
            "elementary_erfc_scaled",
            &[Positive(1e-6, 1e32)],
            |a| elementary::erfc_scaled(a.f(0)),
        ),
        entry(FILE, "elementary_erfc_inverse", &[Even(0.0, 2.0)], |a| {
            elementary::erfc_inverse(a.f(0))
        }),
        entry(
            FILE,
            "elementary_erfc_inverse",
            &[Positive(1e-9, 1.0)],
            |a| elementary::erfc_inverse(a.f(0)),
        ),
        entry(
            FILE,
            "elementary_bessel_i0_scaled",
            &[Positive(1e-6, 1e32)],
            |a| elementary::bessel_i0_scaled(a.f(0)),
        ),
        entry(
            FILE,
            "elementary_erf_integral",
            &[Positive(1e-12, 1e30)],
            |a| elementary::erf_integral(a.f(0)),
        ),
        entry(
            FILE,
            "elementary_erfc_integral",
            &[Positive(1e-6, 12.0)],
            |a| elementary::erfc_integral(a.f(0)),
        ),
        entry(
            FILE,
            "elementary_erfc_integral_scaled",
            &[Positive(1e-6, 1e20)],
            |a| elementary::erfc_integral_scaled(a.f(0)),
        ),
        entry(
            FILE,
            "elementary_sin_cos_turns",
            &[Even(-16.0, 16.0)],
            |a| elementary::sin_cos_turns(a.f(0)),
        )
        .floor(1.0),
    ]
}

fn vectors() -> Vec<Entry> {
    const FILE: &str = "math/vec";
    vec![
        entry(FILE, "vec_normalize", &[Vector(1e-18, 1e18)], |a| {
            vec::normalize(a.v(0))
        }),
        entry(FILE, "vec_one_minus_cos", &[Unit, Unit], |a| {
            vec::one_minus_cos(a.v(0), a.v(1))
        }),
        entry(FILE, "vec_reflect", &[Unit, Unit], |a| {
            vec::reflect(a.v(0), a.v(1))
        }),
        entry(FILE, "vec_orthonormal_basis", &[Unit], |a| {
            vec::orthonormal_basis(a.v(0))
        }),
        entry(FILE, "vec_luminance", &[Vector(1e-6, 1e6)], |a| {
            vec::luminance(a.v(0))
        }),
    ]
}

fn moments() -> Vec<Entry> {
    const FILE: &str = "math/moments";
    let weight = Positive(1e-12, 1e6);
    let spread = Positive(1e-12, 1e9);
    let one = |a: &Arguments<'_>, i: usize| Moments {
        mean: a.v(i),
        spread: a.f(i + 1),
    };
    let full = |a: &Arguments<'_>, i: usize| Scatter {
        mean: a.v(i),
        diagonal: a.v(i + 1),
        rest: a.v(i + 2),
    };
    let place = Vector(1e-3, 1e4);
    vec![
        entry(FILE, "moments_point", &[place], |a| Moments::point(a.v(0))),
        entry(
            FILE,
            "moments_merge",
            &[place, spread, weight, place, spread, weight],
            move |a| one(a, 0).merge(a.f(2), one(a, 3), a.f(5)),
        )
        .by("moments_merge(Moments(x0, x1), x2, Moments(x3, x4), x5)"),
        entry(FILE, "moments_scaled", &[place, spread, weight], move |a| {
            one(a, 0).scaled(a.f(2))
        })
        .by("moments_scaled(Moments(x0, x1), x2)"),
        entry(FILE, "scatter_point", &[place], |a| Scatter::point(a.v(0))),
        entry(
            FILE,
            "scatter_merge",
            &[place, place, place, weight, place, place, place, weight],
            move |a| full(a, 0).merge(a.f(3), full(a, 4), a.f(7)),
        )
        .by("scatter_merge(Scatter(x0, x1, x2), x3, Scatter(x4, x5, x6), x7)"),
        entry(
            FILE,
            "scatter_scaled",
            &[place, place, place, weight],
            move |a| full(a, 0).scaled(a.f(3)),
        )
        .by("scatter_scaled(Scatter(x0, x1, x2), x3)"),
    ]
}

/// Upper and lower half of an integer, which f32 holds exactly.
fn halves(x: u32) -> (f32, f32) {
    ((x >> 16) as f32, (x & 0xffff) as f32)
}

/// Functions of integers; the bits of any numbers are their arguments.
fn integers() -> Vec<Entry> {
    const FILE: &str = "math/sobol";
    const HALVES: &str =
        "fn halves(x: u32) -> vec2<f32> { return vec2(f32(x >> 16u), f32(x & 0xffffu)); }\n";
    let bits = Signed(1e-38, 1e38);
    let of = |a: &Arguments<'_>, i: usize| a.f(i).to_bits();
    vec![
        entry(FILE, "sobol_hash", &[bits], move |a| {
            halves(sobol::hash(of(a, 0)))
        })
        .by("halves(sobol_hash(bitcast<u32>(x0)))")
        .with(HALVES),
        entry(FILE, "sobol_combine", &[bits, bits], move |a| {
            halves(sobol::combine(of(a, 0), of(a, 1)))
        })
        .by("halves(sobol_combine(bitcast<u32>(x0), bitcast<u32>(x1)))")
        .with(HALVES),
        entry(FILE, "sobol_scramble", &[bits, bits], move |a| {
            halves(sobol::scramble(of(a, 0), of(a, 1)))
        })
        .by("halves(sobol_scramble(bitcast<u32>(x0), bitcast<u32>(x1)))")
        .with(HALVES),
        entry(FILE, "sobol_sobol", &[bits], move |a| {
            halves(sobol::sobol(of(a, 0))[1])
        })
        .by("halves(sobol_sobol(bitcast<u32>(x0)).y)")
        .with(HALVES),
        entry(FILE, "sobol_point", &[bits, bits, bits], move |a| {
            let [x, y] = sobol::point(of(a, 0), of(a, 1), of(a, 2));
            (x, y)
        })
        .by("sobol_point(bitcast<u32>(x0), bitcast<u32>(x1), bitcast<u32>(x2))"),
        entry(FILE, "sobol_fraction", &[bits], move |a| {
            sobol::fraction(of(a, 0))
        })
        .by("sobol_fraction(bitcast<u32>(x0))"),
    ]
}
