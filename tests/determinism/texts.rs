//! Blocks and single elements, for the tests beside.

use vsgl_core::data::{DiffuseVsgl, SpecularVsgl};
use vsgl_core::glam::Vec3;
use vsgl_core::phase::shade::{self, Incoming, PointSender, Receiver};
use vsgl_core::plan::ShadePlan;
use vsgl_core::settings::{DiffuseForm, Emission, GlossyForm, OcclusionMethod};
use vsgl_core::sg::glossy::GlossyView;
use vsgl_cpu::block::{self, LANES, Receivers, Sums};
use vsgl_tests::random::Random;

/// Sums of one receiver: Lambert part, at normal and at grazing incidence.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Single {
    pub(crate) diffuse: Vec3,
    pub(crate) near: Vec3,
    pub(crate) grazing: Vec3,
}

/// A plan that shades everything by these forms.
pub(crate) fn plan(emission: Emission, diffuse: DiffuseForm, glossy: GlossyForm) -> ShadePlan {
    ShadePlan {
        bounce: true,
        emitters: false,
        glossy_receivers: true,
        glossy_senders: true,
        anisotropic_receivers: false,
        anisotropic_senders: false,
        emission,
        diffuse,
        glossy,
        occlusion: OcclusionMethod::None,
        rays: 8,
        interleave: 1,
        masks: false,
    }
}

