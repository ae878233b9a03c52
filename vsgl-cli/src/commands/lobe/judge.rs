//! Which function is judged by which column, and how much error the documentation admits.

use super::errors::{Errors, Limit, Measure};
use super::table::{Row, Table};
use crate::exit::Result;
use Limit::{Max, Median, P99};
use Measure::{Absolute, Logarithm, OfPeak, Relative, Ulp};
use std::path::Path;
use vsgl_core::brdf::roughness::Roughness;
use vsgl_core::brdf::{beckmann, ggx_local};
use vsgl_core::glam::Vec3;
use vsgl_core::math::elementary as el;
use vsgl_core::sg::asg::AsgLobe;
use vsgl_core::sg::{cosine, filtering, glossy, glossy_blend, hemisphere, lobe, vmf, warp};

/// A comparison of one row: the value, the exact one, and the scale for errors relative to a peak.
struct Pair {
    value: f64,
    exact: f64,
    scale: f64,
}

fn pair(value: f32, exact: f64) -> Option<Pair> {
    Some(Pair {
        value: f64::from(value),
        exact,
        scale: 1.0,
    })
}

fn of_peak(value: f32, exact: f64, scale: f64) -> Option<Pair> {
    Some(Pair {
        value: f64::from(value),
        exact,
        scale,
    })
}

/// Judges the functions of one table.
struct Judge<'a> {
    table: &'a Table,
    sharpness: &'static str,
    out: Vec<Errors>,
}

impl Judge<'_> {
    /// Compares `f` over all rows for which it yields a pair. Every value must be finite.
    fn add(
        &mut self,
        function: &'static str,
        measure: Measure,
        limit: Limit,
        f: impl Fn(&Row<'_>) -> Option<Pair>,
    ) {
        let (mut samples, mut unfit) = (Vec::new(), 0);
        for row in self.table.rows() {
            if let Some(p) = f(&row) {
                let negative = p.exact >= 0.0 && p.value < 0.0;
                unfit += usize::from(!p.value.is_finite() || negative);
                samples.push((
                    measure.error(p.value, p.exact, p.scale),
                    row.exact(self.sharpness),
                ));
            }
        }
        self.out
            .push(Errors::new(function, measure, limit, unfit, &samples));
    }
}

