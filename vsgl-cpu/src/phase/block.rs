//! Sixteen receivers against one virtual light at a time: the texts of `vsgl_core::phase::shade` over lanes.
//!
//! The functions here hold loops over lanes and nothing else, so that the compiler turns each text into vector
//! instructions of the machine at hand, with the bits of the scalar text.

#![expect(
    clippy::needless_range_loop,
    reason = "one index runs over several arrays side by side"
)]

use glam::Vec3;
use vsgl_core::data::{DiffuseVsgl, SpecularVsgl};
use vsgl_core::phase::shade::{self, Incoming, PointSender, Receiver};
use vsgl_core::plan::ShadePlan;
use vsgl_core::settings::{DiffuseForm, Emission, GlossyForm};
use vsgl_core::sg::glossy::GlossyView;

/// Receivers that are shaded together.
pub const LANES: usize = 16;

/// A vector a lane, component by component.
pub type Vec3Lanes = [[f32; LANES]; 3];

#[inline(always)]
fn get(v: &Vec3Lanes, lane: usize) -> Vec3 {
    Vec3::new(v[0][lane], v[1][lane], v[2][lane])
}

#[inline(always)]
fn set(v: &mut Vec3Lanes, lane: usize, value: Vec3) {
    v[0][lane] = value.x;
    v[1][lane] = value.y;
    v[2][lane] = value.z;
}

/// Sixteen receivers.
#[derive(Clone, Copy, Debug)]
pub struct Receivers {
    position: Vec3Lanes,
    normal: Vec3Lanes,
    view: Vec3Lanes,
    f0: [f32; LANES],
    f90: [f32; LANES],
    alpha: [f32; LANES],
    tangent: Vec3Lanes,
    across: [f32; LANES],
}

impl Receivers {
    /// From single receivers.
    pub fn new(receivers: &[Receiver; LANES]) -> Self {
        let zero = [[0.0; LANES]; 3];
        let mut all = Self {
            position: zero,
            normal: zero,
            view: zero,
            f0: [0.0; LANES],
            f90: [0.0; LANES],
            alpha: [0.0; LANES],
            tangent: zero,
            across: [0.0; LANES],
        };
        for (lane, r) in receivers.iter().enumerate() {
            set(&mut all.position, lane, r.position);
            set(&mut all.normal, lane, r.normal);
            set(&mut all.view, lane, r.view);
            all.f0[lane] = r.f0;
            all.f90[lane] = r.f90;
            all.alpha[lane] = r.alpha;
            set(&mut all.tangent, lane, r.tangent);
            all.across[lane] = r.across;
        }
        all
    }

    /// Their positions.
    pub(crate) fn position(&self) -> &Vec3Lanes {
        &self.position
    }

    #[inline(always)]
    fn glossy(&self, lane: usize) -> GlossyView {
        let r = self.lane(lane);
        GlossyView::new(r.view, r.normal, r.alpha)
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> Receiver {
        Receiver {
            position: get(&self.position, lane),
            normal: get(&self.normal, lane),
            view: get(&self.view, lane),
            f0: self.f0[lane],
            f90: self.f90[lane],
            alpha: self.alpha[lane],
            tangent: get(&self.tangent, lane),
            across: self.across[lane],
        }
    }
}

/// What arrives at sixteen receivers.
#[derive(Clone, Copy, Debug)]
struct Arriving {
    axis: Vec3Lanes,
    sharpness: [f32; LANES],
    horizon: [f32; LANES],
    strength: Vec3Lanes,
}

/// [`Arriving`] from a text a lane. A macro: a closure would be compiled for the baseline machine and called.
macro_rules! arriving {
    ($lane:ident => $text:expr) => {{
        let zero = [[0.0; LANES]; 3];
        let mut all = Arriving {
            axis: zero,
            sharpness: [0.0; LANES],
            horizon: [0.0; LANES],
            strength: zero,
        };
        for $lane in 0..LANES {
            let one: Incoming = $text;
            set(&mut all.axis, $lane, one.axis);
            all.sharpness[$lane] = one.sharpness;
            all.horizon[$lane] = one.horizon;
            set(&mut all.strength, $lane, one.strength);
        }
        all
    }};
}

/// Writes a text a lane into an array.
macro_rules! lanes {
    ($out:ident, $lane:ident => $text:expr) => {
        for $lane in 0..LANES {
            $out[$lane] = $text;
        }
    };
}

impl Arriving {
    #[inline(always)]
    fn lane(&self, lane: usize) -> Incoming {
        Incoming {
            axis: get(&self.axis, lane),
            sharpness: self.sharpness[lane],
            horizon: self.horizon[lane],
            strength: get(&self.strength, lane),
        }
    }
}

/// Sums over lights at sixteen receivers, without the receivers' colours.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sums {
    /// For the Lambert part: multiply by albedo over π \[W/m²\].
    pub diffuse: Vec3Lanes,
    /// For the specular part: multiply by `F0` \[W/(m² sr)\].
    pub near: Vec3Lanes,
    /// For the specular part: multiply by `F90` \[W/(m² sr)\].
    pub grazing: Vec3Lanes,
}

