//! One receiver against one virtual light.
//!
//! In two steps: what arrives at the receiver ([`Incoming`], by the form of emission), and what the receiver reflects
//! of it (a factor for the Lambert part, one for the specular part). All functions here are reached by lane loops.

use crate::brdf::fresnel::{half_cosine, schlick_weight};
use crate::brdf::ggx;
use crate::data::{DiffuseVsgl, GBuffer, Rsm, SpecularVsgl};
use crate::math::elementary::{exp, expm1_over_x};
use crate::math::vec::normalize;
use crate::sg::anisotropic::{self, AnisotropicView, Frame, glossy_asg, tangent_of};
use crate::sg::glossy::GlossyView;
use crate::sg::lobe::SHARPNESS_MAX;
use crate::sg::{cosine, extent, lobe, vmf, warp};
use glam::Vec3;

/// Least positional variance \[m²\]: keeps its inverse finite.
pub const VARIANCE_MIN: f32 = 1e-30;

/// A lobe of light as it arrives at a receiver.
#[derive(Clone, Copy, Debug)]
pub struct Incoming {
    /// Unit direction that it comes from.
    pub axis: Vec3,
    /// Its sharpness.
    pub sharpness: f32,
    /// Its sharpness towards the receiver's normal, which is what the receiver's horizon sees: a flat cluster has less
    /// extent along its own normal than across.
    pub horizon: f32,
    /// Irradiance that it brings to a surface that faces it \[W/m²\].
    pub strength: Vec3,
}

/// A receiver, without its colours: they are factors of the sums over all lights.
#[derive(Clone, Copy, Debug)]
pub struct Receiver {
    /// Position \[m\].
    pub position: Vec3,
    /// Unit normal, turned to the eye.
    pub normal: Vec3,
    /// Unit direction to the eye.
    pub view: Vec3,
    /// Dielectric reflectance at normal incidence, of the Lambert part.
    pub f0: f32,
    /// Dielectric reflectance at grazing incidence, of the Lambert part.
    pub f90: f32,
    /// GGX roughness; along the tangent where there are two.
    pub alpha: f32,
    /// Unit direction in the surface that `alpha` belongs to. Read only by the anisotropic forms.
    pub tangent: Vec3,
    /// GGX roughness across the tangent.
    pub across: f32,
}

impl Receiver {
    /// The receiver at a sample of a G-buffer that hit something, seen from `eye`.
    pub fn of(gbuffer: &GBuffer, sample: usize, eye: Vec3) -> Self {
        let [nx, ny, nz, f90] = gbuffer.normal[sample];
        let position = xyz(gbuffer.position[sample]);
        let tangent = gbuffer.tangent.get(sample).copied().unwrap_or_default();
        Self {
            position,
            normal: Vec3::new(nx, ny, nz),
            view: normalize(eye - position),
            f0: gbuffer.diffuse[sample][3],
            f90,
            alpha: gbuffer.specular.get(sample).map_or(1.0, |s| s[3]),
            tangent: xyz(tangent),
            across: tangent[3],
        }
    }

    /// The frame of the anisotropic forms.
    #[inline(always)]
    fn frame(&self) -> Frame {
        Frame::new(self.normal, self.tangent)
    }
}

/// A surface that reflects by lobes: what [`incoming_specular`] asks of a sender.
pub trait Gloss {
    /// Reflected radiance of a light of strength 1 and Fresnel factor 1 \[1/sr\].
    fn masked(&self, axis: Vec3, sharpness: f32, horizon_sharpness: f32) -> f32;
}

impl Gloss for GlossyView {
    #[inline(always)]
    fn masked(&self, axis: Vec3, sharpness: f32, horizon_sharpness: f32) -> f32 {
        self.masked(axis, sharpness, horizon_sharpness)
    }
}

impl Gloss for AnisotropicView {
    #[inline(always)]
    fn masked(&self, axis: Vec3, sharpness: f32, horizon_sharpness: f32) -> f32 {
        self.masked(axis, sharpness, horizon_sharpness)
    }
}

