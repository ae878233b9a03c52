//! `sg/` and `brdf/`: glossy surfaces, alone and under lobes.

use super::arguments::Kind::*;
use super::table::{Arguments, Entry, entry};
use vsgl_core::brdf::albedo::{Albedo, ggx_albedo};
use vsgl_core::brdf::gltf::Surface;
use vsgl_core::brdf::roughness::Roughness;
use vsgl_core::brdf::{beckmann, fresnel, ggx, ggx_local};
use vsgl_core::sg::anisotropic::{self, AnisotropicView, Frame};
use vsgl_core::sg::filtering::{self, FilteredView};
use vsgl_core::sg::glossy::{self, GlossyView};
use vsgl_core::sg::{glossy_blend, lobe, warp};

pub(super) fn entries() -> Vec<Entry> {
    let mut all = reflectance();
    all.extend(roughness());
    all.extend(local());
    all.extend(surfaces());
    all.extend(views());
    all.extend(blended_and_warped());
    all.extend(filtered());
    all.extend(anisotropic());
    all
}

fn reflectance() -> Vec<Entry> {
    let color = Vector(1e-3, 1e0);
    vec![
        entry("brdf/fresnel", "fresnel_schlick_weight", &[Cosine], |a| {
            fresnel::schlick_weight(a.f(0))
        }),
        entry(
            "brdf/fresnel",
            "fresnel_schlick",
            &[color, color, Cosine],
            |a| fresnel::schlick(a.v(0), a.v(1), a.f(2)),
        ),
        entry("brdf/fresnel", "fresnel_half_cosine", &[Unit, Unit], |a| {
            fresnel::half_cosine(a.v(0), a.v(1))
        }),
        entry(
            "brdf/fresnel",
            "fresnel_f0_of_index",
            &[Positive(1e-3, 1e3)],
            |a| fresnel::f0_of_index(a.f(0)),
        ),
        entry(
            "brdf/ggx",
            "ggx_distribution",
            &[Vector(1e-4, 1e1), Unit, Alpha],
            |a| ggx::distribution(a.v(0), a.v(1), a.f(2)),
        ),
        entry("brdf/ggx", "ggx_reach", &[Cosine, Even(0.0, 1.0)], |a| {
            ggx::reach(a.f(0), a.f(1))
        }),
        entry("brdf/ggx", "ggx_lambda", &[Cosine, Alpha], |a| {
            ggx::lambda(a.f(0), a.f(1))
        }),
        entry(
            "brdf/ggx",
            "ggx_visibility",
            &[Even(0.0, 1.0), Even(0.0, 1.0), Alpha],
            |a| ggx::visibility(a.f(0), a.f(1), a.f(2)),
        ),
        entry(
            "brdf/ggx",
            "ggx_reflectance",
            &[Unit, Unit, Unit, Alpha],
            |a| ggx::reflectance(a.v(0), a.v(1), a.v(2), a.f(3)),
        ),
        entry(
            "brdf/albedo",
            "albedo_ggx_albedo",
            &[Cosine, AnyAlpha],
            |a| ggx_albedo(a.f(0), a.f(1)),
        ),
        entry(
            "brdf/albedo",
            "albedo_weigh",
            &[Even(0.0, 1.0), Even(0.0, 1.0), color, color],
            |a| {
                Albedo {
                    a: a.f(0),
                    b: a.f(1),
                }
                .weigh(a.v(2), a.v(3))
            },
        )
        .by("albedo_weigh(Albedo(x0, x1), x2, x3)"),
    ]
}

/// Roughness of any direction from four arguments: two alphas, a turn as a vector.
fn turned(a: &Arguments<'_>, i: usize) -> Roughness {
    let (cos, sin) = a.turn(i + 2);
    Roughness::rotated(a.f(i), a.f(i + 1), cos, sin)
}

