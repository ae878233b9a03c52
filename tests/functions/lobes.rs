//! `sg/`: lobes, their integrals over spheres, hemispheres and cosines.

use super::arguments::Kind::*;
use super::table::{Arguments, Entry, entry};
use vsgl_core::sg::lobe::{self, SgLobe};
use vsgl_core::sg::polar::PolarMoments;
use vsgl_core::sg::vmf::{self, MeanLength};
use vsgl_core::sg::{asg, cosine, extent, hemisphere};

pub(super) fn entries() -> Vec<Entry> {
    let mut all = lobes();
    all.extend(mean_lengths());
    all.extend(halves());
    all.extend(cosines());
    all.extend(rest());
    all
}

fn lobes() -> Vec<Entry> {
    const FILE: &str = "sg/lobe";
    let lobe = |a: &Arguments<'_>| SgLobe {
        axis: a.v(0),
        sharpness: a.f(1),
        log_amplitude: a.f(2),
    };
    let log = Signed(1e-3, 1e4);
    let pair = [Unit, Sharpness, Unit, Sharpness];
    vec![
        entry(FILE, "sg_lobe_new", &[Unit, Sharpness], |a| {
            SgLobe::new(a.v(0), a.f(1))
        }),
        entry(
            FILE,
            "sg_lobe_evaluate",
            &[Unit, Positive(1e-6, 4.4e12), log, Unit],
            move |a| lobe(a).evaluate(a.v(3)),
        )
        .by("sg_lobe_evaluate(SgLobe(x0, x1, x2), x3)"),
        entry(
            FILE,
            "sg_lobe_integral",
            &[Unit, Positive(1e-6, 4.4e12), log],
            move |a| lobe(a).integral(),
        )
        .by("sg_lobe_integral(SgLobe(x0, x1, x2))"),
        entry(
            FILE,
            "sg_lobe_log_integral",
            &[Unit, Positive(1e-6, 4.4e12), log],
            move |a| lobe(a).log_integral(),
        )
        .by("sg_lobe_log_integral(SgLobe(x0, x1, x2))")
        .floor(1.0),
        entry(FILE, "lobe_evaluate", &[Unit, Sharpness, Unit], |a| {
            lobe::evaluate(a.v(0), a.f(1), a.v(2))
        }),
        entry(FILE, "lobe_integral", &[Sharpness], |a| {
            lobe::integral(a.f(0))
        }),
        entry(FILE, "lobe_log_integral", &[Sharpness], |a| {
            lobe::log_integral(a.f(0))
        })
        .floor(1.0),
        entry(FILE, "lobe_integral_sharp", &[Sharpness], |a| {
            lobe::integral_sharp(a.f(0))
        }),
        entry(FILE, "lobe_product", &pair, |a| {
            lobe::product(a.v(0), a.f(1), a.v(2), a.f(3))
        }),
        entry(
            FILE,
            "lobe_product_by_chord",
            &[Sharpness, Sharpness, Even(0.0, 4.0)],
            |a| lobe::product_by_chord(a.f(0), a.f(1), a.f(2)),
        ),
        // Where nearly nothing is left the rounding of the exponent, up to 87, counts.
        entry(FILE, "lobe_inner_product", &pair, |a| {
            lobe::inner_product(a.v(0), a.f(1), a.v(2), a.f(3))
        })
        .floor(1e-20),
        entry(FILE, "lobe_log_inner_product", &pair, |a| {
            lobe::log_inner_product(a.v(0), a.f(1), a.v(2), a.f(3))
        })
        .floor(1.0),
        entry(FILE, "lobe_inner_product_sharp", &pair, |a| {
            lobe::inner_product_sharp(a.v(0), a.f(1), a.v(2), a.f(3))
        }),
    ]
}