/// The colours of a receiver, which sums over lights are multiplied by.
#[derive(Clone, Copy, Debug)]
pub struct Colors {
    /// Albedo of the Lambert part.
    pub albedo: Vec3,
    /// Specular reflectance at normal incidence.
    pub f0: Vec3,
    /// Specular reflectance at grazing incidence.
    pub f90: f32,
}

impl Colors {
    /// The colours at a sample of a G-buffer; without specular columns those are black.
    pub fn of(gbuffer: &GBuffer, sample: usize) -> Self {
        Self {
            albedo: xyz(gbuffer.diffuse[sample]),
            f0: gbuffer.specular.get(sample).map_or(Vec3::ZERO, |&s| xyz(s)),
            f90: gbuffer.grazing.get(sample).copied().unwrap_or_default(),
        }
    }

    /// Radiance to the eye by the Lambert part, from the sum of strength times Lambert factor.
    #[inline(always)]
    pub fn diffuse(&self, sum: Vec3) -> Vec3 {
        sum * (self.albedo * std::f32::consts::FRAC_1_PI)
    }

    /// Radiance to the eye by the specular part, from the sums for `F0` and for `F90`.
    #[inline(always)]
    pub fn glossy(&self, near: Vec3, grazing: Vec3) -> Vec3 {
        near * self.f0 + grazing * self.f90
    }
}

fn xyz(v: [f32; 4]) -> Vec3 {
    Vec3::new(v[0], v[1], v[2])
}

/// The way from a receiver to a cluster.
#[derive(Clone, Copy, Debug)]
struct Path {
    /// Unit direction from the receiver to the cluster's mean.
    direction: Vec3,
    /// Sharpness of the cluster's extent as seen from the receiver.
    sharpness: f32,
    /// `A(sharpness)/(2π variance)`: what a radiant intensity is multiplied by to give the irradiance; tends to one
    /// over the squared distance and stays finite inside the cluster \[1/m²\].
    spread: f32,
}

#[inline(always)]
fn path(position: Vec3, variance: f32, receiver: Vec3) -> Path {
    let apart = position - receiver;
    let distance2 = apart.dot(apart);
    let variance = variance
        .max(distance2 * (1.0 / SHARPNESS_MAX))
        .max(VARIANCE_MIN);
    let sharpness = distance2 / variance;
    let spread = 2.0 * expm1_over_x(-2.0 * sharpness) / variance;
    Path {
        direction: normalize(apart),
        sharpness,
        spread,
    }
}

/// Sharpness of a cluster's extent along a unit direction, from that across the line of sight: their variances are as
/// `aᵀ C a` to `variance`.
#[inline(always)]
fn sharpness_along(sharpness: f32, variance: f32, covariance: &[f32; 6], direction: Vec3) -> f32 {
    // Flat clusters have no extent along their normal.
    let along = extent::along(covariance, direction)
        .max(1e-12 * variance)
        .max(VARIANCE_MIN);
    (sharpness * (variance / along)).min(SHARPNESS_MAX)
}

/// Unit direction in which light leaves a cluster towards a receiver: from where its surfaces' planes lie in the mean, so
/// that a receiver on the same convex surface gets none.
#[inline(always)]
fn leaving(position: [f32; 3], axis: Vec3, bulge: f32, receiver: Vec3) -> Vec3 {
    normalize(receiver - (Vec3::from_array(position) + axis * bulge))
}

/// Share that a dielectric's Lambert part keeps: one minus its reflectance, at a half-vector cosine.
#[inline(always)]
fn lambert_share(f0: f32, f90: f32, cosine: f32) -> f32 {
    1.0 - (f0 + (f90 - f0) * schlick_weight(cosine))
}

#[inline(always)]
fn mean_length(complement: f32) -> vmf::MeanLength {
    vmf::MeanLength {
        length: 1.0 - complement,
        complement,
    }
}