type Rule = (&'static str, &'static str, fn(&mut Judge<'_>));

/// Tables that are known: file name without extension, column of the sharpness, judge.
const RULES: &[Rule] = &[
    ("expm1_over_x", "", expm1_over_x),
    ("erf", "", erf),
    ("sg_integral", "sharpness", sg_integral),
    ("sg_clamped_cosine_bounds", "sharpness", bounds),
    ("sg_product", "sharpness1", product),
    ("sg_product_len2", "sharpness1", product_by_chord),
    ("vmf_mean_length", "sharpness", mean_length),
    ("sg_hemisphere", "sharpness", hemispheres),
    ("microfacet_ndf", "", microfacets),
    ("filtered_lobe", "sharpness", filtered_lobe),
    ("asg_sg_integral", "sharpness", asg_integral),
    ("brdf_sg_integral", "sharpness", glossy_integral),
];

/// Judges every function for which the folder holds a table. Returns name of the table and errors, in a fixed order.
///
/// # Errors
/// [`crate::exit::Failure::Input`] for a table that cannot be read. Missing tables are left out.
pub fn judge(folder: &Path) -> Result<Vec<(&'static str, Vec<Errors>)>> {
    let mut all = Vec::new();
    for (name, sharpness, rule) in RULES {
        let path = folder.join(format!("{name}.csv"));
        if path.is_file() {
            let table = Table::read(&path)?;
            let mut judge = Judge {
                table: &table,
                sharpness,
                out: Vec::new(),
            };
            rule(&mut judge);
            all.push((*name, judge.out));
        }
    }
    Ok(all)
}

fn expm1_over_x(j: &mut Judge<'_>) {
    // Above the saturation of the exponential the values are far outside f32.
    let within = |r: &Row<'_>| r.argument("x") <= el::EXP_ARGUMENT_MAX;
    j.add("math::elementary::expm1", Ulp, Max(2.5), |r| {
        within(r).then(|| pair(el::expm1(r.argument("x")), r.exact("expm1")))?
    });
    j.add("math::elementary::expm1_over_x", Ulp, Max(2.5), |r| {
        within(r).then(|| pair(el::expm1_over_x(r.argument("x")), r.exact("expm1_over_x")))?
    });
}

fn erf(j: &mut Judge<'_>) {
    j.add("math::elementary::erf", Ulp, Max(4.0), |r| {
        pair(el::erf(r.argument("x")), r.exact("erf"))
    });
    j.add("math::elementary::erfc", Ulp, Max(5.0), |r| {
        // From here on the result is formed with an exponential below the normal numbers.
        (r.argument("x") < 9.1).then(|| pair(el::erfc(r.argument("x")), r.exact("erfc")))?
    });
    j.add("math::elementary::erfc, tail", Absolute, Max(1e-35), |r| {
        (r.argument("x") >= 9.1).then(|| pair(el::erfc(r.argument("x")), r.exact("erfc")))?
    });
}

/// Rows that the functions take as they are: beyond the sharpest lobe they clamp.
fn sharp_enough(r: &Row<'_>, column: &str) -> bool {
    r.argument(column) <= lobe::SHARPNESS_MAX
}

fn sg_integral(j: &mut Judge<'_>) {
    let column = "sharpness";
    j.add("sg::lobe::integral", Ulp, Max(4.0), |r| {
        sharp_enough(r, column)
            .then(|| pair(lobe::integral(r.argument(column)), r.exact("sg_integral")))?
    });
    j.add("sg::hemisphere::upper", Ulp, Max(4.0), |r| {
        sharp_enough(r, column)
            .then(|| pair(hemisphere::upper(r.argument(column)), r.exact("c_upper")))?
    });
    j.add("sg::hemisphere::lower", Ulp, Max(5.0), |r| {
        // Above 87 the value is subnormal, and zero here.
        (r.argument(column) < 83.0)
            .then(|| pair(hemisphere::lower(r.argument(column)), r.exact("c_lower")))?
    });
    j.add("sg::hemisphere::log_lower", Logarithm, Max(3e-7), |r| {
        sharp_enough(r, column).then(|| {
            of_peak(
                hemisphere::log_lower(r.argument(column)),
                r.exact("ln_c_lower"),
                1.0,
            )
        })?
    });
}

fn bounds(j: &mut Judge<'_>) {
    let (column, tau) = ("sharpness", std::f64::consts::TAU);
    j.add("sg::cosine::upper", Ulp, Max(6.0), |r| {
        sharp_enough(r, column).then(|| {
            pair(
                cosine::upper(r.argument(column)),
                tau * r.exact("b_upper_over_2pi"),
            )
        })?
    });
    j.add("sg::cosine::lower", Ulp, Max(7.0), |r| {
        (r.argument(column) < 80.0).then(|| {
            pair(
                cosine::lower(r.argument(column)),
                tau * r.exact("b_lower_over_2pi"),
            )
        })?
    });
    j.add("sg::cosine::log_lower", Logarithm, Max(5e-7), |r| {
        let exact = r.exact("ln_b_lower_over_2pi") + tau.ln();
        sharp_enough(r, column).then(|| pair(cosine::log_lower(r.argument(column)), exact))?
    });
}

fn product(j: &mut Judge<'_>) {
    // Errors relative to the larger sharpness: what is left of two opposite lobes has its rounding.
    let larger = |r: &Row<'_>| r.exact("sharpness1").max(r.exact("sharpness2")).max(1e-30);
    // Close to -1 a rounded cosine does not hold the chord; `sg_product_len2` judges opposite axes.
    let sharp = |r: &Row<'_>| {
        let held = r.exact("cosine") > -0.9999;
        held && sharp_enough(r, "sharpness1") && sharp_enough(r, "sharpness2")
    };
    let value = |r: &Row<'_>| {
        let chord2 = 2.0 * (1.0 - r.argument("cosine"));
        lobe::product_by_chord(r.argument("sharpness1"), r.argument("sharpness2"), chord2)
    };
    j.add(
        "sg::lobe::product_by_chord, sharpness",
        OfPeak,
        Max(1.5e-6),
        |r| sharp(r).then(|| of_peak(value(r).0, r.exact("product_sharpness"), larger(r)))?,
    );
    j.add(
        "sg::lobe::product_by_chord, log_amplitude",
        Relative,
        Max(8e-7),
        |r| sharp(r).then(|| pair(value(r).1, r.exact("log_amplitude")))?,
    );
    j.add("sg::lobe::log_inner_product", Absolute, P99(2e-5), |r| {
        // The axes are rounded to f32, which moves them by 1e-7: only lobes that do not resolve this are comparable.
        let (z, k) = (r.exact("cosine"), larger(r));
        let axis = Vec3::new((1.0 - z * z).max(0.0).sqrt() as f32, 0.0, z as f32);
        let log = lobe::log_inner_product(
            axis,
            r.argument("sharpness1"),
            Vec3::Z,
            r.argument("sharpness2"),
        );
        (k < 100.0).then(|| pair(log, r.exact("ln_inner_product")))?
    });
}

