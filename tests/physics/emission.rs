//! One cluster's light against the sum over its texels.

use std::sync::Arc;
use vsgl_core::data::{DiffuseVsgl, Rsm, Vsgls};
use vsgl_core::glam::Vec3;
use vsgl_core::phase::shade::{
    PointSender, incoming_diffuse, incoming_point, incoming_sg, incoming_specular, sender_view,
};
use vsgl_tests::random::sphere_point;
use vsgl_tests::render::Shot;

const DIRECTIONS: usize = 2000;

fn clusters(name: &str, settings: &str) -> (Arc<Rsm>, Arc<Vsgls>) {
    let mut shot = Shot::sample(name).size(8, 8).with(settings);
    for material in &mut shot.scene.materials {
        material.roughness = 0.8;
    }
    let frame = shot.frame();
    (frame.rsm.expect("a bounce"), frame.vsgls.expect("clusters"))
}

fn xyz(v: [f32; 4]) -> Vec3 {
    Vec3::new(v[0], v[1], v[2])
}

/// One part of a texel as a point light, the other without flux.
fn sender(map: &Rsm, texel: usize, specular: bool) -> PointSender {
    let position = xyz(map.position[texel]);
    let point = PointSender {
        position,
        variance: map.position[texel][3] / 12.0,
        normal: xyz(map.normal[texel]),
        light: map.map_of(texel).to_light(position).normalize(),
        dielectric_f0: map.diffuse[texel][3],
        dielectric_f90: map.normal[texel][3],
        alpha: 1.0,
        ..PointSender::default()
    };
    if specular {
        let (f0, f90) = (map.specular[texel], map.grazing[texel]);
        PointSender {
            f0: xyz(f0),
            f90: xyz(f90),
            alpha: f0[3],
            ..point
        }
    } else {
        PointSender {
            diffuse: xyz(map.diffuse[texel]),
            ..point
        }
    }
}

/// Radiant intensities of a cluster and of its texels over the sphere: mean difference over the mean.
fn far_error(map: &Rsm, lights: &Vsgls, cluster: usize, specular: bool) -> f64 {
    let members: Vec<PointSender> = (0..lights.label.len())
        .filter(|&t| lights.label[t] == cluster as u32)
        .map(|t| sender(map, t, specular))
        .collect();
    let centre = lights.diffuse[cluster].position;
    let centre = if specular {
        lights.specular[cluster].position
    } else {
        centre
    };
    // A thousand times the room: only directions are left of positions.
    let far = 1e4f32;
    let (mut apart, mut whole) = (0.0, 0.0);
    for i in 0..DIRECTIONS {
        let direction = sphere_point(i, DIRECTIONS);
        let receiver = Vec3::from_array(centre) + direction * far;
        let exact: f32 = members
            .iter()
            .map(|m| incoming_point(m, receiver).strength.y)
            .sum();
        let found = if specular {
            let light = &lights.specular[cluster];
            incoming_specular(light, &sender_view(light), receiver, -direction)
                .strength
                .y
        } else {
            incoming_diffuse(&lights.diffuse[cluster], receiver, -direction)
                .strength
                .y
        };
        apart += f64::from((found - exact).abs());
        whole += f64::from(exact);
    }
    apart / whole
}

/// Mean over clusters, weighted by flux, of [`far_error`].
fn mean_far_error(name: &str, settings: &str, specular: bool) -> f64 {
    let (map, lights) = clusters(name, settings);
    let (mut sum, mut weights) = (0.0, 0.0);
    for cluster in 0..lights.count as usize {
        let flux = if specular {
            lights.specular[cluster].f90[1]
        } else {
            lights.diffuse[cluster].intensity[1]
        };
        if flux > 0.0 {
            sum += f64::from(flux) * far_error(&map, &lights, cluster, specular);
            weights += f64::from(flux);
        }
    }
    sum / weights
}

#[test]
fn diffuse_clusters_from_afar_are_the_sum_of_their_texels() {
    // What is left is the closed form of the cosine (1e-4) and that a von Mises-Fisher distribution stands for normals:
    // coarse clusters hold the two sides of an edge, which it does not describe.
    for (name, limit) in [
        ("cornell", 0.005),
        ("roughness-row", 0.005),
        ("caustic-ring", 0.005),
    ] {
        let error = mean_far_error(name, "rsm=64 lights=256", false);
        println!("{name}: {:.3} %", 100.0 * error);
        assert!(error < limit, "{name}: {error}");
    }
}