/// What the Lambert part of a cluster sends: the clamped cosine averaged over its normals and its extent.
///
/// Ours, see `docs/derivations.md`.
#[inline(always)]
pub fn incoming_diffuse(light: &DiffuseVsgl, receiver: Vec3, normal: Vec3) -> Incoming {
    let path = path(Vec3::from_array(light.position), light.variance, receiver);
    let axis = Vec3::from_array(light.axis);
    let outgoing = leaving(light.position, axis, light.bulge, receiver);
    let blur = sharpness_along(path.sharpness, light.variance, &light.covariance, axis);
    let sharpness = vmf::convolve_with(mean_length(light.complement), blur);
    let mean_cosine = cosine::mean_clamped_cosine(sharpness, outgoing.dot(axis));
    let half = half_cosine(Vec3::from_array(light.light), outgoing);
    let factor = mean_cosine * lambert_share(light.f0, light.f90, half) * path.spread;
    Incoming {
        axis: path.direction,
        sharpness: path.sharpness,
        horizon: sharpness_along(path.sharpness, light.variance, &light.covariance, normal),
        strength: Vec3::from_array(light.intensity) * factor,
    }
}

/// What the specular part of a cluster sends: GGX under the lobe of directions that the light comes from, blurred by
/// the cluster's extent. The sender is shaded like a receiver whose eye is the light.
///
/// Ours, see `docs/derivations.md`. `sender` is [`sender_view`] or [`anisotropic_sender_view`] of the light.
#[inline(always)]
pub fn incoming_specular<S: Gloss>(
    light: &SpecularVsgl,
    sender: &S,
    receiver: Vec3,
    normal: Vec3,
) -> Incoming {
    let path = path(Vec3::from_array(light.position), light.variance, receiver);
    let axis = Vec3::from_array(light.axis);
    let outgoing = leaving(light.position, axis, light.bulge, receiver);
    let across = vmf::mean(path.sharpness);
    let along = sharpness_along(path.sharpness, light.variance, &light.covariance, axis);
    let lobe = vmf::sharpness(mean_length(light.complement_mirror).convolve(across));
    let horizon = vmf::convolve_with(mean_length(light.complement), along);
    let reflected = sender.masked(outgoing, lobe, horizon) * path.spread;
    let grazing = schlick_weight(half_cosine(Vec3::from_array(light.light), outgoing));
    let (f0, f90) = (Vec3::from_array(light.f0), Vec3::from_array(light.f90));
    let arriving = lobe::product(
        -Vec3::from_array(light.mirror),
        light.sharpness_lobe,
        path.direction,
        path.sharpness,
    );
    Incoming {
        axis: arriving.axis,
        sharpness: arriving.sharpness,
        horizon: sharpness_along(
            arriving.sharpness,
            light.variance,
            &light.covariance,
            normal,
        ),
        strength: (f0 + (f90 - f0) * grazing) * reflected,
    }
}

/// The sender of [`incoming_specular`], once a light.
#[inline(always)]
pub fn sender_view(light: &SpecularVsgl) -> GlossyView {
    GlossyView::new(
        Vec3::from_array(light.light),
        Vec3::from_array(light.axis),
        light.alpha,
    )
}

/// The sender of [`incoming_specular`] where surfaces have two roughnesses, once a light.
#[inline(always)]
pub fn anisotropic_sender_view(light: &SpecularVsgl) -> AnisotropicView {
    let axis = Vec3::from_array(light.axis);
    let tangent = tangent_of(axis, light.turn);
    let view = Vec3::from_array(light.light);
    AnisotropicView::new(view, axis, tangent, light.alpha, light.across)
}

/// What one spherical Gaussian of radiant intensity sends.
///
/// Source: Tokuyoshi 2016, supplement, section C.1 (product of the lobe with the Gaussian of the cluster's extent).
#[inline(always)]
pub fn incoming_sg(
    position: [f32; 3],
    variance: f32,
    axis: [f32; 3],
    sharpness: f32,
    intensity: [f32; 3],
    receiver: Vec3,
) -> Incoming {
    let path = path(Vec3::from_array(position), variance, receiver);
    let product = lobe::product(
        -Vec3::from_array(axis),
        sharpness,
        path.direction,
        path.sharpness,
    );
    // spread = A(sharpness)/(2π variance), of the extent alone.
    let factor = exp(product.log_amplitude) * lobe::integral(product.sharpness)
        / lobe::integral(path.sharpness);
    Incoming {
        axis: product.axis,
        sharpness: product.sharpness,
        horizon: product.sharpness,
        strength: Vec3::from_array(intensity) * (factor * path.spread),
    }
}