fn product_by_chord(j: &mut Judge<'_>) {
    let larger = |r: &Row<'_>| r.exact("sharpness1").max(r.exact("sharpness2")).max(1e-30);
    let sharp = |r: &Row<'_>| sharp_enough(r, "sharpness1") && sharp_enough(r, "sharpness2");
    let value = |r: &Row<'_>| {
        lobe::product_by_chord(
            r.argument("sharpness1"),
            r.argument("sharpness2"),
            r.argument("len2"),
        )
    };
    j.add(
        "sg::lobe::product_by_chord, sharpness",
        OfPeak,
        Max(6e-7),
        |r| sharp(r).then(|| of_peak(value(r).0, r.exact("product_sharpness"), larger(r)))?,
    );
    j.add(
        "sg::lobe::product_by_chord, log_amplitude",
        Relative,
        Max(8e-7),
        |r| sharp(r).then(|| pair(value(r).1, r.exact("log_amplitude")))?,
    );
}

fn mean_length(j: &mut Judge<'_>) {
    let column = "sharpness";
    let k = |r: &Row<'_>| r.argument("sharpness");
    let fits = |r: &Row<'_>| sharp_enough(r, column);
    j.add("sg::vmf::mean_length", Ulp, Max(4.0), |r| {
        fits(r).then(|| pair(vmf::mean_length(k(r)), r.exact("mean_length")))?
    });
    j.add("sg::vmf::mean_length_complement", Ulp, Max(4.0), |r| {
        fits(r).then(|| {
            pair(
                vmf::mean_length_complement(k(r)),
                r.exact("one_minus_mean_length"),
            )
        })?
    });
    j.add("sg::vmf::sharpness of mean", Relative, Max(6.5e-5), |r| {
        fits(r).then(|| pair(vmf::sharpness(vmf::mean(k(r))), r.exact(column)))?
    });
    j.add(
        "sg::vmf::sharpness_exact of mean",
        Relative,
        Max(1.5e-6),
        |r| fits(r).then(|| pair(vmf::sharpness_exact(vmf::mean(k(r))), r.exact(column)))?,
    );
    j.add(
        "sg::vmf::sharpness_banerjee_2005 of mean",
        Relative,
        Max(1e-6),
        |r| {
            let exact = r.exact("banerjee_sharpness_of_mean_length");
            let inside = exact <= f64::from(lobe::SHARPNESS_MAX);
            (fits(r) && inside)
                .then(|| pair(vmf::sharpness_banerjee_2005(vmf::mean(k(r))), exact))?
        },
    );
    j.add(
        "sg::vmf::sharpness_toksvig_2005 of mean",
        Relative,
        Max(1e-6),
        |r| {
            let exact = r.exact("toksvig_sharpness_of_mean_length");
            let inside = exact <= f64::from(lobe::SHARPNESS_MAX);
            (fits(r) && inside)
                .then(|| pair(vmf::sharpness_toksvig_2005(vmf::mean(k(r))), exact))?
        },
    );
}