fn roughness() -> Vec<Entry> {
    const FILE: &str = "brdf/roughness";
    let slope = Signed(1e-6, 1e3);
    vec![
        entry(FILE, "roughness_isotropic", &[Alpha], |a| {
            Roughness::isotropic(a.f(0))
        }),
        entry(FILE, "roughness_aligned", &[Alpha, Alpha], |a| {
            Roughness::aligned(a.f(0), a.f(1))
        }),
        entry(
            FILE,
            "roughness_rotated",
            &[Alpha, Alpha, Cosine, Cosine],
            |a| Roughness::rotated(a.f(0), a.f(1), a.f(2), a.f(3)),
        ),
        entry(
            FILE,
            "roughness_from_entries",
            &[Alpha, Cosine, Alpha],
            |a| Roughness::from_entries(a.f(0), a.f(1), a.f(2)),
        ),
        entry(
            FILE,
            "roughness_form",
            &[Alpha, Alpha, Turn, slope, slope],
            |a| turned(a, 0).form(a.f(3), a.f(4)),
        )
        .by("roughness_form(roughness_rotated(x0, x1, x2.x, x2.y), x3, x4)"),
        entry(
            FILE,
            "roughness_inverse_form",
            &[Alpha, Alpha, Turn, slope, slope],
            |a| turned(a, 0).inverse_form(a.f(3), a.f(4)),
        )
        .by("roughness_inverse_form(roughness_rotated(x0, x1, x2.x, x2.y), x3, x4)"),
        entry(FILE, "roughness_factor", &[Alpha, Alpha, Turn], |a| {
            turned(a, 0).factor()
        })
        .by("roughness_factor(roughness_rotated(x0, x1, x2.x, x2.y))"),
    ]
}

/// Functions of both distributions in a tangent frame.
macro_rules! distributions {
    ($file:literal, $module:ident) => {{
        let share = Even(0.0, 1.0);
        let name = |function: &str| -> &'static str {
            Box::leak(format!("{}_{function}", stringify!($module)).into_boxed_str())
        };
        let by = |function: &str, arguments: &str, after: &str| {
            let rough = "roughness_rotated(x0, x1, x2.x, x2.y)";
            format!(
                "{}_{function}({arguments}, {rough}{after})",
                stringify!($module)
            )
        };
        vec![
            entry(
                $file,
                name("distribution"),
                &[Alpha, Alpha, Turn, Vector(1e-2, 1e1)],
                |a| $module::distribution(a.v(3), turned(a, 0)),
            )
            .by(&by("distribution", "x3", "")),
            entry(
                $file,
                name("projected_area"),
                &[Alpha, Alpha, Turn, Unit],
                |a| $module::projected_area(a.v(3), turned(a, 0)),
            )
            .by(&by("projected_area", "x3", "")),
            entry($file, name("lambda"), &[Alpha, Alpha, Turn, Unit], |a| {
                $module::lambda(a.v(3), turned(a, 0))
            })
            .by(&by("lambda", "x3", "")),
            entry(
                $file,
                name("reflectance"),
                &[Alpha, Alpha, Turn, Upper, Unit],
                |a| $module::reflectance(a.v(3), a.v(4), turned(a, 0)),
            )
            .by(&by("reflectance", "x3, x4", "")),
            entry(
                $file,
                name("sample_visible_normal"),
                &[Alpha, Alpha, Turn, Upper, share, share],
                |a| $module::sample_visible_normal(a.v(3), turned(a, 0), a.f(4), a.f(5)),
            )
            .by(&by("sample_visible_normal", "x3", ", x4, x5"))
            // Towards the end of the sampled range the distance to it has few digits.
            .scale(|a| 1.0 / (1.0 - a.f(4).max(a.f(5))).max(6e-8)),
            entry(
                $file,
                name("visible_normal_density"),
                &[Alpha, Alpha, Turn, Upper, Unit],
                |a| $module::visible_normal_density(a.v(3), a.v(4), turned(a, 0)),
            )
            .by(&by("visible_normal_density", "x3, x4", "")),
            entry(
                $file,
                name("reflected_density"),
                &[Alpha, Alpha, Turn, Upper, Unit],
                |a| $module::reflected_density(a.v(3), a.v(4), turned(a, 0)),
            )
            .by(&by("reflected_density", "x3, x4", "")),
            entry(
                $file,
                name("sample_weight"),
                &[Alpha, Alpha, Turn, Upper, Unit],
                |a| $module::sample_weight(a.v(3), a.v(4), turned(a, 0)),
            )
            .by(&by("sample_weight", "x3, x4", "")),
        ]
    }};
}