#[test]
fn specular_clusters_from_afar_are_near_the_sum_of_their_texels() {
    // All metals rough, so that the lobes of neighbouring texels overlap and their sum is smooth. NDF filtering is no
    // exact integral: its own error under lights as wide as those of a curved cluster is what is left.
    for (name, limit) in [("cornell", 0.005), ("roughness-row", 0.09)] {
        let error = mean_far_error(name, "rsm=64 lights=256", true);
        println!("{name}: {:.3} %", 100.0 * error);
        assert!(error < limit, "{name}: {error}");
    }
}

#[test]
fn the_error_from_afar_falls_with_more_clusters() {
    // The specular part is limited by NDF filtering, see above.
    for (specular, factor) in [(false, 0.1), (true, 0.7)] {
        let [few, many] = ["rsm=64 lights=16", "rsm=64 lights=256"]
            .map(|s| mean_far_error("roughness-row", s, specular));
        println!("specular {specular}: {few:.4} {many:.4}");
        assert!(many < factor * few, "{few} {many}");
    }
}

/// A flat cluster that faces upwards.
fn flat() -> DiffuseVsgl {
    DiffuseVsgl {
        variance: 0.01,
        axis: [0.0, 1.0, 0.0],
        sharpness: 1e9,
        intensity: [2.0, 3.0, 4.0],
        light: [0.0, 1.0, 0.0],
        covariance: [0.01, 0.0, 0.01, 0.0, 0.0, 0.0],
        ..DiffuseVsgl::default()
    }
}

#[test]
fn a_flat_cluster_from_afar_is_a_point_light() {
    for distance in [10.0f32, 1e3, 1e5] {
        for degrees in [0.0f32, 30.0, 60.0, 85.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let receiver = Vec3::new(sin, cos, 0.0) * distance;
            let found = incoming_diffuse(&flat(), receiver, Vec3::NEG_Y).strength.y;
            let exact = 3.0 * cos / (distance * distance);
            // 1e-4 of the peak is the cosine's closed form; the cluster's extent counts as its square over the distance's.
            let limit = (1e-4 + 4.0 * 0.01 / (distance * distance)) * 3.0 / (distance * distance);
            assert!(
                (found - exact).abs() < limit,
                "{distance} {degrees}: {found} {exact}"
            );
        }
    }
}

/// Integral of the radiant intensity over the sphere, as seen from far away [W].
fn power(strength: impl Fn(Vec3, Vec3) -> f32) -> f64 {
    let count = 40_000;
    let far = 1e4f32;
    let sum: f64 = (0..count)
        .map(|i| {
            let direction = sphere_point(i, count);
            f64::from(strength(direction * far, -direction)) * f64::from(far * far)
        })
        .sum();
    sum * 4.0 * std::f64::consts::PI / count as f64
}

#[test]
fn diffuse_clusters_send_their_power() {
    // Copper's Lambert part is black; walls are pure Lambert, so nothing is held back by a dielectric layer.
    for name in ["caustic-ring", "many-lights:2"] {
        for emission in ["cosine", "sg"] {
            let (_, lights) = clusters(name, &format!("rsm=64 lights=16 emission={emission}"));
            for light in &lights.diffuse {
                if light.f90 > 0.0 || light.intensity[1] <= 0.0 {
                    continue;
                }
                let (found, expected) = if emission == "cosine" {
                    let found = power(|from, normal| {
                        incoming_diffuse(light, Vec3::from_array(light.position) + from, normal)
                            .strength
                            .y
                    });
                    (found, std::f64::consts::PI * f64::from(light.intensity[1]))
                } else {
                    let found = power(|from, _| {
                        let from = Vec3::from_array(light.position) + from;
                        incoming_sg(
                            light.position,
                            light.variance,
                            light.axis,
                            light.sharpness,
                            light.intensity,
                            from,
                        )
                        .strength
                        .y
                    });
                    let integral = vsgl_core::sg::lobe::integral(light.sharpness);
                    (found, f64::from(integral * light.intensity[1]))
                };
                // 1e-4 from the closed form, the rest from the quadrature.
                assert!(
                    (found / expected - 1.0).abs() < 1e-3,
                    "{name} {emission}: {found} {expected}"
                );
            }
        }
    }
}