impl Sums {
    /// Adds where a lane is open.
    #[inline(always)]
    pub fn add_open(&mut self, other: &Self, open: &[f32; LANES]) {
        let pairs = [
            (&mut self.diffuse, &other.diffuse),
            (&mut self.near, &other.near),
            (&mut self.grazing, &other.grazing),
        ];
        for (sum, more) in pairs {
            for channel in 0..3 {
                for lane in 0..LANES {
                    sum[channel][lane] += more[channel][lane] * open[lane];
                }
            }
        }
    }

    /// Whether a lane holds any light.
    #[inline(always)]
    pub fn lit(&self, lane: usize) -> bool {
        let (d, n, g) = (&self.diffuse, &self.near, &self.grazing);
        let diffuse = d[0][lane] + d[1][lane] + d[2][lane];
        let near = n[0][lane] + n[1][lane] + n[2][lane];
        let grazing = g[0][lane] + g[1][lane] + g[2][lane];
        diffuse + (near + grazing) > 0.0
    }
}

/// The forms of a point light: exact reflectance instead of integrals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Integral {
    Lobe(DiffuseForm, GlossyForm),
    Point,
}

/// What of the receivers' specular part there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Specular {
    None,
    Isotropic,
    Anisotropic,
}

impl Specular {
    fn of(plan: &ShadePlan) -> Self {
        match (plan.glossy_receivers, plan.anisotropic_receivers) {
            (false, _) => Self::None,
            (true, false) => Self::Isotropic,
            (true, true) => Self::Anisotropic,
        }
    }
}

/// Adds what receivers reflect of what arrives.
#[inline(always)]
fn reflect(
    sums: &mut Sums,
    arriving: &Arriving,
    receivers: &Receivers,
    integral: Integral,
    kind: Specular,
) {
    let mut lambert = [0.0; LANES];
    match integral {
        Integral::Lobe(DiffuseForm::V13, _) => {
            lanes!(lambert, i => shade::lambert_v13(&arriving.lane(i), &receivers.lane(i)));
        }
        Integral::Lobe(DiffuseForm::V14, _) => {
            lanes!(lambert, i => shade::lambert_v14(&arriving.lane(i), &receivers.lane(i)));
        }
        Integral::Lobe(DiffuseForm::Tokuyoshi2024, _) => {
            lanes!(lambert, i => shade::lambert_2024(&arriving.lane(i), &receivers.lane(i)));
        }
        Integral::Lobe(DiffuseForm::Tokuyoshi2022, _) => {
            lanes!(lambert, i => shade::lambert_2022(&arriving.lane(i), &receivers.lane(i)));
        }
        Integral::Lobe(DiffuseForm::MederBruederlin2018, _) => {
            lanes!(lambert, i => shade::lambert_2018(&arriving.lane(i), &receivers.lane(i)));
        }
        Integral::Lobe(DiffuseForm::Sg2015, _) => {
            lanes!(lambert, i => shade::lambert_sg_2015(&arriving.lane(i), &receivers.lane(i)));
        }
        Integral::Lobe(DiffuseForm::SgProduct, _) => {
            lanes!(lambert, i => shade::lambert_sg_product(&arriving.lane(i), &receivers.lane(i)));
        }
        Integral::Lobe(DiffuseForm::Constant, _) | Integral::Point => {
            lanes!(lambert, i => shade::lambert_constant(&arriving.lane(i), &receivers.lane(i)));
        }
    }
    for channel in 0..3 {
        for lane in 0..LANES {
            sums.diffuse[channel][lane] += arriving.strength[channel][lane] * lambert[lane];
        }
    }
    let specular = match kind {
        Specular::None => return,
        Specular::Isotropic => isotropic(arriving, receivers, integral),
        Specular::Anisotropic => anisotropic(arriving, receivers, integral),
    };
    let mut weight = [0.0; LANES];
    lanes!(weight, i => shade::fresnel_weight(&arriving.lane(i), &receivers.lane(i)));
    for channel in 0..3 {
        for lane in 0..LANES {
            let reflected = arriving.strength[channel][lane] * specular[lane];
            let grazing = reflected * weight[lane];
            sums.near[channel][lane] += reflected - grazing;
            sums.grazing[channel][lane] += grazing;
        }
    }
}

