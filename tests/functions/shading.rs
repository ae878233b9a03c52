//! `geom/` and `phase/`: what is plain mathematics there. The rest reads the scene and is compared as phases.

use super::arguments::Kind::{self, *};
use super::table::{Arguments, Entry, entry};
use vsgl_core::data::{DiffuseVsgl, SpecularVsgl};
use vsgl_core::geom::{Ray, cross};
use vsgl_core::glam::Vec3;
use vsgl_core::math::vec;
use vsgl_core::phase::shade::{self, Colors, Incoming, PointSender, Receiver};
use vsgl_core::sg::anisotropic::{Frame, tangent_of};
use vsgl_core::sg::filtering::FilteredView;
use vsgl_core::sg::glossy::GlossyView;
use vsgl_core::sg::lobe;
use vsgl_core::sg::vmf::{self, MeanLength};

pub(super) fn entries() -> Vec<Entry> {
    let mut all = geometry();
    all.extend(arriving());
    all.extend(reflected());
    all
}

fn corners(a: &Arguments<'_>) -> [f32; 9] {
    let mut all = [0.0; 9];
    for (i, corner) in all.chunks_mut(3).enumerate() {
        corner.copy_from_slice(&a.v(2 + i).to_array());
    }
    all
}

fn geometry() -> Vec<Entry> {
    let place = Vector(1e-1, 1e1);
    vec![
        entry("geom/ray", "ray_new", &[place, Unit], |a| Ray::new(a.v(0), a.v(1))),
        entry(
            "geom/triangle",
            "triangle_cross",
            &[Vector(1e-3, 1.0), Unit, place, place, place],
            |a| {
                let c = cross(a.v(0), a.v(1), &corners(a));
                Vec3::new(c.t, c.u, c.v)
            },
        )
        .by(
            "triangle_vector(triangle_cross(x0, x1, array(x2.x, x2.y, x2.z, x3.x, x3.y, x3.z, x4.x, x4.y, x4.z)))",
        )
        .with("fn triangle_vector(c: Crossing) -> vec3<f32> { return vec3(c.t, c.u, c.v); }")
        // Volumes of the tetrahedra over that of all.
        .scale(|a| {
            let [x, y, z] = [2, 3, 4].map(|i| a.v(i) - a.v(0));
            let size = x.length().max(y.length()).max(z.length());
            let volume = (y - x).cross(z - x).dot(a.v(1)).abs();
            8.0 * size * size * (1.0 + size) / volume.max(1e-6)
        }),
        entry(
            "geom/triangle",
            "triangle_cross",
            &[Vector(1e-3, 1.0), Unit, place, place, place],
            |a| f32::from(u8::from(cross(a.v(0), a.v(1), &corners(a)).hit)),
        )
        .by(
            "select(0.0, 1.0, triangle_cross(x0, x1, \
             array(x2.x, x2.y, x2.z, x3.x, x3.y, x3.z, x4.x, x4.y, x4.z)).hit)",
        ),
    ]
}

const FILE: &str = "phase/shade";

/// Position, variance, axis, complement, bulge, light, covariance as its root's rows, colours.
fn sender_kinds(more: &[Kind]) -> Vec<Kind> {
    let share = Even(0.0, 1.0);
    let place = Vector(1e-1, 1e1);
    let variance = Positive(1e-8, 1e2);
    let complement = Positive(1e-9, 1.0);
    let color = Vector(1e-3, 1.0);
    let mixed = Vector(1e-4, 1e-1);
    let own = [
        place,
        variance,
        Unit,
        complement,
        Even(-0.1, 0.1),
        Unit,
        mixed,
        mixed,
        color,
        share,
    ];
    [&own[..], more].concat()
}

fn covariance(a: &Arguments<'_>) -> [f32; 6] {
    let (diagonal, rest) = (a.v(6).abs(), a.v(7));
    [diagonal.x, diagonal.y, diagonal.z, rest.x, rest.y, rest.z]
}

const COVARIANCE: &str = "array(abs(x6.x), abs(x6.y), abs(x6.z), x7.x, x7.y, x7.z)";

/// Irradiance of a radiant intensity of 1 at the receiver, without what the cluster's form takes of it, times the colour.
fn arrives(a: &Arguments<'_>) -> f32 {
    let apart = a.v(0) - a.v(10);
    let distance2 = apart.dot(apart);
    // The path is the same for both parts.
    let k = diffuse(a).sharpness.max(1e-6);
    lobe::integral(k) * k / (std::f32::consts::TAU * distance2) * a.v(8).abs().max_element()
}