fn local() -> Vec<Entry> {
    let mut all = distributions!("brdf/ggx_local", ggx_local);
    all.extend(distributions!("brdf/beckmann", beckmann));
    all.push(
        entry(
            "brdf/beckmann",
            "beckmann_log_distribution",
            &[Alpha, Alpha, Turn, Vector(1e-2, 1e1)],
            |a| beckmann::log_distribution(a.v(3), turned(a, 0)),
        )
        .by("beckmann_log_distribution(x3, roughness_rotated(x0, x1, x2.x, x2.y))")
        .floor(1.0),
    );
    all
}

fn surfaces() -> Vec<Entry> {
    const FILE: &str = "brdf/gltf";
    let share = Even(0.0, 1.0);
    let color = Vector(1e-3, 1e0);
    let kinds = [color, share, Alpha, color, share];
    let surface = |a: &Arguments<'_>| Surface {
        base_color: a.v(0),
        metallic: a.f(1),
        alpha: a.f(2),
        dielectric_f0: a.v(3),
        dielectric_f90: a.f(4),
    };
    let with = |more: &[super::arguments::Kind]| [&kinds[..], more].concat();
    const OWN: &str = "GltfSurface(x0, x1, x2, x3, x4)";
    vec![
        entry(FILE, "gltf_surface_f0", &kinds, move |a| surface(a).f0())
            .by(&format!("gltf_surface_f0({OWN})")),
        entry(FILE, "gltf_surface_f90", &kinds, move |a| surface(a).f90())
            .by(&format!("gltf_surface_f90({OWN})")),
        entry(FILE, "gltf_surface_diffuse_albedo", &kinds, move |a| {
            surface(a).diffuse_albedo()
        })
        .by(&format!("gltf_surface_diffuse_albedo({OWN})")),
        entry(
            FILE,
            "gltf_surface_diffuse_weight",
            &with(&[Cosine]),
            move |a| surface(a).diffuse_weight(a.f(5)),
        )
        .by(&format!("gltf_surface_diffuse_weight({OWN}, x5)")),
        entry(
            FILE,
            "gltf_surface_diffuse",
            &with(&[Unit, Unit]),
            move |a| surface(a).diffuse(a.v(5), a.v(6)),
        )
        .by(&format!("gltf_surface_diffuse({OWN}, x5, x6)")),
        entry(
            FILE,
            "gltf_surface_specular",
            &with(&[Unit, Unit, Unit]),
            move |a| surface(a).specular(a.v(5), a.v(6), a.v(7)),
        )
        .by(&format!("gltf_surface_specular({OWN}, x5, x6, x7)")),
        entry(
            FILE,
            "gltf_surface_reflected",
            &with(&[Unit, Unit, Unit]),
            move |a| surface(a).reflected(a.v(5), a.v(6), a.v(7)),
        )
        .by(&format!("gltf_surface_reflected({OWN}, x5, x6, x7)")),
    ]
}