type OfCosine = fn(f32, f32) -> f32;

fn hemispheres(j: &mut Judge<'_>) {
    let fits = |r: &Row<'_>| sharp_enough(r, "sharpness");
    let hemispherical: [(&str, OfCosine, f64); 3] = [
        ("sg::hemisphere::integral", hemisphere::integral, 6.3e-4),
        (
            "sg::hemisphere::integral_2018",
            hemisphere::integral_2018,
            1.25e-2,
        ),
        (
            "sg::hemisphere::integral_2022",
            hemisphere::integral_2022,
            4.9e-3,
        ),
    ];
    for (name, f, limit) in hemispherical {
        j.add(name, OfPeak, Max(limit), |r| {
            let (k, z) = (r.argument("sharpness"), r.argument("cosine"));
            let peak = f64::from(hemisphere::upper(k));
            fits(r).then(|| of_peak(f(k, z), r.exact("sg_hemispherical_integral"), peak))?
        });
    }
    j.add("sg::hemisphere::share", Absolute, Max(6.3e-4), |r| {
        let (k, z) = (r.argument("sharpness"), r.argument("cosine"));
        fits(r).then(|| {
            pair(
                hemisphere::share(k, z),
                r.exact("vmf_hemispherical_integral"),
            )
        })?
    });
    j.add("sg::hemisphere::share_2022", Absolute, Max(4.9e-3), |r| {
        let (k, z) = (r.argument("sharpness"), r.argument("cosine"));
        fits(r).then(|| {
            pair(
                hemisphere::share_2022(k, z),
                r.exact("vmf_hemispherical_integral"),
            )
        })?
    });
    let cosines: [(&str, OfCosine, f64); 9] = [
        (
            "sg::cosine::interpolated_v14",
            cosine::interpolated_v14,
            4.5e-5,
        ),
        ("sg::cosine::constant", cosine::constant, 3.01),
        ("sg::cosine::sg_2015", cosine::sg_2015, 0.155),
        (
            "sg::cosine::sg_iwasaki_2012",
            cosine::sg_iwasaki_2012,
            0.145,
        ),
        ("sg::cosine::sg_product", cosine::sg_product, 0.145),
        ("sg::cosine::lobes_2018", cosine::lobes_2018, 1.55e-2),
        ("sg::cosine::lobes_2022", cosine::lobes_2022, 5e-3),
        (
            "sg::cosine::interpolated_2024",
            cosine::interpolated_2024,
            1.6e-3,
        ),
        (
            "sg::cosine::interpolated_v13",
            cosine::interpolated_v13,
            1.3e-4,
        ),
    ];
    for (name, f, limit) in cosines {
        j.add(name, OfPeak, Max(limit), |r| {
            let (k, z) = (r.argument("sharpness"), r.argument("cosine"));
            let peak = f64::from(cosine::upper(k));
            fits(r).then(|| of_peak(f(k, z), r.exact("sg_clamped_cosine_integral"), peak))?
        });
    }
    j.add("sg::hemisphere::log_integral", Logarithm, Max(0.01), |r| {
        let (k, z) = (r.argument("sharpness"), r.argument("cosine"));
        let exact = r.exact("ln_sg_hemispherical_integral");
        fits(r).then(|| pair(hemisphere::log_integral(k, z), exact))?
    });
    j.add("sg::cosine::log_interpolated", Logarithm, Max(0.13), |r| {
        let (k, z) = (r.argument("sharpness"), r.argument("cosine"));
        let exact = r.exact("ln_sg_clamped_cosine_integral");
        fits(r).then(|| pair(cosine::log_interpolated(k, z), exact))?
    });
    j.add(
        "sg::cosine::mean_clamped_cosine",
        OfPeak,
        Max(1.3e-4),
        |r| {
            let (k, z) = (r.argument("sharpness"), r.argument("cosine"));
            let whole = f64::from(lobe::integral(k));
            let peak = f64::from(cosine::upper(k)) / whole;
            let exact = r.exact("sg_clamped_cosine_integral") / whole;
            fits(r).then(|| of_peak(cosine::mean_clamped_cosine(k, z), exact, peak))?
        },
    );
}