/// Factors of the specular part of surfaces with one roughness.
#[inline(always)]
fn isotropic(arriving: &Arriving, receivers: &Receivers, integral: Integral) -> [f32; LANES] {
    let mut specular = [0.0; LANES];
    match integral {
        Integral::Lobe(_, GlossyForm::NdfFilter) => {
            lanes!(specular, i => shade::glossy_masked(&arriving.lane(i), &receivers.glossy(i)));
        }
        Integral::Lobe(_, GlossyForm::NdfFilter2024) => {
            lanes!(specular, i => shade::glossy_2024(&arriving.lane(i), &receivers.glossy(i)));
        }
        Integral::Lobe(_, GlossyForm::Asg2013) => {
            lanes!(specular, i => shade::glossy_asg_2013(&arriving.lane(i), &receivers.lane(i)));
        }
        Integral::Lobe(_, GlossyForm::Asg2015) => {
            lanes!(specular, i => shade::glossy_asg_2015(&arriving.lane(i), &receivers.lane(i)));
        }
        Integral::Lobe(_, GlossyForm::Sg) => {
            lanes!(specular, i => shade::glossy_sg(&arriving.lane(i), &receivers.lane(i)));
        }
        Integral::Lobe(_, GlossyForm::Blend) => {
            lanes!(specular, i => shade::glossy_blended(&arriving.lane(i), &receivers.glossy(i)));
        }
        Integral::Point => {
            lanes!(specular, i => shade::glossy_point(&arriving.lane(i), &receivers.lane(i)));
        }
    }
    specular
}

/// Factors of the specular part of surfaces with two roughnesses.
#[inline(always)]
fn anisotropic(arriving: &Arriving, receivers: &Receivers, integral: Integral) -> [f32; LANES] {
    let mut specular = [0.0; LANES];
    match integral {
        Integral::Lobe(_, GlossyForm::NdfFilter) => {
            lanes!(specular, i => {
                let surface = shade::anisotropic_view(&receivers.lane(i));
                shade::anisotropic_masked(&arriving.lane(i), &surface)
            });
        }
        Integral::Lobe(_, GlossyForm::NdfFilter2024) => {
            lanes!(specular, i => {
                let surface = shade::anisotropic_view(&receivers.lane(i));
                shade::anisotropic_2024(&arriving.lane(i), &surface)
            });
        }
        Integral::Lobe(_, GlossyForm::Asg2013) => {
            lanes!(specular, i => shade::anisotropic_asg_2013(&arriving.lane(i), &receivers.lane(i)));
        }
        Integral::Lobe(_, GlossyForm::Asg2015) => {
            lanes!(specular, i => shade::anisotropic_asg_2015(&arriving.lane(i), &receivers.lane(i)));
        }
        // The plan asks no form of one roughness for two.
        Integral::Lobe(_, GlossyForm::Sg | GlossyForm::Blend) => {}
        Integral::Point => {
            lanes!(specular, i => shade::anisotropic_point(&arriving.lane(i), &receivers.lane(i)));
        }
    }
    specular
}

/// What arrives by the Lambert part of a cluster.
#[inline(always)]
fn arriving_diffuse(light: &DiffuseVsgl, receivers: &Receivers, plan: &ShadePlan) -> Arriving {
    match plan.emission {
        Emission::Cosine => arriving!(i => {
            let r = receivers.lane(i);
            shade::incoming_diffuse(light, r.position, r.normal)
        }),
        Emission::Sg => arriving!(i => {
            let d = light;
            let from = receivers.lane(i).position;
            shade::incoming_sg(d.position, d.variance, d.axis, d.sharpness, d.intensity, from)
        }),
    }
}