fn mean_lengths() -> Vec<Entry> {
    const FILE: &str = "sg/vmf";
    // A length from its complement, which a quarter of the arguments has small.
    let mean = |a: &Arguments<'_>| MeanLength {
        length: 1.0 - a.f(0),
        complement: a.f(0),
    };
    let complement = Positive(1e-13, 1.0);
    vec![
        entry(FILE, "mean_length_from_length", &[Even(0.0, 1.0)], |a| {
            MeanLength::from_length(a.f(0))
        }),
        entry(
            FILE,
            "mean_length_convolve",
            &[complement, complement],
            move |a| {
                let other = MeanLength {
                    length: 1.0 - a.f(1),
                    complement: a.f(1),
                };
                mean(a).convolve(other)
            },
        )
        .by("mean_length_convolve(MeanLength(1.0 - x0, x0), MeanLength(1.0 - x1, x1))"),
        entry(FILE, "vmf_mean", &[Sharpness], |a| vmf::mean(a.f(0))),
        entry(FILE, "vmf_mean_length", &[Sharpness], |a| {
            vmf::mean_length(a.f(0))
        }),
        entry(FILE, "vmf_mean_length_complement", &[Sharpness], |a| {
            vmf::mean_length_complement(a.f(0))
        }),
        entry(FILE, "vmf_sharpness", &[complement], move |a| {
            vmf::sharpness(mean(a))
        })
        .by("vmf_sharpness(MeanLength(1.0 - x0, x0))"),
        entry(FILE, "vmf_sharpness", &[Sharpness], |a| {
            vmf::sharpness(vmf::mean(a.f(0)))
        })
        .by("vmf_sharpness(vmf_mean(x0))"),
        entry(FILE, "vmf_sharpness_exact", &[complement], move |a| {
            vmf::sharpness_exact(mean(a))
        })
        .by("vmf_sharpness_exact(MeanLength(1.0 - x0, x0))"),
        entry(FILE, "vmf_sharpness_exact", &[Sharpness], |a| {
            vmf::sharpness_exact(vmf::mean(a.f(0)))
        })
        .by("vmf_sharpness_exact(vmf_mean(x0))"),
        entry(FILE, "vmf_convolve", &[Sharpness, Sharpness], |a| {
            vmf::convolve(a.f(0), a.f(1))
        }),
        entry(
            FILE,
            "vmf_convolve_with",
            &[complement, Sharpness],
            move |a| vmf::convolve_with(mean(a), a.f(1)),
        )
        .by("vmf_convolve_with(MeanLength(1.0 - x0, x0), x1)"),
        entry(
            FILE,
            "vmf_sharpness_banerjee_2005",
            &[complement],
            move |a| vmf::sharpness_banerjee_2005(mean(a)),
        )
        .by("vmf_sharpness_banerjee_2005(MeanLength(1.0 - x0, x0))"),
        entry(FILE, "vmf_mean_banerjee_2005", &[Sharpness], |a| {
            vmf::mean_banerjee_2005(a.f(0))
        }),
        entry(
            FILE,
            "vmf_sharpness_toksvig_2005",
            &[complement],
            move |a| vmf::sharpness_toksvig_2005(mean(a)),
        )
        .by("vmf_sharpness_toksvig_2005(MeanLength(1.0 - x0, x0))"),
        entry(FILE, "vmf_mean_toksvig_2005", &[Sharpness], |a| {
            vmf::mean_toksvig_2005(a.f(0))
        }),
    ]
}

/// A function of sharpness and cosine.
macro_rules! of_lobe {
    ($file:literal, $($wgsl:literal $rust:path),* $(,)?) => {
        vec![$(entry($file, $wgsl, &[Sharpness, Cosine], |a| $rust(a.f(0), a.f(1)))),*]
    };
}

/// A function of sharpness.
macro_rules! of_sharpness {
    ($file:literal, $($wgsl:literal $rust:path),* $(,)?) => {
        vec![$(entry($file, $wgsl, &[Sharpness], |a| $rust(a.f(0)))),*]
    };
}

fn halves() -> Vec<Entry> {
    let mut all = vec![
        entry("sg/polar", "polar_moments_new", &[Sharpness], |a| {
            PolarMoments::new(a.f(0))
        }),
        entry("sg/polar", "polar_moments_sphere", &[Sharpness], |a| {
            PolarMoments::new(a.f(0)).sphere()
        })
        .by("polar_moments_sphere(polar_moments_new(x0))"),
    ];
    all.extend(of_sharpness!(
        "sg/hemisphere",
        "hemisphere_upper" hemisphere::upper,
        "hemisphere_lower" hemisphere::lower,
        "hemisphere_log_lower" hemisphere::log_lower,
    ));
    all.extend(of_lobe!(
        "sg/hemisphere",
        "hemisphere_integral_2018" hemisphere::integral_2018,
        "hemisphere_integral_2022" hemisphere::integral_2022,
        "hemisphere_share_2022" hemisphere::share_2022,
        "hemisphere_integral" hemisphere::integral,
        "hemisphere_share" hemisphere::share,
        "hemisphere_log_integral" hemisphere::log_integral,
        "hemisphere_log_share" hemisphere::log_share,
    ));
    sized(all)
}