fn microfacets(j: &mut Judge<'_>) {
    let roughness = |r: &Row<'_>| {
        Roughness::from_entries(r.argument("a11"), r.argument("a12"), r.argument("a22"))
    };
    let direction = |r: &Row<'_>| r.vector("x", "y", "z");
    let grazing = |r: &Row<'_>| r.exact("z").abs() < 1e-8;
    j.add("brdf::ggx_local::distribution", Relative, Max(3e-6), |r| {
        pair(
            ggx_local::distribution(direction(r), roughness(r)),
            r.exact("ggx_d"),
        )
    });
    j.add("brdf::ggx_local::lambda", Relative, Max(3e-6), |r| {
        (!grazing(r)).then(|| {
            pair(
                ggx_local::lambda(direction(r), roughness(r)),
                r.exact("ggx_lambda"),
            )
        })?
    });
    j.add(
        "brdf::ggx_local::projected_area",
        Relative,
        Max(2e-6),
        |r| {
            pair(
                ggx_local::projected_area(direction(r), roughness(r)),
                r.exact("ggx_microflake_area"),
            )
        },
    );
    // The exponent's rounding is amplified by the exponent: judged where that is moderate, by its logarithm elsewhere.
    j.add("brdf::beckmann::distribution", Relative, Max(2e-5), |r| {
        let moderate = r.exact("ln_beckmann_d") > -30.0;
        moderate.then(|| {
            pair(
                beckmann::distribution(direction(r), roughness(r)),
                r.exact("beckmann_d"),
            )
        })?
    });
    j.add(
        "brdf::beckmann::log_distribution",
        Logarithm,
        Max(3e-6),
        |r| {
            let finite = r.exact("ln_beckmann_d").abs() < 1e37;
            finite.then(|| {
                pair(
                    beckmann::log_distribution(direction(r), roughness(r)),
                    r.exact("ln_beckmann_d"),
                )
            })?
        },
    );
    j.add("brdf::beckmann::lambda", Relative, Max(3e-5), |r| {
        let normal = r.exact("beckmann_lambda") > 1e-30;
        (normal && !grazing(r)).then(|| {
            pair(
                beckmann::lambda(direction(r), roughness(r)),
                r.exact("beckmann_lambda"),
            )
        })?
    });
    j.add("brdf::beckmann::projected_area", Relative, Max(2e-6), |r| {
        pair(
            beckmann::projected_area(direction(r), roughness(r)),
            r.exact("beckmann_microflake_area"),
        )
    });
}

fn filtered_lobe(j: &mut Judge<'_>) {
    let density = |r: &Row<'_>| {
        let view = filtering::FilteredView::reflection(
            view(r),
            r.argument("alpha_x"),
            r.argument("alpha_y"),
        );
        view.reflected_density(light(r), r.argument("sharpness"))
    };
    j.add(
        "sg::filtering::FilteredView::reflected_density",
        Relative,
        P99(1e-6),
        |r| pair(density(r), r.exact("density")),
    );
    j.add(
        "sg::glossy::GlossyView::density_2024",
        Relative,
        P99(1e-6),
        |r| {
            let isotropic = r.exact("alpha_x") == r.exact("alpha_y");
            let glossy = glossy::GlossyView::new(view(r), Vec3::Z, r.argument("alpha_x"));
            isotropic.then(|| {
                pair(
                    glossy.density_2024(light(r), r.argument("sharpness")),
                    r.exact("density"),
                )
            })?
        },
    );
}