/// The forms of points are no choice of the plan.
enum Forms<'a> {
    Lobe(&'a ShadePlan),
    Point(&'a ShadePlan),
}

#[inline(always)]
fn reflect(sum: &mut Single, arriving: &Incoming, receiver: &Receiver, forms: &Forms<'_>) {
    let lambert = match forms {
        Forms::Lobe(plan) => match plan.diffuse {
            DiffuseForm::V13 => shade::lambert_v13(arriving, receiver),
            DiffuseForm::V14 => shade::lambert_v14(arriving, receiver),
            DiffuseForm::Tokuyoshi2024 => shade::lambert_2024(arriving, receiver),
            DiffuseForm::Tokuyoshi2022 => shade::lambert_2022(arriving, receiver),
            DiffuseForm::MederBruederlin2018 => shade::lambert_2018(arriving, receiver),
            DiffuseForm::Sg2015 => shade::lambert_sg_2015(arriving, receiver),
            DiffuseForm::SgProduct => shade::lambert_sg_product(arriving, receiver),
            DiffuseForm::Constant => shade::lambert_constant(arriving, receiver),
        },
        Forms::Point(_) => shade::lambert_constant(arriving, receiver),
    };
    sum.diffuse += arriving.strength * lambert;
    let specular = match forms {
        Forms::Lobe(plan) if plan.anisotropic_receivers => {
            let surface = shade::anisotropic_view(receiver);
            match plan.glossy {
                GlossyForm::NdfFilter => shade::anisotropic_masked(arriving, &surface),
                GlossyForm::NdfFilter2024 => shade::anisotropic_2024(arriving, &surface),
                GlossyForm::Asg2013 => shade::anisotropic_asg_2013(arriving, receiver),
                GlossyForm::Asg2015 => shade::anisotropic_asg_2015(arriving, receiver),
                form => panic!("{form} has one roughness"),
            }
        }
        Forms::Point(plan) if plan.anisotropic_receivers => {
            shade::anisotropic_point(arriving, receiver)
        }
        _ => isotropic(arriving, receiver, forms),
    };
    let reflected = arriving.strength * specular;
    let grazing = reflected * shade::fresnel_weight(arriving, receiver);
    sum.near += reflected - grazing;
    sum.grazing += grazing;
}

#[inline(always)]
fn isotropic(arriving: &Incoming, receiver: &Receiver, forms: &Forms<'_>) -> f32 {
    let surface = GlossyView::new(receiver.view, receiver.normal, receiver.alpha);
    match forms {
        Forms::Lobe(plan) => match plan.glossy {
            GlossyForm::NdfFilter => shade::glossy_masked(arriving, &surface),
            GlossyForm::NdfFilter2024 => shade::glossy_2024(arriving, &surface),
            GlossyForm::Asg2013 => shade::glossy_asg_2013(arriving, receiver),
            GlossyForm::Asg2015 => shade::glossy_asg_2015(arriving, receiver),
            GlossyForm::Sg => shade::glossy_sg(arriving, receiver),
            GlossyForm::Blend => shade::glossy_blended(arriving, &surface),
        },
        Forms::Point(_) => shade::glossy_point(arriving, receiver),
    }
}

/// One receiver under one cluster, compiled for the baseline machine.
#[inline(never)]
pub(crate) fn single_vsgl(
    d: &DiffuseVsgl,
    s: &SpecularVsgl,
    r: &Receiver,
    plan: &ShadePlan,
) -> Single {
    let mut sum = Single::default();
    let forms = Forms::Lobe(plan);
    let (diffuse, specular) = match plan.emission {
        Emission::Cosine => (
            shade::incoming_diffuse(d, r.position, r.normal),
            if plan.anisotropic_senders {
                let sender = shade::anisotropic_sender_view(s);
                shade::incoming_specular(s, &sender, r.position, r.normal)
            } else {
                shade::incoming_specular(s, &shade::sender_view(s), r.position, r.normal)
            },
        ),
        Emission::Sg => (
            shade::incoming_sg(
                d.position,
                d.variance,
                d.axis,
                d.sharpness,
                d.intensity,
                r.position,
            ),
            shade::incoming_sg(
                s.position,
                s.variance,
                s.mirror,
                s.sharpness_lobe,
                s.f0,
                r.position,
            ),
        ),
    };
    reflect(&mut sum, &diffuse, r, &forms);
    reflect(&mut sum, &specular, r, &forms);
    sum
}

/// One receiver under one point light, compiled for the baseline machine.
#[inline(never)]
pub(crate) fn single_vpl(light: &PointSender, r: &Receiver, plan: &ShadePlan) -> Single {
    let mut sum = Single::default();
    let arriving = if plan.anisotropic_senders {
        shade::incoming_anisotropic_point(light, r.position)
    } else {
        shade::incoming_point(light, r.position)
    };
    reflect(&mut sum, &arriving, r, &Forms::Point(plan));
    sum
}

/// Sixteen receivers under one cluster, compiled for the machine at hand.
#[multiversion::multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
pub(crate) fn block_vsgl(
    d: &DiffuseVsgl,
    s: &SpecularVsgl,
    r: &Receivers,
    plan: &ShadePlan,
) -> Sums {
    let r = *r;
    block::vsgl(d, Some(s), &r, plan)
}

/// Sixteen receivers under one point light, compiled for the machine at hand.
#[multiversion::multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
pub(crate) fn block_vpl(light: &PointSender, r: &Receivers, plan: &ShadePlan) -> Sums {
    let r = *r;
    block::vpl(light, &r, plan)
}

/// Mostly ordinary numbers, some at the edge.
fn number(random: &mut Random, edges: &[f32], low: f32, high: f32) -> f32 {
    if random.unit() < 0.15 {
        random.pick(edges)
    } else {
        random.between(low, high)
    }
}

fn position(random: &mut Random) -> Vec3 {
    let size = random.pick(&[0.0, 1e-6, 1.0, 1.0, 1.0, 3.0, 1e3, 1e7]);
    random.point(size)
}

/// A receiver anywhere, facing anywhere.
pub(crate) fn receiver(random: &mut Random) -> Receiver {
    let normal = random.direction();
    let view = if random.unit() < 0.1 {
        normal
    } else {
        random.direction()
    };
    Receiver {
        position: position(random),
        normal,
        view,
        f0: number(random, &[0.0, 1.0], 0.0, 0.1),
        f90: number(random, &[0.0, 1.0], 0.0, 1.0),
        alpha: number(random, &[0.0, 1e-6, 1.0], 0.01, 1.0),
        tangent: random.direction(),
        across: number(random, &[0.0, 1e-6, 1.0], 0.01, 1.0),
    }
}

pub(crate) fn receivers(random: &mut Random) -> [Receiver; LANES] {
    std::array::from_fn(|_| receiver(random))
}

fn color(random: &mut Random) -> [f32; 3] {
    let scale = random.pick(&[0.0, 1e-20, 1.0, 1.0, 1e6]);
    std::array::from_fn(|_| scale * random.unit())
}

fn covariance(random: &mut Random, variance: f32) -> [f32; 6] {
    let share = random.unit() * variance;
    [
        share,
        variance - share,
        variance,
        0.0,
        0.3 * share * random.unit(),
        0.0,
    ]
}

const VARIANCES: [f32; 6] = [0.0, 1e-30, 1e-10, 1.0, 1e6, 1e20];
const SHARPNESSES: [f32; 6] = [0.0, 1e-30, 1e-3, 1.0, 1e6, 2.199_023_3e12];

/// A cluster anywhere, of any size and roughness.
pub(crate) fn cluster(random: &mut Random) -> (DiffuseVsgl, SpecularVsgl) {
    let variance = number(random, &VARIANCES, 1e-4, 0.5);
    let direction = |random: &mut Random| random.direction().to_array();
    let diffuse = DiffuseVsgl {
        position: position(random).to_array(),
        variance,
        axis: direction(random),
        sharpness: number(random, &SHARPNESSES, 0.1, 100.0),
        intensity: color(random),
        complement: number(random, &[0.0, 1e-12, 1.0], 0.0, 1.0),
        light: direction(random),
        f0: random.unit() * 0.1,
        covariance: covariance(random, variance),
        f90: random.unit(),
        bulge: random.between(-0.2, 0.2) * variance.sqrt(),
    };
    let specular = SpecularVsgl {
        position: position(random).to_array(),
        variance,
        axis: direction(random),
        mirror: direction(random),
        light: direction(random),
        sharpness_lobe: number(random, &SHARPNESSES, 0.1, 100.0),
        f0: color(random),
        alpha: number(random, &[0.0, 1e-6, 1.0], 0.01, 1.0),
        f90: color(random),
        complement: number(random, &[0.0, 1e-12, 1.0], 0.0, 1.0),
        covariance: covariance(random, variance),
        complement_mirror: number(random, &[0.0, 1e-12, 1.0], 0.0, 1.0),
        bulge: random.between(-0.2, 0.2) * variance.sqrt(),
        across: number(random, &[0.0, 1e-6, 1.0], 0.01, 1.0),
        turn: random.between(-1.0, 1.0),
    };
    (diffuse, specular)
}

/// A texel anywhere.
pub(crate) fn point(random: &mut Random) -> PointSender {
    PointSender {
        position: position(random),
        variance: number(random, &VARIANCES, 1e-6, 1e-2),
        normal: random.direction(),
        light: random.direction(),
        diffuse: color(random).into(),
        dielectric_f0: random.unit() * 0.1,
        dielectric_f90: random.unit(),
        f0: color(random).into(),
        f90: color(random).into(),
        alpha: number(random, &[0.0, 1e-6, 1.0], 0.01, 1.0),
        across: number(random, &[0.0, 1e-6, 1.0], 0.01, 1.0),
        turn: random.between(-1.0, 1.0),
    }
}
