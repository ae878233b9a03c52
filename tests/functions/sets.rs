//! `phase/`: plain mathematics of the density, of the partition, of square kernels and of nearest centres.

use super::arguments::Kind::*;
use super::table::{Arguments, Entry, entry};
use vsgl_core::glam::Vec3;
use vsgl_core::phase::filtered_box::{Cells, side_of};
use vsgl_core::phase::nearest::{Bounds, Centre, Nearest, key};
use vsgl_core::phase::partition::{Features, Statistics};
use vsgl_core::phase::pdf;

const FILE: &str = "phase/partition";
const BOX: &str = "phase/filtered_box";
const NEAREST: &str = "phase/nearest";

/// The box of two points.
fn bounds(a: Vec3, b: Vec3) -> Bounds {
    Bounds::point(a).join(Bounds::point(b))
}

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
    let (texel, side) = (Even(0.0, 512.0), Positive(0.0625, 1024.0));
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
        entry(BOX, "filtered_box_side_of", &[Even(-4.0, 13.0)], |a| {
            side_of(a.f(0))
        }),
        entry(BOX, "cells_at", &[texel, texel, side, Even(0.0, 1.0)], |a| {
            let cells = Cells::new(512, a.f(0), a.f(1), a.f(2));
            cells.at((a.f(3) * (cells.count - 1) as f32) as u32)
        })
        .by("cells_at(cells_new(512u, x0, x1, x2), u32(x3 * f32(cells_new(512u, x0, x1, x2).count - 1u)))"),
        entry(NEAREST, "nearest_key", &[texel, texel], |a| {
            key(1, 512, a.f(0) as u32, a.f(1) as u32)
        })
        .by("nearest_key(1u, 512u, u32(x0), u32(x1))"),
        entry(NEAREST, "bounds_distance2", &[place; 3], |a| {
            bounds(a.v(0), a.v(1)).distance2(a.v(2))
        })
        .by("bounds_distance2(bounds_join(Bounds(x0, x0), Bounds(x1, x1)), x2)"),
        entry(NEAREST, "nearest_or", &[weight, place, place], |a| {
            let (number, distance2) = (3, a.f(0));
            let (position, other) = (a.v(1), 2);
            Nearest { number, distance2 }.or(&Centre { position, number: other }, a.v(2))
        })
        .by("nearest_or(Nearest(3u, x0), Centre(x1, 2u), x2)"),
    ]
}