fn views() -> Vec<Entry> {
    const FILE: &str = "sg/glossy";
    let view = |a: &Arguments<'_>| GlossyView::new(a.v(0), a.v(1), a.f(2));
    const OWN: &str = "glossy_view_new(x0, x1, x2)";
    let one = [Unit, Unit, AnyAlpha, Unit, Sharpness];
    let two = [Unit, Unit, AnyAlpha, Unit, Sharpness, Sharpness];
    vec![
        entry(FILE, "glossy_view_view_cosine", &one[..3], move |a| {
            view(a).view_cosine()
        })
        .by(&format!("glossy_view_view_cosine({OWN})")),
        entry(FILE, "glossy_view_alpha2", &one[..3], move |a| {
            view(a).alpha2()
        })
        .by(&format!("glossy_view_alpha2({OWN})")),
        entry(FILE, "glossy_view_density_2024", &one, move |a| {
            view(a).density_2024(a.v(3), a.f(4))
        })
        .by(&format!("glossy_view_density_2024({OWN}, x3, x4)")),
        entry(FILE, "glossy_view_density", &one, move |a| {
            view(a).density(a.v(3), a.f(4))
        })
        .by(&format!("glossy_view_density({OWN}, x3, x4)")),
        entry(FILE, "glossy_view_share", &one, move |a| {
            view(a).share(a.v(3), a.f(4))
        })
        .by(&format!("glossy_view_share({OWN}, x3, x4)"))
        .floor(1.0),
        entry(FILE, "glossy_view_masked_share", &one, move |a| {
            view(a).masked_share(a.v(3), a.f(4))
        })
        .by(&format!("glossy_view_masked_share({OWN}, x3, x4)"))
        .floor(1.0),
        entry(FILE, "glossy_view_masked", &two, move |a| {
            view(a).masked(a.v(3), a.f(4), a.f(5))
        })
        .by(&format!("glossy_view_masked({OWN}, x3, x4, x5)"))
        .scale(move |a| view(a).density(a.v(3), a.f(4))),
        entry(FILE, "glossy_view_filtered_2024", &one, move |a| {
            view(a).filtered_2024(a.v(3), a.f(4))
        })
        .by(&format!("glossy_view_filtered_2024({OWN}, x3, x4)"))
        .scale(move |a| view(a).density_2024(a.v(3), a.f(4))),
        entry(FILE, "glossy_masked", &one, |a| {
            glossy::masked(a.v(0), a.v(1), a.f(2), a.v(3), a.f(4))
        })
        .scale(move |a| view(a).density(a.v(3), a.f(4)) * lobe::integral(a.f(4))),
        entry(FILE, "glossy_filtered_2024", &one, |a| {
            glossy::filtered_2024(a.v(0), a.v(1), a.f(2), a.v(3), a.f(4))
        })
        .scale(move |a| view(a).density_2024(a.v(3), a.f(4)) * lobe::integral(a.f(4))),
    ]
}

fn blended_and_warped() -> Vec<Entry> {
    let view = |a: &Arguments<'_>| GlossyView::new(a.v(0), a.v(1), a.f(2));
    let one = [Unit, Unit, AnyAlpha, Unit, Sharpness];
    vec![
        entry(
            "sg/glossy_blend",
            "glossy_view_blended",
            &[Unit, Unit, AnyAlpha, Unit, Sharpness, Sharpness],
            |a| GlossyView::new(a.v(0), a.v(1), a.f(2)).blended(a.v(3), a.f(4), a.f(5)),
        )
        .by("glossy_view_blended(glossy_view_new(x0, x1, x2), x3, x4, x5)")
        .scale(move |a| view(a).density_2024(a.v(3), a.f(4))),
        entry("sg/glossy_blend", "glossy_blend_blended", &one, |a| {
            glossy_blend::blended(a.v(0), a.v(1), a.f(2), a.v(3), a.f(4))
        })
        .scale(move |a| view(a).density_2024(a.v(3), a.f(4)) * lobe::integral(a.f(4))),
        entry("sg/warp", "warp_normal_sharpness", &[Alpha], |a| {
            warp::normal_sharpness(a.f(0))
        }),
        entry("sg/warp", "warp_reflection_sg", &one[..3], |a| {
            warp::reflection_sg(a.v(0), a.v(1), a.f(2))
        }),
        entry(
            "sg/warp",
            "warp_reflection_asg_local",
            &[Upper, Alpha, Alpha],
            |a| warp::reflection_asg_local(a.v(0), a.f(1), a.f(2)),
        ),
        entry("sg/warp", "warp_glossy_asg_2015", &one, |a| {
            warp::glossy_asg_2015(a.v(0), a.v(1), a.f(2), a.v(3), a.f(4))
        })
        // As the form of 2016 below: exponentials of sums of up to 87, which rounding moves by their size.
        .floor(1e-20),
        entry("sg/warp", "warp_glossy_asg_2016", &one, |a| {
            warp::glossy_asg_2016(a.v(0), a.v(1), a.f(2), a.v(3), a.f(4))
        })
        .floor(1e-20),
        entry("sg/warp", "warp_glossy_sg_2015", &one, |a| {
            warp::glossy_sg_2015(a.v(0), a.v(1), a.f(2), a.v(3), a.f(4))
        })
        // Exponential of a difference of logarithms that are up to 100.
        .floor(1e-20)
        .within(3e-5),
    ]
}

