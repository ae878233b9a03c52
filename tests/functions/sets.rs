//! `phase/`: plain mathematics of the density and of the partition.

use super::arguments::Kind::*;
use super::table::{Arguments, Entry, entry};
use vsgl_core::phase::partition::{Features, Statistics};
use vsgl_core::phase::pdf;

const FILE: &str = "phase/partition";

/// Mean and deviation of position and normal from vectors, and the weight before them.
fn features(a: &Arguments<'_>, i: usize) -> Features {
    let pair = |at: usize| {
        let (p, n) = (a.v(i + at), a.v(i + at + 2));
        [p.x, p.y, p.z, 0.0, n.x, n.y, n.z, 0.0]
    };
    Features {
        weight: a.f(i),
        mean: pair(1),
        deviation: pair(2).map(f32::abs),
    }
}

pub(super) fn entries() -> Vec<Entry> {
    let weight = Positive(1e-9, 1e3);
    let place = Vector(1e-2, 1e2);
    let deviation = Vector(1e-9, 1e2);
    let set = [weight, place, deviation, Unit, deviation];
    const ONE: &str = "Features(x1, x0, x3, abs(x2), abs(x4))";
    vec![
        entry("phase/unit", "pdf_unit", &[Signed(1e-38, 1e38)], |a| {
            pdf::unit(a.f(0).to_bits())
        })
        .by("pdf_unit(bitcast<u32>(x0))"),
        entry(FILE, "features_texel", &[weight, place, Unit], |a| {
            let (p, n) = (a.v(1), a.v(2));
            Features::texel(&[p.x, p.y, p.z, a.f(0), n.x, n.y, n.z, 0.0])
        })
        .by("features_texel(vec4(x1, x0), x2)"),
        entry(FILE, "features_merge", &[set, set].concat(), |a| {
            features(a, 0).merge(features(a, 5))
        })
        .by(&format!(
            "features_merge({ONE}, Features(x6, x5, x8, abs(x7), abs(x9)))"
        ))
        // Means of places that may cancel.
        .scales(|a, part| {
            if part == 1 {
                a.v(1).length() + a.v(6).length()
            } else {
                1e-12
            }
        }),
        entry(FILE, "features_scale", &set, |a| features(a, 0).scale())
            .by(&format!("features_scale({ONE})")),
        entry(
            FILE,
            "statistics_new",
            &[&set[..], &[weight]].concat(),
            |a| Statistics::new(&features(a, 0), a.f(5)),
        )
        .by(&format!("statistics_new({ONE}, x5)")),
    ]
}