fn view(r: &Row<'_>) -> Vec3 {
    r.vector("i_x", "i_y", "i_z")
}

fn light(r: &Row<'_>) -> Vec3 {
    r.vector("xi_x", "xi_y", "xi_z")
}

fn asg_integral(j: &mut Judge<'_>) {
    // Known only to be good for lobes that overlap: rows above 1e-3 of the lobe's own integral.
    j.add(
        "sg::asg::AsgLobe::product_integral",
        Relative,
        Median(0.1),
        |r| {
            let lobe = AsgLobe {
                x: Vec3::X,
                y: Vec3::Y,
                z: Vec3::Z,
                sharpness_x: r.argument("eta_x"),
                sharpness_y: r.argument("eta_y"),
            };
            let sharpness = r.argument("sharpness");
            let peak = f64::from(lobe.product_integral(Vec3::Z, sharpness));
            let exact = r.exact("asg_sg_integral");
            (exact > 1e-3 * peak)
                .then(|| pair(lobe.product_integral(light(r), sharpness), exact))?
        },
    );
}

fn glossy_integral(j: &mut Judge<'_>) {
    // Rows above 1e-3 of the largest with the same surface, view and sharpness.
    let key = |r: &Row<'_>| {
        [
            "ndf",
            "alpha_x",
            "alpha_y",
            "i_x",
            "i_y",
            "i_z",
            "sharpness",
        ]
        .map(|c| r.exact(c).to_bits())
    };
    let mut peaks: std::collections::HashMap<[u64; 7], f64> = std::collections::HashMap::new();
    for r in j.table.rows() {
        let peak = peaks.entry(key(&r)).or_insert(0.0);
        *peak = peak.max(r.exact("brdf_sg_integral"));
    }
    let ggx = |r: &Row<'_>| {
        r.exact("ndf") == 0.0
            && r.exact("brdf_sg_integral") > 1e-3 * peaks.get(&key(r)).copied().unwrap_or(0.0)
    };
    let isotropic = |r: &Row<'_>| r.exact("alpha_x") == r.exact("alpha_y");
    type Glossy = fn(Vec3, Vec3, f32, Vec3, f32) -> f32;
    let forms: [(&str, Glossy, f64); 6] = [
        ("sg::glossy_blend::blended", glossy_blend::blended, 0.1),
        ("sg::glossy::masked", glossy::masked, 0.2),
        ("sg::glossy::filtered_2024", glossy::filtered_2024, 0.2),
        ("sg::warp::glossy_asg_2015", warp::glossy_asg_2015, 0.25),
        ("sg::warp::glossy_asg_2016", warp::glossy_asg_2016, 0.3),
        ("sg::warp::glossy_sg_2015", warp::glossy_sg_2015, 0.6),
    ];
    for (name, f, limit) in forms {
        j.add(name, Relative, Median(limit), |r| {
            let value = || {
                f(
                    view(r),
                    Vec3::Z,
                    r.argument("alpha_x"),
                    light(r),
                    r.argument("sharpness"),
                )
            };
            (ggx(r) && isotropic(r)).then(|| pair(value(), r.exact("brdf_sg_integral")))?
        });
    }
    type Anisotropic = fn(Vec3, f32, f32, Vec3, f32) -> f32;
    let forms: [(&str, Anisotropic, f64); 2] = [
        ("sg::filtering::masked, anisotropic", filtering::masked, 0.2),
        (
            "sg::filtering::filtered_2024, anisotropic",
            filtering::filtered_2024,
            0.2,
        ),
    ];
    for (name, f, limit) in forms {
        j.add(name, Relative, Median(limit), |r| {
            let value = || {
                f(
                    view(r),
                    r.argument("alpha_x"),
                    r.argument("alpha_y"),
                    light(r),
                    r.argument("sharpness"),
                )
            };
            (ggx(r) && !isotropic(r)).then(|| pair(value(), r.exact("brdf_sg_integral")))?
        });
    }
}