fn cosines() -> Vec<Entry> {
    let mut all = of_sharpness!(
        "sg/cosine",
        "cosine_upper" cosine::upper,
        "cosine_lower" cosine::lower,
        "cosine_log_lower" cosine::log_lower,
    );
    all.extend(of_lobe!(
        "sg/cosine",
        "cosine_constant" cosine::constant,
        "cosine_sg_2015" cosine::sg_2015,
        "cosine_sg_iwasaki_2012" cosine::sg_iwasaki_2012,
        "cosine_sg_product" cosine::sg_product,
        "cosine_lobes_2018" cosine::lobes_2018,
        "cosine_lobes_2022" cosine::lobes_2022,
        "cosine_interpolated_2024" cosine::interpolated_2024,
        "cosine_interpolated_v13" cosine::interpolated_v13,
        "cosine_interpolated_v14" cosine::interpolated_v14,
        "cosine_log_interpolated" cosine::log_interpolated,
        "cosine_mean_clamped_cosine" cosine::mean_clamped_cosine,
        "cosine_odd_part" cosine::odd_part,
    ));
    sized(all)
}

/// The size of a logarithm is that of a relative error, 1; that of a share of the sphere is what the whole has.
fn sized(all: Vec<Entry>) -> Vec<Entry> {
    let size = |e: Entry| match e.name {
        name if name.contains("_log_") => e.floor(1.0),
        name if name.contains("_share") => e.floor(1.0),
        name if name.starts_with("polar")
            || name.ends_with("_upper")
            || name.ends_with("_lower") =>
        {
            e
        }
        // Their terms: 32 and 1183 times that.
        "cosine_lobes_2018" => e.scale(|a| 32.0 * hemisphere::upper(a.f(0))),
        "cosine_lobes_2022" => e.scale(|a| 1183.0 * hemisphere::upper(a.f(0))),
        _ => e.scale(|a| hemisphere::upper(a.f(0))),
    };
    all.into_iter().map(size).collect()
}

fn rest() -> Vec<Entry> {
    let variance = Positive(1e-12, 1e6);
    let mixed = Signed(1e-12, 1e6);
    let half = Positive(1e-3, 1e12);
    vec![
        entry(
            "sg/extent",
            "extent_along",
            &[variance, variance, variance, mixed, mixed, mixed, Unit],
            |a| extent::along(&[a.f(0), a.f(1), a.f(2), a.f(3), a.f(4), a.f(5)], a.v(6)),
        )
        .by("extent_along(array(x0, x1, x2, x3, x4, x5), x6)"),
        entry(
            "sg/extent",
            "extent_along_flat",
            &[variance, Even(0.0, 1.0), Cosine],
            |a| extent::along_flat(a.f(0), a.f(1), a.f(2)),
        ),
        entry("sg/asg", "asg_reflection_lobe", &[Unit, Unit, half], |a| {
            asg::reflection_lobe(a.v(0), a.v(1), a.f(2))
        }),
        entry(
            "sg/asg",
            "asg_lobe_evaluate",
            &[Unit, Unit, half, Unit],
            |a| asg::reflection_lobe(a.v(0), a.v(1), a.f(2)).evaluate(a.v(3)),
        )
        .by("asg_lobe_evaluate(asg_reflection_lobe(x0, x1, x2), x3)"),
        entry(
            "sg/asg",
            "asg_lobe_product_integral",
            &[Unit, Unit, half, Unit, Sharpness],
            |a| asg::reflection_lobe(a.v(0), a.v(1), a.f(2)).product_integral(a.v(3), a.f(4)),
        )
        .by("asg_lobe_product_integral(asg_reflection_lobe(x0, x1, x2), x3, x4)"),
    ]
}