/// Sharpness along a direction is a variance over the covariance's: where the latter cancels, its rounding counts. This is
/// that sharpness were there only the rounding of the sum.
fn flattened(a: &Arguments<'_>, incoming: &Incoming) -> f32 {
    let sum: f32 = covariance(a).iter().map(|x| 2.0 * x.abs()).sum();
    incoming.horizon * (sum * incoming.horizon / (incoming.sharpness * a.f(1)).max(1e-30)).max(1.0)
}

fn diffuse(a: &Arguments<'_>) -> Incoming {
    let light = DiffuseVsgl {
        position: a.v(0).to_array(),
        variance: a.f(1),
        axis: a.v(2).to_array(),
        complement: a.f(3),
        bulge: a.f(4),
        light: a.v(5).to_array(),
        covariance: covariance(a),
        intensity: a.v(8).to_array(),
        f0: 0.04,
        f90: a.f(9),
        sharpness: 0.0,
    };
    shade::incoming_diffuse(&light, a.v(10), a.v(11))
}

fn specular(a: &Arguments<'_>) -> Incoming {
    let light = specular_light(a, 0.0, 0.0);
    shade::incoming_specular(&light, &shade::sender_view(&light), a.v(10), a.v(11))
}

/// The same from a surface with two roughnesses.
fn anisotropic(a: &Arguments<'_>) -> Incoming {
    let light = specular_light(a, a.f(16), a.f(17));
    let sender = shade::anisotropic_sender_view(&light);
    shade::incoming_specular(&light, &sender, a.v(10), a.v(11))
}

fn specular_light(a: &Arguments<'_>, across: f32, turn: f32) -> SpecularVsgl {
    SpecularVsgl {
        position: a.v(0).to_array(),
        variance: a.f(1),
        axis: a.v(2).to_array(),
        complement: a.f(3),
        bulge: a.f(4),
        light: a.v(5).to_array(),
        covariance: covariance(a),
        f0: a.v(8).to_array(),
        f90: (a.v(8) * a.f(9)).to_array(),
        mirror: a.v(12).to_array(),
        complement_mirror: a.f(13),
        sharpness_lobe: a.f(14),
        alpha: a.f(15),
        across,
        turn,
    }
}

/// Density of the sender's reflection towards the receiver, before the share above its horizon.
fn unshared(a: &Arguments<'_>) -> f32 {
    let outgoing = vec::normalize(a.v(10) - (a.v(0) + a.v(2) * a.f(4)));
    let mirrored = MeanLength {
        length: 1.0 - a.f(13),
        complement: a.f(13),
    };
    let lobe = vmf::sharpness(mirrored.convolve(vmf::mean(diffuse(a).sharpness)));
    GlossyView::new(a.v(5), a.v(2), a.f(15)).density(outgoing, lobe)
}

/// As [`unshared`], before the core: by the light itself, at the sharpest.
fn unshared_anisotropic(a: &Arguments<'_>) -> f32 {
    let outgoing = vec::normalize(a.v(10) - (a.v(0) + a.v(2) * a.f(4)));
    let mirrored = MeanLength {
        length: 1.0 - a.f(13),
        complement: a.f(13),
    };
    let lobe = vmf::sharpness(mirrored.convolve(vmf::mean(diffuse(a).sharpness)));
    let frame = Frame::new(a.v(2), tangent_of(a.v(2), a.f(17)));
    FilteredView::reflection(frame.local(a.v(5)), a.f(15), a.f(16))
        .reflected_density(frame.local(outgoing), lobe)
}

fn point(a: &Arguments<'_>) -> Incoming {
    shade::incoming_point(&point_light(a, 0.0, 0.0), a.v(10))
}

fn anisotropic_point(a: &Arguments<'_>) -> Incoming {
    shade::incoming_anisotropic_point(&point_light(a, a.f(11), a.f(12)), a.v(10))
}

fn point_light(a: &Arguments<'_>, across: f32, turn: f32) -> PointSender {
    PointSender {
        position: a.v(0),
        variance: a.f(1),
        normal: a.v(2),
        light: a.v(3),
        diffuse: a.v(4).abs(),
        dielectric_f0: a.f(5),
        dielectric_f90: a.f(6),
        f0: a.v(7).abs(),
        f90: a.v(8).abs(),
        alpha: a.f(9),
        across,
        turn,
    }
}

