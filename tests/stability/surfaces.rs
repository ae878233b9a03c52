//! Contracts of the reflectances and of glossy lighting at the edge.

use crate::directions::{alpha, cosine, direction, pair, sharpness};
use proptest::prelude::*;
use vsgl_core::brdf::roughness::Roughness;
use vsgl_core::brdf::{albedo, beckmann, ggx, ggx_local};
use vsgl_core::glam::Vec3;
use vsgl_core::math::vec::{normalize, reflect};
use vsgl_core::sg::asg::reflection_lobe;
use vsgl_core::sg::filtering::FilteredView;
use vsgl_core::sg::glossy::GlossyView;
use vsgl_core::sg::warp;

fn fit(value: f32) -> bool {
    value.is_finite() && value >= 0.0
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn glossy_lighting_is_finite((view, axis) in pair(), normal in direction(), a in alpha(), b in alpha(),
                                 k in sharpness(), horizon in sharpness(), index in 0.3f32..3.0) {
        let world = GlossyView::new(view, normal, a);
        prop_assert!(fit(world.density(axis, k)) && fit(world.density_2024(axis, k)));
        prop_assert!((0.0..=1.000_01).contains(&world.share(axis, k)));
        prop_assert!((0.0..=2.000_01).contains(&world.masked_share(axis, k)));
        prop_assert!(fit(world.blended(axis, k, horizon)) && fit(world.masked(axis, k, horizon)) && fit(world.filtered_2024(axis, k)));
        let local = FilteredView::reflection(view, a, b);
        prop_assert!(fit(local.reflected_density(axis, k)) && fit(local.masked(axis, k, horizon)));
        prop_assert!(fit(local.filtered_2024(axis, k)));
        let refracted = FilteredView::refraction(view, a, b, index);
        prop_assert!(fit(refracted.refracted_density(axis, k, index)) && fit(refracted.transmitted_2024(axis, k, index)));
        for f in [warp::glossy_asg_2016, warp::glossy_asg_2015, warp::glossy_sg_2015] {
            prop_assert!(fit(f(view, normal, a, axis, k)));
        }
        let lobe = reflection_lobe(view, normal, 0.5 * warp::normal_sharpness(a));
        prop_assert!((lobe.x.cross(lobe.y) - lobe.z).length() < 1e-5);
        prop_assert!(fit(lobe.evaluate(axis)) && fit(lobe.product_integral(axis, k)));
        let lobe = warp::reflection_asg_local(view, a, b);
        prop_assert!((lobe.x.cross(lobe.y) - lobe.z).length() < 1e-4, "{:?}", lobe);
        prop_assert!(fit(lobe.evaluate(axis)) && fit(lobe.product_integral(axis, k)));
    }

    #[test]
    fn reflectances_are_finite_and_reciprocal((view, light) in pair(), normal in direction(), a in alpha(), b in alpha(),
                                              turn in 0.0f32..6.3) {
        prop_assert!(fit(ggx::distribution(view + light, normal, a.max(1e-4))));
        let forward = ggx::reflectance(view, light, normal, a.max(1e-4));
        let backward = ggx::reflectance(light, view, normal, a.max(1e-4));
        prop_assert!(fit(forward) && (forward - backward).abs() <= 1e-5 * forward);
        let roughness = Roughness::rotated(a.max(1e-4), b.max(1e-4), turn.cos(), turn.sin());
        for f in [ggx_local::distribution, beckmann::distribution, ggx_local::projected_area,
                  beckmann::projected_area, ggx_local::lambda, beckmann::lambda] {
            prop_assert!(fit(f(view, roughness)));
        }
        prop_assert!(beckmann::log_distribution(view, roughness).is_finite());
        for f in [ggx_local::reflectance, beckmann::reflectance] {
            let (forward, backward) = (f(view, light, roughness), f(light, view, roughness));
            prop_assert!(fit(forward) && (forward - backward).abs() <= 1e-5 * forward);
        }
    }

    #[test]
    fn samples_are_fit(view in direction(), a in alpha(), b in alpha(), turn in 0.0f32..6.3,
                       u in 0.0f32..1.0, v in 0.0f32..1.0) {
        let view = Vec3::new(view.x, view.y, view.z.abs());
        let roughness = Roughness::rotated(a.max(1e-4), b.max(1e-4), turn.cos(), turn.sin());
        let half = ggx_local::sample_visible_normal(view, roughness, u, v);
        prop_assert!((half.length() - 1.0).abs() < 1e-5 && half.z >= 0.0);
        let light = normalize(reflect(view, half));
        prop_assert!((0.0..=1.0).contains(&ggx_local::sample_weight(view, light, roughness)));
        prop_assert!(fit(ggx_local::reflected_density(view, light, roughness)));
        prop_assert!(fit(ggx_local::visible_normal_density(view, half, roughness)));
        let half = beckmann::sample_visible_normal(view, roughness, u, v);
        prop_assert!((half.length() - 1.0).abs() < 1e-5 && half.z >= 0.0);
        let light = normalize(reflect(view, half));
        prop_assert!((0.0..=1.0).contains(&beckmann::sample_weight(view, light, roughness)));
        prop_assert!(fit(beckmann::reflected_density(view, light, roughness)));
        prop_assert!(fit(beckmann::visible_normal_density(view, half, roughness)));
    }

    #[test]
    fn albedo_is_a_share(c in cosine(), a in alpha()) {
        let value = albedo::ggx_albedo(c, a);
        prop_assert!(value.a >= 0.0 && value.b >= 0.0 && value.a + value.b <= 1.0 + 1e-6);
    }
}