/// A virtual point light: one texel of a reflective shadow map.
#[derive(Clone, Copy, Debug, Default)]
pub struct PointSender {
    /// Position \[m\].
    pub position: Vec3,
    /// Variance of the texel's extent along one axis \[m²\].
    pub variance: f32,
    /// Unit normal, turned to the light.
    pub normal: Vec3,
    /// Unit direction to the light.
    pub light: Vec3,
    /// Flux reflected by the Lambert part \[W\].
    pub diffuse: Vec3,
    /// Dielectric reflectance of the Lambert part at normal incidence.
    pub dielectric_f0: f32,
    /// Dielectric reflectance of the Lambert part at grazing incidence.
    pub dielectric_f90: f32,
    /// Arriving flux times `F0` \[W\].
    pub f0: Vec3,
    /// Arriving flux times `F90` \[W\].
    pub f90: Vec3,
    /// GGX roughness; along the tangent where there are two.
    pub alpha: f32,
    /// GGX roughness across the tangent; read only by [`incoming_anisotropic_point`].
    pub across: f32,
    /// Direction of the tangent about the normal, see [`anisotropic::turn_of`].
    pub turn: f32,
}

impl PointSender {
    /// The light of a texel; none if it reflects no flux. Without `glossy` its specular part is left out.
    pub fn of(rsm: &Rsm, texel: usize, glossy: bool) -> Option<Self> {
        let (diffuse, specular) = rsm.weights(texel);
        if diffuse + specular <= 0.0 {
            return None;
        }
        let position = xyz(rsm.position[texel]);
        let lambert = Self {
            position,
            variance: rsm.position[texel][3] * (1.0 / 12.0),
            normal: xyz(rsm.normal[texel]),
            light: normalize(rsm.map_of(texel).to_light(position)),
            diffuse: xyz(rsm.diffuse[texel]),
            dielectric_f0: rsm.diffuse[texel][3],
            dielectric_f90: rsm.normal[texel][3],
            alpha: 1.0,
            ..Self::default()
        };
        Some(if glossy {
            let specular = rsm.specular[texel];
            let tangent = rsm.tangent.get(texel).copied().unwrap_or_default();
            Self {
                f0: xyz(specular),
                f90: xyz(rsm.grazing[texel]),
                alpha: specular[3],
                across: tangent[3],
                turn: anisotropic::turn_of(lambert.normal, xyz(tangent)),
                ..lambert
            }
        } else {
            lambert
        })
    }
}

/// What a virtual point light sends: its reflectance as it is, in the direction of the receiver.
///
/// Its texel's extent keeps the inverse square of the distance finite.
/// Source: Keller 1997, "Instant Radiosity".
#[inline(always)]
pub fn incoming_point(light: &PointSender, receiver: Vec3) -> Incoming {
    let path = path(light.position, light.variance, receiver);
    let outgoing = -path.direction;
    let specular = ggx::reflectance(light.light, outgoing, light.normal, light.alpha);
    sent_by_point(light, &path, specular)
}

/// As [`incoming_point`] where surfaces have two roughnesses.
#[inline(always)]
pub fn incoming_anisotropic_point(light: &PointSender, receiver: Vec3) -> Incoming {
    let path = path(light.position, light.variance, receiver);
    let frame = Frame::new(light.normal, tangent_of(light.normal, light.turn));
    let outgoing = -path.direction;
    let specular =
        anisotropic::reflectance(light.light, outgoing, &frame, light.alpha, light.across);
    sent_by_point(light, &path, specular)
}

#[inline(always)]
fn sent_by_point(light: &PointSender, path: &Path, specular: f32) -> Incoming {
    let outgoing = -path.direction;
    let facing = outgoing.dot(light.normal).max(0.0) * path.spread;
    let half = half_cosine(light.light, outgoing);
    let lambert = lambert_share(light.dielectric_f0, light.dielectric_f90, half)
        * std::f32::consts::FRAC_1_PI;
    let fresnel = light.f0 + (light.f90 - light.f0) * schlick_weight(half);
    Incoming {
        axis: path.direction,
        sharpness: SHARPNESS_MAX,
        horizon: SHARPNESS_MAX,
        strength: (light.diffuse * lambert + fresnel * specular) * facing,
    }
}