fn filtered() -> Vec<Entry> {
    const FILE: &str = "sg/filtering";
    let index = Even(0.4, 2.5);
    let reflected = |a: &Arguments<'_>| FilteredView::reflection(a.v(0), a.f(1), a.f(2));
    let refracted = |a: &Arguments<'_>| FilteredView::refraction(a.v(0), a.f(1), a.f(2), a.f(3));
    const REFLECTION: &str = "filtered_view_reflection(x0, x1, x2)";
    const REFRACTION: &str = "filtered_view_refraction(x0, x1, x2, x3)";
    let one = [Upper, AnyAlpha, AnyAlpha, Unit, Sharpness];
    let through = [Upper, AnyAlpha, AnyAlpha, index, Unit, Sharpness];
    vec![
        entry(FILE, "filtered_view_reflected_density", &one, move |a| {
            reflected(a).reflected_density(a.v(3), a.f(4))
        })
        .by(&format!(
            "filtered_view_reflected_density({REFLECTION}, x3, x4)"
        )),
        entry(FILE, "filtered_view_density", &one, move |a| {
            reflected(a).density(a.v(3), a.f(4))
        })
        .by(&format!("filtered_view_density({REFLECTION}, x3, x4)"))
        .scale(move |a| reflected(a).reflected_density(a.v(3), a.f(4))),
        entry(
            FILE,
            "filtered_view_refracted_density",
            &through,
            move |a| refracted(a).refracted_density(a.v(4), a.f(5), a.f(3)),
        )
        .by(&format!(
            "filtered_view_refracted_density({REFRACTION}, x4, x5, x3)"
        )),
        entry(FILE, "filtered_view_filtered_2024", &one, move |a| {
            reflected(a).filtered_2024(a.v(3), a.f(4))
        })
        .by(&format!(
            "filtered_view_filtered_2024({REFLECTION}, x3, x4)"
        ))
        .scale(move |a| reflected(a).reflected_density(a.v(3), a.f(4))),
        entry(
            FILE,
            "filtered_view_masked",
            &[Upper, AnyAlpha, AnyAlpha, Unit, Sharpness, Sharpness],
            move |a| reflected(a).masked(a.v(3), a.f(4), a.f(5)),
        )
        .by(&format!("filtered_view_masked({REFLECTION}, x3, x4, x5)"))
        .scale(move |a| reflected(a).reflected_density(a.v(3), a.f(4))),
        entry(FILE, "filtered_view_transmitted_2024", &through, move |a| {
            refracted(a).transmitted_2024(a.v(4), a.f(5), a.f(3))
        })
        .by(&format!(
            "filtered_view_transmitted_2024({REFRACTION}, x4, x5, x3)"
        ))
        .scale(move |a| refracted(a).refracted_density(a.v(4), a.f(5), a.f(3))),
        entry(FILE, "filtering_masked", &one, |a| {
            filtering::masked(a.v(0), a.f(1), a.f(2), a.v(3), a.f(4))
        })
        .scale(move |a| reflected(a).reflected_density(a.v(3), a.f(4)) * lobe::integral(a.f(4))),
        entry(FILE, "filtering_filtered_2024", &one, |a| {
            filtering::filtered_2024(a.v(0), a.f(1), a.f(2), a.v(3), a.f(4))
        })
        .scale(move |a| reflected(a).reflected_density(a.v(3), a.f(4)) * lobe::integral(a.f(4))),
    ]
}

