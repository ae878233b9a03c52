//! `phase/sampled` and `phase/reconstruct`: what a light brings, and how alike two samples are.

use super::arguments::Kind::*;
use super::table::{Entry, entry};
use vsgl_core::phase::reconstruct::{Patch, tent};
use vsgl_core::phase::sampled;
use vsgl_core::phase::shade::Colors;

pub(super) fn entries() -> Vec<Entry> {
    let color = Vector(1e-3, 1e3);
    let place = Vector(1e-3, 1e2);
    let patch = [place, Unit, Alpha];
    const FILE: &str = "phase/sampled";
    const RECONSTRUCT: &str = "phase/reconstruct";
    vec![
        entry(
            FILE,
            "sampled_contribution",
            &[color, color, Even(0.0, 1.0), color, color, color],
            |a| {
                let colors = Colors {
                    albedo: a.v(0),
                    f0: a.v(1),
                    f90: a.f(2),
                };
                sampled::contribution(&colors, a.v(3), a.v(4), a.v(5))
            },
        )
        .by("sampled_contribution(Colors(x0, x1, x2), x3, x4, x5)")
        // Colours of both signs cancel.
        .scale(|a| {
            let [albedo, f0, diffuse, near, grazing] = [0, 1, 3, 4, 5].map(|i| a.v(i).length());
            albedo * diffuse + (f0 * near + a.f(2) * grazing)
        }),
        entry(
            FILE,
            "sampled_threshold",
            &[Even(0.0, 63.0), Even(0.0, 1.0), Positive(1e-9, 1e3)],
            |a| sampled::threshold(a.f(0).max(0.0) as u32, a.f(1), a.f(2)),
        )
        .by("sampled_threshold(u32(min(max(x0, 0.0), 1e6)), x1, x2)"),
        entry(
            FILE,
            "sampled_step",
            &[Positive(1e-9, 1e3), Even(1.0, 64.0)],
            |a| sampled::step(a.f(0), a.f(1).max(1.0) as u32),
        )
        .by("sampled_step(x0, u32(min(max(x1, 1.0), 1e6)))"),
        entry(
            RECONSTRUCT,
            "reconstruct_tent",
            &[Even(1.0, 8.0), Even(-8.0, 8.0)],
            |a| {
                tent(
                    a.f(0).clamp(0.0, 1e6) as u32,
                    a.f(1).clamp(-1e6, 1e6) as i32,
                )
            },
        )
        .by("reconstruct_tent(u32(max(min(x0, 1e6), 0.0)), i32(max(min(x1, 1e6), -1e6)))"),
        entry(
            RECONSTRUCT,
            "patch_likeness",
            &[patch, patch].concat(),
            |a| {
                let at = |i: usize| Patch {
                    position: a.v(i),
                    normal: a.v(i + 1),
                    alpha: a.f(i + 2),
                };
                at(0).likeness(&at(3))
            },
        )
        .by("patch_likeness(Patch(x0, x1, x2), Patch(x3, x4, x5))")
        // Shares of one, made of differences.
        .floor(1.0),
    ]
}