fn arriving() -> Vec<Entry> {
    let place = Vector(1e-1, 1e1);
    let share = Even(0.0, 1.0);
    let color = Vector(1e-3, 1.0);
    let complement = Positive(1e-9, 1.0);
    let variance = Positive(1e-8, 1e2);
    let light = |two: &str| {
        format!(
            "SpecularVsgl(x0, x1, x2, x3, x12, x13, x5, x14, x8, x15, x8 * x9, x4, {COVARIANCE}, {two})"
        )
    };
    let turn = Even(-1.0, 1.0);
    vec![
        entry(FILE, "shade_incoming_diffuse", &sender_kinds(&[place, Unit]), diffuse)
            .by(&format!(
                "shade_incoming_diffuse(DiffuseVsgl(x0, x1, x2, 0.0, x8, x3, x5, 0.04, {COVARIANCE}, x9, x4), x10, x11)"
            ))
            .scales(|a, part| match part {
            2 => flattened(a, &diffuse(a)),
            3 => arrives(a),
            _ => 0.0,
        }),
        entry(
            FILE,
            "shade_incoming_specular",
            &sender_kinds(&[place, Unit, Unit, complement, Sharpness, Alpha]),
            specular,
        )
        .by(&format!("shade_specular({}, x10, x11)", light("0.0, 0.0")))
        .with(
            "fn shade_specular(light: SpecularVsgl, receiver: vec3<f32>, normal: vec3<f32>) -> Incoming {\n    return \
             shade_incoming_specular(light, shade_sender_view(light), receiver, normal);\n}",
        )
        .scales(|a, part| match part {
            2 => flattened(a, &specular(a)),
            3 => arrives(a) * unshared(a),
            _ => 0.0,
        }),
        entry(
            FILE,
            "shade_incoming_anisotropic",
            &sender_kinds(&[place, Unit, Unit, complement, Sharpness, Alpha, Alpha, turn]),
            anisotropic,
        )
        .by(&format!("shade_anisotropic({}, x10, x11)", light("x16, x17")))
        .with(
            "fn shade_anisotropic(light: SpecularVsgl, receiver: vec3<f32>, normal: vec3<f32>) -> Incoming {\n    return \
             shade_incoming_anisotropic(light, shade_anisotropic_sender_view(light), receiver, normal);\n}",
        )
        .scales(|a, part| match part {
            2 => flattened(a, &anisotropic(a)),
            3 => arrives(a) * unshared_anisotropic(a),
            _ => 0.0,
        }),
        entry(FILE, "shade_incoming_sg", &[place, variance, Unit, Sharpness, color, place], |a| {
            shade::incoming_sg(
                a.v(0).to_array(),
                a.f(1),
                a.v(2).to_array(),
                a.f(3),
                a.v(4).to_array(),
                a.v(5),
            )
        })
        // As for products of lobes, where nearly nothing is left.
        .scales(|_, part| if part == 3 { 1e-20 } else { 0.0 }),
        entry(
            FILE,
            "shade_incoming_point",
            &[place, variance, Unit, Unit, color, share, share, color, color, Alpha, place],
            point,
        )
        .by("shade_incoming_point(PointSender(x0, x1, x2, x3, abs(x4), x5, x6, abs(x7), abs(x8), x9, 0.0, 0.0), x10)"),
        entry(
            FILE,
            "shade_incoming_anisotropic_point",
            &[place, variance, Unit, Unit, color, share, share, color, color, Alpha, place, Alpha, turn],
            anisotropic_point,
        )
        .by(
            "shade_incoming_anisotropic_point(PointSender(x0, x1, x2, x3, abs(x4), x5, x6, abs(x7), abs(x8), x9, x11, x12), x10)",
        ),
    ]
}