/// What arrives by the specular part of a cluster.
#[inline(always)]
fn arriving_specular(light: &SpecularVsgl, receivers: &Receivers, plan: &ShadePlan) -> Arriving {
    let s = light;
    match plan.emission {
        Emission::Cosine if plan.anisotropic_senders => {
            let sender = shade::anisotropic_sender_view(s);
            arriving!(i => {
                let r = receivers.lane(i);
                shade::incoming_specular(s, &sender, r.position, r.normal)
            })
        }
        Emission::Cosine => {
            let sender = shade::sender_view(s);
            arriving!(i => {
                let r = receivers.lane(i);
                shade::incoming_specular(s, &sender, r.position, r.normal)
            })
        }
        Emission::Sg => arriving!(i => {
            let from = receivers.lane(i).position;
            shade::incoming_sg(s.position, s.variance, s.mirror, s.sharpness_lobe, s.f0, from)
        }),
    }
}

/// What receivers reflect of one cluster; `specular` only with glossy senders.
#[inline(always)]
pub fn vsgl(
    diffuse: &DiffuseVsgl,
    specular: Option<&SpecularVsgl>,
    receivers: &Receivers,
    plan: &ShadePlan,
) -> Sums {
    let mut sums = Sums::default();
    let integral = Integral::Lobe(plan.diffuse, plan.glossy);
    let kind = Specular::of(plan);
    let arriving = arriving_diffuse(diffuse, receivers, plan);
    reflect(&mut sums, &arriving, receivers, integral, kind);
    let Some(specular) = specular else {
        return sums;
    };
    let arriving = arriving_specular(specular, receivers, plan);
    reflect(&mut sums, &arriving, receivers, integral, kind);
    sums
}

/// As [`vsgl`], with other strengths of what arrives by the Lambert and by the specular part \[W/m²\].
#[inline(always)]
pub(crate) fn vsgl_of_strength(
    diffuse: &DiffuseVsgl,
    specular: Option<&SpecularVsgl>,
    strength: &[Vec3Lanes; 2],
    receivers: &Receivers,
    plan: &ShadePlan,
) -> Sums {
    let mut sums = Sums::default();
    let integral = Integral::Lobe(plan.diffuse, plan.glossy);
    let kind = Specular::of(plan);
    let mut arriving = arriving_diffuse(diffuse, receivers, plan);
    arriving.strength = strength[0];
    reflect(&mut sums, &arriving, receivers, integral, kind);
    let Some(specular) = specular else {
        return sums;
    };
    let mut arriving = arriving_specular(specular, receivers, plan);
    arriving.strength = strength[1];
    reflect(&mut sums, &arriving, receivers, integral, kind);
    sums
}

/// What receivers reflect of one virtual point light.
#[inline(always)]
pub fn vpl(light: &PointSender, receivers: &Receivers, plan: &ShadePlan) -> Sums {
    let mut sums = Sums::default();
    let arriving = if plan.anisotropic_senders {
        arriving!(i => shade::incoming_anisotropic_point(light, receivers.lane(i).position))
    } else {
        arriving!(i => shade::incoming_point(light, receivers.lane(i).position))
    };
    reflect(
        &mut sums,
        &arriving,
        receivers,
        Integral::Point,
        Specular::of(plan),
    );
    sums
}

/// Adds the strength of what arrives of a virtual point light by its Lambert and by its specular part \[W/m²\].
#[inline(always)]
pub(crate) fn add_vpl_strength(
    strength: &mut [Vec3Lanes; 2],
    light: &PointSender,
    receivers: &Receivers,
    plan: &ShadePlan,
) {
    let lambert = PointSender {
        f0: Vec3::ZERO,
        f90: Vec3::ZERO,
        ..*light
    };
    let specular = PointSender {
        diffuse: Vec3::ZERO,
        ..*light
    };
    let mut add = |sum: usize, arriving: &Arriving| {
        for channel in 0..3 {
            for lane in 0..LANES {
                strength[sum][channel][lane] += arriving.strength[channel][lane];
            }
        }
    };
    add(
        0,
        &arriving!(i => shade::incoming_point(&lambert, receivers.lane(i).position)),
    );
    if !plan.glossy_senders {
        return;
    }
    let arriving = if plan.anisotropic_senders {
        arriving!(i => shade::incoming_anisotropic_point(&specular, receivers.lane(i).position))
    } else {
        arriving!(i => shade::incoming_point(&specular, receivers.lane(i).position))
    };
    add(1, &arriving);
}