/// Share of what arrives that meets the receiver's Lambert part, the mean clamped cosine left out: what its dielectric
/// layer lets through.
#[inline(always)]
fn through(incoming: &Incoming, receiver: &Receiver) -> f32 {
    lambert_share(
        receiver.f0,
        receiver.f90,
        half_cosine(receiver.view, incoming.axis),
    )
}

/// Factor of the Lambert part by our refit of the 2024 form. Multiply by strength and albedo over π.
#[inline(always)]
pub fn lambert_v13(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let mean = cosine::mean_clamped_cosine(incoming.horizon, incoming.axis.dot(receiver.normal));
    mean * through(incoming, receiver)
}

/// Factor of the Lambert part by our form with one term more, see [`cosine::interpolated_v14`].
#[inline(always)]
pub fn lambert_v14(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let k = incoming.horizon;
    let mean = cosine::interpolated_v14(k, incoming.axis.dot(receiver.normal)) / lobe::integral(k);
    mean * through(incoming, receiver)
}

/// Factor of the Lambert part by the form of Tokuyoshi et al. 2024.
#[inline(always)]
pub fn lambert_2024(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let k = incoming.horizon;
    let mean = cosine::interpolated_2024(k, incoming.axis.dot(receiver.normal)) / lobe::integral(k);
    mean * through(incoming, receiver)
}

/// Factor of the Lambert part by two hemispherical integrals of 2022, see [`cosine::lobes_2022`].
#[inline(always)]
pub fn lambert_2022(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let k = incoming.horizon;
    let mean = cosine::lobes_2022(k, incoming.axis.dot(receiver.normal)) / lobe::integral(k);
    mean * through(incoming, receiver)
}

/// Factor of the Lambert part by two hemispherical integrals of 2018, see [`cosine::lobes_2018`].
#[inline(always)]
pub fn lambert_2018(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let k = incoming.horizon;
    let mean = cosine::lobes_2018(k, incoming.axis.dot(receiver.normal)) / lobe::integral(k);
    mean * through(incoming, receiver)
}

/// Factor of the Lambert part with the cosine as a lobe, as published in 2015, see [`cosine::sg_2015`].
#[inline(always)]
pub fn lambert_sg_2015(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let k = incoming.horizon;
    let mean = cosine::sg_2015(k, incoming.axis.dot(receiver.normal)) / lobe::integral(k);
    mean * through(incoming, receiver)
}

/// Factor of the Lambert part with the cosine as a lobe and the exact product, see [`cosine::sg_product`].
#[inline(always)]
pub fn lambert_sg_product(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let k = incoming.horizon;
    let mean = cosine::sg_product(k, incoming.axis.dot(receiver.normal)) / lobe::integral(k);
    mean * through(incoming, receiver)
}

/// Factor of the Lambert part with the cosine at the lobe's axis, exact for a point light.
#[inline(always)]
pub fn lambert_constant(incoming: &Incoming, receiver: &Receiver) -> f32 {
    incoming.axis.dot(receiver.normal).max(0.0) * through(incoming, receiver)
}

/// Factor of the specular part by NDF filtering with masking. Multiply by strength and Fresnel reflectance.
#[inline(always)]
pub fn glossy_masked(incoming: &Incoming, surface: &GlossyView) -> f32 {
    surface.masked(incoming.axis, incoming.sharpness, incoming.horizon)
}

/// Factor of the specular part by NDF filtering as published in 2024.
#[inline(always)]
pub fn glossy_2024(incoming: &Incoming, surface: &GlossyView) -> f32 {
    surface.filtered_2024(incoming.axis, incoming.sharpness)
}

/// Factor of the specular part closest to exact integrals, see [`crate::sg::glossy_blend`].
#[inline(always)]
pub fn glossy_blended(incoming: &Incoming, surface: &GlossyView) -> f32 {
    surface.blended(incoming.axis, incoming.sharpness, incoming.horizon)
}