fn reflected() -> Vec<Entry> {
    let share = Even(0.0, 1.0);
    let kinds = [
        Unit, Sharpness, Sharpness, Unit, Unit, share, share, Alpha, Unit, Alpha,
    ];
    let incoming = |a: &Arguments<'_>| Incoming {
        axis: a.v(0),
        sharpness: a.f(1),
        horizon: a.f(2),
        strength: Vec3::ONE,
    };
    let receiver = |a: &Arguments<'_>| Receiver {
        position: Vec3::ZERO,
        normal: a.v(3),
        view: a.v(4),
        f0: a.f(5),
        f90: a.f(6),
        alpha: a.f(7),
        tangent: a.v(8),
        across: a.f(9),
    };
    const OWN: &str =
        "Incoming(x0, x1, x2, vec3(1.0)), Receiver(vec3(0.0), x3, x4, x5, x6, x7, x8, x9)";
    const VIEW: &str = "Incoming(x0, x1, x2, vec3(1.0)), glossy_view_new(x4, x3, x7)";
    let view = |a: &Arguments<'_>| GlossyView::new(a.v(4), a.v(3), a.f(7));
    macro_rules! of {
        ($($name:ident),*) => {
            vec![$(entry(FILE, concat!("shade_", stringify!($name)), &kinds, move |a| {
                shade::$name(&incoming(a), &receiver(a))
            })
            .by(&format!(concat!("shade_", stringify!($name), "({})"), OWN))),*]
        };
    }
    let mut all = of!(
        lambert_v13,
        lambert_v14,
        lambert_2024,
        lambert_2022,
        lambert_2018,
        lambert_sg_2015,
        lambert_sg_product,
        lambert_constant,
        glossy_asg_2013,
        glossy_asg_2015,
        glossy_sg,
        glossy_point,
        anisotropic_asg_2013,
        anisotropic_asg_2015,
        anisotropic_point,
        fresnel_weight
    );
    all.push(
        entry(FILE, "shade_glossy_masked", &kinds, move |a| {
            shade::glossy_masked(&incoming(a), &view(a))
        })
        .by(&format!("shade_glossy_masked({VIEW})"))
        .scale(move |a| view(a).density(a.v(0), a.f(1))),
    );
    all.push(
        entry(FILE, "shade_glossy_2024", &kinds, move |a| {
            shade::glossy_2024(&incoming(a), &view(a))
        })
        .by(&format!("shade_glossy_2024({VIEW})"))
        .scale(move |a| view(a).density_2024(a.v(0), a.f(1))),
    );
    all.push(
        entry(FILE, "shade_glossy_blended", &kinds, move |a| {
            shade::glossy_blended(&incoming(a), &view(a))
        })
        .by(&format!("shade_glossy_blended({VIEW})"))
        .scale(move |a| view(a).density_2024(a.v(0), a.f(1))),
    );
    const TWO: &str = "Incoming(x0, x1, x2, vec3(1.0)), \
         shade_anisotropic_view(Receiver(vec3(0.0), x3, x4, x5, x6, x7, x8, x9))";
    let two = move |a: &Arguments<'_>| shade::anisotropic_view(&receiver(a));
    let density = |a: &Arguments<'_>| {
        let frame = Frame::new(a.v(3), a.v(8));
        FilteredView::reflection(frame.local(a.v(4)), a.f(7), a.f(9))
            .reflected_density(frame.local(a.v(0)), a.f(1))
    };
    all.push(
        entry(FILE, "shade_anisotropic_masked", &kinds, move |a| {
            shade::anisotropic_masked(&incoming(a), &two(a))
        })
        .by(&format!("shade_anisotropic_masked({TWO})"))
        .scale(density),
    );
    all.push(
        entry(FILE, "shade_anisotropic_2024", &kinds, move |a| {
            shade::anisotropic_2024(&incoming(a), &two(a))
        })
        .by(&format!("shade_anisotropic_2024({TWO})"))
        .scale(density),
    );
    let color = Vector(1e-3, 1e3);
    let colors = |a: &Arguments<'_>| Colors {
        albedo: a.v(0),
        f0: a.v(1),
        f90: a.f(2),
    };
    all.push(
        entry(
            FILE,
            "colors_diffuse",
            &[color, color, share, color],
            move |a| colors(a).diffuse(a.v(3)),
        )
        .by("colors_diffuse(Colors(x0, x1, x2), x3)"),
    );
    all.push(
        entry(
            FILE,
            "colors_glossy",
            &[color, color, share, color, color],
            move |a| colors(a).glossy(a.v(3), a.v(4)),
        )
        .by("colors_glossy(Colors(x0, x1, x2), x3, x4)"),
    );
    let size = |e: Entry| match e.name {
        "shade_glossy_asg_2013" | "shade_anisotropic_asg_2013" | "shade_anisotropic_asg_2015" => {
            e.floor(1e-20)
        }
        // Their terms, as of the integrals.
        "shade_lambert_2018" => e.floor(32.0),
        "shade_lambert_2022" => e.floor(1183.0),
        // Exponential of a difference of logarithms that are up to 100.
        "shade_glossy_sg" => e.floor(1e-20).within(3e-5),
        name if name.starts_with("shade_lambert") => e.floor(1.0),
        _ => e,
    };
    all.into_iter().map(size).collect()
}