fn anisotropic() -> Vec<Entry> {
    const FILE: &str = "sg/anisotropic";
    // View, normal, tangent, roughnesses, then the light.
    let one = [Unit, Unit, Unit, AnyAlpha, AnyAlpha, Unit, Sharpness];
    let seen = |a: &Arguments<'_>| AnisotropicView::new(a.v(0), a.v(1), a.v(2), a.f(3), a.f(4));
    let frame = |a: &Arguments<'_>, n: usize, t: usize| Frame::new(a.v(n), a.v(t));
    // What a local vector's rounding is magnified by is a share of the density at the sharpest.
    let size = move |a: &Arguments<'_>| {
        let frame = Frame::new(a.v(1), a.v(2));
        FilteredView::reflection(frame.local(a.v(0)), a.f(3), a.f(4))
            .reflected_density(frame.local(a.v(5)), a.f(6))
    };
    const VIEW: &str = "anisotropic_view_new(x0, x1, x2, x3, x4)";
    vec![
        entry(FILE, "frame_local", &[Unit, Unit, Unit], move |a| {
            frame(a, 0, 1).local(a.v(2))
        })
        .by("frame_local(frame_new(x0, x1), x2)")
        .scale(|_| 1.0),
        entry(FILE, "anisotropic_view_masked", &one, move |a| {
            seen(a).masked(a.v(5), a.f(6), a.f(6))
        })
        .by(&format!("anisotropic_view_masked({VIEW}, x5, x6, x6)"))
        .scale(size),
        entry(FILE, "anisotropic_view_filtered_2024", &one, move |a| {
            seen(a).filtered_2024(a.v(5), a.f(6))
        })
        .by(&format!("anisotropic_view_filtered_2024({VIEW}, x5, x6)"))
        .scale(size),
        entry(
            FILE,
            "anisotropic_reflectance",
            &[Unit, Unit, Unit, Unit, AnyAlpha, AnyAlpha],
            move |a| anisotropic::reflectance(a.v(0), a.v(1), &frame(a, 2, 3), a.f(4), a.f(5)),
        )
        .by("anisotropic_reflectance(x0, x1, frame_new(x2, x3), x4, x5)"),
        entry(FILE, "anisotropic_glossy_asg", &one, move |a| {
            anisotropic::glossy_asg(a.v(0), &frame(a, 1, 2), a.f(3), a.f(4), a.v(5), a.f(6))
        })
        .by("anisotropic_glossy_asg(x0, frame_new(x1, x2), x3, x4, x5, x6)"),
        entry(FILE, "anisotropic_glossy_asg_2015", &one, move |a| {
            anisotropic::glossy_asg_2015(a.v(0), &frame(a, 1, 2), a.f(3), a.f(4), a.v(5), a.f(6))
        })
        .by("anisotropic_glossy_asg_2015(x0, frame_new(x1, x2), x3, x4, x5, x6)")
        .floor(1e-20),
        entry(FILE, "anisotropic_turn_of", &[Unit, Unit], |a| {
            anisotropic::turn_of(a.v(0), a.v(1))
        })
        .scale(|_| 1.0),
        entry(
            FILE,
            "anisotropic_tangent_of",
            &[Unit, Even(-1.0, 1.0)],
            |a| anisotropic::tangent_of(a.v(0), a.f(1)),
        )
        .scale(|_| 1.0),
    ]
}