/// Factor of the specular part by an isotropic spherical Gaussian, see [`warp::glossy_sg_2015`].
#[inline(always)]
pub fn glossy_sg(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let Receiver {
        view,
        normal,
        alpha,
        ..
    } = *receiver;
    let reflected = warp::glossy_sg_2015(view, normal, alpha, incoming.axis, incoming.sharpness);
    reflected / lobe::integral(incoming.sharpness)
}

/// Factor of the specular part by an anisotropic spherical Gaussian, the rest of the reflectance at the axis of the
/// integrand, see [`warp::glossy_asg_2015`].
#[inline(always)]
pub fn glossy_asg_2015(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let Receiver {
        view,
        normal,
        alpha,
        ..
    } = *receiver;
    let reflected = warp::glossy_asg_2015(view, normal, alpha, incoming.axis, incoming.sharpness);
    reflected / lobe::integral(incoming.sharpness)
}

/// Factor of the specular part by an anisotropic spherical Gaussian.
///
/// Source: Tokuyoshi 2016, supplement, section C.2; Xu et al. 2013, "Anisotropic Spherical Gaussians".
#[inline(always)]
pub fn glossy_asg_2013(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let Receiver {
        view,
        normal,
        alpha,
        ..
    } = *receiver;
    let reflected = warp::glossy_asg_2016(view, normal, alpha, incoming.axis, incoming.sharpness);
    reflected / lobe::integral(incoming.sharpness)
}

/// What a receiver with two roughnesses shares between all lights.
#[inline(always)]
pub fn anisotropic_view(receiver: &Receiver) -> AnisotropicView {
    let r = receiver;
    AnisotropicView::new(r.view, r.normal, r.tangent, r.alpha, r.across)
}

/// As [`glossy_masked`] for a surface with two roughnesses.
#[inline(always)]
pub fn anisotropic_masked(incoming: &Incoming, surface: &AnisotropicView) -> f32 {
    surface.masked(incoming.axis, incoming.sharpness, incoming.horizon)
}

/// As [`glossy_2024`] for a surface with two roughnesses.
#[inline(always)]
pub fn anisotropic_2024(incoming: &Incoming, surface: &AnisotropicView) -> f32 {
    surface.filtered_2024(incoming.axis, incoming.sharpness)
}

/// As [`glossy_asg_2013`] for a surface with two roughnesses.
#[inline(always)]
pub fn anisotropic_asg_2013(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let r = receiver;
    let (axis, sharpness) = (incoming.axis, incoming.sharpness);
    glossy_asg(r.view, &r.frame(), r.alpha, r.across, axis, sharpness) / lobe::integral(sharpness)
}

/// As [`glossy_asg_2015`] for a surface with two roughnesses.
#[inline(always)]
pub fn anisotropic_asg_2015(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let r = receiver;
    let (axis, sharpness) = (incoming.axis, incoming.sharpness);
    anisotropic::glossy_asg_2015(r.view, &r.frame(), r.alpha, r.across, axis, sharpness)
        / lobe::integral(sharpness)
}

/// As [`glossy_point`] for a surface with two roughnesses.
#[inline(always)]
pub fn anisotropic_point(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let r = receiver;
    let cosine = incoming.axis.dot(r.normal).max(0.0);
    anisotropic::reflectance(r.view, incoming.axis, &r.frame(), r.alpha, r.across) * cosine
}

/// Factor of the specular part for a light of one direction: GGX as it is.
#[inline(always)]
pub fn glossy_point(incoming: &Incoming, receiver: &Receiver) -> f32 {
    let cosine = incoming.axis.dot(receiver.normal).max(0.0);
    ggx::reflectance(
        receiver.view,
        incoming.axis,
        receiver.normal,
        receiver.alpha,
    ) * cosine
}

/// Weight of `F90` against `F0` in the Fresnel reflectance of what arrives.
#[inline(always)]
pub fn fresnel_weight(incoming: &Incoming, receiver: &Receiver) -> f32 {
    schlick_weight(half_cosine(receiver.view, incoming.axis))
}
